#include "frame/camera.h"

#include <cmath>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

Mat4 Camera::world_from_camera() const {
    // World axes written in camera space: up is the floor's normal; Z points back to the camera, level.
    const Vec3 up = floor_normal;
    Vec3 back = Vec3(0, 0, -1) - up * glm::dot(Vec3(0, 0, -1), up);
    // A camera that looks straight down has no level forward direction: the image's top serves.
    if (glm::length(back) < 1e-4f) back = Vec3(0, 1, 0) - up * glm::dot(Vec3(0, 1, 0), up);
    back = glm::normalize(back);
    const Vec3 right = glm::cross(up, back);
    const Mat3 rotation = glm::transpose(Mat3(right, up, back));
    Mat4 m(rotation);
    m[3] = Vec4(0, floor_distance_m, 0, 1);
    return m;
}

Mat4 Camera::camera_from_world() const {
    const Mat4 m = world_from_camera();
    const Mat3 inverse = glm::transpose(Mat3(m));
    Mat4 r(inverse);
    r[3] = Vec4(-(inverse * Vec3(m[3])), 1.0f);
    return r;
}

float Camera::tilt_rad() const { return std::asin(glm::clamp(-floor_normal.z, -1.0f, 1.0f)); }

Vec3 Camera::side_up() const {
    const Vec3& n = floor_normal;
    return std::abs(n.y) >= std::abs(n.x) ? Vec3(0, n.y > 0 ? 1 : -1, 0) : Vec3(n.x > 0 ? 1 : -1, 0, 0);
}

float Camera::roll_rad() const { return std::atan2(-floor_normal.x, -floor_normal.y); }

namespace {

bool positive(float x) { return std::isfinite(x) && x > 0.0f; }

}  // namespace

void validate(const Camera& c) {
    validate_lens(c);
    validate_placement(c);
}

void validate_lens(const Camera& c) {
    if (c.width == 0 || c.height == 0 || c.width > 16384 || c.height > 16384)
        fail(VFIT_ERROR_ARGUMENT, "intrinsics: image size ", c.width, " x ", c.height, " is out of range");
    if (!positive(c.fx) || !positive(c.fy))
        fail(VFIT_ERROR_ARGUMENT, "intrinsics: focal length ", c.fx, ", ", c.fy, " must be positive");
    if (!finite(c.cx) || !finite(c.cy))
        fail(VFIT_ERROR_ARGUMENT, "intrinsics: principal point ", c.cx, ", ", c.cy, " is not finite");
    for (const float k : c.distortion)
        if (!finite(k)) fail(VFIT_ERROR_ARGUMENT, "intrinsics: distortion is not finite");
}

void validate_placement(const Camera& c) {
    if (!positive(c.depth_unit_m) || c.depth_unit_m > 1.0f)
        fail(VFIT_ERROR_ARGUMENT, "camera: depth_unit_m ", c.depth_unit_m, " is not in (0, 1]");
    if (!finite(c.floor_normal) || std::abs(glm::length(c.floor_normal) - 1.0f) > 1e-2f)
        fail(VFIT_ERROR_ARGUMENT, "camera: floor_normal is not a unit vector");
    if (!finite(c.floor_distance_m)) fail(VFIT_ERROR_ARGUMENT, "camera: floor_distance_m is not finite");
}

void set_floor(Camera& c, float height_m, float tilt_rad, float roll_rad, vfit_floor_state state) {
    const float level = std::cos(tilt_rad);
    c.floor_normal = Vec3(-level * std::sin(roll_rad), -level * std::cos(roll_rad), -std::sin(tilt_rad));
    c.floor_distance_m = height_m;
    c.floor_state = state;
}

}  // namespace vfit
