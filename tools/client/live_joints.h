// Joints that another program is still writing, from standard input.
#pragma once

#include <istream>
#include <optional>

#include "client/joint_formats.h"

namespace vfit::tools {

/// vfit's table (joint_formats.h). Its unit is judged by the first row with two joints.
class LiveJoints {
public:
    explicit LiveJoints(std::istream& in);
    /// Waits for the next row; false at the end. Faults as with read_joint_file.
    bool next(JointRow& row);

private:
    CsvRows rows_;
    std::optional<JointTable> table_;
    bool checked_ = false;
};

}  // namespace vfit::tools
