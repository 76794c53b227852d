// The paper's seven subjects (Table 3) as virtual people of those dimensions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "population/body_measures.h"

namespace vfit::tools {

/// As the paper prints it; lengths in centimetres, errors in per cent, deviations without a unit.
struct PrintedDimension {
    double real, estimated, error, deviation;
};

struct Subject {
    int number;
    vfit_sex sex;  // the paper tells that of 6 and 7; of the others it is a guess by the shoulders
    PrintedDimension shoulder, height;
    std::string uri;                      // of the virtual person, to which frames=N is added
    BodyMeasures measures;                // of its body
    std::vector<vfit_shape_value> shape;  // what differs from the sex's default body
};

/// Bodies are solved for: some seconds.
std::vector<Subject> subjects(const std::shared_ptr<const BodyModel>& body);

}  // namespace vfit::tools
