// From the network's maps to joints in camera space, and which side is left.
#pragma once

#include <array>
#include <span>

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

/// Decides, frame by frame, whether the person's left is the image's right or left: the probability that they
/// face away. From frame to frame it stays, or becomes that of the opposite where joints carry on the last
/// frame's with left and right exchanged, as in a turn past the side view. Where they carry on neither, as
/// after a cut, it is open again. The network's answer is then added to it; front and back look alike in
/// depth, and one frame's answer may be wrong.
class Facing {
public:
    /// Exchanges left and right in `joints` where the person faces away. up: in the joints' space.
    /// `elsewhere`: people as other cameras see them, in the same space; the one at this person's position
    /// counts.
    void apply(float away_logit, const Vec3& up, SeenJoints& joints, std::span<const Body> elsewhere = {});
    /// Logit of the present decision by the last frame alone.
    float agreement() const { return away() ? said_ : -said_; }
    bool away() const { return log_odds_ > 0.0f; }
    /// The decision as it stands; of somebody new what the network says.
    bool away(float away_logit) const { return known_ ? away() : away_logit > 0.0f; }

private:
    bool known_ = false;
    float log_odds_ = 0.0f;  // that the person faces away
    float said_ = 0.0f;      // the same, by the last frame of this camera alone
    SeenJoints last_{};      // as if they faced the sensor
};

}  // namespace vfit
