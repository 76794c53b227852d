#include "track/crop.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kBin_m = 0.01f;
constexpr size_t kDepthBins = 1000;  // to 10 m
// The person's extent is taken without this share of the pixels on either side: single wrong ones.
constexpr float kStray = 0.002f;
// Readings within this of the nearest one under a crop pixel are averaged; those behind are another surface.
constexpr float kSameSurface_m = 0.08f;

/// Bins that hold all but `left` and `right` counts at the ends.
std::pair<size_t, size_t> extent(const std::vector<uint32_t>& bins, size_t count, uint32_t stray) {
    size_t first = 0, last = count - 1;
    for (uint32_t sum = bins[first]; sum <= stray && first + 1 < count; sum += bins[first]) ++first;
    for (uint32_t sum = bins[last]; sum <= stray && last > first; sum += bins[last]) --last;
    return {first, last};
}

}  // namespace

Vec3 CropView::from_camera(const Camera& camera, const Vec3& p) const {
    const Vec2 d = camera.project(p) - centre;
    const float half = 0.5f * kPixels;
    return {glm::dot(d, right) / glm::dot(right, right) / half, glm::dot(d, down) / glm::dot(down, down) / half,
            (p.z - depth_m) / (0.5f * kSide_m)};
}

Vec3 CropView::to_camera(const Camera& camera, const Vec3& crop) const {
    const float half = 0.5f * kPixels;
    const Vec2 q = centre + right * (crop.x * half) + down * (crop.y * half);
    return camera.unproject(q.x, q.y, std::max(0.1f, depth_m + crop.z * 0.5f * kSide_m));
}

bool Cropper::look(const DepthImage& image, uint8_t user, const PixelBox& box, const Vec2& up, CropView& view) {
    // Axes of the crop in the image; along them the extent is searched.
    const Vec2 down = -up, right(down.y, -down.x);
    const size_t reach = image.width() + image.height();  // more than the image's diagonal
    depths_.assign(kDepthBins, 0);
    across_.assign(2 * reach, 0), along_.assign(2 * reach, 0);
    uint32_t count = 0;
    for (int y = box.y0; y < box.y1; ++y) {
        const size_t row = image.index(0, uint32_t(y));
        for (int x = box.x0; x < box.x1; ++x) {
            if (image.users[row + size_t(x)] != user || image.depth[row + size_t(x)] == 0) continue;
            ++count;
            ++depths_[std::min(kDepthBins - 1, size_t(image.metres(row + size_t(x)) / kBin_m))];
            ++across_[size_t(float(reach) + right.x * float(x) + right.y * float(y))];
            ++along_[size_t(float(reach) + down.x * float(x) + down.y * float(y))];
        }
    }
    if (count < kFewestPixels) return false;

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

bool Cropper::run(const DepthImage& image, uint8_t user, const PixelBox& within, const Vec2& up, CropView& view,
                  float* values) {
    const int width = int(image.width()), height = int(image.height());
    const PixelBox box = within.empty() ? PixelBox{0, 0, width, height}
                                        : PixelBox{std::max(within.x0, 0), std::max(within.y0, 0),
                                                   std::min(within.x1, width), std::min(within.y1, height)};
    if (!image.depth || !image.users || !look(image, user, box, up, view)) return false;

    constexpr int n = CropView::kPixels;
    // Where a crop pixel covers several image pixels a small grid of them is read.
    const float covered = std::max(std::abs(view.right.x) + std::abs(view.down.x),
                                   std::abs(view.right.y) + std::abs(view.down.y));
    const int grid = std::clamp(int(std::lround(covered)), 1, 3);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            float nearest = 1e9f, sum = 0.0f;
            float read[9];
            int reads = 0;
            for (int b = 0; b < grid; ++b)
                for (int a = 0; a < grid; ++a) {
                    const float ci = float(i) + (float(a) + 0.5f) / float(grid) - 0.5f * n;
                    const float cj = float(j) + (float(b) + 0.5f) / float(grid) - 0.5f * n;
                    const Vec2 q = view.centre + view.right * ci + view.down * cj;
                    const int x = int(std::floor(q.x + 0.5f)), y = int(std::floor(q.y + 0.5f));
                    if (x < box.x0 || y < box.y0 || x >= box.x1 || y >= box.y1) continue;
                    const size_t p = image.index(uint32_t(x), uint32_t(y));
                    if (image.users[p] != user || image.depth[p] == 0) continue;
                    read[reads] = image.metres(p);
                    nearest = std::min(nearest, read[reads++]);
                }
            int same = 0;
            for (int k = 0; k < reads; ++k)
                if (read[k] <= nearest + kSameSurface_m) sum += read[k], ++same;
            values[j * n + i] =
                same == 0 ? 1.0f
                          : std::clamp((sum / float(same) - view.depth_m) / (0.5f * CropView::kSide_m), -1.0f, 1.0f);
        }
    return true;
}

}  // namespace vfit
