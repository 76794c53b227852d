#include "client/joint_row.h"

#include <algorithm>
#include <cmath>

#include "client/client.h"

namespace vfit::tools {

namespace {

constexpr float kAnkleHeightM = 0.08f;

}  // namespace

void add_joint(JointRow& row, vfit_joint_id joint, float x, float y, float z, vfit_joint_state state,
               float confidence) {
    vfit_joint j = vfit_joint_init();
    j.joint = joint;
    j.state = state;
    j.confidence = confidence;
    j.position[0] = x, j.position[1] = y, j.position[2] = z;
    row.joints.push_back(j);
}

vfit_result step_row(vfit_motion motion, const JointRow& row) {
    if (row.joints.empty()) {
        check(vfit_motion_step(motion, vfit_frame{}, 0, row.time_ns));
        return VFIT_NOT_READY;
    }
    vfit_body body = vfit_body_init();
    body.body_id = 1;
    body.time_ns = row.time_ns;
    return vfit_motion_step_body(motion, &body, row.joints.data(), sizeof(vfit_joint),
                                 uint32_t(row.joints.size()), row.time_ns);
}

void put_on_floor(std::vector<JointRow>& rows) {
    float lowest = INFINITY;
    for (const JointRow& row : rows)
        for (const vfit_joint& j : row.joints)
            if (j.joint == VFIT_JOINT_LEFT_FOOT || j.joint == VFIT_JOINT_RIGHT_FOOT)
                lowest = std::min(lowest, j.position[1]);
    if (std::isinf(lowest)) return;
    for (JointRow& row : rows)
        for (vfit_joint& j : row.joints) j.position[1] += kAnkleHeightM - lowest;
}

}  // namespace vfit::tools
