// Motion capture files: what is read, what is refused, and how a walk looks once it is carried over.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "bvh.h"
#include "error.h"
#include "motion.h"

namespace vfit::virtual_person {
namespace {

const std::string kTwoJoints =
    "HIERARCHY\n"
    "ROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"
    " JOINT Leg\n {\n  OFFSET 1 -2 0\n  CHANNELS 3 Zrotation Yrotation Xrotation\n"
    "  End Site\n  {\n   OFFSET 0 -3 0\n  }\n }\n}\n"
    "MOTION\nFrames: 2\nFrame Time: .0083333\n"
    "0 10 0 0 0 0 0 0 0\n"
    "5 10 0 90 0 0 0 0 45\n";

std::string refusal(const std::string& text) {
    try {
        parse_bvh(text, "clip.bvh");
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_DATA);
        EXPECT_EQ(std::string(e.what()).find("clip.bvh, line "), 0u) << e.what();
        return e.what();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = kTwoJoints;
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
}

TEST(Bvh, JointsChannelsAndFramesAreRead) {
    const Bvh bvh = parse_bvh(kTwoJoints, "clip.bvh");
    ASSERT_EQ(bvh.joints.size(), 2u);
    EXPECT_EQ(bvh.joints[1].parent, 0);
    EXPECT_EQ(bvh.joints[1].channels, "zyx");
    EXPECT_EQ(bvh.frame_count, 2u);
    EXPECT_NEAR(bvh.frame_time_s, 1 / 120.0, 1e-6);
    BvhFrame frame;
    evaluate(bvh, 1, frame);
    // A quarter turn about Z carries the offset (1, -2, 0) to (2, 1, 0).
    EXPECT_NEAR(glm::distance(frame.position[1], Vec3(7, 11, 0)), 0, 1e-5f);
}

TEST(Bvh, EveryCutOfTheFileIsRefusedByLine) {
    for (size_t length = 0; length + 3 < kTwoJoints.size(); length += 3)
        refusal(kTwoJoints.substr(0, length));
}

TEST(Bvh, WhatIsWrongIsNamed) {
    EXPECT_NE(refusal(with("5 10 0 90", "5 nan 0 90")).find("'nan' is not a number"), std::string::npos);
    EXPECT_NE(refusal(with("5 10 0 90", "5 inf 0 90")).find("inf"), std::string::npos);
    EXPECT_NE(refusal(with("5 10 0 90", "5 ten 0 90")).find("ten"), std::string::npos);
    EXPECT_NE(refusal(with("Frames: 2", "Frames: 3")).find("the file ends"), std::string::npos);
    EXPECT_NE(refusal(with("Frames: 2", "Frames: 1")).find("more motion values"), std::string::npos);
    EXPECT_NE(refusal(with("Frames: 2", "Frames: 0")).find("no frame"), std::string::npos);
    EXPECT_NE(refusal(with("Frames: 2", "Frames: -2")).find("frame count"), std::string::npos);
    EXPECT_NE(refusal(with("Frames: 2", "Frames: 1999999")).find("too short"), std::string::npos);
    EXPECT_NE(refusal(with("CHANNELS 3", "CHANNELS 9")).find("channel count"), std::string::npos);
    EXPECT_NE(refusal(with("CHANNELS 3", "CHANNELS 4")).find("unknown channel"), std::string::npos);
    EXPECT_NE(refusal(with("Yrotation Xrotation\n JOINT", "Yrotation Wrotation\n JOINT")).find("Wrotation"),
              std::string::npos);
    EXPECT_NE(refusal(with(".0083333", "0")).find("frame time"), std::string::npos);
    EXPECT_NE(refusal(with("OFFSET 1 -2", "OFFSET 1")).find("offset"), std::string::npos);
    EXPECT_NE(refusal(with("HIERARCHY", "GLTF")).find("HIERARCHY"), std::string::npos);
}

TEST(Bvh, AMissingFileIsAnIoErrorWithItsName) {
    try {
        read_bvh("/no/such/walk.bvh");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_IO);
        EXPECT_NE(std::string(e.what()).find("/no/such/walk.bvh"), std::string::npos);
    }
}

TEST(Bvh, DeepNestingDoesNotBreakTheReader) {
    std::string text = "HIERARCHY\nROOT a\n{ OFFSET 0 0 0 CHANNELS 0\n";
    for (int i = 0; i < 100000; ++i) text += "JOINT b { OFFSET 0 0 0 CHANNELS 0\n";
    EXPECT_NE(refusal(text).find("1024 joints"), std::string::npos);
}

TEST(BvhMotion, AJointThatIsMissingIsNamed) {
    const std::string path = ::testing::TempDir() + "virtual_two_joints.bvh";
    std::ofstream(path) << kTwoJoints;
    try {
        make_bvh_motion(path, average_proportions());
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_DATA);
        EXPECT_NE(std::string(e.what()).find("lowerback"), std::string::npos) << e.what();
    }
    std::filesystem::remove(path);
}

