// Pinhole camera and where it stands. Camera space: x right, y down, z forward, metres. World space:
// origin on the floor below the camera, Y up, a person who faces the camera faces +Z.
#pragma once

#include "math/types.h"
#include "vfit.h"

namespace vfit {

struct Camera {
    uint32_t width = 0, height = 0;
    float fx = 0, fy = 0, cx = 0, cy = 0;
    float distortion[8] = {};  // OpenCV order; all zero: none. Kept, not applied: images are rectified.
    float depth_unit_m = 0.001f;
    vfit_floor_state floor_state = VFIT_FLOOR_DEFAULT;
    Vec3 floor_normal{0, -1, 0};  // camera space, pointing up: dot(normal, p) + distance = 0
    float floor_distance_m = 1.0f;

    /// The point that pixel (u, v) sees at depth z.
    Vec3 unproject(float u, float v, float z) const { return {(u - cx) / fx * z, (v - cy) / fy * z, z}; }

    /// Pixel of a camera-space point with z > 0.
    Vec2 project(const Vec3& p) const { return {p.x / p.z * fx + cx, p.y / p.z * fy + cy}; }

    /// Carries camera space to world space (rigid).
    Mat4 world_from_camera() const;
    Mat4 camera_from_world() const;

    float camera_height_m() const { return floor_distance_m; }
    float tilt_rad() const;  // > 0: looks down
    /// The side of the image that is up: the image axis nearest to the floor's normal.
    Vec3 side_up() const;
    float roll_rad() const;  // > 0: turned clockwise as the camera sees
};

/// Fails with VFIT_ERROR_ARGUMENT naming the field unless sizes and focal lengths make sense (the lens), the
/// depth unit is in (0, 1] m and the floor normal is a unit vector (the placement).
void validate(const Camera& camera);
void validate_lens(const Camera& camera);
void validate_placement(const Camera& camera);

/// A camera that looks down by tilt and is turned by roll, at that height; sets the floor plane.
void set_floor(Camera& camera, float height_m, float tilt_rad, float roll_rad, vfit_floor_state state);

inline Vec3 transform_point(const Mat4& m, const Vec3& p) { return Vec3(m * Vec4(p, 1.0f)); }

}  // namespace vfit
