#include "track/crop.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vfit {

namespace {

constexpr float kBin_m = 0.01f;
constexpr size_t kDepthBins = 1000;  // to 10 m
// The person's extent is taken without this share of the pixels on either side: single wrong ones.
constexpr float kStray = 0.002f;
constexpr int kManyRows = 240;  // of which every second pixel of every second one tells where the person is
// Readings within this of the nearest one under a crop pixel are averaged; those behind are another surface.
constexpr float kSameSurface_m = 0.08f;

/// Bins that hold all but `left` and `right` counts at the ends.
std::pair<size_t, size_t> extent(const std::vector<uint32_t>& bins, size_t count, uint32_t stray) {
    size_t first = 0, last = count - 1;
    for (uint32_t sum = bins[first]; sum <= stray && first + 1 < count; sum += bins[first]) ++first;
    for (uint32_t sum = bins[last]; sum <= stray && last > first; sum += bins[last]) --last;
    return {first, last};
}

/// Columns of a crop row through `at` (its middle) that come within `margin` pixels of the box; others see
/// nothing.
std::pair<int, int> columns_in(const PixelBox& box, const Vec2& at, const Vec2& right, float margin) {
    constexpr float n = CropView::kPixels;
    float first = 0.0f, last = n;
    const float low[2] = {float(box.x0) - margin - 1, float(box.y0) - margin - 1};
    const float high[2] = {float(box.x1) + margin, float(box.y1) + margin};
    for (int k = 0; k < 2; ++k) {
        if (std::abs(right[k]) < 1e-6f) {
            if (at[k] < low[k] || at[k] > high[k]) return {0, 0};
            continue;
        }
        const float a = (low[k] - at[k]) / right[k] + 0.5f * n, b = (high[k] - at[k]) / right[k] + 0.5f * n;
        first = std::max(first, std::floor(std::min(a, b)));
        last = std::min(last, std::ceil(std::max(a, b)) + 1.0f);
    }
    return first < last ? std::pair(int(first), int(last)) : std::pair(0, 0);
}

/// One row of the crop, from `first` to before `last`: the mean of the nearest surface that `grid` x `grid`
/// points of each pixel see of the person; 1: nothing. All points are read alike, without branches, as most
/// lie on the person.
template <int grid>
void read_row(const DepthImage& image, uint8_t user, const PixelBox& box, const CropView& view, int j,
              int first, int last, float* out) {
    constexpr int n = CropView::kPixels;
    constexpr uint32_t nothing = ~0u;
    constexpr float apart = 1.0f / float(grid), first_at = 0.5f * apart - 0.5f * n;
    const uint16_t* const depth_of = image.depth;
    const uint8_t* const user_of = image.users;
    const Vec2 right = view.right;
    const int x0 = box.x0, y0 = box.y0, x1 = box.x1, y1 = box.y1;
    std::array<uint32_t, size_t(grid) * grid * n> depths;
    for (int b = 0; b < grid; ++b) {
        const Vec2 at = view.centre + view.down * (float(j) + float(b) * apart + first_at);
        uint32_t* const row = depths.data() + b * grid * n;
        for (int k = first * grid; k < last * grid; ++k) {
            const float ci = float(k) * apart + first_at;
            const float u = at.x + right.x * ci, v = at.y + right.y * ci;
            // Rounded; the box starts at 0 or later, and so what a cast takes the wrong way lies outside it.
            const int x = int(u + 0.5f), y = int(v + 0.5f);
            const bool inside = (u >= -0.5f) & (v >= -0.5f) & (x >= x0) & (y >= y0) & (x < x1) & (y < y1);
            const size_t p = inside ? image.index(uint32_t(x), uint32_t(y)) : 0;
            const uint32_t depth = depth_of[p];
            row[k] = inside & (user_of[p] == user) & (depth != 0) ? depth : nothing;
        }
    }
    const auto reach = uint32_t(kSameSurface_m / image.camera.depth_unit_m);
    for (int i = first; i < last; ++i) {
        uint32_t nearest = nothing;
        for (int b = 0; b < grid; ++b)
            for (int a = 0; a < grid; ++a)
                nearest = std::min(nearest, depths[size_t((b * n + i) * grid + a)]);
        if (nearest == nothing) {
            out[i] = 1.0f;
            continue;
        }
        uint32_t sum = 0, same = 0;
        for (int b = 0; b < grid; ++b)
            for (int a = 0; a < grid; ++a) {
                const uint32_t depth = depths[size_t((b * n + i) * grid + a)];
                const bool belongs = depth <= nearest + reach;
                sum += belongs ? depth : 0, same += belongs;
            }
        const float metres = float(sum) / float(same) * image.camera.depth_unit_m;
        out[i] = std::clamp((metres - view.depth_m) / (0.5f * CropView::kSide_m), -1.0f, 1.0f);
    }
}

}  // namespace

