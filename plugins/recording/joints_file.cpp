#include "joints_file.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace recording {

namespace {

constexpr double kFarthest = 1e6;  // m; beyond it a coordinate is no place in a room
constexpr int64_t kMaxId = 255;    // a user map has 8 bits

std::vector<std::string> joint_names() {
    std::vector<std::string> names;
    for (uint32_t j = 0; j < VFIT_JOINT_COUNT; ++j) {
        char name[64];
        vfit_joint_name(static_cast<vfit_joint_id>(j), name, sizeof name);
        names.emplace_back(name);
    }
    return names;
}

}  // namespace

JointsFile::JointsFile(const std::filesystem::path& path) : csv_(path) { read_header(); }

void JointsFile::read_header() {
    const std::vector<std::string> names = joint_names();
    const std::vector<std::string>& columns = csv_.columns();
    has_id_ = columns.size() > 1 && columns[1] == "id";
    for (size_t i = has_id_ ? 2 : 1; i < columns.size(); ++i) {
        const std::string& column = columns[i];
        const size_t stem = column.size() < 3 ? 0 : column.size() - 2;
        const auto name = std::find(names.begin(), names.end(), column.substr(0, stem));
        const size_t axis =
            column.size() < 3 ? std::string::npos : std::string("_x_y_z_c").find(column.substr(stem));
        if (name == names.end() || axis == std::string::npos || axis % 2 != 0)
            csv_.refuse("column '", column.substr(0, 64), "' is not a joint's _x, _y, _z or _c");
        const auto joint = static_cast<vfit_joint_id>(name - names.begin());
        auto group =
            std::find_if(joints_.begin(), joints_.end(), [&](const auto& j) { return j.joint == joint; });
        if (group == joints_.end()) {
            JointColumns fresh;
            fresh.joint = joint;
            group = joints_.insert(joints_.end(), fresh);
        }
        int* const places[] = {&group->x, &group->y, &group->z, &group->c};
        int& place = *places[axis / 2];
        if (place >= 0) csv_.refuse("column '", column, "' stands there twice");
        place = static_cast<int>(i);
    }
    if (joints_.empty()) csv_.refuse("the header names no joint");
    for (const JointColumns& j : joints_)
        if (j.x < 0 || j.y < 0 || j.z < 0)
            csv_.refuse("joint ", names[static_cast<size_t>(j.joint)],
                        " lacks one of its columns _x, _y, _z");
}

void JointsFile::check() {
    RecordedBody body;
    rewind();
    while (next()) read_row(body);
    rewind();
}

void JointsFile::rewind() {
    csv_.rewind();
    pending_ = false;
    frame_ = -1;
    ids_.clear();
}

/// Reads a row and checks its place: frames rise, and a frame has each id once.
bool JointsFile::next() {
    if (!csv_.next()) return false;
    const int64_t frame = csv_.integer(0, 0);
    const int64_t id = has_id_ ? csv_.integer(1, 1) : 1;
    if (id > kMaxId) csv_.refuse("id ", id, " is not in 1..", kMaxId);
    if (frame < frame_) csv_.refuse("frame ", frame, " comes after frame ", frame_, "; rows must rise");
    if (frame > frame_) ids_.clear();
    if (std::find(ids_.begin(), ids_.end(), id) != ids_.end())
        csv_.refuse("frame ", frame, " has id ", id, " twice");
    ids_.push_back(static_cast<uint32_t>(id));
    frame_ = frame;
    return true;
}

bool JointsFile::read_joint(const JointColumns& columns, vfit_joint& joint) const {
    const int axes[] = {columns.x, columns.y, columns.z};
    joint = vfit_joint{};
    joint.struct_size = sizeof joint;
    joint.joint = columns.joint;
    joint.state = VFIT_JOINT_MEASURED;
    joint.confidence = 1.0f;
    bool zero = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<size_t>(axes[axis]);
        if (csv_.empty(column)) return false;  // not seen
        const double value = csv_.number(column);
        if (std::abs(value) > kFarthest)
            csv_.refuse("column ", csv_.columns()[column], ": ", value, " m is no place");
        joint.position[axis] = static_cast<float>(value);
        zero = zero && value == 0.0;
    }
    if (columns.c >= 0) {
        const double confidence = csv_.number(static_cast<size_t>(columns.c));
        if (confidence < 0.0 || confidence > 1.0)
            csv_.refuse("a confidence of ", confidence, " is not in 0..1");
        joint.confidence = static_cast<float>(confidence);
    }
    return !zero;  // no joint lies in the camera's centre: not seen
}

void JointsFile::read_row(RecordedBody& body) const {
    body.id = has_id_ ? static_cast<uint32_t>(csv_.integer(1, 1)) : 1;
    body.joints.clear();
    vfit_joint joint;
    for (const JointColumns& columns : joints_)
        if (read_joint(columns, joint)) body.joints.push_back(joint);
}

size_t JointsFile::bodies(int64_t frame, std::vector<RecordedBody>& out) {
    size_t count = 0;
    while (pending_ || next()) {
        pending_ = frame_ > frame;
        if (pending_) break;
        if (frame_ < frame) continue;
        if (out.size() == count) out.emplace_back();
        read_row(out[count]);
        if (!out[count].joints.empty()) ++count;
    }
    return count;
}

}  // namespace recording
