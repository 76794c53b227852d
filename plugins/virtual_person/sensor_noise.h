// Turns the clean image into what the sensor reports: noise, drop-out, quantisation, projector shadow, flying
// pixels, range.
#pragma once

#include <cstdint>
#include <vector>

#include "clean_image.h"
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
    struct AngleTerms {  // of the model, tabulated over the cosine
        float axial;     // added to sigma_z, to be multiplied by a function of z alone
        float lateral_px, tangent;
        uint32_t dropout;  // of 65536
    };

    void structured_light_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row) const;
    void time_of_flight_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row) const;
    void ideal_row(const CleanImage& clean, uint32_t y, uint16_t* row) const;
    void mark_shadow(const CleanImage& clean, uint32_t y);
    float mixed_depth(const CleanImage& clean, uint32_t x, uint32_t y) const;
    const AngleTerms& terms(float cosine) const;
    float light_sigma_m(float z_m, float axial) const;
    uint16_t report(float z_m) const;

    SensorModel model_;
    NoiseSettings settings_;
    std::vector<AngleTerms> angle_;
    std::vector<float>
        frontal_sigma_m_;  // structured light, head-on, before rounding: one a millimetre of depth
    std::vector<uint16_t> step_depth_mm_;  // what the n-th disparity step reports, 0 out of range
    std::vector<uint8_t> shadow_;          // of the current row
};

}  // namespace vfit::virtual_person
