#include "size/recommend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "math/random.h"
#include "measure/measure_keys.h"

namespace vfit {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A sigma of 0 is "unknown": the value is then taken as exact to the millimetre of a tape, or the tenth of a
// scale.
constexpr double kSmallestSigma_m = 0.001, kSmallestSigma_kg = 0.1;
// Share of the variance that the measures of one scan have in common: clothes and distance act on all girths
// alike (vfit-bench measure prints how errors correlate).
constexpr double kShared = 0.3;
constexpr int kDraws = 8192;  // pairs of opposite ones: a probability is then true to about half a hundredth

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
    if (a < 0.0 && b > 0.0)
        return std::log(0.5 * (std::erf(b / std::sqrt(2.0)) + std::erf(-a / std::sqrt(2.0))));
    const double near = a >= 0.0 ? a : -b, far = a >= 0.0 ? b : -a;
    if (far == kInfinity) return log_above(near);
    return log_above(near) + std::log1p(-std::exp(log_above(far) - log_above(near)));
}

void check(const Measurement& m) {
    if (!std::isfinite(m.value) || m.value <= 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "measurement ", m.key, ": the value ", m.value, " is not ",
             is_mass(m.key) ? "a mass" : "a length");
    if (!std::isfinite(m.sigma) || m.sigma < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "measurement ", m.key, ": the sigma ", m.sigma, " is not a deviation");
}

/// A measure of the garment that is known of the person.
struct Known {
    size_t measure;
    std::string key;
    double value, sigma;
};

std::vector<Known> known_of(const SizeChart& chart, const GarmentSizes& garment,
                            const std::vector<Measurement>& measurements) {
    std::vector<Known> out;
    std::string wanted;
    for (size_t m = 0; m < garment.measures.size(); ++m) {
        const std::string& key = garment.measures[m];
        wanted += text(wanted.empty() ? "" : ", ", key);
        const Measurement* measurement = find(measurements, key);
        if (!measurement) continue;
        check(*measurement);
        out.push_back(
            {m, key, double(measurement->value),
             std::max(double(measurement->sigma), is_mass(key) ? kSmallestSigma_kg : kSmallestSigma_m)});
    }
    if (out.empty())
        fail(VFIT_ERROR_DATA, "size chart \"", chart.name(), "\": ", garment.kind, " needs at least one of ",
             wanted, "; none was given");
    return out;
}

/// Rows as one measure tells them apart: those with the same range are one, in ascending order.
struct Steps {
    std::vector<MeasureRange> ranges;
    std::vector<size_t> of_row;

    Steps(const GarmentSizes& garment, size_t measure) : of_row(garment.sizes.size()) {
        for (const SizeRow& row : garment.sizes) {
            const MeasureRange& r = row.ranges[measure];
            const auto at = std::find_if(ranges.begin(), ranges.end(),
                                         [&](const MeasureRange& o) { return o.low >= r.low; });
            if (at == ranges.end() || at->low != r.low) ranges.insert(at, r);
        }
        for (size_t row = 0; row < of_row.size(); ++row)
            of_row[row] = size_t(std::find_if(ranges.begin(), ranges.end(),
                                              [&](const MeasureRange& o) {
                                                  return o.low == garment.sizes[row].ranges[measure].low;
                                              }) -
                                 ranges.begin());
    }
    /// What the step answers for: its range, half of the gaps beside it, and all that lies beyond the chart.
    double low(size_t i) const {
        return i == 0 ? -kInfinity : 0.5 * (double(ranges[i - 1].high) + double(ranges[i].low));
    }
    double high(size_t i) const { return i + 1 == ranges.size() ? kInfinity : low(i + 1); }
    double width() const {
        double sum = 0.0;
        for (const MeasureRange& r : ranges) sum += double(r.high) - double(r.low);
        return sum / double(ranges.size());
    }
};

/// One measure: the normal distribution's share of each step, shared by the labels that have it.
std::vector<double> by_one(const GarmentSizes& garment, const Known& known) {
    const Steps steps(garment, known.measure);
    std::vector<double> score, rows(steps.ranges.size(), 0.0), out(garment.sizes.size());
    for (size_t i = 0; i < steps.ranges.size(); ++i)
        score.push_back(log_between((steps.low(i) - known.value) / known.sigma,
                                    (steps.high(i) - known.value) / known.sigma));
    const double best = *std::max_element(score.begin(), score.end());
    for (const size_t step : steps.of_row) rows[step] += 1.0;
    for (size_t row = 0; row < out.size(); ++row)
        out[row] = std::exp(score[steps.of_row[row]] - best) / rows[steps.of_row[row]];
    return out;
}

