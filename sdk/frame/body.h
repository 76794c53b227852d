// What a tracker says about one person: joints with state and confidence. Joint ids are VFIT_JOINT_* of
// vfit.h. The space (camera or world) is that of whoever holds the value: frames hold world space.
#pragma once

#include <array>
#include <cstdint>

#include "math/types.h"
#include "vfit.h"

namespace vfit {

inline constexpr int kJointCount = VFIT_JOINT_COUNT;
inline constexpr int kPaperJointCount = 15;  // the first 15 ids are the paper's joints (Fig. 3)

struct Joint {
    vfit_joint_state state = VFIT_JOINT_NOT_SEEN;
    float confidence = 0.0f;
    Vec3 position{0.0f};
    Quat rotation{1, 0, 0, 0};  // world, relative to a T-pose that faces +Z
    bool has_rotation = false;

    bool seen() const { return state != VFIT_JOINT_NOT_SEEN; }
};

inline constexpr float kSureFacing = 3.0f;

struct Body {
    uint32_t id = 0;
    int64_t time_ns = 0;
    uint32_t flags = 0;  // VFIT_BODY_*
    // Logit that the person faces this way and not the opposite one, by this frame alone. A body of a source
    // or of the host is taken as certain.
    float facing_logit = kSureFacing;
    std::array<Joint, kJointCount> joints{};  // by id

    bool has(int joint) const { return joints[static_cast<size_t>(joint)].seen(); }
    const Vec3& at(int joint) const { return joints[static_cast<size_t>(joint)].position; }
    void set(int joint, const Vec3& position, vfit_joint_state state = VFIT_JOINT_MEASURED,
             float confidence = 1.0f) {
        Joint& j = joints[static_cast<size_t>(joint)];
        j.position = position;
        j.state = state;
        j.confidence = confidence;
    }
};

/// Whom a tracker serves.
struct ActiveBody {
    uint32_t id = 0;  // 0: nobody
    vfit_active_state state = VFIT_ACTIVE_NOBODY;
};

/// "LEFT_ELBOW" for VFIT_JOINT_LEFT_ELBOW; null for an unknown id.
const char* joint_name(int joint);

/// The id of a joint name, or -1.
int joint_from_name(const char* name);

/// A joint of the C ABI, as it stands: no space is changed. Fails with VFIT_ERROR_ARGUMENT for an unknown id
/// or state, with VFIT_ERROR_DATA naming the joint where a number is not finite.
Joint joint_in(const vfit_joint& in);

/// The joint of the other side; middle joints are their own mirror.
int mirrored_joint(int joint);

}  // namespace vfit
