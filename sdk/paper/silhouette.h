// The body contour in a filtered depth map: walking from a pixel until the person's surface ends.
#pragma once

#include "frame/camera.h"
#include "track/depth_filter.h"

namespace vfit {

/// A change of depth by more than this within the width of the filter's kernel is a contour. The surface of a
/// limb or a trunk turns away by its half depth at most, 0.07 to 0.09 m over the last four pixels at 3 m; a
/// Kinect v1 scatters by 0.02 m there (Khoshelham and Elberink 2012).
inline constexpr float kContourJump_m = 0.10f;

struct Pixel {
    int x, y;
};

/// Pixel centres lie on integers. Far outside every image where the place is far outside, or not finite.
Pixel nearest_pixel(Vec2 place);

struct Walk {
    bool inside = false;     // the start lies on the person
    bool border = false;     // the image ended first: the contour was not seen
    float length_px = 0.0f;  // from the start to the contour
    Vec2 edge{0.0f};         // its place in the image

    bool seen() const { return inside && !border; }
};

/// Walks pixel by pixel in `direction` (pixels, need not be a unit vector).
Walk walk_to_contour(const FilteredDepth& depth, Vec2 start, Vec2 direction);

/// The vertical plane that faces the camera at some distance: lengths are measured in it, level or upright
/// in the world even where the camera is tilted or turned.
class FrontalPlane {
public:
    FrontalPlane(const Camera& camera, const Vec3& through);

    const Vec3& up() const { return up_; }
    const Vec3& right() const { return right_; }  // of the image, level
    /// The point of the plane that a pixel sees.
    Vec3 point(Vec2 pixel) const;
    float height(const Vec3& p) const { return glm::dot(up_, p); }
    float height(Vec2 pixel) const { return height(point(pixel)); }
    /// Angle of a pixel's line of sight above the horizon.
    float elevation_rad(Vec2 pixel) const;

    /// Walks from a point of the camera space in a direction of the camera space; the edge's place in this
    /// plane comes with it.
    struct Reach : Walk {
        Vec3 point{0.0f};
    };
    Reach reach(const FilteredDepth& depth, const Vec3& from, const Vec3& direction) const;

private:
    const Camera& camera_;
    Vec3 up_, right_, forward_;
    float distance_;
};

}  // namespace vfit
