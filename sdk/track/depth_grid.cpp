#include "track/depth_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace vfit {

namespace {

// Readings of one cell are of one surface where they differ from its nearest by less than z / 32 and 10
// units: 7 sigma at 3 m, written so that whole rows can be done in 16-bit lanes.
constexpr int kDepthShift = 5;
constexpr uint16_t kFewUnits = 10;

// Of the noise that is measured: every so many rows, in units of depth_sigma_m.
constexpr uint32_t kNoiseRows = 8, kNoiseBins = 128, kFewestTriples = 500;
constexpr float kMaxSpread = 4.0f;
// Of three in a straight line: above, the noise is less than the sensor's steps, which hide it
// (1 / (sqrt(2 pi) sqrt(6)) of a normal distribution has the spread of one step).
constexpr float kStepped = 0.16f, kStraight_m = 1e-4f;
constexpr float kQuantile = 0.75f, kQuantileSpread = 1.15f;  // |x| of a normal distribution

/// One row of cells, out of kStride image rows. Arithmetic stays in 16 bits so that compilers use vectors.
template <uint32_t kStride>
void reduce_row(const uint16_t* const* rows, uint32_t width, uint16_t* nearest, uint16_t* extra,
                uint16_t* count) {
    // No reading becomes the farthest reading: 0 - 1 wraps to 65535.
    for (uint32_t x = 0; x < width; ++x) {
        uint16_t least = 65535;
        for (uint32_t j = 0; j < kStride; ++j)
            for (uint32_t i = 0; i < kStride; ++i)
                least = std::min(least, uint16_t(rows[j][x * kStride + i] - 1));
        nearest[x] = least;
    }
    for (uint32_t x = 0; x < width; ++x) {
        const uint16_t least = nearest[x];
        const uint16_t band = uint16_t((least >> kDepthShift) + kFewUnits);
        uint16_t sum = 0, n = 0;
        for (uint32_t j = 0; j < kStride; ++j)
            for (uint32_t i = 0; i < kStride; ++i) {
                const uint16_t over = uint16_t(uint16_t(rows[j][x * kStride + i] - 1) - least);
                const uint16_t taken = over <= band ? 0xffff : 0;
                sum = uint16_t(sum + (over & taken));
                n = uint16_t(n + (taken & 1));
            }
        extra[x] = sum;
        count[x] = n;
    }
}

/// The same for 2 x 2 pixels, the common case, two pixels to a 32-bit word. Without comparisons and with an
/// index that cannot wrap, so that compilers use vectors.
void reduce_pairs(const uint16_t* above, const uint16_t* below, uint32_t width, float unit, float* out) {
    const auto less = [](int32_t a, int32_t b) { return a < b ? a : b; };
    for (size_t x = 0; x < width; ++x) {
        uint32_t a, b;
        std::memcpy(&a, above + 2 * x, sizeof a);
        std::memcpy(&b, below + 2 * x, sizeof b);
        const int32_t p0 = int32_t((a - 1) & 0xffff), p1 = int32_t(((a >> 16) - 1) & 0xffff);
        const int32_t p2 = int32_t((b - 1) & 0xffff), p3 = int32_t(((b >> 16) - 1) & 0xffff);
        const int32_t least = less(less(p0, p1), less(p2, p3));
        const int32_t most = least + (least >> kDepthShift) + kFewUnits;
        const auto taken = [&](int32_t p) { return ~((most - p) >> 31); };  // all bits or none
        const int32_t t0 = taken(p0), t1 = taken(p1), t2 = taken(p2), t3 = taken(p3);
        const int32_t sum = (p0 & t0) + (p1 & t1) + (p2 & t2) + (p3 & t3), count = -(t0 + t1 + t2 + t3);
        const float none = float((65534 - least) >> 31);  // -1: no reading in the cell
        out[x] = (float(sum) / float(count) + 1.0f) * (unit + unit * none);
    }
}

}  // namespace

