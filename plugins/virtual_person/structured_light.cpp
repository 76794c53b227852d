// The noise of a structured-light sensor, a row at a time. Each pass over the row has no branches, so that
// most of them run on vectors.
#include <algorithm>
#include <cmath>
#include <limits>

#include "random.h"
#include "sensor_noise.h"

namespace vfit::virtual_person {

namespace {

constexpr float kNearest_m = 0.01f, kFarthest_m = 20.0f;  // where noise is computed: beyond every range

// Rounds to the nearest whole number, for values above -64: a plain conversion, where std::lrint is a call.
inline float round_offset(float x) { return static_cast<float>(static_cast<int>(x + 64.5f) - 64); }

// sigma_z was measured on quantised depth: rounding to a step adds step^2 / 12 to the variance, which is
// taken off before.
inline float light_sigma_m(const NoiseSettings& settings, float z, float axial) {
    const float sigma = settings.scale * (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f) + axial / std::sqrt(z));
    const float step = quantum_m(z), rest = sigma * sigma - step * step * (1.0f / 12.0f);
    return settings.quantise ? std::sqrt(std::max(0.0f, rest)) : sigma;
}

}  // namespace

void SensorNoise::prepare_light() {
    const uint32_t width = model_.width;
    for (auto* v :
         {&row_.along, &row_.across, &row_.down, &row_.place, &row_.depth_m, &row_.sigma_m, &row_.axial})
        v->resize(width);
    for (auto* v : {&row_.bin, &row_.lit, &row_.alive}) v->assign(width, 1);
    row_.bits.resize(width), row_.seen.resize(width), row_.step.resize(width);
    // Steeper surfaces may look farther than the tiles tell of; at a large noise scale all do.
    const float farthest = normal_quantiles()[kQuantileCount - 1];
    uint32_t bin = kAngleBins;
    while (bin > 0 && round_offset(terms_.lateral_px[bin - 1] * farthest) <= EdgeTiles::kReach) --bin;
    least_cosine_ = static_cast<float>(bin) / kAngleBins;
    for (int mm = 0; mm <= static_cast<int>(kFarthest_m * 1000.0f); ++mm)
        frontal_sigma_m_.push_back(light_sigma_m(settings_, (static_cast<float>(mm) + 0.5f) * 0.001f, 0.0f));
    const auto steps = static_cast<size_t>(1.0f / (model_.range_min_m * kDisparityQuantumPerM)) + 2;
    for (size_t n = 0; n < steps; ++n)
        step_depth_mm_.push_back(n == 0 ? uint16_t{0}
                                        : report(1.0f / (static_cast<float>(n) * kDisparityQuantumPerM)));
}

// The projector stands at +x: seen from there, column u lies at u - f b / z. Going from right to left, a
// pixel is lit as long as that place moves on to the left; behind what moved further it lies in the shadow.
void SensorNoise::find_shadow(const float* depth, uint32_t width) {
    constexpr float kNowhere = std::numeric_limits<float>::max();
    const float fb = model_.fx * model_.baseline_m;
    float* const place = row_.place.data();
    for (uint32_t x = 0; x < width; ++x) {
        const float z = depth[x], seen_at = static_cast<float>(static_cast<int>(x)) - fb / z;
        place[x] = z > 0.0f ? seen_at : kNowhere;
    }
    uint32_t* const lit = row_.lit.data();
    float reached = kNowhere;
    for (uint32_t x = width; x-- > 0;) {
        lit[x] = place[x] <= reached;
        reached = std::min(reached, place[x]);
    }
}

void SensorNoise::draw_numbers(uint64_t key, uint64_t first, uint32_t width) {
    const float* const normal = normal_quantiles();
    uint64_t* const bits = row_.bits.data();
    float* const along = row_.along.data();
    for (uint32_t x = 0; x < width; ++x) {
        bits[x] = random_bits(key, first + x);
        along[x] = normal[bits[x] % kQuantileCount];
    }
}

// Which pixel each one looks at: edges are seen sigma_L off their place.
void SensorNoise::jitter(uint32_t begin, uint32_t end, const CleanImage& clean, uint32_t y) {
    const float *const normal = normal_quantiles(), *const lateral_px = terms_.lateral_px.data();
    const uint64_t* const bits = row_.bits.data();
    const uint32_t* const bin = row_.bin.data();
    float *const across = row_.across.data(), *const down = row_.down.data();
    for (uint32_t x = begin; x < end; ++x) {
        const float sigma_px = lateral_px[bin[x]];
        across[x] = sigma_px * normal[(bits[x] >> 16) % kQuantileCount];
        down[x] = sigma_px * normal[(bits[x] >> 32) % kQuantileCount];
    }
    int* const seen = row_.seen.data();
    // Whole numbers in floats, for which every processor has vectors: an index stays far below 2^24.
    const float row = static_cast<float>(y), columns = static_cast<float>(clean.width);
    const float last_x = columns - 1.0f, last_y = static_cast<float>(clean.height) - 1.0f;
    for (int x = static_cast<int>(begin); x < static_cast<int>(end); ++x) {
        across[x] = round_offset(across[x]), down[x] = round_offset(down[x]);
        const float sx = std::min(std::max(static_cast<float>(x) + across[x], 0.0f), last_x);
        const float sy = std::min(std::max(row + down[x], 0.0f), last_y);
        seen[x] = static_cast<int>(sy * columns + sx);
    }
}

