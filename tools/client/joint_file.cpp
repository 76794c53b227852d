#include "client/joint_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "client/client.h"
#include "client/joint_checks.h"
#include "client/joint_formats.h"

namespace vfit::tools {

namespace {

constexpr size_t kProbeBytes = 4096;

const char* const kWanted =
    "a line \"time_s,HEAD_x,HEAD_y,HEAD_z,...\" with the names of joints, or rows of the Kinect v2 (ticks, "
    "then x, y, z, state of 25 joints: 101 columns)";

std::vector<JointRow> read_table(CsvRows& rows) {
    JointTable table(rows);
    std::vector<JointRow> out;
    for (JointRow row; table.next(row);) out.push_back(row);
    return out;
}

std::vector<JointRow> read_rows(CsvRows& rows) {
    if (is_joint_table(rows)) return read_table(rows);
    if (is_kinect2(rows)) return read_kinect2(rows);
    rows.fail("no known stream of joints: wanted is " + std::string(kWanted) + "; this line has " +
              std::to_string(rows.size()) + " and begins with '" + std::string(rows.cell(0).substr(0, 40)) +
              "'");
}

}  // namespace

bool is_joint_file(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    std::ifstream file(path, std::ios::binary);
    std::string start(kProbeBytes, '\0');
    file.read(start.data(), std::streamsize(start.size()));
    start.resize(size_t(file.gcount()));
    return std::all_of(start.begin(), start.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte >= 0x20 || c == '\t' || c == '\r' || c == '\n';
    });
}

std::vector<JointRow> read_joint_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Failure(path + ": cannot be read");
    CsvRows rows(file, path);
    if (!rows.next()) throw Failure(path + ": is empty: wanted is " + kWanted);
    std::vector<JointRow> out = read_rows(rows);
    if (out.empty()) throw Failure(path + ": has a header and no row");
    check_times(out, path);
    check_lengths(out, path);
    check_floor(out, path);
    return out;
}

}  // namespace vfit::tools