/// Several: bodies drawn from what is known of this one, each given its label. The draws are the same each
/// time.
std::vector<double> by_several(const GarmentSizes& garment, const std::vector<Known>& known) {
    std::vector<Steps> steps;
    std::vector<double> scale;
    for (const Known& k : known) {
        steps.emplace_back(garment, k.measure);
        scale.push_back(std::sqrt(double(garment.weights[k.measure])) / steps.back().width());
    }
    std::vector<std::vector<double>> missed(known.size());
    for (size_t k = 0; k < known.size(); ++k) missed[k].resize(steps[k].ranges.size());
    std::vector<double> out(garment.sizes.size(), 0.0);
    std::vector<double> errors(known.size());
    Random random(1);
    const auto count = [&](double way) {
        for (size_t k = 0; k < known.size(); ++k) {
            const double value = known[k].value + way * errors[k];
            for (size_t i = 0; i < missed[k].size(); ++i) {
                const MeasureRange& r = steps[k].ranges[i];
                const double off = scale[k] * std::max({0.0, double(r.low) - value, value - double(r.high)});
                missed[k][i] = off * off;
            }
        }
        size_t best = 0;
        double least = kInfinity;
        for (size_t row = 0; row < out.size(); ++row) {
            double sum = 0.0;
            for (size_t k = 0; k < known.size(); ++k) sum += missed[k][steps[k].of_row[row]];
            if (sum < least) least = sum, best = row;
        }
        out[best] += 1.0;
    };
    for (int i = 0; i < kDraws; ++i) {
        const double shared = std::sqrt(kShared) * double(random.normal());
        for (size_t k = 0; k < known.size(); ++k)
            errors[k] = known[k].sigma * (shared + std::sqrt(1.0 - kShared) * double(random.normal()));
        count(1.0), count(-1.0);
    }
    return out;
}

}  // namespace

std::vector<SizeProbability> recommend(const SizeChart& chart, const std::string& garment_kind,
                                       const std::vector<Measurement>& measurements) {
    const GarmentSizes& garment = chart.garment(garment_kind);
    const std::vector<Known> known = known_of(chart, garment, measurements);
    const std::vector<double> rows =
        known.size() == 1 ? by_one(garment, known[0]) : by_several(garment, known);
    double sum = 0.0;
    for (const double r : rows) sum += r;
    std::vector<SizeProbability> sizes;
    for (const std::string& label : garment.labels) {
        double of_label = 0.0;
        for (size_t row = 0; row < rows.size(); ++row)
            if (garment.sizes[row].label == label) of_label += rows[row];
        sizes.push_back({label, float(of_label / sum)});
    }
    std::stable_sort(sizes.begin(), sizes.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
    return sizes;
}

std::vector<SizeZone> size_zones(const SizeChart& chart, const std::string& garment_kind,
                                 const std::string& label, const std::vector<Measurement>& measurements) {
    const GarmentSizes& garment = chart.garment(garment_kind);
    const SizeRow* chosen = nullptr;
    for (const SizeRow& row : garment.sizes) {
        if (row.label != label) continue;
        if (chosen)
            fail(VFIT_ERROR_ARGUMENT, "size chart \"", chart.name(), "\": label ", label, " of ",
                 garment_kind, " serves several ranges of a table: how it sits cannot be told by measure");
        chosen = &row;
    }
    if (!chosen) {
        std::string has;
        for (const std::string& one : garment.labels) has += text(has.empty() ? "" : ", ", one);
        fail(VFIT_ERROR_ARGUMENT, "size chart \"", chart.name(), "\": ", garment_kind, " has no label \"",
             label, "\"; it has: ", has);
    }
    std::vector<SizeZone> zones;
    for (const Known& k : known_of(chart, garment, measurements)) {
        const MeasureRange& range = chosen->ranges[k.measure];
        const double low = (double(range.low) - k.value) / k.sigma,
                     high = (double(range.high) - k.value) / k.sigma;
        SizeZone zone;
        zone.key = k.key;
        zone.ease = float(0.5 * (double(range.low) + double(range.high)) - k.value);
        zone.sigma = float(k.sigma);
        zone.tight = float(std::exp(log_between(high, kInfinity)));
        zone.regular = float(std::exp(log_between(low, high)));
        zone.loose = float(std::exp(log_between(-low, kInfinity)));
        zones.push_back(zone);
    }
    return zones;
}

}  // namespace vfit
