// Motion of one person: tracked joints in, the clean pose of a humanoid skeleton out (paper 3.3). Stages:
// position filter, rotations from positions, joint limits, rotation smoothing, planting of the feet.
#pragma once

#include <cstdint>
#include <memory>

#include "body/range_of_motion.h"
#include "body/skeleton.h"
#include "frame/body.h"
#include "motion/position_filter.h"

namespace vfit {

struct MotionSettings {
    uint32_t flags = 0;  // VFIT_MOTION_*
    PositionFilterSettings filter;
    vfit_contact_rule contact_rule = VFIT_CONTACT_LEARNT;
    float prediction_s = 0.0f;               // how far ahead of now, to hide latency
    float rotation_divisor = 2.0f;           // k of Eq. 10, per 1/30 s
    float rotation_divisor_switched = 4.0f;  // k right after the planted foot changed
    RangeOfMotion range_of_motion = RangeOfMotion::natural();
};

class Motion {
public:
    /// Fails with VFIT_ERROR_ARGUMENT naming the field that is out of range.
    explicit Motion(const MotionSettings& settings);
    ~Motion();
    Motion(Motion&&) noexcept;
    Motion& operator=(Motion&&) noexcept;

    /// The proportions whose feet are planted. Without: lengths measured from the tracked person.
    void bind(const Skeleton& skeleton);

    /// Takes a body in world space if its time differs from the last one's; body null or not new: predicts
    /// to now_ns. A body of another id, or one that goes back in time, starts anew. Returns false, and the
    /// pose is the T-pose, while nobody was seen whose trunk can be placed. Fails with VFIT_ERROR_DATA naming
    /// the joint that is not finite, far outside of any room, or has no valid rotation; the state is then
    /// unchanged. Does not allocate.
    bool step(const Body* body, int64_t now_ns);

    const Pose& pose() const;
    /// The person's filtered joints, feet corrected. Joints that are lost are VFIT_JOINT_INFERRED.
    const Body& joints() const;
    /// The bound skeleton, or the person's.
    const Skeleton& skeleton() const;

    void reset();  // forgets the person, keeps settings and binding

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vfit
