// The avatar while a garment is put on. Put on in the pose, a skirt would start between two legs that step,
// or around a hand; on a body that stands straight and then moves into the pose it is pushed to its place.
// Arms and legs stand apart at first: where limbs touch, the cloth that they carry would begin crossed.
#include "avatar/avatar.h"

namespace vfit {

namespace {

// Of the upper arms below the T-pose: clear of the trunk and of a flared skirt, also where that goes past
// another.
constexpr float kArmsOutRad = 0.4f;
constexpr float kLegsOutRad = 0.12f;  // of each leg: the legs of wide trousers are clear of each other

Quat straight(int bone) {
    const float turn = bone == VFIT_BONE_LEFT_UPPER_ARM    ? -kArmsOutRad
                       : bone == VFIT_BONE_RIGHT_UPPER_ARM ? kArmsOutRad
                       : bone == VFIT_BONE_LEFT_UPPER_LEG  ? kLegsOutRad
                       : bone == VFIT_BONE_RIGHT_UPPER_LEG ? -kLegsOutRad
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

void Avatar::while_closing_legs(float share, std::span<Mat4> matrices, std::vector<Collider>& out) const {
    const std::vector<AvatarBone>& bones = rig_.bones();
    std::copy(matrices_.begin(), matrices_.end(), matrices.begin());
    std::vector<uint8_t> of_leg(bones.size(), 0);
    Mat4 hips(1.0f);
    for (size_t i = 0; i < bones.size(); ++i) {
        const int bone = bones[i].bone;
        if (bone == VFIT_BONE_HIPS) hips = matrices_[i];
        of_leg[i] = bone == VFIT_BONE_LEFT_UPPER_LEG || bone == VFIT_BONE_RIGHT_UPPER_LEG ||
                    (bones[i].parent >= 0 && of_leg[size_t(bones[i].parent)]);
        if (!of_leg[i]) continue;
        // Rigid all the way: the bone's head goes straight, the bone turns about it.
        const Vec3 head = bones[i].rest_head;
        const Vec3 from = Vec3(hips * Vec4(head, 1.0f)), to = Vec3(matrices_[i] * Vec4(head, 1.0f));
        const Mat3 turn =
            glm::mat3_cast(glm::slerp(glm::quat_cast(Mat3(hips)), glm::quat_cast(Mat3(matrices_[i])), share));
        Mat4 between(turn);
        between[3] = Vec4(glm::mix(from, to, share) - turn * head, 1.0f);
        matrices[i] = between;
    }
    colliders_of(matrices, out);
}

}  // namespace vfit
