// Joints over time without pictures, from a text file: vfit's own table, and the rows of the Kinect v2 SDK
// (docs/motion.md, "Joints without pictures"). The format is found by the content.
#pragma once

#include <string>
#include <vector>

#include "client/joint_row.h"

namespace vfit::tools {

/// A file of text: no pictures, and nothing that a sensor plug-in plays.
bool is_joint_file(const std::string& path);

/// Throws Failure, which names file, line and column, for another format, a row that is cut, a value that is
/// no number, times that do not increase, and for another unit than metres and seconds.
std::vector<JointRow> read_joint_file(const std::string& path);

}  // namespace vfit::tools
