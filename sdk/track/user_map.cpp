#include "track/user_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vfit {

namespace {

// Of the way from the person to what is behind. The nearer surface sends back more light, so that half of
// each reads as less than half of the way.
constexpr float kMixedShare = 0.5f;

class Writer {
public:
    Writer(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users)
        : image_(image), grid_(grid), labels_(labels), users_(users), width_(int(image.width())),
          height_(int(image.height())), stride_(int(grid.stride())) {}

    void run() {
        std::memset(users_, 0, size_t(width_) * size_t(height_));
        for_each_labelled([this](int x, int y, int middle, int band, uint8_t label) {
            for (int v = y; v < y + stride_; ++v)
                for (int u = x; u < x + stride_; ++u) {
                    const int d = at(u, v);
                    if (d != 0 && std::abs(d - middle) <= band) users_[index(u, v)] = label;
                }
        });
        const int columns = int(grid_.width()), rows = int(grid_.height());
        for_each_labelled([&](int x, int y, int middle, int band, uint8_t label) {
            const int cx = x / stride_, cy = y / stride_;
            const size_t cell = size_t(cy) * size_t(columns) + size_t(cx);
            const bool inside = cx > 0 && cy > 0 && cx + 1 < columns && cy + 1 < rows && labels_[cell - 1] == label &&
                                labels_[cell + 1] == label && labels_[cell - size_t(columns)] == label &&
                                labels_[cell + size_t(columns)] == label;
            if (inside) return;
            for (int v = y; v < y + stride_; ++v)
                for (int u = x; u < x + stride_; ++u) {
                    if (std::abs(at(u, v) - middle) > band) continue;
                    mixed(u, v, 1, 0, middle, band, label);
                    mixed(u, v, -1, 0, middle, band, label);
                    mixed(u, v, 0, 1, middle, band, label);
                    mixed(u, v, 0, -1, middle, band, label);
                }
        });
    }

private:
    size_t index(int u, int v) const { return size_t(v) * size_t(width_) + size_t(u); }
    int at(int u, int v) const { return image_.depth[index(u, v)]; }

    /// visit(x and y of the first pixel, the surface's depth and the band around it in the image's units,
    /// label)
    template <typename Visit>
    void for_each_labelled(const Visit& visit) const {
        const float per_metre = 1.0f / image_.camera.depth_unit_m;
        const uint8_t* label = labels_;
        const float* depth = grid_.depth().data();
        const int width = int(grid_.width());
        for (int y = 0; y < int(grid_.height()); ++y, label += width, depth += width)
            for (int x = 0; x < width; ++x) {
                uint64_t eight = 1;
                if (x + 8 <= width) std::memcpy(&eight, label + x, sizeof eight);
                if (eight == 0) {
                    x += 7;
                } else if (label[x] != 0) {
                    const float z = depth[x];
                    visit(x * stride_, y * stride_, int(z * per_metre), int(same_surface_m(z) * per_metre), label[x]);
                }
            }
    }

    /// The pixel beside (u, v), if it lies between that pixel's surface and the one beyond.
    void mixed(int u, int v, int du, int dv, int middle, int band, uint8_t label) {
        const int bu = u + 2 * du, bv = v + 2 * dv;
        if (bu < 0 || bv < 0 || bu >= width_ || bv >= height_) return;
        const size_t next = index(u + du, v + dv);
        const int d = image_.depth[next], beyond = at(bu, bv);
        if (users_[next] != 0 || d <= middle + band || beyond <= middle + 2 * band) return;
        if (float(d - middle) < kMixedShare * float(beyond - middle)) users_[next] = label;
    }

    const DepthImage& image_;
    const DepthGrid& grid_;
    const uint8_t* labels_;
    uint8_t* users_;
    int width_, height_, stride_;
};

}  // namespace

void write_user_map(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users) {
    Writer(image, grid, labels, users).run();
}

}  // namespace vfit
