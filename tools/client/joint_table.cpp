#include <array>
#include <cmath>
#include <map>

#include "client/client.h"
#include "client/joint_formats.h"

namespace vfit::tools {

namespace {

constexpr const char* kTime = "time_s";
constexpr size_t kParts = 4;
constexpr std::array<const char*, kParts> kEndings = {"_x", "_y", "_z", "_confidence"};
constexpr size_t kNone = SIZE_MAX;

// As vfit_joint_filter has it: from these confidences on.
constexpr float kMeasured = 0.5f, kInferred = 0.15f;

std::string joint_list() {
    std::string names;
    for (int j = 0; j < int(VFIT_JOINT_COUNT); ++j) names += (j ? ", " : "") + joint_name(j);
    return names;
}

vfit_joint_id joint_from(const std::string& name) {
    for (int j = 0; j < int(VFIT_JOINT_COUNT); ++j)
        if (joint_name(j) == name) return j;
    return -1;
}

/// The part of a joint that a column holds; the name of the joint is left in `name`.
size_t part_of(std::string& name) {
    for (size_t part = 0; part < kParts; ++part) {
        const std::string ending = kEndings[part];
        if (!name.ends_with(ending)) continue;
        name.resize(name.size() - ending.size());
        return part;
    }
    return kNone;
}

}  // namespace

bool is_joint_table(const CsvRows& first) { return first.cell(0) == kTime; }

JointTable::JointTable(CsvRows& rows) : rows_(rows), width_(rows.size()) { read_header(); }

void JointTable::read_header() {
    const CsvRows& header = rows_;
    std::map<vfit_joint_id, Columns> joints;
    for (size_t c = 1; c < header.size(); ++c) {
        std::string name(header.cell(c));
        const size_t part = part_of(name);
        if (part == kNone) header.fail(c, "ends in none of _x, _y, _z, _confidence");
        const vfit_joint_id joint = joint_from(name);
        if (joint < 0) header.fail(c, "names no joint; known are " + joint_list());
        Columns& columns = joints[joint];
        columns.joint = joint;
        if (columns.at[part] != kNone) header.fail(c, "is there twice");
        columns.at[part] = c;
    }
    for (const auto& [joint, columns] : joints) {
        for (size_t part = 0; part < 3; ++part)
            if (columns.at[part] == kNone)
                header.fail("column " + joint_name(joint) + kEndings[part] + " is missing");
        joints_.push_back(columns);
    }
    if (joints_.empty()) header.fail("no joint follows time_s");
}

void JointTable::read_joint(const Columns& columns, JointRow& row) const {
    std::array<float, 3> p{};
    size_t given = 0;
    for (size_t i = 0; i < 3; ++i) {
        const size_t c = columns.at[i];
        p[i] = rows_.cell(c).empty() ? NAN : rows_.coordinate(c);
        given += !std::isnan(p[i]);
    }
    if (given == 0) return;
    if (given < 3)
        rows_.fail(columns.at[0], "and its neighbours: joint " + joint_name(columns.joint) +
                                      " has only some of its coordinates; a joint that is not seen has none");
    const size_t c = columns.at[3];
    float confidence = 1.0f;
    if (c != kNone) {
        confidence = rows_.coordinate(c);
        if (!(confidence >= 0.0f && confidence <= 1.0f)) rows_.fail(c, "is no confidence in 0..1");
    }
    if (confidence < kInferred) return;
    add_joint(row, columns.joint, p[0], p[1], p[2],
              confidence < kMeasured ? VFIT_JOINT_INFERRED : VFIT_JOINT_MEASURED, confidence);
}

bool JointTable::next(JointRow& row) {
    if (!rows_.next()) return false;
    rows_.check_size(width_);
    constexpr double kMaxTime_s = 9e9;  // what nanoseconds in 64 bits hold
    const double time_s = rows_.number(0);
    if (std::abs(time_s) > kMaxTime_s) rows_.fail(0, "is no time in seconds");
    row.time_ns = std::llround(1e9 * time_s);
    if (last_ns_ && row.time_ns <= *last_ns_) rows_.fail(0, "is not after the time of the row before");
    last_ns_ = row.time_ns;
    row.joints.clear();
    for (const Columns& columns : joints_) read_joint(columns, row);
    return true;
}

}  // namespace vfit::tools
