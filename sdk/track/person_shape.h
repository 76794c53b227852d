// Size and shape of a set of cells, and whether a person can look like that: tells people from walls, boxes,
// curtains, chairs and coat racks by their measures alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "track/depth_grid.h"

namespace vfit {

/// Sides of the upright person at which the view or the image ends.
enum OutOfView : uint32_t {
    kOutOfViewLeft = 1,  // of the person's picture, not of the body
    kOutOfViewRight = 2,
    kOutOfViewTop = 4,
    kOutOfViewFeet = 8,
};

/// World space (floor at 0, Y up) as far as the camera's floor is known.
struct Shape {
    uint32_t cells = 0;
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // of the cells, half open
    Vec3 centre{0.0f};
    float area_m2 = 0.0f;  // facing the camera
    float depth_m = 0.0f;  // mean
    float low_m = 0.0f, high_m = 0.0f;
    float width_m = 0.0f;        // 5th to 95th percentile across the view
    float trunk_width_m = 0.0f;  // 15th to 85th: arms held out are left out
    float thickness_m = 0.0f;    // 5th to 95th percentile along the view
    float flatness_m = 0.0f;     // standard deviation from the best plane
    float sigma_m = 0.0f;        // of a reading, at that depth
    float top_area_m2 = 0.0f;    // of the uppermost 20 cm: a head's 0.03 m2, a box's more
    float leg_width_m = 0.0f;    // mean breadth seen from 20 to 60 cm above the floor
    uint32_t out_of_view = 0;

    float height_m() const { return high_m - low_m; }
};

/// Measures the cells that it is given, in one pass.
class ShapeMeter {
public:
    /// view: the cells that the sensor fills at all (x0, y0, x1, y1; half open).
    ShapeMeter(const DepthGrid& grid, const Camera& camera, const std::array<int, 4>& view);
    void start();
    /// Row by row.
    void add(std::span<const uint32_t> cells);
    Shape finish();

    Vec3 world(uint32_t x, uint32_t y) const { return rotation_ * grid_.point(x, y) + Vec3(0, floor_m_, 0); }
    /// Image neighbour that is further down in the world: +-1 or +-width.
    int down() const { return down_; }

private:
    static constexpr int kBins = 160;
    using Histogram = std::array<float, kBins>;  // m2 per bin
    const DepthGrid& grid_;
    Mat3 rotation_;
    float floor_m_;
    std::array<int, 4> view_;
    int down_;

    Shape shape_;
    Histogram heights_, across_, along_;
    std::array<uint16_t, kBins> height_cells_;
    Vec3 sum_{0.0f}, origin_{0.0f};
    std::array<double, 6> products_{};
    uint32_t sides_ = 0;
};

/// As a wall or the side of a box, but for noise, and too large for a forearm.
bool is_flat(const Shape& shape);

/// feet_hidden: something nearer stands before the lower end.
bool looks_like_person(const Shape& shape, bool floor_known, bool feet_hidden);

}  // namespace vfit
