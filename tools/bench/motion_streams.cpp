#include "bench/motion_streams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <zlib.h>

#include "client/client.h"
#include "client/joint_file.h"
#include "client/joint_row.h"

namespace vfit::tools {

namespace fs = std::filesystem;

namespace {

constexpr double kUiPrmdRateHz = 30.0;
constexpr float kRad = kPi / 180.0f;

// ui_prmd: waist, spine, chest, neck, head, its tip, then collar, upper arm, forearm, hand of the left and
// the right, upper leg, lower leg, foot, toes of the left and the right. A segment's place is the joint that
// it turns about.
constexpr int kUiPrmdCount = 22;
constexpr int kUiPrmdParents[kUiPrmdCount] = {-1, 0,  1,  2, 3,  4,  2,  6, 7,  8,  2,
                                              10, 11, 12, 0, 14, 15, 16, 0, 18, 19, 20};
constexpr int kUiPrmdJoints[kUiPrmdCount] = {
    VFIT_JOINT_PELVIS,        VFIT_JOINT_TORSO,          VFIT_JOINT_CHEST,
    VFIT_JOINT_NECK,          VFIT_JOINT_HEAD,           -1,
    VFIT_JOINT_LEFT_CLAVICLE, VFIT_JOINT_LEFT_SHOULDER,  VFIT_JOINT_LEFT_ELBOW,
    VFIT_JOINT_LEFT_HAND,     VFIT_JOINT_RIGHT_CLAVICLE, VFIT_JOINT_RIGHT_SHOULDER,
    VFIT_JOINT_RIGHT_ELBOW,   VFIT_JOINT_RIGHT_HAND,     VFIT_JOINT_LEFT_HIP,
    VFIT_JOINT_LEFT_KNEE,     VFIT_JOINT_LEFT_FOOT,      VFIT_JOINT_LEFT_TOES,
    VFIT_JOINT_RIGHT_HIP,     VFIT_JOINT_RIGHT_KNEE,     VFIT_JOINT_RIGHT_FOOT,
    VFIT_JOINT_RIGHT_TOES};

std::vector<float> numbers_of(const std::string& line, const std::string& file) {
    std::vector<float> out;
    std::stringstream cells(line);
    std::string cell;
    while (std::getline(cells, cell, ',')) {
        char* end = nullptr;
        out.push_back(std::strtof(cell.c_str(), &end));
        if (end == cell.c_str()) throw Failure(file + ": '" + cell + "' is no number");
    }
    return out;
}

std::vector<std::vector<float>> read_gz(const fs::path& file) {
    const gzFile in = gzopen(file.c_str(), "rb");
    if (!in) throw Failure(file.string() + ": cannot be opened");
    std::string text;
    char buffer[1 << 16];
    int n = 0;
    while ((n = gzread(in, buffer, sizeof buffer)) > 0) text.append(buffer, size_t(n));
    gzclose(in);
    if (n < 0) throw Failure(file.string() + ": damaged");
    std::vector<std::vector<float>> rows;
    std::stringstream lines(text);
    std::string line;
    while (std::getline(lines, line))
        if (!line.empty()) rows.push_back(numbers_of(line, file.string()));
    return rows;
}

JointStream stream_of(const std::string& name, const std::vector<JointRow>& rows) {
    JointStream stream{name, {}};
    for (const JointRow& row : rows) {
        Body body;
        body.id = 1;
        body.time_ns = row.time_ns;
        for (const vfit_joint& joint : row.joints) body.joints[size_t(joint.joint)] = joint_in(joint);
        stream.bodies.push_back(body);
    }
    return stream;
}

Quat rotation_of(const float* degrees) {
    const Vec3 a = kRad * Vec3(degrees[0], degrees[1], degrees[2]);
    return glm::angleAxis(a.z, Vec3(0, 0, 1)) * glm::angleAxis(a.x, Vec3(1, 0, 0)) *
           glm::angleAxis(a.y, Vec3(0, 1, 0));
}

/// Forward kinematics of local offsets and rotations.
JointRow ui_prmd_row(const std::vector<float>& offsets, const std::vector<float>& degrees) {
    std::array<Vec3, kUiPrmdCount> place;
    std::array<Quat, kUiPrmdCount> turn;
    JointRow row;
    for (size_t j = 0; j < kUiPrmdCount; ++j) {
        const Vec3 offset = 0.01f * Vec3(offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]);
        const Quat local = rotation_of(&degrees[3 * j]);
        const int parent = kUiPrmdParents[j];
        place[j] = parent < 0 ? offset : place[size_t(parent)] + turn[size_t(parent)] * offset;
        turn[j] = parent < 0 ? local : turn[size_t(parent)] * local;
        if (kUiPrmdJoints[j] >= 0) add_joint(row, kUiPrmdJoints[j], place[j].x, place[j].y, place[j].z);
    }
    return row;
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
    if (!fs::is_directory(folder)) throw Failure(folder.string() + ": no such folder");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string episode_of(const fs::path& file) {
    return file.filename().string().substr(0, 11);
}  // m01_s01_e01

}  // namespace

std::vector<JointStream> kinect2_streams(const std::string& shared) {
    std::vector<JointStream> streams;
    for (const fs::path& file : files_in(fs::path(shared) / "data/kinect2_joints", ".csv"))
        streams.push_back(stream_of("kinect2 " + file.stem().string(), read_joint_file(file.string())));
    return streams;
}

std::vector<JointStream> ui_prmd_streams(const std::string& shared) {
    std::vector<JointStream> streams;
    for (const fs::path& file : files_in(fs::path(shared) / "data/ui_prmd/Kinect", "_positions.txt.gz")) {
        std::string angles = file.string();
        angles.replace(angles.size() - 16, 16, "angles.txt.gz");
        const auto offsets = read_gz(file), degrees = read_gz(angles);
        std::vector<JointRow> rows;
        for (size_t f = 0; f < std::min(offsets.size(), degrees.size()); ++f) {
            if (offsets[f].size() < 3 * kUiPrmdCount || degrees[f].size() < 3 * kUiPrmdCount)
                throw Failure(file.string() + ": a row of fewer than 22 joints");
            rows.push_back(ui_prmd_row(offsets[f], degrees[f]));
            rows.back().time_ns = int64_t(std::llround(1e9 * double(f) / kUiPrmdRateHz));
        }
        put_on_floor(rows);
        streams.push_back(stream_of(episode_of(file), rows));
    }
    return streams;
}

std::vector<MarkerStream> ui_prmd_markers(const std::string& shared) {
    std::vector<MarkerStream> streams;
    for (const fs::path& file : files_in(fs::path(shared) / "data/ui_prmd/Vicon", "_positions.txt.gz")) {
        MarkerStream stream{episode_of(file), {}};
        for (const std::vector<float>& row : read_gz(file)) {
            std::vector<Vec3> markers;
            for (size_t i = 0; i + 2 < row.size(); i += 3)
                markers.push_back(0.001f * Vec3(row[i], row[i + 1], row[i + 2]));
            stream.frames.push_back(std::move(markers));
        }
        streams.push_back(std::move(stream));
    }
    return streams;
}

}  // namespace vfit::tools
