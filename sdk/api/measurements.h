// Measurements between their internal value and the C struct.
#pragma once

#include <vector>

#include "api/structs.h"
#include "measure/measurement.h"

namespace vfit::api {

/// Fails with VFIT_ERROR_DATA naming the key whose value or sigma is not finite, not positive, or unknown.
std::vector<Measurement> measurements_in(const vfit_measurement* items, uint32_t stride, uint32_t count);

vfit_result write_measurements(const std::vector<Measurement>& list, vfit_measurement* items, uint32_t stride,
                               uint32_t* count);

}  // namespace vfit::api
