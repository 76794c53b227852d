#include <cmath>

#include "client/joint_formats.h"

namespace vfit::tools {

namespace {

constexpr size_t kJoints = 25, kPerJoint = 4, kColumns = 1 + kJoints * kPerJoint;
constexpr int64_t kTick_ns = 100;

// What each of the Kinect v2's 25 joints is here, or -1: both its NECK (middle) and the finger tips have no
// counterpart.
constexpr int kKinect2Joints[kJoints] = {VFIT_JOINT_PELVIS,
                                         VFIT_JOINT_TORSO,
                                         -1,
                                         VFIT_JOINT_HEAD,
                                         VFIT_JOINT_LEFT_SHOULDER,
                                         VFIT_JOINT_LEFT_ELBOW,
                                         VFIT_JOINT_LEFT_WRIST,
                                         VFIT_JOINT_LEFT_HAND,
                                         VFIT_JOINT_RIGHT_SHOULDER,
                                         VFIT_JOINT_RIGHT_ELBOW,
                                         VFIT_JOINT_RIGHT_WRIST,
                                         VFIT_JOINT_RIGHT_HAND,
                                         VFIT_JOINT_LEFT_HIP,
                                         VFIT_JOINT_LEFT_KNEE,
                                         VFIT_JOINT_LEFT_FOOT,
                                         VFIT_JOINT_LEFT_TOES,
                                         VFIT_JOINT_RIGHT_HIP,
                                         VFIT_JOINT_RIGHT_KNEE,
                                         VFIT_JOINT_RIGHT_FOOT,
                                         VFIT_JOINT_RIGHT_TOES,
                                         VFIT_JOINT_NECK,
                                         -1,
                                         -1,
                                         -1,
                                         -1};

/// Recorders end a row with a comma or not.
size_t columns_of(const CsvRows& row) {
    return row.cell(row.size() - 1).empty() ? row.size() - 1 : row.size();
}

void read_joint(const CsvRows& rows, size_t j, JointRow& row) {
    const size_t c = 1 + kPerJoint * j;
    const int64_t state = rows.whole_number(c + 3);
    if (state < VFIT_JOINT_NOT_SEEN || state > VFIT_JOINT_MEASURED)
        rows.fail(c + 3, "is no tracking state: 0 not tracked, 1 inferred, 2 tracked");
    const float x = rows.coordinate(c), y = rows.coordinate(c + 1), z = rows.coordinate(c + 2);
    if (kKinect2Joints[j] < 0 || state == VFIT_JOINT_NOT_SEEN || std::isnan(x + y + z)) return;
    // Camera space has the person's left at -X and looks along +Z: turned about Y.
    add_joint(row, kKinect2Joints[j], -x, y, -z, vfit_joint_state(state));
}

}  // namespace

bool is_kinect2(const CsvRows& first) {
    const std::string_view ticks = first.cell(0);
    return columns_of(first) == kColumns && !ticks.empty() &&
           ticks.find_first_not_of("0123456789") == std::string_view::npos;
}

std::vector<JointRow> read_kinect2(CsvRows& rows) {
    std::vector<JointRow> out;
    do {
        if (columns_of(rows) != kColumns)
            rows.fail(std::to_string(columns_of(rows)) + " columns, and a row of the Kinect v2 has " +
                      std::to_string(kColumns));
        JointRow row;
        const int64_t ticks = rows.whole_number(0);
        if (ticks > INT64_MAX / kTick_ns) rows.fail(0, "is no time in ticks of 100 ns");
        row.time_ns = ticks * kTick_ns;
        for (size_t j = 0; j < kJoints; ++j) read_joint(rows, j, row);
        if (!out.empty() && row.time_ns <= out.back().time_ns)
            rows.fail(0, "is not after the time of the row before");
        out.push_back(std::move(row));
    } while (rows.next());
    put_on_floor(out);
    return out;
}

}  // namespace vfit::tools