// Within one surface the look-up stays: what its slant adds to the noise is part of the measured sigma_z.
void SensorNoise::look_past_edges(uint32_t begin, uint32_t end, const CleanImage& clean, uint32_t y) {
    const float* const image = clean.depth_m.data();
    const float* const depth = image + size_t{y} * clean.width;
    const int* const seen = row_.seen.data();
    for (uint32_t x = begin; x < end; ++x) {
        const float z = depth[x], other = image[seen[x]], jump = std::abs(other - z);
        if (jump <= kEdgeJump_m) continue;  // nearly always
        const float steps = std::abs(row_.across[x]) + std::abs(row_.down[x]);
        if (jump <= kEdgeJump_m + kSlantSlack * steps * z * (1.0f / model_.fx) * terms_.tangent[row_.bin[x]])
            continue;
        row_.depth_m[x] = other;
        row_.bin[x] = bin_of(clean.cosine[static_cast<uint32_t>(seen[x])]);
    }
}

void SensorNoise::find_sigma(uint32_t width) {
    float *const depth = row_.depth_m.data(), *const sigma = row_.sigma_m.data(),
                 *const axial = row_.axial.data();
    const uint32_t *const bin = row_.bin.data(), *const lit = row_.lit.data();
    const uint64_t* const bits = row_.bits.data();
    uint32_t* const alive = row_.alive.data();
    for (uint32_t x = 0; x < width; ++x) {
        const uint32_t there = uint32_t{depth[x] > 0.0f} & uint32_t{depth[x] < kFarthest_m};
        depth[x] = there ? depth[x] : 1.0f;  // any that can be computed with
        alive[x] = there & lit[x];
    }
    for (uint32_t x = 0; x < width; ++x) {
        alive[x] &= static_cast<uint32_t>(bits[x] >> 48) >= terms_.dropout[bin[x]];
        axial[x] = terms_.axial[bin[x]];
        sigma[x] = frontal_sigma_m_[static_cast<uint32_t>(static_cast<int>(depth[x] * 1000.0f))];
    }
    const NoiseSettings settings = settings_;
    // A wall that is met head-on is so over many pixels: there the slant's roots are spared.
    constexpr uint32_t kStretch = 32;
    for (uint32_t begin = 0; begin < width; begin += kStretch) {
        const uint32_t end = std::min(begin + kStretch, width);
        if (std::all_of(axial + begin, axial + end, [](float a) { return a <= 0.0f; })) continue;
        for (uint32_t x = begin; x < end; ++x) {
            const float slanted = light_sigma_m(settings, depth[x], axial[x]);
            sigma[x] = axial[x] > 0.0f ? slanted : sigma[x];
        }
    }
}

void SensorNoise::structured_light_row(const CleanImage& clean, uint64_t key, uint32_t y, uint16_t* row) {
    const uint32_t width = clean.width;
    if (settings_.shadow) find_shadow(clean.depth_m.data() + size_t{y} * width, width);
    draw_numbers(key, uint64_t{y} * width, width);
    const float *const clean_depth = clean.depth_m.data() + size_t{y} * width, *const cosine =
                                                                                   clean.cosine.data() +
                                                                                   size_t{y} * width;
    std::copy(clean_depth, clean_depth + width, row_.depth_m.begin());
    uint32_t* const bin = row_.bin.data();
    for (uint32_t x = 0; x < width; ++x) bin[x] = bin_of(cosine[x]);
    for (uint32_t begin = 0, end; begin < width; begin = end) {
        const bool edges = edges_.marked(begin, y);
        for (end = begin; end < width && edges_.marked(end, y) == edges;) end += EdgeTiles::kWidth;
        end = std::min(end, width);
        if (!edges) continue;
        jitter(begin, end, clean, y);
        look_past_edges(begin, end, clean, y);
    }
    find_sigma(width);
    const float *const depth = row_.depth_m.data(), *const sigma = row_.sigma_m.data(),
                       *const along = row_.along.data();
    const uint32_t* const alive = row_.alive.data();
    if (!settings_.quantise) {
        for (uint32_t x = 0; x < width; ++x)
            row[x] = alive[x] ? report(depth[x] + sigma[x] * along[x]) : uint16_t{0};
        return;
    }
    int* const step = row_.step.data();
    const int last_step = static_cast<int>(step_depth_mm_.size()) - 1;
    for (uint32_t x = 0; x < width; ++x) {
        const float z = std::max(depth[x] + sigma[x] * along[x], kNearest_m);
        const int nearest = static_cast<int>(1.0f / (z * kDisparityQuantumPerM) + 0.5f);
        step[x] = std::min(nearest, last_step) & -static_cast<int>(alive[x]);  // step 0 is no depth
    }
    const uint16_t* const step_depth_mm = step_depth_mm_.data();
    for (uint32_t x = 0; x < width; ++x) row[x] = step_depth_mm[static_cast<uint32_t>(step[x])];
}

}  // namespace vfit::virtual_person
