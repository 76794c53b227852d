#include "outfit.h"

#include <algorithm>
#include <cmath>

#include "client/assets.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr float kBetweenLayers_m =
    0.006f;  // of a fold: more than a quarter of an edge of 20 mm, as docs/cloth.md asks for
constexpr float kSlides_m = 0.08f;  // a sleeve along an arm that is raised: so far from its hem skin stays
constexpr Color kSkin{0.86f, 0.67f, 0.56f},
    kPlain{0.80f, 0.27f, 0.30f};  // of a garment that has no colour of its own
constexpr float kSheen = 0.35f;
constexpr float kTopShare = 0.02f;  // of a garment's vertices: its upper edge

float shown(float linear) { return std::pow(linear, 1.0f / 2.2f); }  // as the ray tracer takes it back

float upper_edge_m(vfit_cloth cloth) {
    Frame frame;
    check(vfit_cloth_acquire(cloth, frame.out()));
    std::vector<float> heights;
    for (const auto& p : items_of<glm::vec3>(frame.get(), VFIT_STREAM_POSITION)) heights.push_back(p.y);
    const auto edge = heights.begin() + std::ptrdiff_t(kTopShare * float(heights.size()));
    std::nth_element(heights.begin(), edge, heights.end(), std::greater<>());
    return *edge;
}

RenderMesh mesh_of(vfit_frame frame) {
    RenderMesh mesh;
    mesh.positions = items_of<glm::vec3>(frame, VFIT_STREAM_POSITION);
    mesh.normals = items_of<glm::vec3>(frame, VFIT_STREAM_NORMAL);
    return mesh;
}

}  // namespace

const std::vector<Outfit>& outfits() {
    static const std::vector<Outfit> all = {
        {"sundress", VFIT_SEX_FEMALE, {"sundress_pattern"}},
        {"duster", VFIT_SEX_FEMALE, {"sundress_pattern", "duster"}},
        {"jeans and vest", VFIT_SEX_FEMALE, {"jeans_women", "vest"}},
        {"flight suit", VFIT_SEX_MALE, {"flight_suit"}},
        {"pants and shirt", VFIT_SEX_MALE, {"pants_men", "shirt_men"}},
        {"martial suit", VFIT_SEX_MALE, {"martial_pants", "martial_jacket"}}};
    return all;
}

const Outfit& outfit(std::string_view name) {
    for (const Outfit& o : outfits())
        if (o.name == name) return o;
    throw Failure("there is no outfit " + std::string(name));
}

Worn::Worn(vfit_context context, vfit_avatar avatar, const Outfit& outfit) : avatar_(avatar) {
    Frame rest;
    check(vfit_avatar_acquire_rest(avatar, rest.out()));
    const auto skin = items_of<uint32_t>(rest.get(), VFIT_STREAM_INDEX);
    std::vector<uint8_t> hidden(skin.size() / 3);
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN;  // hands too: a sleeve needs a forearm in it
    desc.self_thickness_m = kBetweenLayers_m;
    for (const std::string& name : outfit.garments) {
        Piece piece{name, open_garment(context, name), {}};
        check(vfit_cloth_create(avatar, piece.garment.get(), &desc, piece.cloth.out()));
        for (const Piece& inner : pieces_) check(vfit_cloth_wear_over(piece.cloth.get(), inner.cloth.get()));
        check(vfit_cloth_hide_skin(piece.cloth.get(), kSlides_m, hidden.data(), uint32_t(hidden.size())));
        pieces_.push_back(std::move(piece));
    }
    for (size_t t = 0; t < hidden.size(); ++t)
        if (!hidden[t]) seen_skin_.insert(seen_skin_.end(), &skin[3 * t], &skin[3 * t] + 3);
}

void Worn::put_on(float rest_s) {
    for (Piece& piece : pieces_) {
        check(vfit_cloth_reset(piece.cloth.get()));
        piece.top_m = upper_edge_m(piece.cloth.get());
    }
    for (float time_s = 0.0f; time_s < rest_s; time_s += kFrame_s) step(kFrame_s);
}

void Worn::step(float dt) {
    for (const Piece& piece : pieces_) check(vfit_cloth_step(piece.cloth.get(), dt));
}

std::vector<RenderMesh> Worn::meshes() const {
    std::vector<vfit_cloth> cloths;
    for (const Piece& piece : pieces_) cloths.push_back(piece.cloth.get());
    Frame body;
    check(vfit_outfit_skin(cloths.data(), uint32_t(cloths.size()), body.out(), nullptr));
    std::vector<RenderMesh> out{mesh_of(body.get())};
    out[0].indices = seen_skin_;
    out[0].color = kSkin;
    for (const Piece& piece : pieces_) {
        Frame frame;
        check(vfit_cloth_acquire(piece.cloth.get(), frame.out()));
        const auto indices = items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX);
        auto parts = list<vfit_garment_part>([&](auto* items, uint32_t stride, uint32_t* count) {
            return vfit_garment_parts(piece.garment.get(), items, stride, count);
        });
        const bool plain = parts.empty();
        if (plain) {
            parts.push_back(vfit_garment_part_init());
            parts[0].index_count = uint32_t(indices.size());
        }
        for (const vfit_garment_part& part : parts) {
            RenderMesh mesh = mesh_of(frame.get());
            mesh.indices.assign(&indices[part.first_index], &indices[part.first_index] + part.index_count);
            mesh.color =
                plain ? kPlain : Color{shown(part.color[0]), shown(part.color[1]), shown(part.color[2])};
            mesh.sheen = kSheen;
            out.push_back(std::move(mesh));
        }
    }
    return out;
}

Json Worn::report() const {
    Json out = Json::object();
    for (const Piece& piece : pieces_) {
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        check(vfit_cloth_describe(piece.cloth.get(), &stats));
        out[piece.name] = {{"strain_p99", stats.strain_p99},
                           {"strain_max", stats.strain_max},
                           {"sank_m", piece.top_m - upper_edge_m(piece.cloth.get())}};
    }
    return out;
}

}  // namespace vfit::tools
