// Virtual people in clothes before a virtual Kinect v1, for vfit-bench fit: moving as the virtual person
// does, with the truth of their joints.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "avatar/avatar.h"
#include "frame/depth_image.h"

namespace vfit::tools {

struct FitShot {
    Camera camera;
    std::vector<uint16_t> depth;  // millimetres, with a Kinect v1's noise and steps
    std::vector<uint8_t> users;   // 1: the person
    Body truth;                   // camera space, true places and rotations
    int64_t time_ns = 0;
    DepthImage image() const { return {depth.data(), users.data(), camera}; }
};

/// Plays `frames` frames of that motion of the virtual person (docs/virtual-person.md) with a random grown-up
/// body in clothes of 1 to 3 cm (`clothes` false: naked). Everything follows from the seed.
void play_person(const std::shared_ptr<const BodyModel>& model, const std::string& motion, uint32_t seed,
                 uint32_t frames, bool clothes, const std::function<void(const FitShot&)>& sink);

/// A z-buffer of a triangle mesh in camera space; 0 where nothing is.
void draw_depth(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles,
                const Camera& camera, std::vector<float>& depth_m);

}  // namespace vfit::tools
