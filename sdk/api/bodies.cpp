#include "api/bodies.h"

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

}  // namespace

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

vfit_result write_joints(const Body& body, const Axes& axes, vfit_joint* items, uint32_t stride, uint32_t* count) {
    int ids[kJointCount];
    const int n = listed_joints(body, ids);
    return write_list(items, stride, count, static_cast<size_t>(n), [&](size_t i) {
        return joint_out(ids[i], body.joints[static_cast<size_t>(ids[i])], axes);
    });
}

Body body_in(const vfit_body& in, const std::vector<vfit_joint>& joints, const Axes& axes) {
    // The user map has 8 bits a pixel, and 0 is the background.
    if (in.body_id == 0 || in.body_id > 255) fail(VFIT_ERROR_ARGUMENT, "body_id ", in.body_id, " is not in 1..255");
    check_flags(in.flags, VFIT_BODY_CAMERA_SPACE | VFIT_BODY_PARTLY_OUT_OF_VIEW, "body flags");
    if (joints.empty()) fail(VFIT_ERROR_ARGUMENT, "body ", in.body_id, " has no joints");
    const bool camera_space = (in.flags & VFIT_BODY_CAMERA_SPACE) != 0;
    Body body;
    body.id = in.body_id;
    body.time_ns = in.time_ns;
    body.flags = in.flags;
    for (const vfit_joint& j : joints) {
        const char* name = joint_name(j.joint);
        if (!name) fail(VFIT_ERROR_ARGUMENT, "joint ", j.joint, " is not one of VFIT_JOINT_*");
        check_enum(j.state, VFIT_JOINT_MEASURED, "joint state");
        const Vec3 position(j.position[0], j.position[1], j.position[2]);
        const Quat rotation(j.rotation[3], j.rotation[0], j.rotation[1], j.rotation[2]);
        if (!finite(position) || !finite(rotation) || !finite(j.confidence))
            fail(VFIT_ERROR_DATA, "joint ", name, " is not finite");
        const int id = camera_space ? j.joint : axes.joint_out(j.joint);
        Joint& joint = body.joints[static_cast<size_t>(id)];
        joint.state = j.state;
        joint.confidence = j.confidence;
        joint.position = camera_space ? position : axes.point_in(position);
        const float length = glm::length(rotation);
        if (length > 0.5f) {
            joint.rotation = (camera_space ? rotation : axes.rotation_in(rotation)) / length;
            joint.has_rotation = true;
        }
    }
    return body;
}

Pose pose_in(const vfit_pose& in, const std::vector<vfit_bone>& bones, const Axes& axes) {
    Pose pose;
    pose.time_ns = in.time_ns;
    pose.contacts = in.contact_flags;
    bool hips = false;
    for (const vfit_bone& b : bones) {
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

vfit_pose pose_out(const Pose& pose, const Axes& axes) {
    vfit_pose out{};
    const bool left = (pose.contacts & VFIT_CONTACT_LEFT) != 0, right = (pose.contacts & VFIT_CONTACT_RIGHT) != 0;
    const bool swapped = axes.mirrored();
    out.contact_flags = ((swapped ? right : left) ? uint32_t(VFIT_CONTACT_LEFT) : 0u) |
                        ((swapped ? left : right) ? uint32_t(VFIT_CONTACT_RIGHT) : 0u);
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
        set_vector(out.position, axes.point_out(b == VFIT_BONE_HIPS ? pose.hips_position : skeleton.offset[b]));
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
