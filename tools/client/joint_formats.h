// The formats of joint_file.h, each from its first row on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "client/csv_rows.h"
#include "client/joint_row.h"

namespace vfit::tools {

/// "time_s", then NAME_x, NAME_y, NAME_z and an optional NAME_confidence for each joint: world space, metres.
bool is_joint_table(const CsvRows& first);
class JointTable {
public:
    /// rows is at the first line, and must outlive the table.
    explicit JointTable(CsvRows& rows);
    /// False at the end; row is then as it was.
    bool next(JointRow& row);

private:
    struct Columns {
        vfit_joint_id joint = 0;
        std::array<size_t, 4> at{SIZE_MAX, SIZE_MAX, SIZE_MAX, SIZE_MAX};  // x, y, z, confidence
    };
    void read_header();
    void read_joint(const Columns& columns, JointRow& row) const;

    CsvRows& rows_;
    size_t width_;
    std::vector<Columns> joints_;
    std::optional<int64_t> last_ns_;
};

/// Ticks of 100 ns, then x, y, z and tracking state of the 25 joints in the order of the Kinect v2 SDK, in
/// its camera space.
bool is_kinect2(const CsvRows& first);
std::vector<JointRow> read_kinect2(CsvRows& rows);

}  // namespace vfit::tools
