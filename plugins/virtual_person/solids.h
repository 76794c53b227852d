// Boxes and ellipsoids in the room, drawn into the clean image by ray and depth test.
#pragma once

#include <span>
#include <vector>

#include "clean_image.h"
#include "sensor_model.h"
#include "types.h"

namespace vfit::virtual_person {

struct Solid {
    enum class Shape { kBox, kEllipsoid } shape;
    Vec3 centre;  // world space
    Mat3 axes;    // columns: the half axes, at right angles to each other
};

inline Solid box(const Vec3& centre, const Vec3& half) {
    return {Solid::Shape::kBox, centre, Mat3(Vec3(half.x, 0, 0), Vec3(0, half.y, 0), Vec3(0, 0, half.z))};
}
inline Solid ellipsoid(const Vec3& centre, const Vec3& half) {
    return {Solid::Shape::kEllipsoid, centre, box(centre, half).axes};
}
/// Turned about the vertical axis through the world's origin, then moved.
Solid placed(const Solid& solid, float yaw_deg, const Vec3& by);

class SolidPainter {
public:
    /// As DepthCamera has them: rotation of world-from-camera, height of the camera above the world's origin.
    SolidPainter(const SensorModel& model, const Mat3& world_from_camera, float camera_height_m);

    /// Where a solid is nearer than what the image shows, the image shows the solid and nobody's label.
    void paint(std::span<const Solid> solids, CleanImage& image) const;

private:
    struct Window {
        uint32_t x0, y0, x1, y1;  // one past the last
    };
    Window window_of(const Solid& solid) const;
    void paint(const Solid& solid, CleanImage& image) const;

    SensorModel model_;
    Mat3 rotation_;
    Vec3 eye_;
};

}  // namespace vfit::virtual_person
