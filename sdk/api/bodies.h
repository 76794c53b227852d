// Joints, bodies, bones and colliders between their internal values and the C structs, in the host's axes.
#pragma once

#include <vector>

#include "api/structs.h"
#include "body/collider.h"
#include "body/skeleton.h"
#include "frame/axes.h"
#include "frame/body.h"

namespace vfit::api {

/// A rotation of the host (x, y, z, w). Fails with VFIT_ERROR_ARGUMENT unless it is a unit quaternion.
Quat rotation_in(const float* rotation, const Axes& axes);

/// The joints of a body that are seen.
vfit_result write_joints(const Body& body, const Axes& axes, vfit_joint* items, uint32_t stride,
                         uint32_t* count);

/// A body of the host, in world space, or in camera space as it stands where flags say so (axes do not
/// apply there). Fails with VFIT_ERROR_ARGUMENT or VFIT_ERROR_DATA, naming the joint.
Body body_in(const vfit_body& body, const Items<vfit_joint>& joints, const Axes& axes);

/// A pose of the host: bones that are not listed rest. Fails with VFIT_ERROR_DATA, naming the bone.
Pose pose_in(const vfit_pose& pose, const Items<vfit_bone>& bones, const Axes& axes);
/// The proportions that the bones of a pose tell. Fails with VFIT_ERROR_DATA where a bone is not listed, or
/// where all offsets are zero, as after vfit_pose_unpack.
Skeleton skeleton_in(const Items<vfit_bone>& bones, const Axes& axes);
vfit_pose pose_out(const Pose& pose, const Axes& axes);
vfit_result write_bones(const Pose& pose, const Skeleton& skeleton, const Axes& axes, vfit_bone* items,
                        uint32_t stride, uint32_t* count);

vfit_result write_colliders(const std::vector<Collider>& colliders, const Axes& axes, vfit_collider* items,
                            uint32_t stride, uint32_t* count);

}  // namespace vfit::api
