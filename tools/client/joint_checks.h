// Streams of joints that cannot be meant: another unit, a floor that is none. Each throws Failure, which
// opens with the name of the source.
#pragma once

#include <string>
#include <vector>

#include "client/joint_row.h"

namespace vfit::tools {

void check_lengths(const std::vector<JointRow>& rows, const std::string& source);
void check_floor(const std::vector<JointRow>& rows, const std::string& source);
void check_times(const std::vector<JointRow>& rows, const std::string& source);

}  // namespace vfit::tools
