// Walks whose feet roll from heel to toes, as motion capture files: what the contact network learns rolling feet from.
#pragma once

#include <cstdint>
#include <string>

namespace vfit::tools {

/// The text of a BVH file of 120 Hz with CMU's joint names; every seed is another walk.
std::string rolling_gait(uint32_t seed);

}  // namespace vfit::tools
