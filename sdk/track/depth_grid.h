// The depth image on a coarser grid: what floor, background and people are looked for on. A cell is a square
// of 1, 2, ... pixels, so that the grid is at most about 360 cells wide and costs the same for every camera.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "frame/depth_image.h"

namespace vfit {

/// Spread of a depth reading at z metres: Nguyen, Izadi and Lovell 2012, Kinect v1. Time-of-flight cameras
/// are better than that at every distance.
inline float depth_sigma_m(float z) { return 0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f); }

/// Two neighbouring cells are of one surface where their depths differ by less: five sigma of noise, and what
/// a surface as oblique as a body's flank climbs in one cell.
inline float same_surface_m(float z) { return 0.03f + 5.0f * depth_sigma_m(z); }

class DepthGrid {
public:
    static constexpr uint32_t kMostColumns = 360;

    /// Allocates only where the image is larger than any before.
    void run(const DepthImage& image);

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    uint32_t cells() const { return width_ * height_; }
    /// Pixels along a cell's side; what is left over at the right and lower border belongs to no cell.
    uint32_t stride() const { return stride_; }

    /// Depth of each cell in metres, 0 where none of its pixels has a reading: the mean of the readings that
    /// are on the surface nearest to the camera, so that no finger between two pixels gets lost.
    const std::vector<float>& depth() const { return depth_; }
    /// x / z of a column's cells, y / z of a row's.
    const std::vector<float>& ray_x() const { return ray_x_; }
    const std::vector<float>& ray_y() const { return ray_y_; }

    /// visit(cell, x, y) for each of these cells; quick where they come row by row.
    template <typename Visit>
    void for_each(std::span<const uint32_t> cells, const Visit& visit) const {
        uint32_t row = 0, y = 0;
        for (const uint32_t cell : cells) {
            if (cell - row >= width_) {  // wraps where the cell lies before the row
                y = cell / width_;
                row = y * width_;
            }
            visit(cell, cell - row, y);
        }
    }

    Vec3 point(uint32_t x, uint32_t y) const {
        const float z = depth_[size_t(y) * width_ + x];
        return {ray_x_[x] * z, ray_y_[y] * z, z};
    }
    /// Spread of a cell's depth at z metres, as this image shows it: at most depth_sigma_m.
    float sigma_m(float z) const { return noise_ * depth_sigma_m(z); }
    /// Two neighbouring cells are of one surface where their depths differ by less: five sigma of noise, and
    /// what a surface as oblique as a body's flank climbs in one cell.
    float same_surface_m(float z) const {
        return std::min(kClimb_m, kSteepest * cell_m(z)) + 5.0f * sigma_m(z);
    }
    /// Square metres that a cell at depth z covers.
    float area_m2(float z) const { return cell_area_ * z * z; }
    float cell_m(float z) const { return cell_side_ * z; }

private:
    static constexpr float kClimb_m = 0.03f;
    static constexpr float kSteepest = 3.0f;  // tan 72 degrees: steeper surfaces send back next to nothing
    void rays(const Camera& camera);
    void measure_noise();
    uint32_t width_ = 0, height_ = 0, stride_ = 1;
    float cell_area_ = 0.0f, cell_side_ = 0.0f;
    float noise_ = 1.0f;  // of depth_sigma_m
    std::vector<float> depth_, ray_x_, ray_y_;
    std::vector<uint16_t> nearest_, extra_, count_;  // of one row of cells
};

}  // namespace vfit
