// A pinhole depth camera in a plain room: floor, back wall, side wall and one triangle mesh. The room is
// static and solved once; the mesh is drawn into it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clean_image.h"
#include "mesh_raster.h"
#include "sensor_model.h"
#include "types.h"

namespace vfit::virtual_person {

struct CameraPlace {
    float height_m = 1.0f;
    float tilt_rad = 0.0f;  // > 0 looks down
};

/// Planes of the room; 0: that wall is absent. The floor is y = 0.
struct Room {
    float back_wall_m = 0.0f;  // wall z = -back_wall_m
    float side_wall_m = 0.0f;  // wall x = -side_wall_m, on the person's right
};

class DepthCamera {
public:
    DepthCamera(const SensorModel& model, const CameraPlace& place, const Room& room);

    /// Rotation part of world-from-camera; its origin is (0, height, 0).
    const Mat3& world_from_camera() const { return rotation_; }
    Vec3 to_camera(const Vec3& world) const;
    Vec3 to_world(const Vec3& camera_point) const;
    /// Pixel of a point with z > 0.
    Vec2 project(const Vec3& camera_point) const;

    /// The mesh, three vertices a triangle; once, before the first render.
    void set_triangles(std::span<const uint32_t> indices, uint32_t vertex_count);
    /// positions: vertex_count packed x, y, z in world space.
    void render(const float* positions, CleanImage& out);

private:
    void solve_room(const Room& room);

    SensorModel model_;
    CameraPlace place_;
    Mat3 rotation_;
    CleanImage room_;
    MeshRaster mesh_;
    std::vector<Vec3> points_;  // vertices in camera space
};

}  // namespace vfit::virtual_person
