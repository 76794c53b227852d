#include "refit/refit.h"

#include <algorithm>

#include "avatar/avatar.h"
#include "cloth/crossings.h"
#include "core/error.h"
#include "geometry/mesh_query.h"
#include "outfit/hidden_skin.h"
#include "outfit/worn_together.h"
#include "refit/bound_cloth.h"
#include "refit/clear_of_skin.h"
#include "refit/hidden_below.h"
#include "refit/stands.h"

namespace vfit {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr int kFrames = 90;  // until it hangs still
constexpr float kOwnLayers_m = 0.003f;
constexpr uint32_t kSubsteps = 16;

std::vector<uint8_t> flags_of(const Character& character, const std::vector<std::string>& taken_off) {
    std::vector<uint8_t> flags(character.source.rest.indices.size() / 3, 0);
    for (const std::string& name : taken_off) {
        bool known = false;
        std::string names;
        for (const CharacterPart& part : character.parts) {
            names += (names.empty() ? "\"" : ", \"") + part.mesh + "\" (" + part.material + ")";
            if (part.mesh != name && part.material != name) continue;
            known = true;
            std::fill_n(flags.begin() + std::ptrdiff_t(part.first_index / 3), part.index_count / 3,
                        uint8_t(1));
        }
        if (!known)
            fail(VFIT_ERROR_ARGUMENT, "the character has no \"", name, "\"; its meshes (materials): ", names);
    }
    if (std::all_of(flags.begin(), flags.end(), [](uint8_t off) { return off != 0; }))
        fail(VFIT_ERROR_ARGUMENT, "nothing of the character is left that could wear a garment");
    return flags;
}

std::vector<Refitted::Outside> outside_of(const Character& character, const CharacterBody& body,
                                          std::span<const uint8_t> left_out) {
    constexpr float kNamed_m = 0.03f;
    std::vector<Refitted::Outside> out;
    for (const CharacterPart& part : character.parts) {
        if (!left_out.empty() && left_out[part.first_index / 3]) continue;
        float most_m = 0.0f;
        for (uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
            most_m = std::max(most_m, body.outside_m[character.source.rest.indices[i]]);
        if (most_m > kNamed_m) out.push_back({part.mesh, part.material, most_m / body.scale});
    }
    return out;
}

/// What is drawn of a simulated garment, and taken from where it was simulated to the character's rest mesh.
void to_rest(const BoundCloth& cloth, const CharacterBody& body, RefittedGarment& out) {
    const Garment& garment = cloth.garment();
    const std::vector<Vec3>& positions = cloth.positions();
    std::vector<Vec3> normals;
    compute_normals(positions, garment.mesh.indices, normals);
    std::vector<Vec3> drawn, drawn_normals;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;
    if (const DrawnMesh& mesh = garment.drawn; !mesh.empty()) {
        const CarryingMesh carrying{garment.mesh.indices, positions, normals};
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            const DrawnFrame frame(carrying, mesh.triangles[i], mesh.weights[i]);
            drawn.push_back(frame.origin + frame.axes * mesh.offsets[i]);
            drawn_normals.push_back(frame.axes * mesh.normals[i]);
            // The corner that is closest.
            const float shares[3] = {1.0f - mesh.weights[i].x - mesh.weights[i].y, mesh.weights[i].x,
                                     mesh.weights[i].y};
            const size_t k = size_t(std::max_element(shares, shares + 3) - shares);
            const uint32_t corner = garment.mesh.indices[3 * mesh.triangles[i] + k];
            bones.push_back(cloth.bones()[corner]), weights.push_back(cloth.weights()[corner]);
        }
    } else {
        drawn.assign(positions.begin(), positions.end()), drawn_normals = normals;
        bones = cloth.bones(), weights = cloth.weights();
        for (const uint32_t of : garment.copies) {
            drawn.push_back(Vec3(drawn[of])), drawn_normals.push_back(Vec3(drawn_normals[of]));
            bones.push_back(SkinBones(bones[of])), weights.push_back(SkinWeights(weights[of]));
        }
    }
    for (size_t v = 0; v < drawn.size(); ++v) {
        const Mat4 back = glm::inverse(blended(bones[v], weights[v], body.from_rest));
        out.positions.push_back(Vec3(back * Vec4(drawn[v], 1.0f)));
        const Vec3 n = Mat3(back) * drawn_normals[v];
        const float length = glm::length(n);
        out.normals.push_back(length > 0.0f ? n / length : Vec3(0, 1, 0));
    }
    out.bones = std::move(bones), out.weights = std::move(weights);
}

/// Skin that is mostly covered and goes through the cloth in some stand: a piece that misses within a hem is
/// less seen than one that comes through.
void hide_what_crosses(std::span<const BoundCloth> cloths, const Character& character,
                       const CharacterBody& body, const ClearOfSkin& seen, std::vector<uint8_t>& hidden,
                       Jobs& jobs) {
    constexpr float kMostly = 0.6f;
    const std::vector<uint32_t>& indices = character.source.rest.indices;
    for (const BoundCloth& cloth : cloths) {
        const std::vector<uint32_t> crossing = seen.still_crossing(cloth);
        if (crossing.empty()) continue;
        const std::vector<float> cover =
            cover_of({body.skin, indices, cloth.positions(), cloth.indices(), false}, jobs);
        for (const uint32_t t : crossing)
            if (std::min({cover[indices[3 * t]], cover[indices[3 * t + 1]], cover[indices[3 * t + 2]]}) >
                kMostly)
                hidden[t] = 1;
    }
}

}  // namespace

