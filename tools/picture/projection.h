// World space to the pixels of a depth picture, and which joints a skeleton is drawn between.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

/// Into a picture that is `scale` times as large as the frame's depth image.
class Projection {
public:
    Projection(vfit_frame frame, int scale);

    struct Pixel {
        float x, y, per_metre;
    };
    /// Nothing for what is behind the camera.
    std::optional<Pixel> operator()(const float (&world)[3]) const;

private:
    vfit_camera camera_;
    vfit_intrinsics k_ = vfit_intrinsics_init();
    int scale_;
};

using JointPixels = std::array<std::optional<Projection::Pixel>, VFIT_JOINT_COUNT>;  // by id
JointPixels project_joints(const Projection& projection, const std::vector<vfit_joint>& joints);

/// Pairs of joints to draw a line between, both of them there.
std::vector<std::pair<vfit_joint_id, vfit_joint_id>> drawn_bones(const JointPixels& at);

}  // namespace vfit::tools
