// Algorithm 1 and Eq. 2 of the paper: one person's depth pixels, smoothed, on a background of their mean.
//
// Eq. 1 as printed multiplies the background by the mean; Algorithm 1, which sets it to the mean, is what is
// done here, followed by the Gaussian of Eq. 2 that Algorithm 1 leaves out.
//
// A pixel without a reading (depth 0) is never a source of data. It is patched on its way along the row, by
// linear interpolation between the person's readings on both sides, if the user map calls it the person's, or
// if it lies in a hole no wider and no higher than the kernel whose two sides lie on one surface (the long
// gap between arm and trunk is no hole). Every other one is background.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/depth_image.h"

namespace vfit {

/// Half-open pixel rectangle.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x1 <= x0 || y1 <= y0; }
};

/// A view of the filter's buffers: valid until its next run.
struct FilteredDepth {
    enum Mask : uint8_t { kBackground = 0, kMeasured = 1, kPatched = 2 };

    const float* depth_m = nullptr;  // D_G of Eq. 2, one a pixel
    const uint8_t* mask = nullptr;   // Mask, one a pixel
    uint32_t width = 0, height = 0;
    float mean_m = 0.0f;        // of the person's readings: depth_average of Algorithm 1
    float correction_m = 0.0f;  // mean |D_G - D| over the person's readings (Fig. 9)
    uint32_t pixels = 0;        // measured; 0: the person is not in the image
    uint32_t patched = 0;
    PixelBox box;  // of the mask

    bool inside(int x, int y) const {
        return x >= 0 && y >= 0 && x < int(width) && y < int(height) &&
               mask[size_t(y) * width + size_t(x)] != 0;
    }
    float at(int x, int y) const { return depth_m[size_t(y) * width + size_t(x)]; }
};

class DepthFilter {
public:
    /// An odd kernel of 1 (no smoothing) to 31 pixels, else VFIT_ERROR_ARGUMENT. The Gaussian's sigma is
    /// the one that goes with that size (1.1 pixels for 5).
    explicit DepthFilter(int kernel_px = 5);
    ~DepthFilter();
    DepthFilter(const DepthFilter&) = delete;
    DepthFilter& operator=(const DepthFilter&) = delete;

    /// Allocates only where the image is larger than any before. Without a user map nobody is found.
    FilteredDepth run(const DepthImage& image, uint32_t user_id);

    /// Overwrites the last person's depth with zeros.
    void wipe();

private:
    void extract(const DepthImage& image, uint32_t user_id, FilteredDepth& out);
    void patch_row(const DepthImage& image, size_t row, int first, int last, uint32_t user_id,
                   FilteredDepth& out);
    void smooth(FilteredDepth& out);

    std::vector<float> weights_;  // one side of the symmetric kernel, centre first
    std::vector<float> depth_, rows_, smooth_;
    std::vector<uint8_t> mask_;
};

}  // namespace vfit
