#include "size/recommend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace vfit {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A sigma of 0 is "unknown": the value is then taken as exact to the millimetre of a tape.
constexpr double kSmallestSigma_m = 0.001;

/// Logarithm of the share of the standard normal distribution above x. Logarithms, because a measure may lie
/// hundreds of deviations off a label and still has to rank it.
double log_above(double x) {
    constexpr double kAsymptotic = 20.0;  // erfc underflows beyond 26 sqrt(2)
    if (x < kAsymptotic) return std::log(0.5 * std::erfc(x / std::sqrt(2.0)));
    return -0.5 * x * x - std::log(x * std::sqrt(2.0 * 3.14159265358979323846)) + std::log1p(-1.0 / (x * x));
}

/// Logarithm of the share between a and b.
double log_between(double a, double b) {
    // About the middle both parts add up, so that even a sliver of a very wide distribution keeps its share.
    if (a < 0.0 && b > 0.0) return std::log(0.5 * (std::erf(b / std::sqrt(2.0)) + std::erf(-a / std::sqrt(2.0))));
    const double near = a >= 0.0 ? a : -b, far = a >= 0.0 ? b : -a;
    if (far == kInfinity) return log_above(near);
    return log_above(near) + std::log1p(-std::exp(log_above(far) - log_above(near)));
}

struct Bounds {
    double low, high;
};

/// What the label answers for: its range, half of the gaps beside it, and all that lies beyond the chart.
Bounds bounds(const GarmentSizes& garment, size_t row, size_t measure) {
    const auto middle = [&](size_t below) {
        return 0.5 * (double(garment.sizes[below].ranges[measure].high_m) +
                      double(garment.sizes[below + 1].ranges[measure].low_m));
    };
    return {row == 0 ? -kInfinity : middle(row - 1),
            row + 1 == garment.sizes.size() ? kInfinity : middle(row)};
}

void check(const Measurement& m) {
    if (!std::isfinite(m.value) || m.value <= 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "measurement ", m.key, ": the value ", m.value, " is not a length");
    if (!std::isfinite(m.sigma) || m.sigma < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "measurement ", m.key, ": the sigma ", m.sigma, " is not a deviation");
}

}  // namespace

std::vector<SizeProbability> recommend(const SizeChart& chart, const std::string& garment_kind,
                                       const std::vector<Measurement>& measurements) {
    const GarmentSizes& garment = chart.garment(garment_kind);
    std::vector<double> score(garment.sizes.size(), 0.0);
    bool any = false;
    std::string wanted;
    for (size_t m = 0; m < garment.measures.size(); ++m) {
        wanted += text(wanted.empty() ? "" : ", ", garment.measures[m]);
        const Measurement* measurement = find(measurements, garment.measures[m]);
        if (!measurement) continue;
        check(*measurement);
        any = true;
        const double value = measurement->value,
                     sigma = std::max(double(measurement->sigma), kSmallestSigma_m);
        for (size_t row = 0; row < score.size(); ++row) {
            const Bounds range = bounds(garment, row, m);
            score[row] += log_between((range.low - value) / sigma, (range.high - value) / sigma);
        }
    }
    if (!any)
        fail(VFIT_ERROR_DATA, "size chart \"", chart.name(), "\": ", garment_kind, " needs at least one of ",
             wanted, "; none was given");

    const double best = *std::max_element(score.begin(), score.end());
    double sum = 0.0;
    for (double& s : score) sum += s = std::exp(s - best);
    std::vector<SizeProbability> sizes;
    for (size_t row = 0; row < score.size(); ++row)
        sizes.push_back({garment.sizes[row].label, float(score[row] / sum)});
    std::stable_sort(sizes.begin(), sizes.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
    return sizes;
}

}  // namespace vfit