TEST(Bvh, NumbersThatNoSkeletonHasAreRefused) {
    const std::string text =
        "HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 1 Xposition End Site { OFFSET 0 1 0 } } "
        "MOTION Frames: 1 Frame Time: 0.01 ";
    EXPECT_EQ(parse_bvh(text + "12.5", "walk.bvh").values.at(0), 12.5f);
    for (const char* value : {"1e30", "-1e300", "nan", "inf"})
        EXPECT_THROW(parse_bvh(text + value, "walk.bvh"), Error) << value;
}

std::filesystem::path shared_folder() {
    if (const char* given = std::getenv("VFIT_SHARED")) return given;
    return std::filesystem::path(VFIT_SOURCE_DIR) / ".." / "shared";
}

class CapturedWalk : public ::testing::TestWithParam<const char*> {};

TEST_P(CapturedWalk, KeepsItsFeetOnTheFloorAndFacesWhereItGoes) {
    const auto path = shared_folder() / "data/cmu_bvh" / GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Proportions p = average_proportions();
    const auto motion = make_bvh_motion(path.string(), p);
    const int frames = 120 * 8;
    constexpr int kFirst[2] = {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG};
    std::array<Vec3, 2> before{};
    std::array<bool, 2> stood{false, false};
    std::array<int, 2> standing{0, 0}, landings{0, 0};
    double along = 0;
    Vec3 hips_before(0.0f);
    float lowest_hips_m = 10;
    for (int i = 0; i < frames; ++i) {
        const BonePose pose = motion->at(i / 120.0);
        for (size_t side = 0; side < 2; ++side) {
            const Leg& leg = p.leg[side];
            const auto b = static_cast<size_t>(kFirst[side]);
            const Quat pelvis = pose.rotation[VFIT_BONE_HIPS], thigh = pelvis * pose.rotation[b],
                       shank = thigh * pose.rotation[b + 1], foot = shank * pose.rotation[b + 2];
            const Vec3 ankle = pose.hips + pelvis * leg.hip + thigh * leg.thigh + shank * leg.shank;
            const Vec3 ball = ankle + foot * Vec3(leg.foot.x, -p.ankle_height_m, leg.foot.z);
            ASSERT_GT(ball.y, -0.005f) << "frame " << i;
            if (pose.contact[side]) {
                ++standing[side];
                ASSERT_NEAR(ankle.y, p.ankle_height_m, 0.002f) << "frame " << i << " side " << side;
                ASSERT_NEAR(ball.y, 0.0f, 0.005f) << "frame " << i << " side " << side;
                if (stood[side]) {
                    ASSERT_LT(glm::distance(ankle, before[side]), 0.001f) << i;
                }
                landings[side] += !stood[side];
            }
            stood[side] = pose.contact[side];
            before[side] = ankle;
        }
        const Vec3 forward = pose.rotation[VFIT_BONE_HIPS] * Vec3(0, 0, 1);
        if (i > 0) along += glm::dot(forward, pose.hips - hips_before);
        hips_before = pose.hips;
        lowest_hips_m = std::min(lowest_hips_m, pose.hips.y);
    }
    EXPECT_GT(along, 1.5) << "the walk goes backwards";
    EXPECT_GT(lowest_hips_m, 0.3f) << "one of the clips crouches, none lies down";
    for (size_t side = 0; side < 2; ++side) {
        EXPECT_GE(landings[side], 2) << side;
        EXPECT_GT(standing[side], frames / 5) << side;
    }
}

INSTANTIATE_TEST_SUITE_P(Cmu, CapturedWalk, ::testing::Values("131_01.bvh", "131_02.bvh", "131_03.bvh"),
                         [](const auto& info) { return std::string(info.param).substr(0, 6); });

}  // namespace
}  // namespace vfit::virtual_person
