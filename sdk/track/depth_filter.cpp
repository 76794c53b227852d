#include "track/depth_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace vfit {

namespace {

// Two readings of one surface a few pixels apart differ by less: five times the random error of a Kinect v1
// at 3.5 m (Khoshelham and Elberink 2012: 17 mm).
constexpr float kSameSurface_m = 0.085f;

/// Index into a line of `count` pixels, mirrored about its end pixels (gfedcb|abcdefgh|gfedcba).
int reflect(int i, int count) {
    if (count == 1) return 0;
    while (i < 0 || i >= count) i = i < 0 ? -i : 2 * count - 2 - i;
    return i;
}

/// Marks the person's readings of one row and counts them. The loop is free of branches, so that it is
/// vectorised.
uint32_t mark_row(const DepthImage& image, size_t row, uint32_t user_id, uint8_t* mask) {
    const uint32_t width = image.width();
    const uint16_t* const raw = image.depth + row;
    const uint8_t* const users = image.users + row;
    const uint8_t id = uint8_t(user_id);
    const void* const found = std::memchr(users, id, width);
    const uint32_t first = found ? uint32_t(static_cast<const uint8_t*>(found) - users) : width;
    std::fill_n(mask, first, uint8_t(FilteredDepth::kBackground));
    uint32_t count = 0;
    for (uint32_t x = first; x < width; ++x) {
        const uint8_t measured = uint8_t(users[x] == id) & uint8_t(raw[x] != 0);
        mask[x] = measured;
        count += measured;
    }
    return count;
}

/// Rows without a reading of the person, above and below a pixel that has none, itself included; counted to
/// one more than `most`. The image's edge ends no gap.
int gap_height(const DepthImage& image, size_t pixel, uint32_t user_id, int most) {
    const auto person = [&](size_t i) { return image.users[i] == user_id && image.depth[i] != 0; };
    const size_t width = image.width(), count = width * image.height();
    int rows = 1;
    size_t i = pixel;
    for (; rows <= most && i >= width && !person(i - width); i -= width) ++rows;
    if (i < width) return most + 1;
    i = pixel;
    for (; rows <= most && i + width < count && !person(i + width); i += width) ++rows;
    return i + width >= count ? most + 1 : rows;
}

/// Half of a Gaussian kernel, its centre first: binomial up to 5 pixels, beyond by OpenCV's rule for the
/// deviation that goes with a size. Written out, for it would be all that the library needs OpenCV for (20 MB
/// with what that needs).
std::vector<float> gaussian_weights(int kernel_px) {
    if (kernel_px == 1) return {1.0f};
    if (kernel_px == 3) return {2.0f / 4, 1.0f / 4};
    if (kernel_px == 5) return {6.0f / 16, 4.0f / 16, 1.0f / 16};
    const double sigma_px = 0.3 * (0.5 * (kernel_px - 1) - 1.0) + 0.8;
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = 0; i <= kernel_px / 2; ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
        sum += (i == 0 ? 1.0 : 2.0) * weights.back();
    }
    std::vector<float> out;
    for (const double weight : weights) out.push_back(float(weight / sum));
    return out;
}

}  // namespace

DepthFilter::DepthFilter(int kernel_px) {
    if (kernel_px < 1 || kernel_px > 31 || kernel_px % 2 == 0)
        fail(VFIT_ERROR_ARGUMENT, "depth filter: a kernel of ", kernel_px,
             " pixels is not odd and in 1 to 31");
    weights_ = gaussian_weights(kernel_px);
}

DepthFilter::~DepthFilter() { wipe(); }

void DepthFilter::wipe() {
    // volatile: the stores must survive although the buffers may be freed next.
    for (std::vector<float>* buffer : {&depth_, &rows_, &smooth_})
        for (volatile float& value : *buffer) value = 0.0f;
    for (volatile uint8_t& value : mask_) value = 0;
}

FilteredDepth DepthFilter::run(const DepthImage& image, uint32_t user_id) {
    FilteredDepth out;
    out.width = image.width();
    out.height = image.height();
    const size_t count = size_t(out.width) * out.height;
    if (depth_.size() < count) {
        depth_.resize(count);
        rows_.resize(count);
        smooth_.resize(count);
        mask_.resize(count);
    }
    out.depth_m = smooth_.data();
    out.mask = mask_.data();

    extract(image, user_id, out);
    smooth(out);
    return out;
}

