// One person's depth as the small square picture that the skeleton network reads, and the way back from it.
// Training (training/crops) cuts its pictures with this same code.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/depth_image.h"
#include "track/depth_filter.h"

namespace vfit {

/// Where a crop looks. Its picture is seen by the sensor, resampled so that a pixel is kSide_m / kPixels wide
/// at the person's depth, and turned so that the world's up is the picture's up.
struct CropView {
    static constexpr int kPixels = 128;
    static constexpr float kSide_m = 2.3f;

    Vec2 centre{0.0f};       // image pixels
    Vec2 right{1.0f, 0.0f};  // one crop pixel to the right, in image pixels
    Vec2 down{0.0f, 1.0f};
    float depth_m = 0.0f;  // of the person: the median of the pixels

    /// Crop coordinates: x and y from -1 (left, top) to 1, z of +-1 at kSide_m / 2 behind and before the
    /// person.
    Vec3 from_camera(const Camera& camera, const Vec3& p) const;
    Vec3 to_camera(const Camera& camera, const Vec3& crop) const;
};

class Cropper {
public:
    /// Pixels of `users` equal to `user` inside `box` (what of it lies in the image; empty: all of the image)
    /// into kPixels x kPixels values of crop z; 1 where the person is not. `up`: the world's up in image axes
    /// (x right, y down), unit length. False where fewer than kFewestPixels pixels have a reading. Does not
    /// allocate after its first run.
    bool run(const DepthImage& image, uint8_t user, const PixelBox& box, const Vec2& up, CropView& view,
             float* values);

    static constexpr uint32_t kFewestPixels = 64;

private:
    bool look(const DepthImage& image, uint8_t user, const PixelBox& box, const Vec2& up, CropView& view);
    std::vector<uint32_t> depths_, across_, along_;  // histograms
};

}  // namespace vfit
