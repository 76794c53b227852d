// The body in a pose as the solid that a garment is worn on. Props are moved out of it, with room for cloth:
// otherwise no place between the two would be outside of both.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/collider.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/triangle_groups.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

class PosedBody {
public:
    /// Of a skin with these triangles, which may be open; without any, of spheres and capsules.
    explicit PosedBody(std::span<const uint32_t> indices);

    /// From now on it is there: vertices of the skin, and colliders. Both must outlive the calls that follow.
    void see(std::span<const Vec3> skin, std::span<const Collider> colliders);

    /// Points that the host moves.
    struct Points {
        std::vector<Vec3> at, before;  // moved out; as the host has them, in the step before
        std::vector<float> outside_m;  // of the skin, at least, as the host has them; below 0: may be inside
    };
    /// Takes the places that the host has, and moves those within the bounds out, to that clearance.
    void move(std::span<const Vec3> places, float clearance_m, const Bounds& bounds, Points& points,
              Jobs& jobs);

private:
    void find_skin(Jobs& jobs);
    float push_out_of_skin(float reach_m, float clearance_m, Vec3& p) const;
    void push_out_of_colliders(float clearance_m, Vec3& p) const;

    std::vector<uint32_t> indices_;
    std::vector<uint8_t> at_border_;  // one a triangle
    std::optional<TriangleGroups> triangles_;
    std::span<const Vec3> skin_;
    std::vector<Vec3> last_skin_;  // that was found
    std::span<const Collider> colliders_;
    std::vector<CapsuleShape> shapes_;
    float skin_way_m_ = 0.0f;  // since then, at most
    bool is_found_ = false;    // triangles and way are those of the skin now
};

}  // namespace vfit
