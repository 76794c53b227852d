// Hints from elsewhere: they decide where the network wavers, and do little where it is sure.
#include "track/joint_hints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "crop_scene.h"
#include "track/skeleton.h"

namespace vfit {
namespace {

using testing::camera_320, testing::view_at;

/// Heat as the network draws it, a Gaussian of 7 cm, at a place of the crop.
void add_heat(JointMaps& maps, int joint, float cx, float cy, float share) {
    for (int y = 0; y < JointMaps::kSide; ++y)
        for (int x = 0; x < JointMaps::kSide; ++x) {
            const float px = (float(x) + 0.5f) / 16.0f - 1.0f, py = (float(y) + 0.5f) / 16.0f - 1.0f;
            const float d2 = ((px - cx) * (px - cx) + (py - cy) * (py - cy)) / (0.06f * 0.06f);
            float& logit = maps.heat[size_t(joint) * JointMaps::kCells + size_t(y * JointMaps::kSide + x)];
            logit = std::log(std::exp(logit) + share * std::exp(-0.5f * d2));
        }
}

class JointHintsTest : public ::testing::Test {
protected:
    JointHintsTest() { maps->heat.fill(-16.0f), maps->depth.fill(0.0f); }
    JointHint hint(int joint, float cx, float cy, float confidence) const {
        const Vec2 q = view.centre + view.right * (cx * 64.0f) + view.down * (cy * 64.0f);
        return {joint, q.x, q.y, confidence, 0};
    }
    SeenJoint read(int joint) const {
        SeenJoints joints;
        read_maps(*maps, view, camera_320(), joints);
        return joints[size_t(joint)];
    }
    Vec3 place(int joint) const { return view.from_camera(camera_320(), read(joint).position); }

    CropView view = view_at(2.5f);
    std::unique_ptr<JointMaps> maps = std::make_unique<JointMaps>();
};

TEST_F(JointHintsTest, DecideBetweenTwoPlaces) {
    add_heat(*maps, VFIT_JOINT_LEFT_HAND, -0.4f, 0.0f, 0.6f);
    add_heat(*maps, VFIT_JOINT_LEFT_HAND, 0.4f, 0.1f, 0.4f);
    const float unsure = read(VFIT_JOINT_LEFT_HAND).confidence;
    const JointHint hints[] = {hint(VFIT_JOINT_LEFT_HAND, 0.45f, 0.1f, 0.8f)};
    apply_hints(hints, view, false, *maps);
    EXPECT_NEAR(place(VFIT_JOINT_LEFT_HAND).x, 0.4f, 0.05f);
    EXPECT_GT(read(VFIT_JOINT_LEFT_HAND).confidence, unsure + 0.3f);
}

TEST_F(JointHintsTest, HardlyMoveAJointThatTheNetworkIsSureOf) {
    add_heat(*maps, VFIT_JOINT_LEFT_HAND, -0.4f, 0.0f, 1.0f);
    const float before = place(VFIT_JOINT_LEFT_HAND).x;
    for (const float confidence : {0.3f, 0.6f, 0.8f}) {
        const JointHint hints[] = {hint(VFIT_JOINT_LEFT_HAND, 0.5f, 0.0f, confidence)};
        auto copy = std::make_unique<JointMaps>(*maps);
        apply_hints(hints, view, false, *copy);
        std::swap(copy, maps);
        EXPECT_NEAR(place(VFIT_JOINT_LEFT_HAND).x, before, 0.09f)
            << "10 cm, for a hint a metre off; " << confidence;
        std::swap(copy, maps);
    }
}

TEST_F(JointHintsTest, ChangeNothingWithoutConfidenceAndOutsideTheCrop) {
    add_heat(*maps, VFIT_JOINT_LEFT_HAND, -0.4f, 0.0f, 1.0f);
    const JointMaps before = *maps;
    const JointHint hints[] = {hint(VFIT_JOINT_LEFT_HAND, 0.3f, 0.0f, 0.0f),
                               hint(VFIT_JOINT_LEFT_HAND, 1.2f, 0.0f, 1.0f),
                               {VFIT_JOINT_LEFT_HAND, 1e30f, -1e30f, 1.0f, 0}};
    apply_hints(hints, view, false, *maps);
    EXPECT_EQ(maps->heat, before.heat);
}

TEST_F(JointHintsTest, OfSomebodyWhoFacesAwayGoToTheOtherSidesMap) {
    for (const int joint : {VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND}) {
        add_heat(*maps, joint, -0.4f, 0.0f, 0.5f);
        add_heat(*maps, joint, 0.4f, 0.0f, 0.5f);
    }
    const JointHint hints[] = {hint(VFIT_JOINT_LEFT_HAND, 0.4f, 0.0f, 0.9f)};
    apply_hints(hints, view, true, *maps);
    EXPECT_NEAR(place(VFIT_JOINT_LEFT_HAND).x, 0.0f, 0.05f);
    EXPECT_NEAR(place(VFIT_JOINT_RIGHT_HAND).x, 0.4f, 0.05f);
}

TEST_F(JointHintsTest, SayWhichSideSomebodyFaces) {
    add_heat(*maps, VFIT_JOINT_LEFT_HAND, 0.4f, 0.0f, 1.0f);
    add_heat(*maps, VFIT_JOINT_RIGHT_HAND, -0.4f, 0.0f, 1.0f);
    maps->away = 0.0f;
    const JointHint as_drawn[] = {hint(VFIT_JOINT_LEFT_HAND, 0.4f, 0.0f, 0.8f)};
    answer_facing(as_drawn, view, *maps);
    EXPECT_LT(maps->away, -2.0f);
    maps->away = 0.0f;
    const JointHint exchanged[] = {hint(VFIT_JOINT_LEFT_HAND, -0.4f, 0.0f, 0.8f),
                                   hint(VFIT_JOINT_HEAD, 0.0f, 0.0f, 0.8f)};
    answer_facing(exchanged, view, *maps);
    EXPECT_GT(maps->away, 2.0f);
}

TEST_F(JointHintsTest, AreOfABoxWithSomeRoomAroundIt) {
    const PixelBox box{100, 40, 160, 200};
    EXPECT_TRUE(near_box({0, 130.0f, 100.0f, 1.0f, 0}, box));
    EXPECT_TRUE(near_box({0, 190.0f, 100.0f, 1.0f, 0}, box));
    EXPECT_FALSE(near_box({0, 210.0f, 100.0f, 1.0f, 0}, box));
    EXPECT_FALSE(near_box({0, 130.0f, 250.0f, 1.0f, 0}, box));
    EXPECT_TRUE(near_box({0, 999.0f, 999.0f, 1.0f, 0}, PixelBox{}));
}

}  // namespace
}  // namespace vfit
