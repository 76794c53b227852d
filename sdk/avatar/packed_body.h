// A body and its clothing size as a packet for the network: shape values in 10 bits each, scale, collider
// radii to a millimetre, a size label.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "avatar/avatar.h"

namespace vfit {

struct PackedBody {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    std::vector<float> shape;  // of the body model
    Vec2 scale{1.0f};
    std::array<float, kPaperJointCount> radii{};  // 0: not measured
    std::string size_label;
};

inline constexpr size_t kMaxPackedBodyBytes = 240;
inline constexpr size_t kMaxPackedLabel = 19;

/// VFIT_ERROR_ARGUMENT for a longer label.
std::vector<uint8_t> pack_body(const BodyModel& model, const PackedBody& body);

/// VFIT_ERROR_VERSION for a packet of another version or another body model, VFIT_ERROR_DATA for a damaged
/// one.
PackedBody unpack_body(const BodyModel& model, std::span<const uint8_t> bytes);

}  // namespace vfit
