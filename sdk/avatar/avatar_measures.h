// Tape measures of an avatar's own body, in the posture of each definition.
#pragma once

#include <vector>

#include "anthropometry/measurement.h"
#include "avatar/avatar.h"

namespace vfit {

std::vector<Measurement> measure_avatar(const Avatar& avatar, vfit_sex sex);

/// Heights of the trunk's girths on the avatar's rest mesh, and the middle of the body there.
struct TrunkLevel {
    const char* key;
    float height_m, axis_z_m;
};
std::vector<TrunkLevel> trunk_levels(const Avatar& avatar, vfit_sex sex);

}  // namespace vfit