Vec3 CropView::from_camera(const Camera& camera, const Vec3& p) const {
    const Vec2 d = camera.project(p) - centre;
    const float half = 0.5f * kPixels;
    return {glm::dot(d, right) / glm::dot(right, right) / half,
            glm::dot(d, down) / glm::dot(down, down) / half, (p.z - depth_m) / (0.5f * kSide_m)};
}

Vec3 CropView::to_camera(const Camera& camera, const Vec3& crop) const {
    const float half = 0.5f * kPixels;
    const Vec2 q = centre + right * (crop.x * half) + down * (crop.y * half);
    return camera.unproject(q.x, q.y, std::max(0.1f, depth_m + crop.z * 0.5f * kSide_m));
}

bool Cropper::look(const DepthImage& image, uint8_t user, const PixelBox& box, const Vec2& up,
                   CropView& view) {
    // Axes of the crop in the image; along them the extent is searched.
    const Vec2 down = -up, right(down.y, -down.x);
    const size_t reach = image.width() + image.height();  // more than the image's diagonal
    depths_.assign(kDepthBins, 0);
    across_.assign(2 * reach, 0), along_.assign(2 * reach, 0);
    uint32_t count = 0;
    uint32_t *const depths = depths_.data(), *const across = across_.data(), *const along = along_.data();
    const float bins = image.camera.depth_unit_m / kBin_m;
    const int apart = box.y1 - box.y0 > kManyRows ? 2 : 1;
    for (int y = box.y0; y < box.y1; y += apart) {
        const size_t row = image.index(0, uint32_t(y));
        const float across_y = float(reach) + right.y * float(y), along_y = float(reach) + down.y * float(y);
        for (int x = box.x0; x < box.x1; x += apart) {
            const uint16_t depth = image.depth[row + size_t(x)];
            if (image.users[row + size_t(x)] != user || depth == 0) continue;
            ++count;
            ++depths[std::min(int(kDepthBins) - 1, int(float(depth) * bins))];
            ++across[int(across_y + right.x * float(x))];
            ++along[int(along_y + down.x * float(x))];
        }
    }
    if (count * uint32_t(apart * apart) < kFewestPixels) return false;

    size_t median = 0;
    for (uint32_t sum = depths_[0]; 2 * sum < count; sum += depths_[median]) ++median;
    view.depth_m = (float(median) + 0.5f) * kBin_m;
    const auto stray = static_cast<uint32_t>(kStray * float(count));
    const auto [left, rightmost] = extent(across_, 2 * reach, stray);
    const auto [top, bottom] = extent(along_, 2 * reach, stray);
    const float middle_right = 0.5f * (float(left) + float(rightmost)) + 0.5f - float(reach);
    const float middle_down = 0.5f * (float(top) + float(bottom)) + 0.5f - float(reach);
    view.centre = right * middle_right + down * middle_down;
    const float step = CropView::kSide_m / float(CropView::kPixels) / view.depth_m;
    view.right = right * (step * image.camera.fx);
    view.down = down * (step * image.camera.fy);
    return true;
}

bool Cropper::run(const DepthImage& image, uint8_t user, const PixelBox& within, const Vec2& up,
                  CropView& view, float* values) {
    const int width = int(image.width()), height = int(image.height());
    const PixelBox box = within.empty() ? PixelBox{0, 0, width, height}
                                        : PixelBox{std::max(within.x0, 0), std::max(within.y0, 0),
                                                   std::min(within.x1, width), std::min(within.y1, height)};
    if (!image.depth || !image.users || !look(image, user, box, up, view)) return false;

    // Where a crop pixel covers several image pixels a small grid of them is read.
    const float covered = std::max(std::abs(view.right.x) + std::abs(view.down.x),
                                   std::abs(view.right.y) + std::abs(view.down.y));
    const int grid = std::clamp(int(std::lround(covered)), 1, 3);
    const auto read_pixels = grid == 3 ? read_row<3> : grid == 2 ? read_row<2> : read_row<1>;
    constexpr int n = CropView::kPixels;
    for (int j = 0; j < n; ++j) {
        const float row = float(j) + 0.5f - 0.5f * n;
        const Vec2 at = view.centre + view.down * row;
        const auto [first, last] = columns_in(box, at, view.right, covered);
        std::fill_n(values + j * n, n, 1.0f);
        read_pixels(image, user, box, view, j, first, last, values + j * n);
    }
    return true;
}

}  // namespace vfit
