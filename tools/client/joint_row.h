// The joints of one person at one time, in world space.
#pragma once

#include <cstdint>
#include <vector>

#include "vfit.h"

namespace vfit::tools {

/// What was seen at one time, in world space; a joint that was not seen is not listed.
struct JointRow {
    int64_t time_ns = 0;
    std::vector<vfit_joint> joints;
};

void add_joint(JointRow& row, vfit_joint_id joint, float x, float y, float z,
               vfit_joint_state state = VFIT_JOINT_MEASURED, float confidence = 1.0f);

/// Steps the motion stage; VFIT_NOT_READY where the person was not there.
vfit_result step_row(vfit_motion motion, const JointRow& row);

/// Lifts a stream whose floor is not known so that the lowest ankle stands on it.
void put_on_floor(std::vector<JointRow>& rows);

}  // namespace vfit::tools
