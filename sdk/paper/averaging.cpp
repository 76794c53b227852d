#include "paper/averaging.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vfit {

namespace {

float median(std::vector<float>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How far from that median a value may lie without being plainly wrong.
float outlier_distance(const std::vector<float>& values, float centre) {
    std::vector<float> distances;
    distances.reserve(values.size());
    for (const float v : values) distances.push_back(std::abs(v - centre));
    constexpr float kSigmaPerMad = 1.4826f;  // of a normal distribution
    constexpr float kOutlier_sigma = 3.0f;
    constexpr float kRounding_m = 0.005f;  // values that differ by a fraction of a pixel are no outliers
    return std::max(kOutlier_sigma * kSigmaPerMad * median(distances), kRounding_m);
}

}  // namespace

Averaged average(std::vector<float>& values, Outliers outliers) {
    if (values.empty()) return {};
    const float centre = median(values);
    const float limit = outliers == Outliers::kKeep ? std::numeric_limits<float>::infinity()
                                                    : outlier_distance(values, centre);

    double sum = 0.0;
    Averaged result;
    for (const float v : values) {
        if (std::abs(v - centre) > limit) continue;
        sum += v;
        ++result.kept;
    }
    const double mean = sum / double(result.kept);
    double squares = 0.0;
    for (const float v : values)
        if (std::abs(v - centre) <= limit) squares += (v - mean) * (v - mean);
    result.mean = float(mean);
    if (result.kept > 1) result.deviation = float(std::sqrt(squares / double(result.kept - 1)));
    return result;
}

}  // namespace vfit
