// Which part of a garment meets which arm.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/garment/garment.h"
#include "math/types.h"

namespace vfit {

/// Categories of the skin's vertices and masks of the garment's (MeshFilter).
struct ArmFilter {
    std::vector<uint8_t> category, mask;

    MeshFilter filter() const { return {category, mask}; }
};

/// A sleeve meets the forearm and the hand that are in it, not those of the other arm. All other cloth meets
/// both arms; without `hands` it meets neither forearms nor hands. skin: the body part of each vertex of the
/// skin. rest: the garment, which has sleeves, on the body at rest, whose left is +x; one a vertex.
ArmFilter arm_filter(std::span<const BodyPart> skin, const Garment& garment, std::span<const Vec3> rest,
                     bool hands);

}  // namespace vfit
