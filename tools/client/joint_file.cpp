#include "client/joint_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "client/client.h"
#include "client/files.h"
#include "client/joint_formats.h"

namespace vfit::tools {

namespace {

constexpr float kAnkleHeightM = 0.08f;
constexpr size_t kProbeBytes = 4096;

// Between the outermost joints of a person: less is no person in metres, more than the span of raised arms is
// none either.
constexpr double kMinSpan_m = 0.1, kMaxSpan_m = 3.0;
// A span of more than this is one in millimetres rather than in centimetres.
constexpr double kMillimetreSpan = 300.0;
// Joints that lie deeper are not on a floor at 0: no foot would stand.
constexpr double kDeepest_m = -0.3;
// Cameras give 1 to 1000 rows a second.
constexpr double kMinStep_s = 1e-3, kMaxStep_s = 1.0;

const char* const kWanted =
    "a line \"time_s,HEAD_x,HEAD_y,HEAD_z,...\" with the names of joints, or rows of the Kinect v2 (ticks, "
    "then x, "
    "y, z, state of 25 joints: 101 columns)";

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Of the box around the joints.
double span_of(const JointRow& row) {
    double diagonal = 0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = INFINITY, high = -INFINITY;
        for (const vfit_joint& j : row.joints) {
            low = std::min(low, double(j.position[axis]));
            high = std::max(high, double(j.position[axis]));
        }
        diagonal += (high - low) * (high - low);
    }
    return std::sqrt(diagonal);
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

void check_lengths(const std::vector<JointRow>& rows, const std::string& path) {
    std::vector<double> spans;
    for (const JointRow& row : rows)
        if (row.joints.size() > 1) spans.push_back(span_of(row));
    if (spans.empty()) throw Failure(path + ": no row has two joints that are seen");
    const double span = middle_of(spans);
    if (span >= kMinSpan_m && span <= kMaxSpan_m) return;
    throw Failure(path + ": the joints of a row lie " + short_number(span) +
                  " apart (median), which is no person in metres" +
                  (span > kMillimetreSpan ? ": are these millimetres?"
                   : span > kMaxSpan_m    ? ": are these centimetres?"
                                          : ""));
}

void check_floor(const std::vector<JointRow>& rows, const std::string& path) {
    std::vector<double> lowest;
    for (const JointRow& row : rows) {
        double low = INFINITY;
        for (const vfit_joint& j : row.joints) low = std::min(low, double(j.position[1]));
        if (!row.joints.empty()) lowest.push_back(low);
    }
    const double low = middle_of(lowest);
    if (low >= kDeepest_m) return;
    throw Failure(path + ": the lowest joint of a row is at y = " + short_number(low) +
                  " m (median): y points up, and the floor is at 0");
}

void check_times(const std::vector<JointRow>& rows, const std::string& path) {
    std::vector<double> steps;
    for (size_t i = 1; i < rows.size(); ++i)
        steps.push_back(1e-9 * double(rows[i].time_ns - rows[i - 1].time_ns));
    if (steps.empty()) return;
    const double step = middle_of(steps);
    if (step >= kMinStep_s && step <= kMaxStep_s) return;
    throw Failure(path + ": rows are " + short_number(step) + " s apart (median); known are " +
                  short_number(kMinStep_s) + " to " + short_number(kMaxStep_s) +
                  " s: is the time in another unit?");
}

std::vector<JointRow> read_rows(CsvRows& rows, const std::string& text) {
    if (is_joint_table(rows)) return read_joint_table(rows);
    if (is_kinect2(rows)) return read_kinect2(rows);
    if (text.starts_with("HIERARCHY"))
        rows.fail("this is a BVH file; the virtual person plays those of CMU: virtual:bvh=PATH");
    rows.fail("no known stream of joints: wanted is " + std::string(kWanted) + "; this line has " +
              std::to_string(rows.size()) + " and begins with '" + std::string(rows.cell(0).substr(0, 40)) +
              "'");
}

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
    const std::string text = read_text(path);
    CsvRows rows(text, path);
    if (!rows.next()) throw Failure(path + ": is empty: wanted is " + kWanted);
    std::vector<JointRow> out = read_rows(rows, text);
    if (out.empty()) throw Failure(path + ": has a header and no row");
    check_times(out, path);
    check_lengths(out, path);
    check_floor(out, path);
    return out;
}

}  // namespace vfit::tools
