// Joints over time without pictures, from a text file: vfit's own table, and the rows of the Kinect v2 SDK
// (docs/motion.md, "Joints without pictures"). The format is found by the content.
#pragma once

#include <cstdint>
#include <string>
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

/// Lifts a stream whose floor is not known so that the lowest ankle stands on it.
void put_on_floor(std::vector<JointRow>& rows);

/// A file of text: no pictures, and nothing that a sensor plug-in plays.
bool is_joint_file(const std::string& path);

/// Throws Failure, which names file, line and column, for another format, a row that is cut, a value that is
/// no number, times that do not increase, and for another unit than metres and seconds.
std::vector<JointRow> read_joint_file(const std::string& path);

}  // namespace vfit::tools
