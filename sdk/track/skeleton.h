// From the network's maps to joints in camera space, and which side is left.
#pragma once

#include <array>

#include "frame/body.h"
#include "track/crop.h"
#include "track/joint_network.h"

namespace vfit {

/// One joint as a crop shows it.
struct SeenJoint {
    Vec3 position{0.0f};      // camera space
    float confidence = 0.0f;  // share of the heat within kNear_m of the place
};

/// Joints as if the person faced the sensor: what is left is on the image's right.
using SeenJoints = std::array<SeenJoint, kJointCount>;

inline constexpr float kNear_m = 0.10f;

void read_maps(const JointMaps& maps, const CropView& view, const Camera& camera, SeenJoints& out);

/// Decides, frame by frame, whether the person's left is the image's right or left. Front and back look alike
/// in depth, and one frame's answer may be wrong: the sides that carry on the last frame's joints stand until
/// the network has disagreed for a while.
class Facing {
public:
    /// Exchanges left and right in `joints` where the person faces away.
    void apply(float away_logit, SeenJoints& joints);
    bool away() const { return away_; }
    /// The decision as it stands; of somebody new what the network says.
    bool away(float away_logit) const { return known_ ? away_ : away_logit > 0.0f; }

private:
    bool known_ = false, away_ = false;
    float doubt_ = 0.0f;  // evidence against the present decision, summed with decay
    SeenJoints last_{};
};

}  // namespace vfit
