#include "sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "random.h"
#include "types.h"

namespace vfit::virtual_person {

namespace {

constexpr uint32_t kAngleBins = 1024;

// Two looked-up depths that differ by more than the slant of the surface explains belong to two surfaces. The
// factor leaves room for curvature, the offset for facets.
constexpr float kSlantSlack = 1.5f, kEdgeJump_m = 0.02f;

constexpr float kNearest_m = 0.01f,
                kFarthest_m = 20.0f;  // where structured light is computed: beyond every range

// A time-of-flight pixel mixes what its lens blurs into it: centre, side and corner weights of a Gaussian of
// 0.5 px, the usual blur of such lenses at the pixel pitch.
constexpr float kBlurCentre = 0.619f, kBlurSide = 0.084f, kBlurCorner = 0.011f;

constexpr float kMixingJump_m = 0.03f;     // below, the mixture is the mean within a few millimetres
constexpr float kModulation_hz = 16.0e6f;  // lowest of the Kinect v2: unambiguous to 9.4 m
constexpr float kLightSpeed_m_s = 2.99792458e8f;
constexpr float kLeastCoherence = 0.4f;  // of |sum| to the sum of amplitudes: below, no depth is reported

// A look-up goes no farther than 64 px, which only a noise scale above 10 would ask for.
constexpr float kMostLateral_px = 14.0f;

// Rounds to the nearest whole number, for values above -64: a plain conversion, where std::lrint is a call.
inline int round_offset(float x) { return static_cast<int>(x + 64.5f) - 64; }

}  // namespace

SensorNoise::SensorNoise(const SensorModel& model, const NoiseSettings& settings)
    : model_(model),
      settings_(settings),
      angle_(kAngleBins),
      shadow_(model.width) {
    for (uint32_t i = 0; i < kAngleBins; ++i) {
        const float theta = std::acos((static_cast<float>(i) + 0.5f) / kAngleBins);
        // The slant term is separable: what is left at z = 1 m, where its factor of z is 1.
        const float frontal = axial_sigma_m(model.principle, 1.0f, 0.0f);
        AngleTerms& t = angle_[i];
        t.axial = axial_sigma_m(model.principle, 1.0f, theta) - frontal;
        t.lateral_px = std::min(kMostLateral_px, lateral_sigma_px(model.principle, theta) * settings.scale);
        t.tangent = std::tan(theta);
        const float share = std::min(1.0f, dropout_probability(model.principle, theta) * settings.scale);
        t.dropout = static_cast<uint32_t>(std::lround(share * 65536.0f));
    }
    if (model.principle != DepthPrinciple::kStructuredLight) return;
    for (int mm = 0; mm <= static_cast<int>(kFarthest_m * 1000.0f); ++mm)
        frontal_sigma_m_.push_back(light_sigma_m((static_cast<float>(mm) + 0.5f) * 0.001f, 0.0f));
    const auto steps = static_cast<size_t>(1.0f / (model.range_min_m * kDisparityQuantumPerM)) + 2;
    for (size_t n = 0; n < steps; ++n)
        step_depth_mm_.push_back(n == 0 ? uint16_t{0}
                                        : report(1.0f / (static_cast<float>(n) * kDisparityQuantumPerM)));
}

// sigma_z was measured on quantised depth: rounding to a step adds step^2 / 12 to the variance, which is
// taken off before.
float SensorNoise::light_sigma_m(float z, float axial) const {
    const float sigma =
        settings_.scale * (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f) + axial / std::sqrt(z));
    if (!settings_.quantise) return sigma;
    const float step = quantum_m(z);
    return std::sqrt(std::max(0.0f, sigma * sigma - step * step * (1.0f / 12.0f)));
}

const SensorNoise::AngleTerms& SensorNoise::terms(float cosine) const {
    const auto bin = static_cast<int>(std::max(0.0f, cosine) * kAngleBins);
    return angle_[static_cast<uint32_t>(std::min(bin, static_cast<int>(kAngleBins) - 1))];
}

uint16_t SensorNoise::report(float z) const {
    if (!(z >= model_.range_min_m && z <= model_.range_max_m)) return 0;
    return static_cast<uint16_t>(z * 1000.0f + 0.5f);
}

void SensorNoise::apply(const CleanImage& clean, uint64_t frame, uint16_t* depth_mm, uint32_t row_stride) {
    const uint64_t key = frame_key(settings_.seed, frame);
    for (uint32_t y = 0; y < clean.height; ++y) {
        auto* row =
            reinterpret_cast<uint16_t*>(reinterpret_cast<uint8_t*>(depth_mm) + size_t{y} * row_stride);
        switch (model_.principle) {
            case DepthPrinciple::kIdeal: ideal_row(clean, y, row); break;
            case DepthPrinciple::kStructuredLight:
                if (settings_.shadow) mark_shadow(clean, y);
                structured_light_row(clean, key, y, row);
                break;
            case DepthPrinciple::kTimeOfFlight: time_of_flight_row(clean, key, y, row); break;
        }
    }
}

