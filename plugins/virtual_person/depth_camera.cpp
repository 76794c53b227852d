#include "depth_camera.h"

#include <cmath>

namespace vfit::virtual_person {

DepthCamera::DepthCamera(const SensorModel& model, const CameraPlace& place, const Room& room)
    : model_(model), place_(place), mesh_(model) {
    const float c = std::cos(place.tilt_rad), s = std::sin(place.tilt_rad);
    rotation_ = Mat3(Vec3(1, 0, 0), Vec3(0, -c, s), Vec3(0, -s, -c));  // columns: right, down, forward
    solve_room(room);
}

Vec3 DepthCamera::to_camera(const Vec3& world) const {
    return glm::transpose(rotation_) * (world - Vec3(0, place_.height_m, 0));
}

Vec3 DepthCamera::to_world(const Vec3& p) const { return rotation_ * p + Vec3(0, place_.height_m, 0); }

Vec2 DepthCamera::project(const Vec3& p) const {
    return {p.x / p.z * model_.fx + model_.cx, p.y / p.z * model_.fy + model_.cy};
}

void DepthCamera::solve_room(const Room& room) {
    room_.resize(model_.width, model_.height);
    for (uint32_t y = 0; y < model_.height; ++y) {
        for (uint32_t x = 0; x < model_.width; ++x) {
            // A direction with z = 1 in camera space: the ray's parameter is the depth.
            const Vec3 d = rotation_ * Vec3((static_cast<float>(x) - model_.cx) / model_.fx,
                                            (static_cast<float>(y) - model_.cy) / model_.fy, 1.0f);
            float depth = 0.0f, along_normal = 0.0f;
            const auto meet = [&](float distance, float speed) {
                if (distance <= 0.0f || speed <= 0.0f) return;
                const float t = distance / speed;
                if (depth == 0.0f || t < depth) depth = t, along_normal = speed;
            };
            meet(place_.height_m, -d.y);
            meet(room.back_wall_m, -d.z);
            meet(room.side_wall_m, -d.x);
            const size_t i = size_t{y} * model_.width + x;
            room_.depth_m[i] = depth;
            room_.cosine[i] = along_normal / glm::length(d);
        }
    }
}

void DepthCamera::set_triangles(std::span<const uint32_t> indices, uint32_t vertex_count) {
    mesh_.set_triangles(indices, vertex_count);
    points_.resize(vertex_count);
}

void DepthCamera::render(const float* positions, CleanImage& out) {
    out = room_;
    if (points_.empty()) return;
    const Mat3 camera_from_world = glm::transpose(rotation_);
    const Vec3 origin(0, place_.height_m, 0);
    for (size_t i = 0; i < points_.size(); ++i)
        points_[i] =
            camera_from_world * (Vec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]) - origin);
    mesh_.draw(points_.data(), out);
}

}  // namespace vfit::virtual_person
