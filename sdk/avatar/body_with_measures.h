// The body of given measures: shape values by damped Gauss-Newton steps on what is measured of the body.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body/body_model.h"

namespace vfit {

/// A measure to come near to, as firmly as one over its tolerance.
struct WantedMeasure {
    std::string key;
    double value_m, tolerance_m;
};

/// A shape value that may be changed, and how far it usually is from `usual`.
struct FreeShape {
    std::string key;
    double usual, spread;
};

/// By key; metres.
using BodyMeasures = std::map<std::string, double>;
/// What is measured of the body of a shape. May fail with VFIT_ERROR_DATA where that is no person's.
using MeasureShape = std::function<BodyMeasures(const std::vector<float>& shape)>;

class BodyWithMeasures {
public:
    /// keys: the measures that solve() is asked for. usual: measures bodies of three weights, about which
    /// slopes are looked at.
    BodyWithMeasures(std::shared_ptr<const BodyModel> model, vfit_sex sex, std::vector<FreeShape> free,
                     std::vector<std::string> keys, MeasureShape usual);

    /// Changes the free values of `shape`; returns the measures of what it came to. `wanted` are those of the
    /// keys, in their order. The first body of about that weight takes a measuring for each free value more:
    /// how measures move with the values is kept.
    BodyMeasures solve(const std::vector<WantedMeasure>& wanted, const MeasureShape& measure,
                       std::vector<float>& shape);

    /// Squares of what is missed over its tolerance and of free values over their spread.
    double cost(const std::vector<WantedMeasure>& wanted, const BodyMeasures& measures,
                const std::vector<float>& shape) const;

private:
    using Row = std::vector<double>;
    using Slopes = std::vector<Row>;  // a row a measure, of it by each free value

    const Slopes& slopes_about_weight(float weight);
    Slopes slopes_about(const std::vector<float>& shape, const BodyMeasures& here,
                        const MeasureShape& measure) const;
    size_t parameter(const FreeShape& free) const { return size_t(model_->parameter(free.key)); }

    // Bodies about which slopes are looked at: heavy ones gain more centimetres by the same change than slim
    // ones.
    static constexpr std::array<float, 3> kAnchorWeights = {0.4f, 0.7f, 1.0f};

    std::shared_ptr<const BodyModel> model_;
    vfit_sex sex_;
    std::vector<FreeShape> free_;
    std::vector<std::string> keys_;
    MeasureShape usual_;
    std::array<std::optional<Slopes>, kAnchorWeights.size()> slopes_;
};

}  // namespace vfit
