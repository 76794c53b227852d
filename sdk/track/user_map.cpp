#include "track/user_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vfit {

namespace {

// Of the way from the person to what is behind. The nearer surface sends back more light, so that half of
// each reads as less than half of the way.
constexpr float kMixedShare = 0.5f;
constexpr int kChunk = 256;  // pixels that are written at a time; more than the widest cell

class Writer {
public:
    Writer(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users)
        : image_(image),
          grid_(grid),
          labels_(labels),
          users_(users),
          width_(int(image.width())),
          height_(int(image.height())),
          stride_(int(grid.stride())),
          per_metre_(1.0f / image.camera.depth_unit_m) {}

    void run() {
        std::memset(users_, 0, size_t(width_) * size_t(height_));
        const int columns = int(grid_.width()), rows = int(grid_.height());
        const int chunk = std::max(1, kChunk / stride_);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; x += chunk) fill(x, y, std::min(chunk, columns - x));
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                // Eight cells at a time are left out where nobody is, or nobody but one.
                if (x > 0 && x + 9 <= columns && y > 0 && y + 1 < rows && alike(x, y)) {
                    x += 7;
                    continue;
                }
                if (at_cell(x, y) != 0 && !surrounded(x, y)) outline(x, y);
            }
    }

private:
    size_t index(int u, int v) const { return size_t(v) * size_t(width_) + size_t(u); }
    int at(int u, int v) const { return image_.depth[index(u, v)]; }

    uint8_t at_cell(int x, int y) const { return labels_[size_t(y) * grid_.width() + size_t(x)]; }

    uint64_t eight(int x, int y) const {
        uint64_t labels;
        std::memcpy(&labels, labels_ + size_t(y) * grid_.width() + size_t(x), sizeof labels);
        return labels;
    }
    bool alike(int x, int y) const {
        const uint64_t same = at_cell(x, y) * 0x0101010101010101ull;
        return eight(x, y) == same && (same == 0 || (eight(x - 1, y) == same && eight(x + 1, y) == same &&
                                                     eight(x, y - 1) == same && eight(x, y + 1) == same));
    }
    bool surrounded(int x, int y) const {
        const uint8_t label = at_cell(x, y);
        return x > 0 && y > 0 && x + 1 < int(grid_.width()) && y + 1 < int(grid_.height()) &&
               at_cell(x - 1, y) == label && at_cell(x + 1, y) == label && at_cell(x, y - 1) == label &&
               at_cell(x, y + 1) == label;
    }

    /// A cell's surface in the image's units, and how far a reading of it may be off.
    void surface(int x, int y, int& middle, int& band) const {
        const float z = grid_.depth()[size_t(y) * grid_.width() + size_t(x)];
        middle = int(z * per_metre_);
        band = int(same_surface_m(z) * per_metre_);
    }

    /// The pixels of so many cells of a row. Written in passes without branches, for vectors.
    void fill(int x, int y, int cells) {
        const uint8_t* const labels = labels_ + size_t(y) * grid_.width() + size_t(x);
        const float* const depth = grid_.depth().data() + size_t(y) * grid_.width() + size_t(x);
        uint8_t any = 0;
        for (int k = 0; k < cells; ++k) any |= labels[k];
        if (any == 0) return;
        // A reading from `low` to `low + span` is labelled.
        int low[kChunk], span[kChunk];
        for (int k = 0; k < cells; ++k) {
            const int middle = int(depth[k] * per_metre_), band = int(same_surface_m(depth[k]) * per_metre_);
            const int least = middle - band > 1 ? middle - band : 1;
            const int most = middle + band < 65535 ? middle + band : 65535;
            low[k] = least;
            span[k] = most - least;
        }
        for (int v = y * stride_; v < (y + 1) * stride_; ++v) {
            const uint16_t* const from = image_.depth + index(x * stride_, v);
            uint8_t* const to = users_ + index(x * stride_, v);
            if (stride_ == 2) {
                for (int k = 0; k < cells; ++k)
                    for (int i = 0; i < 2; ++i)
                        to[2 * k + i] = label(from[2 * k + i], low[k], span[k], labels[k]);
            } else {
                for (int k = 0; k < cells; ++k)
                    for (int i = 0; i < stride_; ++i)
                        to[stride_ * k + i] = label(from[stride_ * k + i], low[k], span[k], labels[k]);
            }
        }
    }
    static uint8_t label(int reading, int low, int span, uint8_t of_cell) {
        const uint32_t above = uint32_t(reading - low);  // huge where it is below
        return above <= uint32_t(span) ? of_cell : uint8_t(0);
    }

    void outline(int x, int y) {
        int middle, band;
        surface(x, y, middle, band);
        const uint8_t label = at_cell(x, y);
        for (int v = y * stride_; v < (y + 1) * stride_; ++v)
            for (int u = x * stride_; u < (x + 1) * stride_; ++u) {
                if (std::abs(at(u, v) - middle) > band) continue;
                mixed(u, v, 1, 0, middle, band, label);
                mixed(u, v, -1, 0, middle, band, label);
                mixed(u, v, 0, 1, middle, band, label);
                mixed(u, v, 0, -1, middle, band, label);
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
    float per_metre_;
};

}  // namespace

void write_user_map(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users) {
    Writer(image, grid, labels, users).run();
}

}  // namespace vfit