void DepthGrid::rays(const Camera& camera) {
    // Where the cell's middle lies: pixel centres are at whole coordinates.
    const float middle = 0.5f * float(stride_ - 1);
    for (uint32_t x = 0; x < width_; ++x) ray_x_[x] = (float(x * stride_) + middle - camera.cx) / camera.fx;
    for (uint32_t y = 0; y < height_; ++y) ray_y_[y] = (float(y * stride_) + middle - camera.cy) / camera.fy;
    cell_area_ = float(stride_ * stride_) / (camera.fx * camera.fy);
    cell_side_ = float(stride_) / camera.fx;
}

// Three neighbours on a smooth surface: their second difference has sqrt(6) times the spread of one. Edges
// have large ones, and so a quantile is taken that they do not reach.
void DepthGrid::measure_noise() {
    std::array<uint32_t, kNoiseBins> bins{};
    uint32_t count = 0, straight = 0;
    for (uint32_t y = kNoiseRows / 2; y < height_; y += kNoiseRows) {
        const float* const z = depth_.data() + size_t(y) * width_;
        for (uint32_t x = 1; x + 1 < width_; ++x) {
            if (z[x - 1] == 0.0f || z[x] == 0.0f || z[x + 1] == 0.0f) continue;
            const float bend = std::abs(z[x - 1] - 2.0f * z[x] + z[x + 1]);
            const float spread = bend / (2.45f * depth_sigma_m(z[x]));
            if (spread >= kMaxSpread) continue;  // an edge
            ++bins[size_t(spread * (float(kNoiseBins) / kMaxSpread))];
            ++count;
            straight += bend < kStraight_m;
        }
    }
    noise_ = 1.0f;
    if (count < kFewestTriples || float(straight) > kStepped * float(count)) return;
    uint32_t bin = 0;
    for (uint32_t below = bins[0]; float(below) < kQuantile * float(count); below += bins[bin]) ++bin;
    noise_ = std::min(1.0f, float(bin + 1) * (kMaxSpread / float(kNoiseBins)) / kQuantileSpread);
}

void DepthGrid::run(const DepthImage& image) {
    stride_ = 1;
    const auto next = [](uint32_t stride) { return stride < 4 ? stride + 1 : stride * 2; };
    // An image of a few rows keeps them: the grid is never empty.
    while (image.width() / stride_ > kMostColumns && next(stride_) <= image.height()) stride_ = next(stride_);
    width_ = image.width() / stride_;
    height_ = image.height() / stride_;
    depth_.resize(cells());
    ray_x_.resize(width_);
    ray_y_.resize(height_);
    nearest_.resize(width_);
    extra_.resize(width_);
    count_.resize(width_);
    rays(image.camera);

    const float unit = image.camera.depth_unit_m;
    for (uint32_t y = 0; y < height_; ++y) {
        // Cells of more than 3 x 3 pixels are sampled by their first ones: enough to average the noise.
        const uint16_t* rows[3];
        for (uint32_t j = 0; j < 3; ++j)
            rows[j] = image.depth + image.index(0, std::min(y * stride_ + j, image.height() - 1));
        float* const out = depth_.data() + size_t(y) * width_;
        if (stride_ == 1) {
            for (uint32_t x = 0; x < width_; ++x) out[x] = float(rows[0][x]) * unit;
            continue;
        }
        if (stride_ == 2) {
            reduce_pairs(rows[0], rows[1], width_, unit, out);
            continue;
        }
        if (stride_ == 3) {
            reduce_row<3>(rows, width_, nearest_.data(), extra_.data(), count_.data());
        } else {
            for (uint32_t x = 0; x < width_; ++x) {
                const uint32_t first = x * stride_;
                const uint16_t* const one[2] = {rows[0] + first, rows[1] + first};
                reduce_row<2>(one, 1, &nearest_[x], &extra_[x], &count_[x]);
            }
        }
        for (uint32_t x = 0; x < width_; ++x) {
            const float z = (float(nearest_[x]) + 1.0f + float(extra_[x]) / float(count_[x])) * unit;
            out[x] = nearest_[x] == 65535 ? 0.0f : z;
        }
    }
    measure_noise();
}

}  // namespace vfit
