// Dress: a garment bound to one avatar. Carries the garment from the body it was authored on to the
// avatar's, cooks its fabric there, and skins it with the avatar's bones.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "avatar/skin.h"
#include "body/body_model.h"
#include "cloth/fabric/fabric.h"
#include "cloth/garment/bound_garment.h"
#include "cloth/garment/carry.h"
#include "cloth/garment/garment.h"
#include "cloth/garment/held_shape.h"
#include "cloth/garment/hems.h"
#include "math/types.h"

namespace vfit {

/// The avatar's body as the garment needs it, of the topology of the one that the garment is bound to.
struct DressBody : BoundBody {
    std::span<const LimbChain> limbs;  // whose bones share in the limb's twist
    const MeshQuery& skin;             // of these positions and indices
};

class Dress {
public:
    /// size_ratio: of the rest lengths around the body (size_ratio of garment.h; 1: made to measure), of a
    /// garment that has neither flat triangles nor a cut_shape. thickness_m: the clearance that the carried
    /// garment keeps from the body. size: one of the garment's with lengths of its own (with a cut_shape: the
    /// garment's); null: made to the body, its ease where the author gave it.
    Dress(const Garment& garment, const BoundGarment& bound, const FabricMaterial& material,
          const DressBody& body, float size_ratio = 1.0f, float thickness_m = 0.004f,
          const GarmentSize* size = nullptr, Jobs* jobs = nullptr);

    const std::shared_ptr<const Fabric>& fabric() const { return fabric_; }
    /// The garment's triangles as they are cut in that size, one place an index.
    std::vector<Vec2> cut(const Garment& garment, float size_ratio, const GarmentSize* size) const;
    const std::vector<LimbHem>& hems() const { return hems_; }
    /// What was taken up of sleeves and legs that are too long.
    const TakenUp& taken_up() const { return taken_up_; }
    /// The same garment in another size: as many vertices and targets, other lengths.
    std::shared_ptr<const Fabric> fabric_of(const Garment& garment, const FabricMaterial& material,
                                            float size_ratio, const GarmentSize* size,
                                            TakenUp* taken_up = nullptr, Jobs* jobs = nullptr) const;
    /// The garment on the avatar's rest body; one a garment vertex.
    const std::vector<Vec3>& rest() const { return rest_; }
    const std::vector<uint32_t>& indices() const { return indices_; }
    /// Where the bones carry it from: rest(), and what was lifted over garments below. One a garment vertex.
    std::span<const Vec3> carried_from() const { return std::span(carried_.rest).first(rest_.size()); }
    /// The vertices that hold it: on the shoulders, at the waist.
    const std::vector<uint32_t>& held() const { return held_; }
    /// What holds it goes with the skin, as that of a garment worn below does: from now on so far off that
    /// one, where the two lie on each other.
    void lift_over(const Dress& below, float thickness_m);
    /// What was lifted lies on the skin again.
    void lie_on_skin();
    /// The garment's vertices by the bones that carry them.
    const Carry& carry() const { return *carry_; }

    struct Scratch {
        Skin::Scratch bones;
        std::vector<Vec3> places;
    };
    /// Start and targets of a Cloth, as the avatar's skinning matrices (posed from rest, one a rig bone)
    /// carry them: the garment's vertices, then the backstops' centres.
    void place(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch,
               Jobs& jobs) const;
    /// The same of those alone that a step looks at: of vertices the held and the limited ones. All have
    /// been placed before.
    void follow(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch,
                Jobs& jobs) const;

private:
    std::shared_ptr<const Fabric> fabric_;
    std::vector<Vec3> rest_;
    std::vector<uint32_t> indices_;
    std::vector<uint32_t> held_;
    HeldShape held_shape_;   // of these
    float slides_m_ = 0.0f;  // these, on the skin
    std::vector<Backstop> backstops_;
    std::vector<LimbHem> hems_;
    TakenUp taken_up_;
    void skin();

    std::optional<Carry> carry_;
    Carried carried_;                 // rest_ as it was lifted, then the backstops' centres
    std::optional<Skin> skin_;        // of these
    std::vector<uint32_t> followed_;  // of these
    std::optional<Skin> followed_skin_;
};

}  // namespace vfit
