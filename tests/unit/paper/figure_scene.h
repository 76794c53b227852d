// A person of spheres and boxes before a pinhole camera, seen ray by ray: every measure is known by
// construction.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "frame/body.h"
#include "frame/depth_image.h"

namespace vfit::testing {

struct Box {
    Vec3 low, high;
};
struct Sphere {
    Vec3 center;
    float radius;
};

/// World space: the person faces +Z, the camera looks along -Z.
struct Figure {
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    Body joints;
};

// Lengths of standing_figure().
inline constexpr float kStature_m = 1.70f, kHeadRadius_m = 0.10f, kShoulderJoint_x = 0.18f,
                       kArmOutside_x = 0.23f, kHipHalfBreadth_m = 0.16f, kHipHeight_m = 0.90f,
                       kElbow_y = 1.10f, kShoulder_y = 1.40f, kFingertip_y = 0.68f, kTorso_m = 0.46f;

/// What a camera sees of a trunk that is 0.10 m deep to either side: its front edges, 2.7 m away.
inline constexpr float kSeenHipBreadth_m = 2.0f * kHipHalfBreadth_m * 2.8f / 2.7f;

/// Arms hanging straight down, clear of the trunk, at distance z before the camera.
inline Figure standing_figure(float z = 2.8f) {
    Figure f;
    const auto box = [&](float x0, float x1, float y0, float y1, float half) {
        f.boxes.push_back({{x0, y0, -z - half}, {x1, y1, -z + half}});
        f.boxes.push_back({{-x1, y0, -z - half}, {-x0, y1, -z + half}});
    };
    f.spheres.push_back({{0, kStature_m - kHeadRadius_m, -z}, kHeadRadius_m});
    box(0, 0.05f, 1.40f, 1.55f, 0.05f);                      // neck
    box(0, kHipHalfBreadth_m, 0.84f, 1.44f, 0.10f);          // trunk
    box(0.02f, kHipHalfBreadth_m, 0.0f, 0.84f, 0.07f);       // legs
    box(0.13f, kArmOutside_x, 1.36f, 1.44f, 0.05f);          // shoulders
    box(0.185f, kArmOutside_x, kFingertip_y, 1.40f, 0.04f);  // arms
    const auto joint = [&](int id, float x, float y) { f.joints.set(id, {x, y, -z}); };
    joint(VFIT_JOINT_HEAD, 0, 1.60f);
    joint(VFIT_JOINT_NECK, 0, 1.42f);
    joint(VFIT_JOINT_TORSO, 0, 1.15f);
    joint(VFIT_JOINT_PELVIS, 0, 1.42f - kTorso_m);
    for (const int side : {0, 1}) {
        const float s = side == 0 ? 1.0f : -1.0f;  // the person's left is at +X
        joint(VFIT_JOINT_LEFT_SHOULDER + side, s * kShoulderJoint_x, kShoulder_y);
        joint(VFIT_JOINT_LEFT_ELBOW + side, s * 0.205f, kElbow_y);
        joint(VFIT_JOINT_LEFT_WRIST + side, s * 0.205f, 0.87f);
        joint(VFIT_JOINT_LEFT_HAND + side, s * 0.205f, 0.80f);
        joint(VFIT_JOINT_LEFT_HIP + side, s * 0.09f, kHipHeight_m);
        joint(VFIT_JOINT_LEFT_KNEE + side, s * 0.09f, 0.48f);
        joint(VFIT_JOINT_LEFT_FOOT + side, s * 0.09f, 0.07f);
    }
    f.joints.id = 1;
    return f;
}

inline Camera level_camera(uint32_t width = 640, uint32_t height = 480, float tilt_rad = 0.0f,
                           float roll_rad = 0.0f) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 0.9f * float(std::max(width, height));
    camera.cx = 0.5f * float(width - 1);
    camera.cy = 0.5f * float(height - 1);
    set_floor(camera, 0.95f, tilt_rad, roll_rad, VFIT_FLOOR_GIVEN);
    return camera;
}

/// One image with its user map and camera-space joints.
struct Picture {
    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    Camera camera;
    Body body;

    DepthImage image() const { return {depth.data(), users.data(), camera}; }
};

inline float ray_box(const Vec3& from, const Vec3& d, const Box& b) {
    float near = 0.0f, far = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        const float inverse = 1.0f / (std::abs(d[axis]) > 1e-9f ? d[axis] : 1e-9f);
        const float t0 = (b.low[axis] - from[axis]) * inverse, t1 = (b.high[axis] - from[axis]) * inverse;
        near = std::max(near, std::min(t0, t1));
        far = std::min(far, std::max(t0, t1));
    }
    return near <= far ? near : std::numeric_limits<float>::max();
}

inline float ray_sphere(const Vec3& from, const Vec3& d, const Sphere& s) {
    const Vec3 o = from - s.center;
    const float b = glm::dot(o, d), a = glm::dot(d, d), c = glm::dot(o, o) - s.radius * s.radius;
    const float root = b * b - a * c;
    return root < 0.0f ? std::numeric_limits<float>::max() : (-b - std::sqrt(root)) / a;
}

inline Picture take_picture(const Figure& figure, const Camera& camera) {
    Picture picture;
    picture.camera = camera;
    const size_t count = size_t(camera.width) * camera.height;
    picture.depth.assign(count, 0);
    picture.users.assign(count, 0);
    const Mat4 to_world = camera.world_from_camera(), to_camera = camera.camera_from_world();
    const Vec3 from = transform_point(to_world, Vec3(0));
    for (uint32_t y = 0; y < camera.height; ++y)
        for (uint32_t x = 0; x < camera.width; ++x) {
            const Vec3 ray = transform_point(to_world, camera.unproject(float(x), float(y), 1.0f)) - from;
            float z = std::numeric_limits<float>::max();
            for (const Box& b : figure.boxes) z = std::min(z, ray_box(from, ray, b));
            for (const Sphere& s : figure.spheres) z = std::min(z, ray_sphere(from, ray, s));
            const size_t i = size_t(y) * camera.width + x;
            if (z > 60.0f) continue;
            picture.depth[i] = uint16_t(std::lround(z / camera.depth_unit_m));
            picture.users[i] = 1;
        }
    picture.body = figure.joints;
    for (Joint& j : picture.body.joints)
        if (j.seen()) j.position = transform_point(to_camera, j.position);
    return picture;
}

}  // namespace vfit::testing
