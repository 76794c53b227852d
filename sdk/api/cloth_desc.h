// vfit_cloth_desc, checked and converted.
#pragma once

#include "frame/axes.h"
#include "outfit/wear_options.h"
#include "vfit.h"

namespace vfit::api {

inline constexpr uint32_t kMaxSubsteps = 256;

/// desc may be null. VFIT_ERROR_ARGUMENT, naming the field.
WearOptions wear_options(const vfit_cloth_desc* desc, const Axes& axes);

}  // namespace vfit::api
