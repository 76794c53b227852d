// Real recordings through the whole motion: finite, planted where people stand, less slide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "math/finite.h"
#include "math/quaternion.h"
#include "motion_support.h"

namespace vfit {
namespace {

namespace fs = std::filesystem;

fs::path recordings() {
    const char* shared = std::getenv("VFIT_SHARED");
    return (shared ? fs::path(shared) : fs::path(VFIT_SOURCE_DIR) / ".." / "shared") / "data" / "recordings";
}

/// joints.csv in world space; the floor lies under the lowest ankle of the first frame.
std::vector<Body> read_bodies(const fs::path& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::getline(in, line);
    std::vector<std::pair<int, int>> columns;  // joint, axis
    std::stringstream head(line);
    std::getline(head, cell, ',');
    while (std::getline(head, cell, ',')) {
        const int joint = joint_from_name(cell.substr(0, cell.size() - 2).c_str());
        columns.emplace_back(joint, cell.back() - 'x');
    }
    std::vector<Body> bodies;
    float height = 0;
    while (std::getline(in, line)) {
        std::stringstream row(line);
        std::getline(row, cell, ',');
        Body body;
        body.id = 1;
        body.time_ns = testing::frame_ns(std::stoi(cell));
        for (const auto& [joint, axis] : columns) {
            std::getline(row, cell, ',');
            Joint& j = body.joints[size_t(joint)];
            j.state = VFIT_JOINT_MEASURED;
            j.position[axis] = std::stof(cell);
        }
        if (bodies.empty())
            height = std::max(body.at(VFIT_JOINT_LEFT_FOOT).y, body.at(VFIT_JOINT_RIGHT_FOOT).y) + 0.08f;
        for (Joint& j : body.joints)
            if (j.seen()) j.position = {j.position.x, height - j.position.y, -j.position.z};
        bodies.push_back(body);
    }
    return bodies;
}

struct Played {
    double slide_mm_s = 0, contact_share = 0;
};

Played play(const std::vector<Body>& bodies, uint32_t flags, const std::vector<uint32_t>* contacts_of,
            std::vector<uint32_t>* contacts) {
    MotionSettings settings;
    settings.flags = flags;
    Motion motion(settings);
    motion.bind(testing::test_skeleton());
    Played run;
    PosedSkeleton before;
    int frames = 0, contact_count = 0;
    for (size_t f = 0; f < bodies.size(); ++f) {
        EXPECT_TRUE(motion.step(&bodies[f], bodies[f].time_ns));
        const Pose& pose = motion.pose();
        EXPECT_TRUE(finite(pose.hips_position) && finite(pose.root_correction));
        for (const Quat& q : pose.rotation) EXPECT_TRUE(finite(q) && std::abs(glm::length(q) - 1) < 1e-3f);
        for (int j = 0; j < kJointCount; ++j)
            EXPECT_TRUE(!motion.joints().has(j) || finite(motion.joints().at(j)));
        const PosedSkeleton posed = forward_kinematics(motion.skeleton(), pose);
        if (contacts) contacts->push_back(pose.contacts);
        contact_count += (pose.contacts & 1) + ((pose.contacts >> 1) & 1);
        const std::vector<uint32_t>& truth = contacts_of ? *contacts_of : *contacts;
        for (int side = 0; f > 0 && side < 2; ++side) {
            if (!(truth[f] & truth[f - 1] & (1u << side))) continue;
            const size_t foot = side == 0 ? VFIT_BONE_LEFT_FOOT : VFIT_BONE_RIGHT_FOOT;
            const Vec3 d = posed.position[foot] - before.position[foot];
            run.slide_mm_s += 3e4 * std::hypot(d.x, d.z);
            ++frames;
        }
        before = posed;
    }
    run.slide_mm_s /= std::max(frames, 1);
    run.contact_share = 0.5 * contact_count / double(bodies.size());
    return run;
}

TEST(Recordings, RunThroughTheMotionWithFeetOnTheFloor) {
    if (!fs::exists(recordings())) GTEST_SKIP() << "no shared recordings at " << recordings();
    int count = 0;
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(recordings())) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    for (const fs::path& folder : folders) {
        if (!fs::exists(folder / "joints.csv")) continue;
        const std::vector<Body> bodies = read_bodies(folder / "joints.csv");
        const std::string name = folder.filename().string();
        std::vector<uint32_t> contacts;
        const Played corrected = play(bodies, 0, nullptr, &contacts);
        const Played plain = play(bodies, VFIT_MOTION_NO_FEET, &contacts, nullptr);
        const bool stands =
            name.find("walking") == std::string::npos && name.find("jogging") == std::string::npos;
        EXPECT_GT(corrected.contact_share, stands ? 0.9 : 0.2) << name;
        EXPECT_LT(corrected.contact_share, 1.01);
        EXPECT_LT(corrected.slide_mm_s * 5, std::max(plain.slide_mm_s, 1.0)) << name;
        ++count;
    }
    EXPECT_GT(count, 0);
}

/// The largest turn of an arm's bones from one frame to the next.
float largest_turn_of_arms(const std::vector<Body>& bodies) {
    Motion motion{MotionSettings()};
    motion.bind(testing::test_skeleton());
    PosedSkeleton before;
    float largest = 0.0f;
    for (size_t f = 0; f < bodies.size(); ++f) {
        motion.step(&bodies[f], bodies[f].time_ns);
        const PosedSkeleton posed = forward_kinematics(motion.skeleton(), motion.pose());
        for (const int bone : {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM,
                               VFIT_BONE_RIGHT_LOWER_ARM}) {
            const size_t b = size_t(bone);
            if (f > 0)
                largest = std::max(largest, angle_of(posed.rotation[b] * glm::conjugate(before.rotation[b])));
        }
        before = posed;
    }
    return largest;
}

TEST(Recordings, ArmsDoNotFlipAboutTheirAxes) {
    if (!fs::exists(recordings())) GTEST_SKIP() << "no shared recordings at " << recordings();
    for (const auto& entry : fs::directory_iterator(recordings())) {
        if (!fs::exists(entry.path() / "joints.csv")) continue;
        // A quick swing turns an arm by up to 80 degrees; a roll that flips takes 160.
        EXPECT_LT(largest_turn_of_arms(read_bodies(entry.path() / "joints.csv")), 100 * testing::kDeg)
            << entry.path().filename();
    }
}

}  // namespace
}  // namespace vfit
