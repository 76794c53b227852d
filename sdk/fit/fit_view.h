// What one frame shows of one person: a grid of cells of about a centimetre with depth and mask, and depth
// points with normals.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/depth_image.h"
#include "track/depth_filter.h"

namespace vfit {

enum class FitCell : uint8_t {
    kFree,  // no reading
    kPerson,
    kOther,  // a reading that is not the person's: behind them, or hiding them
};

struct FitDepthPoint {
    Vec3 place{0.0f}, normal{0.0f};  // camera space; the normal points to the camera's side
};

class FitView {
public:
    /// Looks at the pixels of `users` equal to `user` inside `box` (empty: all of the image). Does not
    /// allocate after its first run on an image of that size. False where fewer than kFewestCells cells have
    /// a reading.
    bool look(const DepthImage& image, uint8_t user, const PixelBox& box);

    int width() const { return width_; }
    int height() const { return height_; }
    size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
    /// Cell coordinates (whole at a cell's centre) of a camera-space point before the camera.
    Vec2 project(const Vec3& p) const {
        return {p.x / p.z * focal_.x + centre_.x, p.y / p.z * focal_.y + centre_.y};
    }
    /// The direction, with z = 1, that a cell's centre looks into.
    Vec3 ray(float x, float y) const {
        return {(x - centre_.x) / focal_.x, (y - centre_.y) / focal_.y, 1.0f};
    }
    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    FitCell cell(int x, int y) const { return cells_[index(x, y)]; }
    /// Metres along the optical axis; 0 where there is no reading. Of a kPerson cell: the person's.
    float depth(int x, int y) const { return depths_[index(x, y)]; }
    const std::vector<FitDepthPoint>& points() const { return points_; }
    uint32_t person_cells() const { return person_cells_; }
    /// Of any view of an image of this size.
    size_t most_cells() const { return most_cells_; }
    /// Cells at the grid's rim lie at the image's border: what is beyond is not seen, not free.
    bool beyond_image(const Vec2& cell) const {
        return cell.x < image_left_ || cell.y < image_top_ || cell.x > image_right_ || cell.y > image_bottom_;
    }

    /// Overwrites what was seen.
    void wipe();

    static constexpr uint32_t kFewestCells = 150;

private:
    void choose_grid(const DepthImage& image, const PixelBox& person, float depth_m);
    void fill_cells(const DepthImage& image, uint8_t user);
    /// `fixed`: step_, or 0.
    template <int fixed>
    void fill_cells_of(const DepthImage& image, uint8_t user);
    void find_points();

    int width_ = 0, height_ = 0, step_ = 1;  // step: pixels a cell
    int left_ = 0, top_ = 0;                 // of the grid, pixels
    Vec2 focal_{1.0f}, centre_{0.0f};        // in cells
    float image_left_ = 0, image_top_ = 0, image_right_ = 0, image_bottom_ = 0;
    uint32_t person_cells_ = 0;
    size_t most_cells_ = 0;
    std::vector<FitCell> cells_;
    std::vector<float> depths_;
    std::vector<FitDepthPoint> points_;
    std::vector<uint32_t> histogram_;
};

}  // namespace vfit