// Lines 1 to 12 of Algorithm 1.
void DepthFilter::extract(const DepthImage& image, uint32_t user_id, FilteredDepth& out) {
    const int width = int(out.width), height = int(out.height);
    const float unit = image.camera.depth_unit_m;
    const bool possible = image.depth && image.users && user_id > 0 && user_id <= 255;
    PixelBox box{width, height, 0, 0};
    uint64_t sum = 0;

    for (int y = 0; y < height; ++y) {
        const size_t row = size_t(y) * out.width;
        uint8_t* const mask = mask_.data() + row;
        if (!possible) {
            std::fill_n(mask, width, uint8_t(FilteredDepth::kBackground));
            continue;
        }
        const uint32_t count = mark_row(image, row, user_id, mask);
        if (count == 0) continue;
        const auto measured = [](uint8_t m) { return m != FilteredDepth::kBackground; };
        const int first = int(std::find_if(mask, mask + width, measured) - mask);
        int last = width - 1;
        while (!measured(mask[last])) --last;

        const uint16_t* const raw = image.depth + row;
        float* const depth = depth_.data() + row;
        uint32_t row_sum = 0;
        for (int x = first; x <= last; ++x) {
            depth[x] = float(raw[x]) * unit;
            row_sum += mask[x] * uint32_t(raw[x]);  // kMeasured is 1
        }
        sum += row_sum;
        out.pixels += count;
        box = {std::min(box.x0, first), std::min(box.y0, y), std::max(box.x1, last + 1), y + 1};
        if (count < uint32_t(last - first + 1)) patch_row(image, row, first, last, user_id, out);
    }

    out.box = out.pixels > 0 ? box : PixelBox{};
    out.mean_m = out.pixels > 0 ? float(double(sum) / out.pixels * unit) : 0.0f;
    const int reach = 2 * int(weights_.size()) - 2;  // as far as smooth() looks beyond the box
    const int x0 = std::max(0, out.box.x0 - reach), x1 = std::min(width, out.box.x1 + reach);
    for (int y = std::max(0, out.box.y0 - reach); y < std::min(height, out.box.y1 + reach); ++y) {
        const size_t row = size_t(y) * out.width;
        for (size_t i = row + size_t(x0); i < row + size_t(x1); ++i)
            depth_[i] = mask_[i] == FilteredDepth::kBackground ? out.mean_m : depth_[i];
    }
}

void DepthFilter::patch_row(const DepthImage& image, size_t row, int first, int last, uint32_t user_id,
                            FilteredDepth& out) {
    uint8_t* const mask = mask_.data() + row;
    float* const depth = depth_.data() + row;
    const int longest_hole = 2 * int(weights_.size()) - 1;

    int left = first;  // the last reading so far
    for (int x = first + 1; x <= last; ++x) {
        if (mask[x] != FilteredDepth::kMeasured) continue;
        const int hole = x - left - 1;
        if (hole > 0) {
            bool empty = true, marked = true;
            for (int i = left + 1; i < x; ++i) {
                empty = empty && image.depth[row + size_t(i)] == 0;
                marked = marked && image.users[row + size_t(i)] == user_id;
            }
            const bool speckle =
                hole <= longest_hole && std::abs(depth[x] - depth[left]) < kSameSurface_m &&
                gap_height(image, row + size_t(left + 1 + hole / 2), user_id, longest_hole) <= longest_hole;
            if (empty && (marked || speckle)) {
                const float slope = (depth[x] - depth[left]) / float(hole + 1);
                for (int i = left + 1; i < x; ++i) {
                    depth[i] = depth[left] + slope * float(i - left);
                    mask[i] = FilteredDepth::kPatched;
                }
                out.patched += uint32_t(hole);
            }
        }
        left = x;
    }
}

// Eq. 2. Beyond the kernel's reach around the person the image is constant and stays so.
void DepthFilter::smooth(FilteredDepth& out) {
    const int width = int(out.width), height = int(out.height);
    std::fill_n(smooth_.data(), size_t(width) * size_t(height), out.mean_m);
    if (out.pixels == 0) return;

    const int reach = int(weights_.size()) - 1;
    const int x0 = std::max(0, out.box.x0 - reach), x1 = std::min(width, out.box.x1 + reach);
    const int y0 = std::max(0, out.box.y0 - reach), y1 = std::min(height, out.box.y1 + reach);

    const int inner0 = std::clamp(reach, x0, x1), inner1 = std::clamp(width - reach, inner0, x1);
    for (int y = std::max(0, y0 - reach); y < std::min(height, y1 + reach); ++y) {
        const float* const in = depth_.data() + size_t(y) * out.width;
        float* const to = rows_.data() + size_t(y) * out.width;
        const auto at_border = [&](int x) {
            float value = weights_[0] * in[x];
            for (int k = 1; k <= reach; ++k)
                value += weights_[size_t(k)] * (in[reflect(x - k, width)] + in[reflect(x + k, width)]);
            to[x] = value;
        };
        for (int x = x0; x < inner0; ++x) at_border(x);
        for (int x = inner1; x < x1; ++x) at_border(x);
        for (int x = inner0; x < inner1; ++x) to[x] = weights_[0] * in[x];
        for (int k = 1; k <= reach; ++k) {
            const float weight = weights_[size_t(k)];
            for (int x = inner0; x < inner1; ++x) to[x] += weight * (in[x - k] + in[x + k]);
        }
    }

    double correction = 0.0;
    for (int y = y0; y < y1; ++y) {
        const size_t row = size_t(y) * out.width;
        float* const to = smooth_.data() + row;
        const float* const centre = rows_.data() + row;
        for (int x = x0; x < x1; ++x) to[x] = weights_[0] * centre[x];
        for (int k = 1; k <= reach; ++k) {
            const float weight = weights_[size_t(k)];
            const float* const above = rows_.data() + size_t(reflect(y - k, height)) * out.width;
            const float* const below = rows_.data() + size_t(reflect(y + k, height)) * out.width;
            for (int x = x0; x < x1; ++x) to[x] += weight * (above[x] + below[x]);
        }
        float row_correction = 0.0f;
        for (int x = x0; x < x1; ++x) {
            const float change = std::abs(to[x] - depth_[row + size_t(x)]);
            row_correction += mask_[row + size_t(x)] == FilteredDepth::kMeasured ? change : 0.0f;
        }
        correction += row_correction;
    }
    out.correction_m = float(correction / out.pixels);
}

}  // namespace vfit
