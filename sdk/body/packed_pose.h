// A pose as a packet for the network: each rotation by its three smaller parts, 11 bits each, 0.1 degrees off
// at most; the hips to a tenth of a millimetre. In the library's own axes, so that hosts of different engines
// understand it.
#pragma once

#include <array>
#include <span>

#include "body/skeleton.h"

namespace vfit {

inline constexpr size_t kPackedPoseBytes = 115;

/// VFIT_ERROR_DATA where a rotation is not of unit length or not finite, or the hips are more than 800 m
/// away. What the foot stage did (root_correction, foot_correction_m) stays at home.
std::array<uint8_t, kPackedPoseBytes> pack_pose(const Pose& pose);

/// VFIT_ERROR_VERSION for a packet of another version, VFIT_ERROR_DATA for anything else that pack_pose did
/// not make.
Pose unpack_pose(std::span<const uint8_t> bytes);

}  // namespace vfit
