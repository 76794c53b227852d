// The formats of joint_file.h, each from its first row on.
#pragma once

#include "client/csv_rows.h"
#include "client/joint_file.h"

namespace vfit::tools {

/// "time_s", then NAME_x, NAME_y, NAME_z and an optional NAME_confidence for each joint: world space, metres.
bool is_joint_table(const CsvRows& first);
std::vector<JointRow> read_joint_table(CsvRows& rows);

/// Ticks of 100 ns, then x, y, z and tracking state of the 25 joints in the order of the Kinect v2 SDK, in
/// its camera space.
bool is_kinect2(const CsvRows& first);
std::vector<JointRow> read_kinect2(CsvRows& rows);

}  // namespace vfit::tools
