// The obstacles that the avatar's body is to a garment: its skin as a mesh, or its spheres and capsules.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "body/collider.h"
#include "cloth/garment/dress.h"
#include "outfit/cloth_piece.h"
#include "outfit/passing_arms.h"
#include "outfit/posed_body.h"
#include "outfit/skin_below.h"
#include "outfit/skin_cover.h"
#include "outfit/wear_options.h"
#include "outfit/wearer.h"

namespace vfit {

class BodyObstacles {
public:
    /// Of that garment on the body at rest. The wearer's avatar must outlive this.
    BodyObstacles(const Wearer& wearer, const Garment& garment, const Dress& dress,
                  const WearOptions& options);

    /// Adds the skin's mesh to the cloth, where the skin is the obstacle.
    void add_to(ClothPiece cloth);
    /// From all colliders of the posed avatar to those that the cloth meets.
    void select(std::span<const Mat4> matrices, std::vector<Collider>& colliders, Jobs& jobs);
    /// Moves the skin's mesh with these skinning matrices, one a rig bone.
    void move_skin(std::span<const Mat4> matrices, ClothPiece cloth, Jobs& jobs);
    /// The body as a solid, as the skin was moved last, or of selected colliders. Valid until one of them
    /// changes.
    PosedBody& posed(std::span<const Collider> colliders);
    /// With that fraction of the step behind the cloth, dt after the last time.
    void let_arms_pass(ClothPiece cloth, float share, float dt, Jobs& jobs);
    /// Arms that passed meet the cloth, before it is put on.
    void meet_arms(ClothPiece cloth);

private:
    const Creases& creases_;
    bool forearms_;                   // and hands; false: they pass through the cloth
    std::optional<PosedBody> posed_;  // made when first asked for
    std::optional<SkinBelow> skin_;
    std::optional<PassingArms> arms_;  // none: all meet all
    std::optional<SkinCover> cover_;
    uint32_t skin_mesh_ = 0;
    std::vector<Vec3> skin_before_, skin_positions_, cover_centers_;
    Skin::Scratch scratch_;
};

}  // namespace vfit
