#include "refit/clear_of_skin.h"

#include <algorithm>
#include <numeric>

#include "cloth/crossings.h"

namespace vfit {

namespace {

/// Hands may be anywhere, and arms press against the trunk: cloth can only keep clear of skin that it hangs
/// beside.
float beside_m(BodyPart cloth, BodyPart skin) { return !is_arm(skin) ? 0.2f : is_arm(cloth) ? 0.12f : 0.05f; }

/// Legs pass each other, and arms the trunk: what one wears cannot go out of the way of the other.
bool are_apart(BodyPart a, BodyPart b) {
    enum Limb : uint8_t { kNone, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
    constexpr Limb kLimbs[kBodyPartCount] = {kNone,     kNone,     kLeftArm,  kLeftArm, kLeftArm,
                                             kRightArm, kRightArm, kRightArm, kLeftLeg, kLeftLeg,
                                             kLeftLeg,  kRightLeg, kRightLeg, kRightLeg};
    const Limb first = kLimbs[size_t(a)], second = kLimbs[size_t(b)];
    return first != kNone && second != kNone && first != second;
}

}  // namespace

ClearOfSkin::ClearOfSkin(const CharacterBody& body, const MeshQuery& skin, const Character& character,
                         std::span<const uint8_t> hidden, std::span<const Stand> stands)
    : body_(body), skin_(skin), character_(character), stands_(stands) {
    const std::vector<uint32_t>& indices = character.source.rest.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        if (!hidden[i / 3]) {
            seen_.corners.insert(seen_.corners.end(), &indices[i], &indices[i] + 3);
            seen_.numbers.push_back(uint32_t(i / 3));
        }
}

ClearOfSkin::Seen ClearOfSkin::beside(const BoundCloth& cloth) const {
    const MeshQuery mesh(cloth.positions(), cloth.indices());
    const std::vector<BodyPart>& parts = character_.source.topology->parts;
    Seen out;
    for (size_t i = 0; i + 2 < seen_.corners.size(); i += 3) {
        const uint32_t* t = &seen_.corners[i];
        if (std::none_of(t, t + 3, [&](uint32_t v) {
                return mesh.closest(body_.skin[v]).distance < beside_m(parts[v], parts[v]);
            }))
            continue;
        out.corners.insert(out.corners.end(), t, t + 3);
        out.numbers.push_back(seen_.numbers[i / 3]);
    }
    return out;
}

std::vector<ClearOfSkin::Crossing> ClearOfSkin::find(const BoundCloth& cloth, const Seen& seen,
                                                     std::span<const BoundCloth> below, size_t stand) const {
    const std::vector<Vec3> places = cloth.in(stand);
    const std::vector<uint32_t>& indices = cloth.indices();
    std::vector<Crossing> out;
    for (const TrianglePair& pair :
         crossed_triangles(MeshView{places, indices}, MeshView{stands_[stand].skin, seen.corners})) {
        const uint32_t vertex = seen.corners[3 * pair.second];
        const BodyPart part = character_.source.topology->parts[vertex];
        const BodyPart worn_on = cloth.parts()[indices[3 * pair.first]];
        if (are_apart(part, worn_on)) continue;
        if (glm::distance(cloth.positions()[indices[3 * pair.first]], body_.skin[vertex]) <
            beside_m(worn_on, part))
            out.push_back({pair.first, vertex, seen.numbers[pair.second]});
    }
    // Cloth over cloth goes by the same bones: only where it lies.
    for (const BoundCloth& inner : stand == 0 ? below : std::span<const BoundCloth>())
        for (const TrianglePair& pair :
             crossed_triangles(MeshView{places, indices}, MeshView{inner.in(stand), inner.indices()}))
            out.push_back({pair.first, UINT32_MAX, UINT32_MAX});
    return out;
}

void ClearOfSkin::push(BoundCloth& cloth, std::span<const Crossing> crossings,
                       std::span<const Vec3> start) const {
    constexpr float kStep_m = 0.002f, kLeast_m = 0.002f, kFarthest_m = 0.04f;
    std::vector<float> ways(cloth.positions().size(), 0.0f);
    for (const Crossing& crossing : crossings) {
        const bool inwards = crossing.vertex != UINT32_MAX && body_.of_head[crossing.vertex] > 0.5f;
        for (size_t k = 0; k < 3; ++k) {
            float& way = ways[cloth.indices()[3 * crossing.triangle + k]];
            if (way <= 0.0f) way = inwards ? -kStep_m : kStep_m;
        }
    }
    // Cloth beside what crosses goes along, less and less.
    constexpr float kStays = 0.05f, kStiff = 0.5f;
    constexpr int kRounds = 20;
    std::vector<Vec3> wanted(ways.size(), Vec3(0.0f));
    std::vector<float> weights(ways.size(), kStays);
    for (size_t v = 0; v < ways.size(); ++v) {
        if (ways[v] == 0.0f) continue;
        const MeshQuery::Closest closest = skin_.closest(cloth.positions()[v]);
        if (ways[v] < 0.0f && closest.distance < kLeast_m - ways[v]) continue;
        wanted[v] = ways[v] * closest.normal, weights[v] = 1.0f;
    }
    const std::vector<Vec3> shifts = cloth.membrane().even(wanted, weights, kStiff, kRounds);
    for (size_t v = 0; v < ways.size(); ++v)
        if (const Vec3 to = cloth.positions()[v] + shifts[v]; glm::distance(to, start[v]) < kFarthest_m)
            cloth.positions()[v] = to;
}

void ClearOfSkin::go_with(BoundCloth& cloth, std::span<const Crossing> crossings) const {
    const AvatarSource& character = character_.source;
    std::vector<BoundCloth::GoesWith> list;
    for (const Crossing& crossing : crossings) {
        const uint32_t skin = crossing.vertex;
        if (skin == UINT32_MAX || body_.of_head[skin] > 0.5f) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = cloth.indices()[3 * crossing.triangle + k];
            // At the armpit, cloth of the trunk that went with the arm would stand off as that is raised.
            if (is_arm(character.topology->parts[skin]) && !is_arm(cloth.parts()[vertex])) continue;
            list.push_back({vertex, &character.skin_bones[skin], &character.skin_weights[skin]});
        }
    }
    if (!list.empty()) cloth.go_with(list);
}

void ClearOfSkin::clear(BoundCloth& cloth, std::span<const BoundCloth> below) const {
    constexpr int kTries = 4, kPushes = 8;
    const std::vector<Vec3> start = cloth.positions();
    const Seen seen = beside(cloth);
    std::vector<size_t> all(stands_.size());
    std::iota(all.begin(), all.end(), size_t(0));
    // Crossings in these stands, which are those left.
    const auto find_in = [&](std::vector<size_t>& stands) {
        std::vector<Crossing> crossings;
        std::vector<size_t> left;
        for (const size_t stand : stands) {
            const std::vector<Crossing> here = find(cloth, seen, below, stand);
            if (!here.empty()) left.push_back(stand);
            crossings.insert(crossings.end(), here.begin(), here.end());
        }
        stands = std::move(left);
        return crossings;
    };
    BoundCloth::State best = cloth.state();
    size_t least = SIZE_MAX;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        std::vector<size_t> stands = all;
        std::vector<Crossing> crossings = find_in(stands);
        for (int round = 0; round < kPushes && !crossings.empty(); ++round) {
            push(cloth, crossings, start);
            crossings = find_in(stands);
        }
        stands = all;
        crossings = find_in(stands);
        constexpr double kHelps = 0.8;
        const bool helps = double(crossings.size()) < kHelps * double(least);
        if (crossings.size() < least) least = crossings.size(), best = cloth.state();
        if (crossings.empty()) return;
        if (!helps) break;
        if (attempt + 1 < kTries) go_with(cloth, crossings);
    }
    cloth.restore(std::move(best));
}

std::vector<uint32_t> ClearOfSkin::still_crossing(const BoundCloth& cloth) const {
    const Seen seen = beside(cloth);
    std::vector<uint32_t> out;
    for (size_t stand = 0; stand < stands_.size(); ++stand)
        for (const Crossing& crossing : find(cloth, seen, {}, stand)) out.push_back(crossing.skin);
    return out;
}

uint32_t ClearOfSkin::crossings(const BoundCloth& cloth) const {
    return uint32_t(crossed_triangles(MeshView{cloth.positions(), cloth.indices()},
                                      MeshView{stands_[0].skin, seen_.corners})
                        .size());
}

}  // namespace vfit
