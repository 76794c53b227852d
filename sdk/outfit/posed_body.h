// The body in a pose as the solid that a garment is worn on. What the host puts beside the body is moved out
// of it, with room for cloth: else the cloth between the two could be on neither's outside.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "avatar/creases.h"
#include "body/collider.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/garment/dress.h"
#include "core/jobs.h"
#include "outfit/contact_skin.h"
#include "outfit/skin_below.h"

namespace vfit {

class PosedBody {
public:
    /// Of spheres and capsules.
    explicit PosedBody(const Creases& creases) : creases_(creases) {}
    /// Of the skin. `creases` are those of the body.
    PosedBody(const DressBody& body, const ContactSkin& skin, const Creases& creases);

    /// From now on in that pose: skinning matrices, one a rig bone, and the colliders of a body that is made
    /// of these. Both must outlive the calls that follow.
    void see(std::span<const Mat4> matrices, std::span<const Collider> colliders);
    /// Moves those of the points that are within the bounds out, to that clearance at least.
    void push_out(float clearance_m, const Bounds& bounds, std::span<Vec3> points, Jobs& jobs);

private:
    void pose_skin(Jobs& jobs);

    const Creases& creases_;
    std::optional<SkinBelow> skin_;
    std::optional<TriangleGroups> triangles_;
    std::span<const Mat4> matrices_;
    std::span<const Collider> colliders_;
    bool is_posed_ = false;  // the skin
    std::vector<Vec3> places_;
    Skin::Scratch scratch_;
};

}  // namespace vfit
