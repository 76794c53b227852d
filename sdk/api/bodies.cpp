#include "api/bodies.h"

#include <array>
#include <cmath>

#include "math/finite.h"

namespace vfit::api {

namespace {

constexpr float kUnitTolerance = 0.01f;  // of a rotation's length

void set_vector(float (&to)[3], const Vec3& v) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/// Seen joints, in the order in which they are listed; the count is returned.
int listed_joints(const Body& body, int (&ids)[kJointCount]) {
    int n = 0;
    for (int id = 0; id < kJointCount; ++id)
        if (body.has(id)) ids[n++] = id;
    return n;
}

vfit_joint joint_out(int id, const Joint& joint, const Axes& axes) {
    vfit_joint out{};
    out.joint = axes.joint_out(id);
    out.state = joint.state;
    out.confidence = joint.confidence;
    set_vector(out.position, axes.point_out(joint.position));
    if (joint.has_rotation) {
        const Quat q = axes.rotation_out(joint.rotation);
        out.rotation[0] = q.x;
        out.rotation[1] = q.y;
        out.rotation[2] = q.z;
        out.rotation[3] = q.w;
    }
    return out;
}

uint32_t contacts_seen(uint32_t contacts, const Axes& axes) {
    const uint32_t left = contacts & VFIT_CONTACT_LEFT, right = contacts & VFIT_CONTACT_RIGHT;
    if (!axes.mirrored()) return left | right;
    return (left ? uint32_t(VFIT_CONTACT_RIGHT) : 0u) | (right ? uint32_t(VFIT_CONTACT_LEFT) : 0u);
}

}  // namespace

Quat rotation_in(const float* rotation, const Axes& axes) {
    check_pointer(rotation, "rotation");
    const Quat turn(rotation[3], rotation[0], rotation[1], rotation[2]);
    const float length = glm::length(turn);
    if (!(std::abs(length - 1.0f) <= kUnitTolerance))
        fail(VFIT_ERROR_ARGUMENT, "rotation is no unit quaternion");
    return axes.rotation_in(turn / length);
}

vfit_result write_joints(const Body& body, const Axes& axes, vfit_joint* items, uint32_t stride,
                         uint32_t* count) {
    int ids[kJointCount];
    const int n = listed_joints(body, ids);
    return write_list(items, stride, count, static_cast<size_t>(n), [&](size_t i) {
        return joint_out(ids[i], body.joints[static_cast<size_t>(ids[i])], axes);
    });
}

Body body_in(const vfit_body& in, const Items<vfit_joint>& joints, const Axes& axes) {
    // The user map has 8 bits a pixel, and 0 is the background.
    if (in.body_id == 0 || in.body_id > 255)
        fail(VFIT_ERROR_ARGUMENT, "body_id ", in.body_id, " is not in 1..255");
    check_flags(in.flags, VFIT_BODY_CAMERA_SPACE | VFIT_BODY_PARTLY_OUT_OF_VIEW, "body flags");
    if (joints.size() == 0) fail(VFIT_ERROR_ARGUMENT, "body ", in.body_id, " has no joints");
    const bool camera_space = (in.flags & VFIT_BODY_CAMERA_SPACE) != 0;
    Body body;
    body.id = in.body_id;
    body.time_ns = in.time_ns;
    body.flags = in.flags;
    for (uint32_t i = 0; i < joints.size(); ++i) {
        const vfit_joint given = joints[i];
        Joint joint = joint_in(given);
        int id = given.joint;
        if (!camera_space) {
            id = axes.joint_out(id);
            joint.position = axes.point_in(joint.position);
            joint.rotation = axes.rotation_in(joint.rotation);
        }
        body.joints[static_cast<size_t>(id)] = joint;
    }
    return body;
}

Pose pose_in(const vfit_pose& in, const Items<vfit_bone>& bones, const Axes& axes) {
    Pose pose;
    pose.time_ns = in.time_ns;
    pose.contacts = contacts_seen(in.contact_flags, axes);
    bool hips = false;
    for (uint32_t i = 0; i < bones.size(); ++i) {
        const vfit_bone b = bones[i];
        const char* name = bone_name(b.bone);
        if (!name) fail(VFIT_ERROR_ARGUMENT, "bone ", b.bone, " is not one of VFIT_BONE_*");
        const Quat rotation(b.rotation[3], b.rotation[0], b.rotation[1], b.rotation[2]);
        const Vec3 position(b.position[0], b.position[1], b.position[2]);
        const float length = glm::length(rotation);
        if (!finite(rotation) || !finite(position) || std::abs(length - 1.0f) > kUnitTolerance)
            fail(VFIT_ERROR_DATA, "bone ", name, " is not finite, or its rotation not of unit length");
        const int bone = axes.bone_out(b.bone);
        pose.rotation[static_cast<size_t>(bone)] = axes.rotation_in(rotation / length);
        if (bone == VFIT_BONE_HIPS) {
            pose.hips_position = axes.point_in(position);
            hips = true;
        }
    }
    if (!hips) fail(VFIT_ERROR_DATA, "the pose has no hips bone");
    return pose;
}

Skeleton skeleton_in(const Items<vfit_bone>& bones, const Axes& axes) {
    Skeleton skeleton;
    std::array<bool, kBoneCount> listed{};
    bool any = false;
    for (uint32_t i = 0; i < bones.size(); ++i) {
        const vfit_bone b = bones[i];
        if (!bone_name(b.bone)) fail(VFIT_ERROR_ARGUMENT, "bone ", b.bone, " is not one of VFIT_BONE_*");
        const int bone = axes.bone_out(b.bone);
        const Vec3 offset = axes.point_in(Vec3(b.position[0], b.position[1], b.position[2]));
        if (!finite(offset))
            fail(VFIT_ERROR_DATA, "the offset of bone ", bone_name(b.bone), " is not finite");
        listed[static_cast<size_t>(bone)] = true;
        skeleton.offset[static_cast<size_t>(bone)] = offset;
        any = any || (bone != VFIT_BONE_HIPS && offset != Vec3(0.0f));
    }
    for (int bone = 0; bone < kBoneCount; ++bone)
        if (!listed[static_cast<size_t>(bone)])
            fail(VFIT_ERROR_DATA, "bone ", bone_name(axes.bone_out(bone)),
                 " is missing: wanted are all bones, as vfit_motion_pose gives them");
    if (!any)
        fail(VFIT_ERROR_DATA,
             "the bones have no offsets from their parents: a pose of vfit_pose_unpack has none, one of "
             "vfit_motion_pose has");
    return skeleton;
}

vfit_pose pose_out(const Pose& pose, const Axes& axes) {
    vfit_pose out{};
    out.contact_flags = contacts_seen(pose.contacts, axes);
    out.time_ns = pose.time_ns;
    set_vector(out.root_correction, axes.point_out(pose.root_correction));
    out.foot_correction_m = pose.foot_correction_m;
    return out;
}

vfit_result write_bones(const Pose& pose, const Skeleton& skeleton, const Axes& axes, vfit_bone* items,
                        uint32_t stride, uint32_t* count) {
    return write_list(items, stride, count, kBoneCount, [&](size_t i) {
        // Listed in the order of the ids that the host sees.
        const auto b = static_cast<size_t>(axes.bone_out(static_cast<int>(i)));
        vfit_bone out{};
        out.bone = static_cast<int>(i);
        const Quat q = axes.rotation_out(pose.rotation[b]);
        out.rotation[0] = q.x;
        out.rotation[1] = q.y;
        out.rotation[2] = q.z;
        out.rotation[3] = q.w;
        set_vector(out.position,
                   axes.point_out(b == VFIT_BONE_HIPS ? pose.hips_position : skeleton.offset[b]));
        return out;
    });
}

vfit_result write_colliders(const std::vector<Collider>& colliders, const Axes& axes, vfit_collider* items,
                            uint32_t stride, uint32_t* count) {
    return write_list(items, stride, count, colliders.size(), [&](size_t i) {
        const Collider& c = colliders[i];
        vfit_collider out{};
        out.joint = axes.joint_out(c.joint);
        set_vector(out.center, axes.point_out(c.center));
        out.radius = axes.length_out(c.radius);
        out.joint_b = c.is_capsule() ? axes.joint_out(c.joint_b) : -1;
        set_vector(out.center_b, axes.point_out(c.center_b));
        out.radius_b = axes.length_out(c.radius_b);
        return out;
    });
}

}  // namespace vfit::api
