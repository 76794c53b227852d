#include "frame/depth_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kWidest = 150.0f;                         // degrees
constexpr float kFarthest_m = 12.0f, kNearest_m = 0.05f;  // medians
constexpr uint16_t kNoDisparity = 2047;                   // of a Kinect v1: 11 bits
constexpr size_t kSamples = 20'000;
constexpr float kFewest = 0.01f, kManyOfOne = 0.03f;  // shares of the samples

float field_of_view(uint32_t pixels, float focal_px) {
    return 2.0f * std::atan(0.5f * float(pixels) / focal_px) * (180.0f / kPi);
}

}  // namespace

bool check_depth(const DepthImage& image) {
    const Camera& camera = image.camera;
    const float across = field_of_view(camera.width, camera.fx),
                down = field_of_view(camera.height, camera.fy);
    if (across > kWidest || down > kWidest)
        fail(VFIT_ERROR_DATA, "the intrinsics say a field of view of ", std::lround(across), " by ",
             std::lround(down), " degrees: focal lengths of ", camera.fx, " and ", camera.fy,
             " are not those of ", camera.width, " x ", camera.height, " pixels");
    const size_t count = size_t(camera.width) * camera.height, step = std::max<size_t>(1, count / kSamples);
    std::vector<uint16_t> readings;
    size_t samples = 0, none = 0;
    for (size_t i = 0; i < count; i += step) {
        ++samples, none += image.depth[i] == kNoDisparity;
        if (image.depth[i]) readings.push_back(image.depth[i]);
    }
    if (float(readings.size()) < kFewest * float(samples) || readings.empty()) return false;
    if (float(none) > kManyOfOne * float(samples) &&
        *std::max_element(readings.begin(), readings.end()) == kNoDisparity)
        fail(VFIT_ERROR_DATA, "the depth image has no value above 2047, and that in ",
             std::lround(100.0 * double(none) / double(samples)),
             " of 100 pixels: it holds raw disparities of 11 bits, and not depths");
    const auto middle = readings.begin() + std::ptrdiff_t(readings.size() / 2);
    std::nth_element(readings.begin(), middle, readings.end());
    const float median_m = float(*middle) * camera.depth_unit_m;
    if (median_m > kFarthest_m || median_m < kNearest_m)
        fail(VFIT_ERROR_DATA, "the depth image's median is ", median_m, " m: a unit of ", camera.depth_unit_m,
             " m is wrong, or the values are packed with other bits");
    return true;
}

}  // namespace vfit
