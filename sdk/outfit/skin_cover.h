// Further spheres and capsules that fill the part of the avatar's body that a garment can touch: the paper's
// future work.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "avatar/skin.h"
#include "body/collider.h"
#include "cloth/garment/dress.h"

namespace vfit {

/// Spheres and capsules beside the colliders of the body at rest: as many as are needed until no skin
/// `below`, except hands and feet, is further than tolerance_m outside of all of them. They stick out of the
/// skin by at most as much, and move with the bones of the skin that they touch.
class SkinCover {
public:
    SkinCover(const DressBody& body, std::span<const uint8_t> below, std::span<const Collider> colliders,
              float tolerance_m);

    size_t size() const { return shapes_.size(); }
    /// Adds those that the skinning matrices carry.
    void append(std::span<const Mat4> matrices, std::vector<Collider>& out, Skin::Scratch& scratch,
                std::vector<Vec3>& places, Jobs& jobs) const;

private:
    std::vector<Collider> shapes_;
    std::optional<Skin> skin_;  // of their centres, two a capsule
};

}  // namespace vfit