void SensorNoise::ideal_row(const CleanImage& clean, uint32_t y, uint16_t* row) const {
    const float* depth = clean.depth_m.data() + size_t{y} * clean.width;
    for (uint32_t x = 0; x < clean.width; ++x) row[x] = report(depth[x]);
}

// The projector stands at +x: seen from there, column u lies at u - f b / z. Going from right to left, a
// pixel is lit as long as that place moves on to the left; behind what moved further it lies in the shadow.
void SensorNoise::mark_shadow(const CleanImage& clean, uint32_t y) {
    const float* depth = clean.depth_m.data() + size_t{y} * clean.width;
    const float fb = model_.fx * model_.baseline_m;
    float reached = std::numeric_limits<float>::max();
    for (uint32_t x = clean.width; x-- > 0;) {
        const float z = depth[x];
        const float place = z > 0.0f ? static_cast<float>(x) - fb / z : std::numeric_limits<float>::max();
        shadow_[x] = place > reached;
        reached = std::min(reached, place);
    }
}

void SensorNoise::structured_light_row(const CleanImage& clean, uint64_t key, uint32_t y,
                                       uint16_t* row) const {
    const float* normal = normal_quantiles();
    const size_t first = size_t{y} * clean.width;
    const float pixel_angle = 1.0f / model_.fx;
    const int last_step = static_cast<int>(step_depth_mm_.size()) - 1;
    const int last_x = static_cast<int>(clean.width) - 1, last_y = static_cast<int>(clean.height) - 1;
    for (uint32_t x = 0; x < clean.width; ++x) {
        row[x] = 0;
        float z = clean.depth_m[first + x];
        if (settings_.shadow && shadow_[x]) continue;
        const AngleTerms* t = &terms(clean.cosine[first + x]);
        const uint64_t bits = random_bits(key, first + x);

        // Edges are seen sigma_L off their place. Within one surface the look-up stays: what its slant adds
        // to the noise is part of the measured sigma_z.
        const int dx = round_offset(t->lateral_px * normal[(bits >> 16) % kQuantileCount]);
        const int dy = round_offset(t->lateral_px * normal[(bits >> 32) % kQuantileCount]);
        const int sx = std::clamp(static_cast<int>(x) + dx, 0, last_x);
        const int sy = std::clamp(static_cast<int>(y) + dy, 0, last_y);
        const size_t seen = size_t(sy) * clean.width + size_t(sx);
        const float other = clean.depth_m[seen], jump = std::abs(other - z);
        if (jump > kEdgeJump_m) {
            const float steps = static_cast<float>(std::abs(dx) + std::abs(dy));
            if (jump > kEdgeJump_m + kSlantSlack * steps * z * pixel_angle * t->tangent) {
                z = other;
                t = &terms(clean.cosine[seen]);
            }
        }
        if ((bits >> 48) < t->dropout || !(z > 0.0f && z < kFarthest_m)) continue;

        const float sigma = t->axial > 0.0f
                                ? light_sigma_m(z, t->axial)
                                : frontal_sigma_m_[static_cast<uint32_t>(static_cast<int>(z * 1000.0f))];
        z += sigma * normal[bits % kQuantileCount];
        if (!settings_.quantise) {
            row[x] = report(z);
        } else {
            const auto step =
                static_cast<int>(1.0f / (std::max(z, kNearest_m) * kDisparityQuantumPerM) + 0.5f);
            row[x] = step_depth_mm_[static_cast<uint32_t>(std::min(step, last_step))];
        }
    }
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
        const AngleTerms& t = terms(clean.cosine[i]);
        const uint64_t bits = random_bits(key, i);
        if ((bits >> 48) < t.dropout) {
            row[x] = 0;
            continue;
        }
        if (inner_row && x > 0 && x + 1 < w) {
            const auto [least, most] = std::minmax(
                {clean.depth_m[i - 1], clean.depth_m[i + 1], clean.depth_m[i - w], clean.depth_m[i + w]});
            const float jump = std::max(most - z, z - least);
            if (jump > kMixingJump_m + kSlantSlack * z / model_.fx * t.tangent) z = mixed_depth(clean, x, y);
        }
        const float sigma = 0.001f * (1.5f - 0.5f * z + 0.3f * z * z) + t.axial * z * std::sqrt(z);
        row[x] = report(z + settings_.scale * sigma * normal_quantiles()[bits % kQuantileCount]);
    }
}

}  // namespace vfit::virtual_person
