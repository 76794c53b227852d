// Whether a number from outside can be a person's measurement.
#pragma once

#include <string_view>

#include "anthropometry/measurement.h"

namespace vfit {

struct PlausibleRange {
    float smallest = 0.0f, largest = 0.0f;  // m, or kg where is_mass(key)
};

/// From newborns to the largest adults known (measure_keys()). Of a user's own measure: of any part of a
/// body.
PlausibleRange plausible_range(std::string_view key);

/// VFIT_ERROR_DATA, beginning with `what`, where the key is unknown, the value is not plausible, or the sigma
/// is not a standard deviation. Names key, value, what is plausible, and the unit that the value is probably
/// in.
void check_measurement(const Measurement& measurement, std::string_view what = "");

}  // namespace vfit
