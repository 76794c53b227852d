// The body of given measures: shape values by damped Gauss-Newton steps on tape measures.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "anthropometry/measurement.h"
#include "body/body_model.h"

namespace vfit::tools {

/// A tape measure to come near to, as firmly as one over its tolerance.
struct WantedMeasure {
    std::string key;  // of measure_keys.h, or one at the navel
    double value_m, tolerance_m;
};

/// A shape value that may be changed, and how far it usually is from `usual`.
struct FreeShape {
    std::string key;
    double usual, spread;
};

/// Every tape measure of the body, and the trunk's "navel_girth_m", "navel_breadth_m" and "navel_depth_m" at
/// that fraction of its stature.
using BodyMeasures = std::map<std::string, double>;
BodyMeasures measures_of(const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                         const std::vector<float>& shape, double navel_share);

/// The mesh on which those are taken, as a Wavefront file for tapes of others: metres, Y up, facing +Z, with
/// a group for the faces of the arms. The joints that levels hang on are comments.
void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                const std::vector<float>& shape);

class BodyWithMeasures {
public:
    /// Looks at how those measures move with the free values, about bodies of three weights.
    BodyWithMeasures(std::shared_ptr<const BodyModel> model, vfit_sex sex, std::vector<FreeShape> free,
                     std::vector<std::string> keys);

    /// Changes the free values of `shape`; returns the measures of what it came to. `wanted` are those of the
    /// keys, in their order.
    BodyMeasures solve(const std::vector<WantedMeasure>& wanted, double navel_share,
                       std::vector<float>& shape) const;

private:
    cv::Mat_<double> slopes_about(const std::vector<float>& shape, const BodyMeasures& here,
                                  double navel_share) const;
    double cost(const std::vector<WantedMeasure>& wanted, const BodyMeasures& measures,
                const std::vector<float>& shape) const;

    std::shared_ptr<const BodyModel> model_;
    vfit_sex sex_;
    std::vector<FreeShape> free_;
    std::vector<std::string> keys_;
    std::vector<cv::Mat_<double>> slopes_;  // of a measure by a free value, about each weight
};

}  // namespace vfit::tools
