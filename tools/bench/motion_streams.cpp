#include "bench/motion_streams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <zlib.h>

#include "client/client.h"

namespace vfit::tools {

namespace fs = std::filesystem;

namespace {

constexpr float kAnkleHeightM = 0.08f;
constexpr double kUiPrmdRateHz = 30.0;
constexpr float kRad = kPi / 180.0f;

// What each of the Kinect v2's 25 joints is here, or -1: both its NECK (middle) and the finger tips have no
// counterpart.
constexpr int kKinect2Joints[25] = {VFIT_JOINT_PELVIS,
                                    VFIT_JOINT_TORSO,
                                    -1,
                                    VFIT_JOINT_HEAD,
                                    VFIT_JOINT_LEFT_SHOULDER,
                                    VFIT_JOINT_LEFT_ELBOW,
                                    VFIT_JOINT_LEFT_WRIST,
                                    VFIT_JOINT_LEFT_HAND,
                                    VFIT_JOINT_RIGHT_SHOULDER,
                                    VFIT_JOINT_RIGHT_ELBOW,
                                    VFIT_JOINT_RIGHT_WRIST,
                                    VFIT_JOINT_RIGHT_HAND,
                                    VFIT_JOINT_LEFT_HIP,
                                    VFIT_JOINT_LEFT_KNEE,
                                    VFIT_JOINT_LEFT_FOOT,
                                    VFIT_JOINT_LEFT_TOES,
                                    VFIT_JOINT_RIGHT_HIP,
                                    VFIT_JOINT_RIGHT_KNEE,
                                    VFIT_JOINT_RIGHT_FOOT,
                                    VFIT_JOINT_RIGHT_TOES,
                                    VFIT_JOINT_NECK,
                                    -1,
                                    -1,
                                    -1,
                                    -1};

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

void put_on_floor(std::vector<Body>& bodies) {
    float lowest = 1e9f;
    for (const Body& body : bodies)
        for (const int ankle : {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT})
            if (body.has(ankle)) lowest = std::min(lowest, body.at(ankle).y);
    if (lowest > 1e8f) return;
    for (Body& body : bodies)
        for (Joint& joint : body.joints) joint.position.y += kAnkleHeightM - lowest;
}

JointStream read_kinect2(const fs::path& file) {
    JointStream stream{"kinect2 " + file.stem().string(), {}};
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
        if (line.empty()) continue;
        Body body;
        body.id = 1;
        // The tick count is longer than a float is exact.
        body.time_ns = std::stoll(line) * 100;
        const std::vector<float> row = numbers_of(line, file.string());
        if (row.size() < 1 + 25 * 4) throw Failure(file.string() + ": a row of fewer than 25 joints");
        for (size_t j = 0; j < 25; ++j) {
            if (kKinect2Joints[j] < 0) continue;
            const float* v = &row[1 + 4 * j];
            const int state = int(v[3]);
            if (state < 1) continue;
            // Camera space has the person's left at -X and looks along +Z: turned about Y.
            body.set(kKinect2Joints[j], {-v[0], v[1], -v[2]},
                     state > 1 ? VFIT_JOINT_MEASURED : VFIT_JOINT_INFERRED);
        }
        stream.bodies.push_back(body);
    }
    put_on_floor(stream.bodies);
    return stream;
}

Quat rotation_of(const float* degrees) {
    const Vec3 a = kRad * Vec3(degrees[0], degrees[1], degrees[2]);
    return glm::angleAxis(a.z, Vec3(0, 0, 1)) * glm::angleAxis(a.x, Vec3(1, 0, 0)) *
           glm::angleAxis(a.y, Vec3(0, 1, 0));
}

/// Forward kinematics of local offsets and rotations.
Body ui_prmd_body(const std::vector<float>& offsets, const std::vector<float>& degrees) {
    std::array<Vec3, kUiPrmdCount> place;
    std::array<Quat, kUiPrmdCount> turn;
    Body body;
    body.id = 1;
    for (size_t j = 0; j < kUiPrmdCount; ++j) {
        const Vec3 offset = 0.01f * Vec3(offsets[3 * j], offsets[3 * j + 1], offsets[3 * j + 2]);
        const Quat local = rotation_of(&degrees[3 * j]);
        const int parent = kUiPrmdParents[j];
        place[j] = parent < 0 ? offset : place[size_t(parent)] + turn[size_t(parent)] * offset;
        turn[j] = parent < 0 ? local : turn[size_t(parent)] * local;
        if (kUiPrmdJoints[j] >= 0) body.set(kUiPrmdJoints[j], place[j]);
    }
    return body;
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
        streams.push_back(read_kinect2(file));
    return streams;
}

std::vector<JointStream> ui_prmd_streams(const std::string& shared) {
    std::vector<JointStream> streams;
    for (const fs::path& file : files_in(fs::path(shared) / "data/ui_prmd/Kinect", "_positions.txt.gz")) {
        std::string angles = file.string();
        angles.replace(angles.size() - 16, 16, "angles.txt.gz");
        const auto offsets = read_gz(file), degrees = read_gz(angles);
        JointStream stream{episode_of(file), {}};
        for (size_t f = 0; f < std::min(offsets.size(), degrees.size()); ++f) {
            if (offsets[f].size() < 3 * kUiPrmdCount || degrees[f].size() < 3 * kUiPrmdCount)
                throw Failure(file.string() + ": a row of fewer than 22 joints");
            Body body = ui_prmd_body(offsets[f], degrees[f]);
            body.time_ns = int64_t(std::llround(1e9 * double(f) / kUiPrmdRateHz));
            stream.bodies.push_back(body);
        }
        put_on_floor(stream.bodies);
        streams.push_back(std::move(stream));
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
