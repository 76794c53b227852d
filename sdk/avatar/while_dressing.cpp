// The avatar while a garment is put on. Put on in the pose, a skirt would start between two legs that step, or
// around a hand; on a body that stands straight and then moves into the pose it is pushed to its place.
#include "avatar/avatar.h"

namespace vfit {

namespace {

constexpr float kArmsOutRad = 0.9f;  // of the upper arms below the T-pose: clear of the trunk and of a flared skirt

Quat straight(int bone) {
    const float turn = bone == VFIT_BONE_LEFT_UPPER_ARM    ? -kArmsOutRad
                       : bone == VFIT_BONE_RIGHT_UPPER_ARM ? kArmsOutRad
                                                           : 0.0f;
    return glm::angleAxis(turn, Vec3(0, 0, 1));
}

}  // namespace

void Avatar::while_dressing(float share, std::span<Mat4> matrices, std::vector<Collider>& out) const {
    Pose pose = pose_;
    for (int bone = 0; bone < kBoneCount; ++bone) {
        if (bone == VFIT_BONE_HIPS) continue;
        Quat& rotation = pose.rotation[static_cast<size_t>(bone)];
        rotation = glm::slerp(straight(bone), glm::normalize(rotation), share);
    }
    PosedSkeleton posed;
    rig_.pose(pose, posed, matrices);
    colliders_of(matrices, out);
}

}  // namespace vfit
