#include "client/live_joints.h"

#include "client/client.h"
#include "client/joint_checks.h"

namespace vfit::tools {

namespace {

const char* const kStandardInput = "standard input";
const char* const kWantedLive = "a line \"time_s,HEAD_x,HEAD_y,HEAD_z,...\" with the names of joints";

}  // namespace

LiveJoints::LiveJoints(std::istream& in) : rows_(in, kStandardInput) {
    if (!rows_.next()) throw Failure(std::string(kStandardInput) + ": is empty: wanted is " + kWantedLive);
    if (!is_joint_table(rows_))
        rows_.fail("'" + std::string(rows_.cell(0).substr(0, 40)) +
                   "' opens no stream of joints: wanted is " + kWantedLive);
    table_.emplace(rows_);
}

bool LiveJoints::next(JointRow& row) {
    if (!table_->next(row)) return false;
    if (!checked_ && row.joints.size() > 1) {
        check_lengths({row}, kStandardInput);
        check_floor({row}, kStandardInput);
        checked_ = true;
    }
    return true;
}

}  // namespace vfit::tools
