#include "avatar/body_with_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace vfit {

namespace {

constexpr int kSteps = 24;
constexpr double kProbe = 0.25;        // of a value's spread, for its slope
constexpr double kLongestStep = 1.5;   // spreads: as far as slopes hold
constexpr double kMargin = 1e-3;       // inside a value's range, so that its text is as well
constexpr double kShortestStep = 0.3;  // spreads, after which slopes are looked at anew
constexpr double kStill = 0.01;        // spreads: then it has come to rest
constexpr double kGain = 0.98;         // of the cost: a step that gains less comes to rest too
constexpr double kGood = 8.0;          // squared tolerances a measure: good enough

using Row = std::vector<double>;

double dot(const Row& a, const Row& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// x of system x = right by Cholesky's factors; system: symmetric, positive definite, rows one after another.
Row solved(Row system, Row x) {
    const size_t n = x.size();
    const auto at = [&](size_t row, size_t column) -> double& { return system[row * n + column]; };
    for (size_t c = 0; c < n; ++c) {
        for (size_t k = 0; k < c; ++k) at(c, c) -= at(c, k) * at(c, k);
        at(c, c) = std::sqrt(at(c, c));
        for (size_t r = c + 1; r < n; ++r) {
            for (size_t k = 0; k < c; ++k) at(r, c) -= at(r, k) * at(c, k);
            at(r, c) /= at(c, c);
        }
    }
    for (size_t r = 0; r < n; ++r) {
        for (size_t k = 0; k < r; ++k) x[r] -= at(r, k) * x[k];
        x[r] /= at(r, r);
    }
    for (size_t r = n; r-- > 0;) {
        for (size_t k = r + 1; k < n; ++k) x[r] -= at(k, r) * x[k];
        x[r] /= at(r, r);
    }
    return x;
}

/// The least of the quadratic form of |system x - right| with every x between its bounds: values that would
/// leave them are held there and the others solved for again.
Row solved_within(const Row& system, const Row& right, const Row& least, const Row& most) {
    const size_t n = right.size();
    Row x(n, 0.0);
    std::vector<bool> held(n, false);
    for (bool again = true; again;) {
        Row left = system, wanted = right;
        for (size_t i = 0; i < n; ++i)
            for (size_t k = 0; k < n; ++k) wanted[i] -= system[i * n + k] * x[k];
        for (size_t i = 0; i < n; ++i) {
            if (!held[i]) continue;
            for (size_t k = 0; k < n; ++k) left[i * n + k] = left[k * n + i] = 0.0;
            left[i * n + i] = 1.0, wanted[i] = 0.0;
        }
        const Row change = solved(std::move(left), std::move(wanted));
        again = false;
        for (size_t i = 0; i < n; ++i) {
            if (held[i]) continue;
            x[i] += change[i];
            if (x[i] >= least[i] && x[i] <= most[i]) continue;
            x[i] = std::clamp(x[i], least[i], most[i]);
            held[i] = again = true;
        }
    }
    return x;
}

}  // namespace

BodyWithMeasures::BodyWithMeasures(std::shared_ptr<const BodyModel> model, vfit_sex sex,
                                   std::vector<FreeShape> free, std::vector<std::string> keys,
                                   MeasureShape usual)
    : model_(std::move(model)),
      sex_(sex),
      free_(std::move(free)),
      keys_(std::move(keys)),
      usual_(std::move(usual)) {
    for (const FreeShape& f : free_)
        if (model_->parameter(f.key) < 0) fail(VFIT_ERROR_ARGUMENT, "no shape value is called ", f.key);
}

const BodyWithMeasures::Slopes& BodyWithMeasures::slopes_about_weight(float weight) {
    const auto nearest =
        std::min_element(kAnchorWeights.begin(), kAnchorWeights.end(),
                         [&](float a, float b) { return std::abs(a - weight) < std::abs(b - weight); });
    std::optional<Slopes>& slopes = slopes_[size_t(nearest - kAnchorWeights.begin())];
    if (!slopes) {
        std::vector<float> shape = model_->default_shape(sex_);
        shape[size_t(model_->parameter("weight"))] = *nearest;
        slopes = slopes_about(shape, usual_(shape), usual_);
    }
    return *slopes;
}

BodyWithMeasures::Slopes BodyWithMeasures::slopes_about(const std::vector<float>& shape,
                                                        const BodyMeasures& here,
                                                        const MeasureShape& measure) const {
    Slopes slopes(keys_.size(), Row(free_.size()));
    for (size_t f = 0; f < free_.size(); ++f) {
        std::vector<float> moved = shape;
        const size_t p = parameter(free_[f]);
        const ShapeParameter& range = model_->parameters()[p];
        const float step = float(kProbe * free_[f].spread);
        moved[p] += moved[p] + step <= range.maximum ? step : -step;
        const BodyMeasures there = measure(moved);
        for (size_t k = 0; k < keys_.size(); ++k)
            slopes[k][f] = (there.at(keys_[k]) - here.at(keys_[k])) / double(moved[p] - shape[p]);
    }
    return slopes;
}

double BodyWithMeasures::cost(const std::vector<WantedMeasure>& wanted, const BodyMeasures& measures,
                              const std::vector<float>& shape) const {
    double sum = 0.0;
    for (const WantedMeasure& w : wanted)
        sum += std::pow((w.value_m - measures.at(w.key)) / w.tolerance_m, 2);
    for (const FreeShape& f : free_) sum += std::pow((double(shape[parameter(f)]) - f.usual) / f.spread, 2);
    return sum;
}

BodyMeasures BodyWithMeasures::solve(const std::vector<WantedMeasure>& wanted, const MeasureShape& measure,
                                     std::vector<float>& shape) {
    const size_t values = free_.size();
    BodyMeasures here = measure(shape);
    double cost_here = cost(wanted, here, shape);
    Slopes slopes = slopes_about_weight(shape[size_t(model_->parameter("weight"))]);
    double longest_step = kLongestStep;
    bool anew = false;  // slopes have been looked at anew
    for (int step = 0; step < kSteps; ++step) {
        Row system(values * values, 0.0), right(values, 0.0), least(values), most(values);
        for (size_t w = 0; w < wanted.size(); ++w) {
            const WantedMeasure& one = wanted[w];
            const double firmness = 1.0 / (one.tolerance_m * one.tolerance_m),
                         missed = one.value_m - here.at(one.key);
            for (size_t i = 0; i < values; ++i) {
                for (size_t k = 0; k < values; ++k)
                    system[i * values + k] += firmness * slopes[w][i] * slopes[w][k];
                right[i] += firmness * missed * slopes[w][i];
            }
        }
        for (size_t f = 0; f < values; ++f) {
            const FreeShape& one = free_[f];
            const ShapeParameter& range = model_->parameters()[parameter(one)];
            const double firmness = 1.0 / (one.spread * one.spread), now = double(shape[parameter(one)]);
            system[f * values + f] += firmness;
            right[f] += firmness * (one.usual - now);
            least[f] = std::max(double(range.minimum) + kMargin - now, -longest_step * one.spread);
            most[f] = std::min(double(range.maximum) - kMargin - now, longest_step * one.spread);
        }
        const Row change = solved_within(system, right, least, most);
        std::vector<float> moved = shape;
        double longest = 0.0;
        for (size_t f = 0; f < values; ++f) {
            moved[parameter(free_[f])] += float(change[f]);
            longest = std::max(longest, std::abs(change[f]) / free_[f].spread);
        }
        const BodyMeasures there = measure(moved);
        const double cost_there = cost(wanted, there, moved);
        // Broyden's update: the slopes now explain this step.
        const double squared = dot(change, change);
        for (size_t w = 0; squared > 1e-12 && w < wanted.size(); ++w) {
            const std::string& key = wanted[w].key;
            const double missed = there.at(key) - here.at(key) - dot(slopes[w], change);
            for (size_t f = 0; f < values; ++f) slopes[w][f] += missed / squared * change[f];
        }
        const bool better = cost_there < cost_here;
        const bool resting = longest < kStill || (better && cost_there > kGain * cost_here);
        if (better) here = there, shape = moved, cost_here = cost_there;
        if (better && !resting) continue;
        if (!better && longest_step > kShortestStep) {
            longest_step *= 0.5;
            continue;
        }
        // Slopes about another body lead no further: those about this one may be worth their time, once.
        if (anew || cost_here < kGood * double(wanted.size())) break;
        slopes = slopes_about(shape, here, measure);
        longest_step = kLongestStep, anew = true;
    }
    return here;
}

}  // namespace vfit
