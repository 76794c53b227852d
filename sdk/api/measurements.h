// Measurements between their internal value and the C struct.
#pragma once

#include <vector>

#include "anthropometry/measurement.h"
#include "api/structs.h"

namespace vfit::api {

/// Each checked (check_measurement): VFIT_ERROR_DATA naming the key that is unknown or whose value is not
/// plausible.
std::vector<Measurement> measurements_in(const vfit_measurement* items, uint32_t stride, uint32_t count);

vfit_result write_measurements(const std::vector<Measurement>& list, vfit_measurement* items, uint32_t stride,
                               uint32_t* count);

}  // namespace vfit::api
