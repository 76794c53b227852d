// A virtual person before a virtual camera, for the tests of the fit: the exact depth of an avatar, and its
// joints.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "avatar/avatar.h"
#include "fit/body_fit.h"
#include "frame/floor.h"

namespace vfit {

inline std::shared_ptr<const BodyModel> body_model() {
    static const std::shared_ptr<const BodyModel> model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    return model;
}

inline std::shared_ptr<const FitModel> fit_model() {
    static const std::shared_ptr<const FitModel> model = std::make_shared<FitModel>(*body_model());
    return model;
}

/// A shape of the fit's own space as a body: components as given, no clothes.
inline std::vector<float> shape_of(const std::vector<float>& components) {
    FitShape shape{};
    std::copy(components.begin(), components.end(), shape.begin());
    std::vector<float> out(body_model()->parameters().size());
    fit_model()->body_shape(*body_model(), shape, out);
    return out;
}

inline Camera camera_640() {
    Camera camera;
    camera.width = 640, camera.height = 480;
    camera.fx = camera.fy = 571.0f;
    camera.cx = 319.5f, camera.cy = 239.5f;
    set_floor(camera, 1.0f, 0.05f, 0.0f, VFIT_FLOOR_GIVEN);
    return camera;
}

struct FitScene {
    Camera camera = camera_640();
    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    Body joints;  // camera space

    DepthImage image() const { return {depth.data(), users.data(), camera}; }
    FitJoints seen(float error_m = 0.0f, uint32_t seed = 1) const {
        FitJoints out;
        uint32_t bits = seed * 2654435761u + 1u;
        const auto next = [&] {
            bits = bits * 1664525u + 1013904223u;
            return float(bits >> 8) * 0x1p-24f - 0.5f;
        };
        for (int j = 0; j < kJointCount; ++j) {
            const Vec3 error(next(), next(), next());
            out[size_t(j)] = {joints.at(j) + 2.0f * error_m * error, 1.0f};
        }
        return out;
    }
};

/// A z-buffer of the avatar's skin; depth in millimetres. The person stands `distance_m` before the camera.
inline FitScene shoot(Avatar& avatar, Pose pose, float distance_m = 2.7f) {
    FitScene scene;
    const Camera& camera = scene.camera;
    pose.hips_position.z -= distance_m;
    avatar.pose(pose, *Jobs::own(0));
    scene.joints = to_camera(avatar.joints(), camera);
    const size_t pixels = size_t(camera.width) * camera.height;
    std::vector<float> nearest(pixels, 1e9f);
    const Mat4 to_camera_space = camera.camera_from_world();
    std::vector<Vec3> seen;
    for (const Vec3& p : avatar.positions()) seen.push_back(transform_point(to_camera_space, p));
    const auto& triangles = avatar.topology().indices;
    for (size_t t = 0; t < triangles.size(); t += 3) {
        const Vec3 p[3] = {seen[triangles[t]], seen[triangles[t + 1]], seen[triangles[t + 2]]};
        const Vec2 q[3] = {camera.project(p[0]), camera.project(p[1]), camera.project(p[2])};
        const float area = (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[1].y - q[0].y) * (q[2].x - q[0].x);
        if (std::abs(area) < 1e-6f) continue;
        for (int y = std::max(0, int(std::ceil(std::min({q[0].y, q[1].y, q[2].y}))));
             y <= std::min(479, int(std::max({q[0].y, q[1].y, q[2].y}))); ++y)
            for (int x = std::max(0, int(std::ceil(std::min({q[0].x, q[1].x, q[2].x}))));
                 x <= std::min(639, int(std::max({q[0].x, q[1].x, q[2].x}))); ++x) {
                const float fx = float(x), fy = float(y);
                const float a = ((q[1].x - fx) * (q[2].y - fy) - (q[1].y - fy) * (q[2].x - fx)) / area;
                const float b = ((q[2].x - fx) * (q[0].y - fy) - (q[2].y - fy) * (q[0].x - fx)) / area;
                const float c = 1.0f - a - b;
                if (a < 0 || b < 0 || c < 0) continue;
                const float z = 1.0f / (a / p[0].z + b / p[1].z + c / p[2].z);
                float& here = nearest[size_t(y) * camera.width + size_t(x)];
                here = std::min(here, z);
            }
    }
    scene.depth.assign(pixels, 0);
    scene.users.assign(pixels, 0);
    for (size_t i = 0; i < pixels; ++i)
        if (nearest[i] < 1e8f) {
            scene.depth[i] = uint16_t(std::lround(nearest[i] * 1000.0f));
            scene.users[i] = 1;
        }
    return scene;
}

/// Arms a little out, one knee bent: nothing is straight, nothing hidden.
inline Pose easy_pose(const Skeleton& skeleton) {
    Pose pose;
    pose.hips_position = skeleton.offset[VFIT_BONE_HIPS];
    const auto turn = [](float x, float y, float z) {
        return glm::angleAxis(y, Vec3(0, 1, 0)) * glm::angleAxis(x, Vec3(1, 0, 0)) *
               glm::angleAxis(z, Vec3(0, 0, 1));
    };
    pose.rotation[VFIT_BONE_HIPS] = turn(0.0f, 0.2f, 0.0f);
    pose.rotation[VFIT_BONE_SPINE] = turn(0.05f, 0.05f, 0.02f);
    pose.rotation[VFIT_BONE_NECK] = turn(0.05f, 0.1f, 0.0f);
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = turn(0.0f, -0.3f, -0.8f);
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = turn(0.0f, -0.6f, 0.0f);
    pose.rotation[VFIT_BONE_RIGHT_UPPER_ARM] = turn(0.0f, 0.2f, 1.0f);
    pose.rotation[VFIT_BONE_RIGHT_LOWER_ARM] = turn(0.0f, 0.4f, 0.0f);
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = turn(-0.3f, 0.0f, 0.08f);
    pose.rotation[VFIT_BONE_LEFT_LOWER_LEG] = turn(0.4f, 0.0f, 0.0f);
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] = turn(0.0f, 0.0f, -0.08f);
    return pose;
}

inline BodyFitInput input_of(const FitScene& scene, const FitJoints& joints, int64_t time_ns) {
    BodyFitInput input;
    input.image = scene.image();
    input.user = 1;
    input.time_ns = time_ns;
    input.joints = joints;
    return input;
}

inline float mean_joint_error(const BodyFitOutput& out, const FitScene& scene) {
    float sum = 0.0f;
    for (int j = 0; j < kPaperJointCount; ++j)
        sum += glm::distance(out.joints[size_t(j)], scene.joints.at(j));
    return sum / kPaperJointCount;
}

inline constexpr int64_t kFrameNs = 33333333;

}  // namespace vfit
