#include "outfit/body_obstacles.h"

#include <utility>

namespace vfit {

namespace {

/// A forearm or a hand: sphere or capsule that starts or ends at a hand.
bool is_forearm(const Collider& c) {
    const auto hand = [](int joint) {
        return joint == VFIT_JOINT_LEFT_HAND || joint == VFIT_JOINT_RIGHT_HAND;
    };
    return hand(c.joint) || hand(c.joint_b);
}

}  // namespace

BodyObstacles::BodyObstacles(const Wearer& wearer, const Garment& garment, const Dress& dress,
                             const WearOptions& options)
    : creases_(wearer.avatar().creases()),
      forearms_(options.hands || garment.has_sleeves()) {  // without its forearm a sleeve collapses
    if (!options.on_skin && options.cover_m <= 0.0f) return;
    const DressBody body = wearer.body();
    const bool in_sleeves = options.on_skin && garment.has_sleeves();
    const std::vector<uint8_t> below =
        below_garment(body, dress.rest(), {forearms_, options.hands || in_sleeves});
    if (options.on_skin) {
        skin_ = skin_below(body, wearer.contact_skin(), below, creases_);
        if (body.parts.empty() || (!in_sleeves && !options.hands)) return;
        std::vector<BodyPart> parts;
        for (const uint32_t v : skin_->vertices) parts.push_back(body.parts[v]);
        arms_.emplace(arm_filter(parts, garment, dress.rest(), options.hands), skin_->indices);
        return;
    }
    std::vector<Collider> colliders;
    wearer.avatar().rest_colliders(colliders);
    if (!forearms_) std::erase_if(colliders, is_forearm);
    cover_.emplace(body, below, colliders, options.cover_m);
}

void BodyObstacles::add_to(ClothPiece cloth) {
    if (skin_)
        skin_mesh_ = cloth.add_mesh(skin_->skin.vertex_count(), skin_->indices, MeshOf::solid,
                                    arms_ ? arms_->filter() : MeshFilter());
}

void BodyObstacles::select(std::span<const Mat4> matrices, std::vector<Collider>& colliders, Jobs& jobs) {
    if (skin_)
        colliders.clear();
    else if (!forearms_)
        std::erase_if(colliders, is_forearm);
    if (cover_) cover_->append(matrices, colliders, scratch_, cover_centers_, jobs);
}

void BodyObstacles::move_skin(std::span<const Mat4> matrices, ClothPiece cloth, Jobs& jobs) {
    if (!skin_) return;
    std::swap(skin_before_, skin_positions_);
    skin_->skin.carry(matrices, skin_positions_, scratch_, jobs);
    creases_.open(matrices, skin_->creased, skin_positions_, jobs);
    cloth.move_mesh(skin_mesh_, skin_positions_);
}

PosedBody& BodyObstacles::posed(std::span<const Collider> colliders) {
    if (!posed_)
        posed_.emplace(skin_ ? std::span<const uint32_t>(skin_->indices) : std::span<const uint32_t>());
    posed_->see(skin_positions_, colliders);
    return *posed_;
}

void BodyObstacles::let_arms_pass(ClothPiece cloth, float share, float dt, Jobs& jobs) {
    if (!arms_) return;
    const bool is_first = skin_before_.empty();
    if (arms_->look(cloth, {is_first ? skin_positions_ : skin_before_, skin_positions_, share}, dt, jobs))
        cloth.set_mesh_mask(skin_mesh_, arms_->mask());
}

void BodyObstacles::meet_arms(ClothPiece cloth) {
    if (!arms_) return;
    arms_->meet_again();
    cloth.set_mesh_mask(skin_mesh_, arms_->mask());
}

}  // namespace vfit
