// The motion of a BVH file as vfit's joints over time. Which of its joints are which bones is found as it is
// for characters: by names, by the tree, or by a bone map.
#pragma once

#include <string>
#include <vector>

#include "client/joint_row.h"

namespace vfit::tools {

struct BvhOptions {
    std::string bone_map;  // JSON text; empty: none
    float scale = 0.0f;    // metres in a unit of the file; 0: guessed by the stature
};

/// In world space, metres; the lowest ankle of the motion stands on the floor. Throws Failure, which opens
/// with the file's name; where a bone is found nowhere, it lists the file's joints as a tree and a bone map
/// to fill in.
std::vector<JointRow> read_bvh_joints(vfit_context context, const std::string& path,
                                      const BvhOptions& options);

}  // namespace vfit::tools
