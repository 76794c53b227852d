// The avatar's joints and colliders: where each of VFIT_JOINT_* lies in the body, and the spheres about them.
#include <algorithm>
#include <cmath>

#include "avatar/avatar.h"
#include "body/joint_bones.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

struct CapsuleEnds {
    int a, b;
};

constexpr CapsuleEnds kCapsules[] = {
    {VFIT_JOINT_HEAD, VFIT_JOINT_NECK},
    {VFIT_JOINT_NECK, VFIT_JOINT_TORSO},
    {VFIT_JOINT_NECK, VFIT_JOINT_LEFT_SHOULDER},
    {VFIT_JOINT_NECK, VFIT_JOINT_RIGHT_SHOULDER},
    {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
    {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
    {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND},
    {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_HAND},
    {VFIT_JOINT_TORSO, VFIT_JOINT_LEFT_HIP},
    {VFIT_JOINT_TORSO, VFIT_JOINT_RIGHT_HIP},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
    {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE},
    {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT},
    {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT},
    {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP},
};
static_assert(kPaperJointCount + int(std::size(kCapsules)) == kColliderCount);

}  // namespace

namespace {

/// Where a missing bone would start: as high between spine and head as in a body, toes at the foot's end.
Vec3 missing_start(const AvatarRig& rig, int bone, const Vec3& end_below) {
    const auto trunk = [&](float share) {
        return glm::mix(rig.rest_head(VFIT_BONE_SPINE), rig.rest_head(VFIT_BONE_HEAD), share);
    };
    switch (bone) {
        case VFIT_BONE_CHEST: return trunk(0.22f);
        case VFIT_BONE_UPPER_CHEST: return trunk(0.60f);
        case VFIT_BONE_NECK: return trunk(0.83f);
        case VFIT_BONE_LEFT_SHOULDER:
            return glm::mix(trunk(0.72f), rig.rest_head(VFIT_BONE_LEFT_UPPER_ARM), 0.15f);
        case VFIT_BONE_RIGHT_SHOULDER:
            return glm::mix(trunk(0.72f), rig.rest_head(VFIT_BONE_RIGHT_UPPER_ARM), 0.15f);
        default: return end_below;
    }
}

}  // namespace

void Avatar::place_joints() {
    for (int j = 0; j < kJointCount; ++j) {
        const JointPlace place = kJointPlaces[static_cast<size_t>(j)];
        int carrier = place.bone;
        while (rig_.rig_bone(carrier) < 0) carrier = bone_parent(carrier);
        const int rig_bone = rig_.rig_bone(carrier);
        const AvatarBone& bone = rig_bones()[static_cast<size_t>(rig_bone)];
        anchors_[static_cast<size_t>(j)] = {
            rig_bone, carrier == place.bone ? glm::mix(bone.rest_head, bone.rest_tail, place.along)
                                            : missing_start(rig_, place.bone, bone.rest_tail)};
    }
}

void Avatar::measure_inner_spheres() {
    const MeshQuery skin(std::span<const Vec3>(rest_.positions).first(topology_->vertex_count),
                         topology_->indices);
    // A character's clothes need not close: there, what is nearest counts, inside or not.
    for (size_t j = 0; j < kPaperJointCount; ++j)
        inner_radii_[j] =
            is_body_ ? largest_inner_sphere(skin, anchors_[j].rest) : skin.closest(anchors_[j].rest).distance;
    radii_ = inner_radii_;
}

void Avatar::set_collider_radii(std::span<const float, kPaperJointCount> radii) {
    for (size_t j = 0; j < kPaperJointCount; ++j)
        if (!std::isfinite(radii[j]) || radii[j] < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "the collider radius of ", joint_name(int(j)), " is ", radii[j],
                 ", not finite and at least 0");
    for (size_t j = 0; j < kPaperJointCount; ++j) {
        if (radii[j] == 0.0f)
            radii_[j] = inner_radii_[j];
        else
            radii_[j] = paper_colliders_ ? radii[j] : std::min(radii[j], inner_radii_[j]);
    }
}

Vec3 Avatar::joint_position(int joint, std::span<const Mat4> matrices) const {
    const Anchor& anchor = anchors_[static_cast<size_t>(joint)];
    return Vec3(matrices[static_cast<size_t>(anchor.rig_bone)] * Vec4(anchor.rest, 1.0f));
}

Body Avatar::joints_of(const PosedSkeleton& posed, std::span<const Mat4> matrices) const {
    Body body;
    for (int j = 0; j < kJointCount; ++j) {
        body.set(j, joint_position(j, matrices));
        Joint& joint = body.joints[static_cast<size_t>(j)];
        joint.rotation = posed.rotation[static_cast<size_t>(kJointPlaces[static_cast<size_t>(j)].bone)];
        joint.has_rotation = true;
    }
    return body;
}

Body Avatar::joints() const {
    Body body = joints_of(posed_, matrices_);
    body.time_ns = time_ns();
    return body;
}

void Avatar::colliders(std::vector<Collider>& out) const { colliders_of(matrices_, out); }

void Avatar::rest_colliders(std::vector<Collider>& out) const {
    colliders_of(std::vector<Mat4>(matrices_.size(), Mat4(1.0f)), out);
}

void Avatar::colliders_of(std::span<const Mat4> matrices, std::vector<Collider>& out) const {
    out.clear();
    for (int j = 0; j < kPaperJointCount; ++j) {
        Collider sphere;
        sphere.joint = j;
        sphere.center = joint_position(j, matrices);
        sphere.radius = radii_[static_cast<size_t>(j)];
        out.push_back(sphere);
    }
    for (const CapsuleEnds& ends : kCapsules) {
        Collider capsule = out[static_cast<size_t>(ends.a)];
        const Collider far_end = out[static_cast<size_t>(ends.b)];
        capsule.joint_b = ends.b;
        capsule.center_b = far_end.center;
        capsule.radius_b = far_end.radius;
        out.push_back(capsule);
    }
}

}  // namespace vfit
