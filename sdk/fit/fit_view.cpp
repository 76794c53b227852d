#include "fit/fit_view.h"

#include <algorithm>
#include <cmath>

#include "core/wipe.h"

namespace vfit {

namespace {

constexpr float kCell_m = 0.012f;   // at the person's depth: a third of the model's triangles' sides
constexpr float kMargin_m = 0.25f;  // about the person, where the model may reach in error
constexpr float kSameSurface_m =
    0.05f;  // readings of one cell, or of a normal's window, that belong together
constexpr size_t kMostPoints = 600;
constexpr int kWindow = 2;  // cells to either side that a normal is fitted to
constexpr int kFewestInWindow = 8;
constexpr float kSteepestCosine = 0.15f;  // depth of surfaces turned further away is mostly error
constexpr int kManyRows =
    240;  // of which every second pixel of every second one tells how far and where the person is
constexpr float kBin_m = 0.02f;
constexpr size_t kBins = 500;  // to 10 m

}  // namespace

bool FitView::look(const DepthImage& image, uint8_t user, const PixelBox& within) {
    points_.clear();
    person_cells_ = 0;
    width_ = height_ = 0;
    if (!image.depth || !image.users) return false;
    const int w = int(image.width()), h = int(image.height());
    const PixelBox box = within.empty() ? PixelBox{0, 0, w, h}
                                        : PixelBox{std::max(within.x0, 0), std::max(within.y0, 0),
                                                   std::min(within.x1, w), std::min(within.y1, h)};
    histogram_.assign(kBins, 0);
    uint32_t count = 0;
    PixelBox person{w, h, 0, 0};
    const int apart = box.y1 - box.y0 > kManyRows ? 2 : 1;
    for (int y = box.y0; y < box.y1; y += apart) {
        const size_t row = image.index(0, uint32_t(y));
        for (int x = box.x0; x < box.x1; x += apart) {
            const size_t i = row + size_t(x);
            if (image.users[i] != user || image.depth[i] == 0) continue;
            ++count;
            ++histogram_[std::min(kBins - 1, size_t(image.metres(i) / kBin_m))];
            person.x0 = std::min(person.x0, x), person.x1 = std::max(person.x1, x + 1);
            person.y0 = std::min(person.y0, y), person.y1 = std::max(person.y1, y + 1);
        }
    }
    if (count * uint32_t(apart * apart) < kFewestCells) return false;
    size_t median = 0;
    for (uint32_t sum = histogram_[0]; 2 * sum < count; sum += histogram_[median]) ++median;
    choose_grid(image, person, (float(median) + 0.5f) * kBin_m);
    fill_cells(image, user);
    if (person_cells_ < kFewestCells) return false;
    find_points();
    return true;
}

void FitView::wipe() {
    vfit::wipe(std::span(cells_));
    vfit::wipe(std::span(depths_));
    vfit::wipe(std::span(points_));
    vfit::wipe(std::span(histogram_));
    width_ = height_ = 0;
    person_cells_ = 0;
}

void FitView::choose_grid(const DepthImage& image, const PixelBox& person, float depth_m) {
    const Camera& camera = image.camera;
    const float pixels_per_m = std::sqrt(camera.fx * camera.fy) / depth_m;
    step_ = std::max(1, int(kCell_m * pixels_per_m + 0.3f));
    const int margin = int(kMargin_m * pixels_per_m);
    left_ = std::max(0, person.x0 - margin), top_ = std::max(0, person.y0 - margin);
    most_cells_ = size_t(camera.width) * camera.height;
    width_ = (std::min(int(camera.width), person.x1 + margin) - left_) / step_;
    height_ = (std::min(int(camera.height), person.y1 + margin) - top_) / step_;
    const float s = float(step_), half = 0.5f * float(step_ - 1);  // of a cell's pixels, to their middle
    focal_ = Vec2(camera.fx, camera.fy) / s;
    centre_ = Vec2((camera.cx - float(left_) - half) / s, (camera.cy - float(top_) - half) / s);
    image_left_ = (-float(left_) - half) / s;
    image_top_ = (-float(top_) - half) / s;
    image_right_ = (float(int(camera.width) - 1 - left_) - half) / s;
    image_bottom_ = (float(int(camera.height) - 1 - top_) - half) / s;
}

template <int fixed>
void FitView::fill_cells_of(const DepthImage& image, uint8_t user) {
    const int step = fixed ? fixed : step_;
    const size_t count = size_t(width_) * size_t(height_);
    cells_.reserve(most_cells_);
    depths_.reserve(most_cells_);
    cells_.resize(count);
    depths_.resize(count);
    const float unit_m = image.camera.depth_unit_m;
    const auto reach = uint32_t(kSameSurface_m / unit_m);
    for (int cy = 0; cy < height_; ++cy)
        for (int cx = 0; cx < width_; ++cx) {
            const size_t cell = index(cx, cy),
                         first = image.index(uint32_t(left_ + cx * step), uint32_t(top_ + cy * step));
            uint32_t nearest = ~0u, own = 0, others = 0;
            uint64_t other = 0;
            for (int y = 0; y < step; ++y)
                for (int x = 0; x < step; ++x) {
                    const size_t i = first + size_t(y) * image.width() + size_t(x);
                    const uint32_t z = image.depth[i];
                    const bool seen = z != 0, mine = seen & (image.users[i] == user), theirs = seen & !mine;
                    own += mine, others += theirs;
                    other += theirs ? z : 0;
                    nearest = std::min(nearest, mine ? z : ~0u);
                }
            cells_[cell] = own > others ? FitCell::kPerson : others > 0 ? FitCell::kOther : FitCell::kFree;
            depths_[cell] = cells_[cell] == FitCell::kOther ? float(other) / float(others) * unit_m : 0.0f;
            if (cells_[cell] != FitCell::kPerson) continue;
            uint64_t sum = 0;
            uint32_t same = 0;
            for (int y = 0; y < step; ++y)
                for (int x = 0; x < step; ++x) {
                    const size_t i = first + size_t(y) * image.width() + size_t(x);
                    const uint32_t z = image.depth[i];
                    const bool belongs = (z != 0) & (image.users[i] == user) & (z <= nearest + reach);
                    sum += belongs ? z : 0, same += belongs;
                }
            depths_[cell] = float(sum) / float(same) * unit_m;
            ++person_cells_;
        }
}

void FitView::fill_cells(const DepthImage& image, uint8_t user) {
    // Steps as they are at a few metres: a cell's loops are then unrolled.
    if (step_ == 1) return fill_cells_of<1>(image, user);
    if (step_ == 2) return fill_cells_of<2>(image, user);
    if (step_ == 3) return fill_cells_of<3>(image, user);
    fill_cells_of<0>(image, user);
}

void FitView::find_points() {
    const int stride = std::max(1, int(std::ceil(std::sqrt(float(person_cells_) / float(kMostPoints)))));
    points_.reserve(2 * kMostPoints);
    for (int cy = kWindow; cy < height_ - kWindow; cy += stride)
        for (int cx = kWindow + (cy / stride % 2) * stride / 2; cx < width_ - kWindow; cx += stride) {
            if (cell(cx, cy) != FitCell::kPerson || points_.size() == 2 * kMostPoints) continue;
            const float here = depth(cx, cy);
            // Plane z = z0 + a x + b y through the cells about this one.
            float n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0, yy = 0, z1 = 0, xz = 0, yz = 0;
            for (int dy = -kWindow; dy <= kWindow; ++dy)
                for (int dx = -kWindow; dx <= kWindow; ++dx) {
                    if (cell(cx + dx, cy + dy) != FitCell::kPerson) continue;
                    const float z = depth(cx + dx, cy + dy) - here, x = float(dx), y = float(dy);
                    if (std::abs(z) > kSameSurface_m) continue;
                    n += 1, x1 += x, y1 += y, xx += x * x, xy += x * y, yy += y * y, z1 += z, xz += x * z,
                        yz += y * z;
                }
            if (n < float(kFewestInWindow)) continue;
            const float mx = x1 / n, my = y1 / n, mz = z1 / n;
            const float sxx = xx - n * mx * mx, sxy = xy - n * mx * my, syy = yy - n * my * my;
            const float sxz = xz - n * mx * mz, syz = yz - n * my * mz;
            const float determinant = sxx * syy - sxy * sxy;
            if (determinant < 1.0f) continue;  // cells on one line
            const float a = (sxz * syy - syz * sxy) / determinant, b = (syz * sxx - sxz * sxy) / determinant;
            const float z = here + mz - a * mx - b * my;
            const Vec3 look = ray(float(cx), float(cy));
            const Vec3 along_x = look * a + Vec3(z / focal_.x, 0, 0),
                       along_y = look * b + Vec3(0, z / focal_.y, 0);
            Vec3 normal = glm::normalize(glm::cross(along_y, along_x));
            const float cosine = -glm::dot(normal, look) / glm::length(look);
            if (!(cosine >= kSteepestCosine)) continue;
            points_.push_back({look * z, normal});
        }
}

}  // namespace vfit
