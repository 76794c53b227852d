#include "sensor_noise.h"

#include <algorithm>
#include <cmath>

#include "random.h"
#include "types.h"

namespace vfit::virtual_person {

namespace {

// A time-of-flight pixel mixes what its lens blurs into it: centre, side and corner weights of a Gaussian of
// 0.5 px, the usual blur of such lenses at the pixel pitch.
constexpr float kBlurCentre = 0.619f, kBlurSide = 0.084f, kBlurCorner = 0.011f;

constexpr float kMixingJump_m = 0.03f;     // below, the mixture is the mean within a few millimetres
constexpr float kModulation_hz = 16.0e6f;  // lowest of the Kinect v2: unambiguous to 9.4 m
constexpr float kLightSpeed_m_s = 2.99792458e8f;
constexpr float kLeastCoherence = 0.4f;  // of |sum| to the sum of amplitudes: below, no depth is reported

// A look-up goes no farther than 64 px, which only a noise scale above 10 would ask for.
constexpr float kMostLateral_px = 14.0f;

}  // namespace

SensorNoise::SensorNoise(const SensorModel& model, const NoiseSettings& settings)
    : model_(model), settings_(settings) {
    for (uint32_t i = 0; i < kAngleBins; ++i) {
        const float theta = std::acos((static_cast<float>(i) + 0.5f) / kAngleBins);
        // The slant term is separable: what is left at z = 1 m, where its factor of z is 1.
        const float frontal = axial_sigma_m(model.principle, 1.0f, 0.0f);
        terms_.axial.push_back(axial_sigma_m(model.principle, 1.0f, theta) - frontal);
        terms_.lateral_px.push_back(
            std::min(kMostLateral_px, lateral_sigma_px(model.principle, theta) * settings.scale));
        terms_.tangent.push_back(std::tan(theta));
        const float share = std::min(1.0f, dropout_probability(model.principle, theta) * settings.scale);
        terms_.dropout.push_back(static_cast<uint32_t>(std::lround(share * 65536.0f)));
    }
    if (model.principle == DepthPrinciple::kStructuredLight) prepare_light();
}

uint16_t SensorNoise::report(float z) const {
    if (!(z >= model_.range_min_m && z <= model_.range_max_m)) return 0;
    return static_cast<uint16_t>(z * 1000.0f + 0.5f);
}

void SensorNoise::apply(const CleanImage& clean, uint64_t frame, uint16_t* depth_mm, uint32_t row_stride) {
    const uint64_t key = frame_key(settings_.seed, frame);
    if (model_.principle == DepthPrinciple::kStructuredLight) edges_.find(clean, kEdgeJump_m, least_cosine_);
    for (uint32_t y = 0; y < clean.height; ++y) {
        auto* row =
            reinterpret_cast<uint16_t*>(reinterpret_cast<uint8_t*>(depth_mm) + size_t{y} * row_stride);
        switch (model_.principle) {
            case DepthPrinciple::kIdeal: ideal_row(clean, y, row); break;
            case DepthPrinciple::kStructuredLight: structured_light_row(clean, key, y, row); break;
            case DepthPrinciple::kTimeOfFlight: time_of_flight_row(clean, key, y, row); break;
        }
    }
}

void SensorNoise::ideal_row(const CleanImage& clean, uint32_t y, uint16_t* row) const {
    const float* depth = clean.depth_m.data() + size_t{y} * clean.width;
    for (uint32_t x = 0; x < clean.width; ++x) row[x] = report(depth[x]);
}

// The phasors of what the pixel's blur covers add up; the reported distance is the phase of the sum, which
// between two surfaces lies in the air (a flying pixel).
float SensorNoise::mixed_depth(const CleanImage& clean, uint32_t x, uint32_t y) const {
    const float phase_per_m = 4.0f * kPi * kModulation_hz / kLightSpeed_m_s;
    float real = 0.0f, imaginary = 0.0f, amplitudes = 0.0f;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const size_t i =
                size_t(static_cast<int>(y) + dy) * clean.width + size_t(static_cast<int>(x) + dx);
            const float z = clean.depth_m[i];
            if (z <= 0.0f) continue;
            const float weight = dx == 0 && dy == 0   ? kBlurCentre
                                 : dx == 0 || dy == 0 ? kBlurSide
                                                      : kBlurCorner;
            const float amplitude = weight * clean.cosine[i] / (z * z);
            real += amplitude * std::cos(phase_per_m * z);
            imaginary += amplitude * std::sin(phase_per_m * z);
            amplitudes += amplitude;
        }
    }
    if (std::hypot(real, imaginary) < kLeastCoherence * amplitudes || amplitudes <= 0.0f) return 0.0f;
    float phase = std::atan2(imaginary, real);
    if (phase < 0.0f) phase += 2.0f * kPi;
    return phase / phase_per_m;
}

void SensorNoise::time_of_flight_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row) const {
    const uint32_t w = clean.width;
    const size_t first = size_t{y} * w;
    const bool inner_row = y > 0 && y + 1 < clean.height && settings_.scale > 0.0f;
    for (uint32_t x = 0; x < w; ++x) {
        const size_t i = first + x;
        float z = clean.depth_m[i];
        if (z <= 0.0f) {
            row[x] = 0;
            continue;
        }
        const uint32_t bin = bin_of(clean.cosine[i]);
        const uint64_t bits = random_bits(key, i);
        if ((bits >> 48) < terms_.dropout[bin]) {
            row[x] = 0;
            continue;
        }
        if (inner_row && x > 0 && x + 1 < w) {
            const auto [least, most] = std::minmax(
                {clean.depth_m[i - 1], clean.depth_m[i + 1], clean.depth_m[i - w], clean.depth_m[i + w]});
            const float jump = std::max(most - z, z - least);
            if (jump > kMixingJump_m + kSlantSlack * z / model_.fx * terms_.tangent[bin])
                z = mixed_depth(clean, x, y);
        }
        const float sigma = 0.001f * (1.5f - 0.5f * z + 0.3f * z * z) + terms_.axial[bin] * z * std::sqrt(z);
        row[x] = report(z + settings_.scale * sigma * normal_quantiles()[bits % kQuantileCount]);
    }
}

}  // namespace vfit::virtual_person
