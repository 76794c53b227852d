// The part of the avatar's body that a garment can meet: its skin as a mesh, or shapes that fill it.
#pragma once

#include <span>
#include <vector>

#include "avatar/creases.h"
#include "body/collider.h"
#include "cloth/garment/dress.h"

namespace vfit {

/// Which parts of the arms cloth meets; through the others it passes.
struct ArmsMet {
    bool forearms = true, hands = true;
};

/// One a body vertex, 1: from a hand above the garment's upper edge to a foot's length below its hem, and the
/// arms.
std::vector<uint8_t> below_garment(const DressBody& body, std::span<const Vec3> garment, ArmsMet arms);

/// Of the skin as cloth meets it (wrapped_skin.h), what is below the garment.
struct SkinBelow {
    Skin skin;
    std::vector<uint32_t> indices;  // three a triangle
    Creases::Mesh creased;          // the same vertices
};
/// `creases` are those of the body.
SkinBelow skin_below(const DressBody& body, std::span<const Vec3> wrapped, std::span<const uint8_t> below,
                     const Creases& creases);

/// Spheres and capsules beside the colliders of the body at rest, so many that none of its skin `below`, but
/// for hands and feet, is further than tolerance_m outside of all. They stick out of the skin by no more than
/// that, and go with the bones that carry the skin that they touch.
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
