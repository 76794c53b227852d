// Shape values by name: what a body has other than the default body of its sex.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "body/body_model.h"

namespace vfit {

struct ShapeSetting {
    std::string key;
    float value;
};

/// One value a parameter. VFIT_ERROR_ARGUMENT names a key that the model has not, or a value out of its
/// range.
std::vector<float> shape_of(const BodyModel& model, vfit_sex sex, std::span<const ShapeSetting> settings);

/// What differs from the default body of that sex.
std::vector<ShapeSetting> settings_of(const BodyModel& model, vfit_sex sex, std::span<const float> shape);

}  // namespace vfit
