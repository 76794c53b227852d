#include "size/recommend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "math/random.h"
#include "size/measure_steps.h"

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

/// Fails where none is known, unless the garment has one label alone, for which nothing need be known.
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
    if (out.empty() && garment.labels.size() > 1)
        fail(VFIT_ERROR_DATA, "size chart \"", chart.name(), "\": ", garment.kind, " needs at least one of ",
             wanted, "; none was given");
    return out;
}

/// One measure: the normal distribution's share of each step, shared by the rows that have it.
std::vector<double> by_one(const GarmentSizes& garment, const Known& known) {
    const MeasureSteps steps(garment, known.measure);
    std::vector<double> score, rows(steps.ranges().size(), 0.0), out(garment.sizes.size());
    for (size_t i = 0; i < steps.ranges().size(); ++i)
        score.push_back(log_between((steps.low(i) - known.value) / known.sigma,
                                    (steps.high(i) - known.value) / known.sigma));
    const double best = *std::max_element(score.begin(), score.end());
    for (size_t row = 0; row < out.size(); ++row) rows[steps.of_row(row)] += 1.0;
    for (size_t row = 0; row < out.size(); ++row)
        out[row] = std::exp(score[steps.of_row(row)] - best) / rows[steps.of_row(row)];
    return out;
}

/// Rows that the known measures do not tell apart.
struct Cell {
    std::vector<size_t> steps;  // one a known measure
    double rows = 0.0, bodies = 0.0;
};

/// The distance of one body from every cell of a garment.
class Distances {
public:
    Distances(const GarmentSizes& garment, const std::vector<Known>& known) {
        std::vector<MeasureSteps> steps;
        for (const Known& k : known) {
            steps.emplace_back(garment, k.measure);
            ranges_.push_back(steps.back().ranges());
            weights_.push_back(double(garment.weights[k.measure]) /
                               (steps.back().scale() * steps.back().scale()));
            missed_.emplace_back(ranges_.back().size());
        }
        std::map<std::vector<size_t>, size_t> at;
        for (size_t row = 0; row < garment.sizes.size(); ++row) {
            Cell cell;
            for (const MeasureSteps& s : steps) cell.steps.push_back(s.of_row(row));
            const size_t place = at.try_emplace(cell.steps, cells_.size()).first->second;
            if (place == cells_.size()) cells_.push_back(cell);
            cells_[place].rows += 1.0;
            of_row_.push_back(place);
        }
    }

    /// The cell that a body of those values misses least. Of cells that it misses alike, which are those
    /// whose ranges overlap about it: the one whose middles are nearest.
    Cell& nearest(const std::vector<double>& values) {
        for (size_t k = 0; k < values.size(); ++k)
            for (size_t i = 0; i < missed_[k].size(); ++i)
                missed_[k][i] = square(k, ranges_[k][i].missed(values[k]));
        Cell* best = nullptr;
        double least = kInfinity;
        for (Cell& cell : cells_) {
            double sum = 0.0;
            for (size_t k = 0; k < values.size(); ++k) sum += missed_[k][cell.steps[k]];
            if (!best || sum < least ||
                (sum == least && off_middle(cell, values) < off_middle(*best, values)))
                least = sum, best = &cell;
        }
        return *best;
    }

    /// The part of the bodies counted that each row has.
    std::vector<double> rows() const {
        std::vector<double> out;
        for (const size_t cell : of_row_) out.push_back(cells_[cell].bodies / cells_[cell].rows);
        return out;
    }

private:
    double square(size_t k, double distance) const { return weights_[k] * distance * distance; }

    double off_middle(const Cell& cell, const std::vector<double>& values) const {
        double sum = 0.0;
        for (size_t k = 0; k < values.size(); ++k)
            sum += square(k, ranges_[k][cell.steps[k]].ease(values[k]));
        return sum;
    }

    std::vector<std::vector<MeasureRange>> ranges_;  // one list a known measure: its steps
    std::vector<std::vector<double>> missed_;
    std::vector<double> weights_;
    std::vector<Cell> cells_;
    std::vector<size_t> of_row_;
};

/// Several: bodies drawn from what is known of this one, each given its label. The draws are the same each
/// time.
std::vector<double> by_several(const GarmentSizes& garment, const std::vector<Known>& known) {
    Distances distances(garment, known);
    std::vector<double> errors(known.size()), values(known.size());
    Random random(1);
    for (int i = 0; i < kDraws; ++i) {
        const double shared = std::sqrt(kShared) * double(random.normal());
        for (size_t k = 0; k < known.size(); ++k)
            errors[k] = known[k].sigma * (shared + std::sqrt(1.0 - kShared) * double(random.normal()));
        for (const double way : {1.0, -1.0}) {
            for (size_t k = 0; k < known.size(); ++k) values[k] = known[k].value + way * errors[k];
            distances.nearest(values).bodies += 1.0;
        }
    }
    return distances.rows();
}

}  // namespace

std::vector<SizeProbability> recommend(const SizeChart& chart, const std::string& garment_kind,
                                       const std::vector<Measurement>& measurements) {
    const GarmentSizes& garment = chart.garment(garment_kind);
    std::vector<Known> known = known_of(chart, garment, measurements);
    // A measure with one step says nothing about the label.
    std::erase_if(known,
                  [&](const Known& k) { return MeasureSteps(garment, k.measure).ranges().size() == 1; });
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
        const double low = range.open_low ? -kInfinity : (double(range.low) - k.value) / k.sigma,
                     high = range.open_high ? kInfinity : (double(range.high) - k.value) / k.sigma;
        SizeZone zone;
        zone.key = k.key;
        zone.ease = float(range.ease(k.value));
        zone.sigma = float(k.sigma);
        zone.tight = float(std::exp(log_between(high, kInfinity)));
        zone.regular = float(std::exp(log_between(low, high)));
        zone.loose = float(std::exp(log_between(-low, kInfinity)));
        zones.push_back(zone);
    }
    return zones;
}

}  // namespace vfit
