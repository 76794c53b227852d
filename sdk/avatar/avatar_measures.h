// Tape measures of an avatar's own body, in the posture of each definition.
#pragma once

#include <vector>

#include "avatar/avatar.h"
#include "measure/measurement.h"

namespace vfit {

std::vector<Measurement> measure_avatar(const Avatar& avatar, vfit_sex sex);

}  // namespace vfit
