// Which part of a garment meets which arm.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/garment/garment.h"
#include "math/types.h"

namespace vfit {

/// Forearms with their hands.
enum class Arm : uint8_t { left, right };
inline constexpr std::array kArms{Arm::left, Arm::right};

/// Categories of the skin's vertices and masks of the garment's (MeshFilter).
struct ArmFilter {
    std::vector<uint8_t> category, mask;

    MeshFilter filter() const { return {category, mask}; }
    static constexpr uint8_t category_of(Arm arm) { return uint8_t(2u << uint8_t(arm)); }
};

/// A sleeve meets the arm that is in it, not the other one. All other cloth meets both; without `hands` it
/// meets neither. skin: the body part of each vertex of the skin. rest: the garment on the body at rest,
/// whose left is +x; one a vertex.
ArmFilter arm_filter(std::span<const BodyPart> skin, const Garment& garment, std::span<const Vec3> rest,
                     bool hands);

}  // namespace vfit