Refitted refit(const Character& character, std::span<const Garment> garments,
               const std::shared_ptr<const BodyModel>& model, const FabricLibrary& fabrics,
               const RefitRequest& request, Jobs& jobs) {
    Refitted out;
    const std::vector<uint8_t> taken_off = flags_of(character, request.taken_off);
    const vfit_sex sex = request.sex == VFIT_SEX_UNKNOWN ? garments.front().body_sex : request.sex;
    const CharacterBody body = body_in(character.source, model, sex, taken_off);
    out.scale = body.scale;
    out.outside = outside_of(character, body, taken_off);

    Avatar avatar(body.source, AvatarDesc());
    avatar.pose(avatar.rest_pose(), jobs);
    const Wearer wearer(avatar, sex, 0);
    WearOptions options;
    options.on_skin = true;
    options.any_fit = true;
    options.cloth.self_thickness_m = kOwnLayers_m;
    options.cloth.substeps = kSubsteps;
    std::vector<std::unique_ptr<WearableGarment>> wearable;
    std::vector<std::unique_ptr<WornGarment>> worn;
    std::vector<WornGarment*> all;
    for (const Garment& garment : garments) {
        wearable.push_back(std::make_unique<WearableGarment>(garment, fabrics.get(garment.fabric), model));
        worn.push_back(std::make_unique<WornGarment>(*wearable.back(), wearer, options, jobs));
        all.push_back(worn.back().get());
        for (size_t i = 0; i + 1 < all.size(); ++i) WornTogether(all).wear_over(*all.back(), *all[i]);
    }
    WornTogether together(all);
    together.put_on();
    for (int i = 0; i < kFrames; ++i) {
        together.begin_step(kFrame_s);
        together.step();
        together.end_step();
    }

    const std::vector<Stand> stands = usual_stands(character.source, body);
    std::vector<BoundCloth> cloths;
    for (size_t g = 0; g < all.size(); ++g)
        cloths.emplace_back(garments[g], wearable[g]->bound(0, jobs), body, all[g]->finished().positions(),
                            stands);
    out.garments.resize(cloths.size());
    const MeshQuery skin(wearer.positions(), wearer.indices());
    // What poked through the cloth at first is hidden by it once that has gone out.
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
        out.hidden = hidden_below(cloths, character, body, taken_off, request.margin_m, jobs);
        const ClearOfSkin seen(body, skin, character, out.hidden, stands);
        for (size_t g = 0; g < cloths.size(); ++g) seen.clear(cloths[g], std::span(cloths).first(g));
        if (round + 1 == kRounds) hide_what_crosses(cloths, character, body, seen, out.hidden, jobs);
    }
    const ClearOfSkin seen(body, skin, character, out.hidden, stands);
    for (size_t g = 0; g < cloths.size(); ++g) out.garments[g].skin_crossings = seen.crossings(cloths[g]);
    for (size_t g = 0; g < cloths.size(); ++g) {
        out.garments[g].strain_p99 = all[g]->stats().strain_p99;
        out.garments[g].self_crossings =
            uint32_t(crossed_triangles(cloths[g].positions(), cloths[g].indices()).size());
        to_rest(cloths[g], body, out.garments[g]);
    }
    return out;
}

}  // namespace vfit
