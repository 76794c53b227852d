// Turns the clean image into what the sensor reports: noise, drop-out, quantisation, projector shadow, flying
// pixels, range.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "clean_image.h"
#include "edge_tiles.h"
#include "sensor_model.h"

namespace vfit::virtual_person {

struct NoiseSettings {
    float scale = 1.0f;    // of both standard deviations and of the drop-out probability
    bool quantise = true;  // disparity steps of 1/8 px (structured light)
    bool shadow = true;    // strips that the projector does not reach (structured light)
    uint64_t seed = 1;
};

class SensorNoise {
public:
    SensorNoise(const SensorModel& model, const NoiseSettings& settings);

    /// Writes depth in millimetres, 0 where there is none; row_stride in bytes. Equal seed, frame and image
    /// give equal bits.
    void apply(const CleanImage& clean, uint64_t frame, uint16_t* depth_mm, uint32_t row_stride);

private:
    static constexpr uint32_t kAngleBins = 1024;
    // Two looked-up depths that differ by more than the slant of the surface explains belong to two surfaces.
    // The factor leaves room for curvature, the offset for facets.
    static constexpr float kSlantSlack = 1.5f, kEdgeJump_m = 0.02f;

    struct Terms {                 // of the model, tabulated over the cosine
        std::vector<float> axial;  // added to sigma_z, to be multiplied by a function of z alone
        std::vector<float> lateral_px, tangent;
        std::vector<uint32_t> dropout;  // of 65536
    };
    struct Row {                           // in the making, one item a pixel
        std::vector<uint64_t> bits;        // random
        std::vector<float> along;          // normal numbers
        std::vector<uint32_t> bin;         // of Terms
        std::vector<float> across, down;   // px, how far the look goes aside
        std::vector<int> seen;             // index of the pixel looked at
        std::vector<float> place;          // as the projector sees it
        std::vector<uint32_t> lit, alive;  // 1: by the projector; reports depth
        std::vector<float> depth_m, sigma_m, axial;
        std::vector<int> step;  // of disparity
    };

    static uint32_t bin_of(float cosine) {
        const float bin = std::clamp(cosine * kAngleBins, 0.0f, kAngleBins - 1.0f);
        return static_cast<uint32_t>(static_cast<int>(bin));
    }

    // Structured light.
    void prepare_light();
    void find_shadow(const float* depth, uint32_t width);
    void draw_numbers(uint64_t key, uint64_t first, uint32_t width);
    void jitter(uint32_t begin, uint32_t end, const CleanImage& clean, uint32_t y);
    void look_past_edges(uint32_t begin, uint32_t end, const CleanImage& clean, uint32_t y);
    void find_sigma(uint32_t width);
    void structured_light_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row);

    void time_of_flight_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row) const;
    void ideal_row(const CleanImage& clean, uint32_t y, uint16_t* row) const;
    float mixed_depth(const CleanImage& clean, uint32_t x, uint32_t y) const;
    uint16_t report(float z_m) const;

    SensorModel model_;
    NoiseSettings settings_;
    Terms terms_;
    std::vector<float>
        frontal_sigma_m_;  // structured light, head-on, before rounding: one a millimetre of depth
    std::vector<uint16_t> step_depth_mm_;  // what the n-th disparity step reports, 0 out of range
    EdgeTiles edges_;
    float least_cosine_ = 0.0f;  // of surfaces whose jitter stays within EdgeTiles::kReach
    Row row_;
};

}  // namespace vfit::virtual_person
