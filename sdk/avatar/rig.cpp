#include "avatar/rig.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/finite.h"
#include "math/quaternion.h"

namespace vfit {

namespace {

struct LimbEntry {
    int bone, end_bone;
    // The pronation of a hand turns its forearm, not its wrist; a foot turns with its shank.
    bool takes_twist_of_end;
};

constexpr LimbEntry kLimbs[] = {
    {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, false},
    {VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND, true},
    {VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, false},
    {VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND, true},
    {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, false},
    {VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT, true},
    {VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, false},
    {VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT, true},
};
constexpr size_t kLimbCount = std::size(kLimbs);

const Quat kIdentity(1, 0, 0, 0);

Mat4 about(const Vec3& rest, const Vec3& world, const Quat& rotation) {
    const Mat3 r = glm::mat3_cast(rotation);
    Mat4 m(r);
    m[3] = Vec4(world - r * rest, 1.0f);
    return m;
}

Pose checked(const Pose& pose) {
    if (!finite(pose.hips_position)) fail(VFIT_ERROR_DATA, "the pose's hips position is not finite");
    Pose unit = pose;
    for (int b = 0; b < kBoneCount; ++b) {
        Quat& q = unit.rotation[static_cast<size_t>(b)];
        const float length = std::sqrt(glm::dot(q, q));
        if (!finite(q) || !std::isfinite(length))
            fail(VFIT_ERROR_DATA, "the pose's rotation of bone ", bone_name(b), " is not finite");
        if (length < 1e-6f)
            fail(VFIT_ERROR_DATA, "the pose's rotation of bone ", bone_name(b), " has no length");
        q = q / length;
    }
    return unit;
}

}  // namespace

Vec3 t_pose_direction(int bone) {
    switch (bone) {
        case VFIT_BONE_LEFT_UPPER_ARM:
        case VFIT_BONE_LEFT_LOWER_ARM:
        case VFIT_BONE_LEFT_HAND: return Vec3(1, 0, 0);
        case VFIT_BONE_RIGHT_UPPER_ARM:
        case VFIT_BONE_RIGHT_LOWER_ARM:
        case VFIT_BONE_RIGHT_HAND: return Vec3(-1, 0, 0);
        case VFIT_BONE_LEFT_UPPER_LEG:
        case VFIT_BONE_LEFT_LOWER_LEG:
        case VFIT_BONE_RIGHT_UPPER_LEG:
        case VFIT_BONE_RIGHT_LOWER_LEG: return Vec3(0, -1, 0);
        default: return Vec3(0.0f);
    }
}

bool is_optional_bone(int bone) {
    switch (bone) {
        case VFIT_BONE_CHEST:
        case VFIT_BONE_UPPER_CHEST:
        case VFIT_BONE_NECK:
        case VFIT_BONE_LEFT_SHOULDER:
        case VFIT_BONE_RIGHT_SHOULDER:
        case VFIT_BONE_LEFT_TOES:
        case VFIT_BONE_RIGHT_TOES: return true;
        default: return false;
    }
}

namespace {

/// Who stands where a missing bone would: the child of a neck or a shoulder, so that it turns in its place;
/// else the parent.
int stand_in(int bone) {
    switch (bone) {
        case VFIT_BONE_NECK: return VFIT_BONE_HEAD;
        case VFIT_BONE_LEFT_SHOULDER: return VFIT_BONE_LEFT_UPPER_ARM;
        case VFIT_BONE_RIGHT_SHOULDER: return VFIT_BONE_RIGHT_UPPER_ARM;
        default: return bone_parent(bone);
    }
}

}  // namespace

Vec3 BoneAxis::nearest(const Vec3& p) const {
    const Vec3 way = to - from;
    const float length2 = glm::dot(way, way);
    return from + (length2 > 0.0f ? std::clamp(glm::dot(p - from, way) / length2, 0.0f, 1.0f) : 0.0f) * way;
}

AvatarRig::AvatarRig(std::vector<AvatarBone> bones, float floor_y, uint32_t twist_steps)
    : bones_(std::move(bones)) {
    map_humanoid_bones();
    build_limbs(twist_steps);
    build_t_pose(floor_y);
}

void AvatarRig::map_humanoid_bones() {
    rig_of_.fill(-1);
    for (size_t i = 0; i < bones_.size(); ++i) {
        const AvatarBone& b = bones_[i];
        if (b.parent < -1 || b.parent >= static_cast<int>(i))
            fail(VFIT_ERROR_DATA, "the rig's bone ", b.name, " does not stand behind its parent");
        if (!finite(b.rest_head) || !finite(b.rest_tail))
            fail(VFIT_ERROR_DATA, "the rig's bone ", b.name, " is not at a finite place");
        if (b.bone < 0) continue;
        if (b.bone >= kBoneCount)
            fail(VFIT_ERROR_DATA, "the rig's bone ", b.name, " is no known humanoid bone");
        int& rig = rig_of_[static_cast<size_t>(b.bone)];
        if (rig >= 0) fail(VFIT_ERROR_DATA, "the rig has bone ", bone_name(b.bone), " twice");
        rig = static_cast<int>(i);
    }
    for (int b = 0; b < kBoneCount; ++b)
        if (rig_bone(b) < 0 && !is_optional_bone(b))
            fail(VFIT_ERROR_DATA, "the rig has no bone ", bone_name(b));
    // A missing bone of the trunk lies at its parent's start: whoever stands there turns by all of them.
    for (int b = 0; b < kBoneCount; ++b) turned_by_[static_cast<size_t>(b)] = b;
    for (const int b : {VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST}) {
        if (rig_bone(b) >= 0) continue;
        int below = bone_parent(b);
        while (rig_bone(below) < 0) below = bone_parent(below);
        turned_by_[static_cast<size_t>(below)] = b;
    }
}

const Vec3& AvatarRig::rest_head(int bone) const {
    while (rig_bone(bone) < 0) bone = stand_in(bone);
    return bones_[static_cast<size_t>(rig_bone(bone))].rest_head;
}

void AvatarRig::build_limbs(uint32_t twist_steps) {
    for (const LimbEntry& entry : kLimbs) {
        LimbChain limb;
        limb.bone = entry.bone;
        limb.end_bone = entry.end_bone;
        const int original = rig_bone(entry.bone), end = rig_bone(entry.end_bone);
        limb.near_joint = bones_[static_cast<size_t>(original)].rest_head;
        limb.far_joint = bones_[static_cast<size_t>(end)].rest_head;
        if (glm::distance(limb.near_joint, limb.far_joint) < 1e-4f)
            fail(VFIT_ERROR_DATA, "the rig's bone ", bone_name(entry.bone), " has no length");

        // What lies on the way to the far joint is the model's own twist segment; a rig without gets one.
        int extension = bones_[static_cast<size_t>(end)].parent;
        limb.rig_bones = {original};
        const auto append = [&](uint32_t step) {
            const float near_t = float(step) / float(twist_steps);
            const float far_t = float(step + 1) / float(twist_steps);
            const AvatarBone& o = bones_[static_cast<size_t>(original)];
            bones_.push_back({text(o.name, ".twist", step), original, -1,
                              glm::mix(limb.near_joint, limb.far_joint, near_t),
                              glm::mix(limb.near_joint, limb.far_joint, std::min(far_t, 1.0f))});
            return static_cast<int>(bones_.size()) - 1;
        };
        for (uint32_t step = 1; step < twist_steps; ++step) limb.rig_bones.push_back(append(step));
        if (twist_steps > 0 && extension == original) extension = append(twist_steps);
        if (extension != original) limb.rig_bones.push_back(extension);
        limbs_.push_back(std::move(limb));
    }

    limb_of_.assign(bones_.size(), -1);
    share_of_.assign(bones_.size(), 0.0f);
    if (twist_steps == 0) return;
    for (size_t l = 0; l < limbs_.size(); ++l) {
        const LimbChain& limb = limbs_[l];
        for (size_t k = 0; k < limb.rig_bones.size(); ++k) {
            const auto i = static_cast<size_t>(limb.rig_bones[k]);
            limb_of_[i] = static_cast<int>(l);
            share_of_[i] = float(k) / float(twist_steps);
        }
        const Vec3 axis = limb.far_joint - limb.near_joint;
        for (size_t i = 0; i < bones_.size(); ++i) {
            if (!bones_[i].is_twist || bones_[i].parent != limb.rig_bones.front()) continue;
            // One that starts with its limb carries all of it: half of the twist is the least wrong.
            const float along = glm::dot(bones_[i].rest_head - limb.near_joint, axis) / glm::dot(axis, axis);
            limb_of_[i] = static_cast<int>(l);
            share_of_[i] = along < 0.05f ? 0.5f : std::min(along, 1.0f);
        }
    }
}

void AvatarRig::build_t_pose(float floor_y) {
    const auto head = [&](int bone) { return rest_head(bone); };
    t_pose_.fill(kIdentity);
    const auto stretch = [&](int bone, const Vec3& end) {
        const Vec3 target = t_pose_direction(bone), rest = end - head(bone);
        if (glm::length(rest) < 1e-4f) return;
        // After the parent's own correction, so that a joint straightens about its hinge without a twist.
        const Quat parent = t_pose_[static_cast<size_t>(bone_parent(bone))];
        t_pose_[static_cast<size_t>(bone)] = glm::normalize(shortest_arc(parent * rest, target) * parent);
    };
    for (const LimbEntry& limb : kLimbs) stretch(limb.bone, head(limb.end_bone));
    for (const int hand : {VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND}) {
        const AvatarBone& bone = bones_[static_cast<size_t>(rig_bone(hand))];
        stretch(hand, bone.rest_tail);
    }

    for (int b = 1; b < kBoneCount; ++b) {
        const int parent = bone_parent(b);
        skeleton_.offset[static_cast<size_t>(b)] =
            t_pose_[static_cast<size_t>(parent)] * (head(b) - head(parent));
    }
    const Vec3 ankles = 0.5f * (head(VFIT_BONE_LEFT_FOOT) + head(VFIT_BONE_RIGHT_FOOT));
    skeleton_.ankle_height = ankles.y - floor_y;
    Vec3 hips_to_ankles(0.0f);
    for (const int b : {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT,
                        VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT})
        hips_to_ankles += 0.5f * skeleton_.offset[static_cast<size_t>(b)];
    skeleton_.offset[VFIT_BONE_HIPS] = Vec3(0, skeleton_.ankle_height, 0) - hips_to_ankles;
}

Pose AvatarRig::rest_pose() const {
    Pose pose;
    for (int b = 0; b < kBoneCount; ++b) {
        const Quat above = bone_parent(b) < 0 ? kIdentity : t_pose_[size_t(bone_parent(b))];
        pose.rotation[size_t(b)] = glm::normalize(above * glm::conjugate(t_pose_[size_t(b)]));
    }
    pose.hips_position = rest_head(VFIT_BONE_HIPS);
    return pose;
}

void AvatarRig::pose(const Pose& pose, PosedSkeleton& posed, std::span<Mat4> matrices) const {
    const Pose unit = checked(pose);
    posed = forward_kinematics(skeleton_, unit);

    struct LimbTurn {
        Quat swung;  // world, of the original bone
        Quat twist;  // what the extension adds to it
    };
    std::array<LimbTurn, kLimbCount> turns;
    for (size_t l = 0; l < kLimbCount; ++l) {
        const auto bone = static_cast<size_t>(kLimbs[l].bone);
        const Vec3 axis = t_pose_direction(kLimbs[l].bone);
        const SwingTwist own = split_swing_twist(unit.rotation[bone], axis);
        const auto parent = static_cast<size_t>(bone_parent(kLimbs[l].bone));
        turns[l] = {posed.rotation[parent] * own.swing, own.twist};
        if (kLimbs[l].takes_twist_of_end)
            turns[l].twist =
                own.twist *
                split_swing_twist(unit.rotation[static_cast<size_t>(kLimbs[l].end_bone)], axis).twist;
    }

    const auto place = [&](int bone, const Quat& rotation) {
        const auto b = static_cast<size_t>(bone);
        return about(bones_[static_cast<size_t>(rig_bone(bone))].rest_head, posed.position[b],
                     rotation * t_pose_[b]);
    };
    const Mat4 hips = place(VFIT_BONE_HIPS, posed.rotation[VFIT_BONE_HIPS]);
    for (size_t i = 0; i < bones_.size(); ++i) {
        const int limb = limb_of_[i];
        if (limb >= 0) {
            const LimbTurn& turn = turns[static_cast<size_t>(limb)];
            const float share = share_of_[i];
            // About the near joint: the limb's axis stays where it is for every share of the twist.
            matrices[i] = place(kLimbs[limb].bone, turn.swung * fraction(turn.twist, share));
        } else if (bones_[i].bone >= 0) {
            matrices[i] =
                place(bones_[i].bone,
                      posed.rotation[static_cast<size_t>(turned_by_[static_cast<size_t>(bones_[i].bone)])]);
        } else {
            matrices[i] = bones_[i].parent < 0 ? hips : matrices[static_cast<size_t>(bones_[i].parent)];
        }
    }
}

}  // namespace vfit
