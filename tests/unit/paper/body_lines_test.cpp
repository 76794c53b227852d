// The lines of Fig. 4 on a figure whose lengths are known.
#include "paper/body_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "figure_scene.h"

namespace vfit {
namespace {

using namespace testing;

// Half a pixel of the 640 x 480 camera at 2.8 m is 2.4 mm, at both ends of a line.
constexpr float kPixel_m = 0.005f;

Lines measure(const Picture& picture) {
    DepthFilter filter;
    return measure_lines(filter.run(picture.image(), 1), picture.camera, picture.body);
}

float value(const Lines& lines, Line line) {
    EXPECT_TRUE(at(lines, line).known) << line_key(line);
    return at(lines, line).value_m;
}

float hanging_breadth() {
    // The outside of the arm, turned to 5 degrees from the vertical down to 0.35 of its length.
    const float five = 5.0f * kPi / 180.0f;
    const float upper_arm = std::hypot(kShoulder_y - kElbow_y, 0.205f - kShoulderJoint_x);
    const float tilt = std::atan2(0.205f - kShoulderJoint_x, kShoulder_y - kElbow_y);
    const float share = 0.35f;
    const float x = kShoulderJoint_x + share * (0.205f - kShoulderJoint_x);
    const float outside = (kArmOutside_x - x) / std::cos(tilt);
    return 2.0f * (kShoulderJoint_x + std::max(outside * std::cos(five) + share * upper_arm * std::sin(five),
                                               (kArmOutside_x - kShoulderJoint_x) / std::cos(tilt)));
}

TEST(BodyLines, MeasureTheFigure) {
    const Lines lines = measure(take_picture(standing_figure(), level_camera()));
    EXPECT_NEAR(value(lines, Line::kBodyHeight), kStature_m, kPixel_m);
    EXPECT_NEAR(value(lines, Line::kHeadWidth), 2 * kHeadRadius_m, 2 * kPixel_m);
    EXPECT_NEAR(value(lines, Line::kHipHeight), kHipHeight_m, 0.002f);
    EXPECT_NEAR(value(lines, Line::kHipWidth), kSeenHipBreadth_m, kPixel_m);
    EXPECT_NEAR(value(lines, Line::kShoulderWidth), hanging_breadth(), 1.5f * kPixel_m);
    // The fingertip is the furthest corner of the arm, and nearer to the camera than the joints.
    EXPECT_NEAR(value(lines, Line::kElbowFingertip), kElbow_y - kFingertip_y, 0.02f);
    EXPECT_NEAR(value(lines, Line::kWristFingertip), 0.87f - kFingertip_y, 0.02f);
    EXPECT_NEAR(value(lines, Line::kTorsoHeight), kTorso_m, 0.001f);
    for (const Estimate& line : lines) EXPECT_TRUE(!line.known || line.sigma_m > 0.0f);
}

TEST(BodyLines, StandInTheWorldWhereTheCameraIsTiltedOrOnItsSide) {
    const float height = value(measure(take_picture(standing_figure(), level_camera())), Line::kBodyHeight);
    const Figure figure = standing_figure(3.0f);
    for (const Camera& camera :
         {level_camera(640, 480, 0.15f), level_camera(640, 480, -0.05f), level_camera(640, 480, 0.0f, 0.12f),
          level_camera(480, 640, 0.0f, 0.0f), level_camera(640, 480, 0.0f, 0.5f * kPi),
          level_camera(640, 480, 0.05f, -0.5f * kPi)}) {
        SCOPED_TRACE(text(camera.width, " wide, tilt ", camera.tilt_rad(), ", roll ", camera.roll_rad()));
        const Lines lines = measure(take_picture(figure, camera));
        EXPECT_NEAR(value(lines, Line::kBodyHeight), height, 2 * kPixel_m);
        EXPECT_NEAR(value(lines, Line::kShoulderWidth), hanging_breadth(), 3 * kPixel_m);
        EXPECT_NEAR(value(lines, Line::kHipHeight), kHipHeight_m, 0.002f);
    }
}

TEST(BodyLines, FindTheFloorAtTheSolesWhereNobodyGivesIt) {
    Picture picture = take_picture(standing_figure(), level_camera());
    set_floor(picture.camera, 0.5f, 0.0f, 0.0f, VFIT_FLOOR_DEFAULT);  // a guess, and wrong
    const Lines lines = measure(picture);
    EXPECT_NEAR(value(lines, Line::kBodyHeight), kStature_m, 0.012f);
    EXPECT_NEAR(value(lines, Line::kHipHeight), kHipHeight_m, 0.012f);

    // A user map that ends 6 cm above the floor: the ankles know better.
    const Vec2 cut = picture.camera.project({0, 0.95f - 0.06f, 2.73f});
    for (uint32_t y = uint32_t(cut.y); y < 480; ++y)
        for (uint32_t x = 0; x < 640; ++x) picture.users[y * 640 + x] = 0;
    EXPECT_NEAR(value(measure(picture), Line::kBodyHeight), kStature_m, 0.015f);
}

TEST(BodyLines, KeepTheShouldersWhereTheArmsGoOut) {
    Figure figure = standing_figure();
    figure.boxes.resize(figure.boxes.size() - 2);  // the hanging arms
    const float z = 2.8f;
    for (const float s : {1.0f, -1.0f}) {
        figure.boxes.push_back({{std::min(s * 0.2f, s * 0.8f), 1.36f, -z - 0.04f},
                                {std::max(s * 0.2f, s * 0.8f), 1.44f, -z + 0.04f}});
        const int side = s > 0 ? 0 : 1;
        figure.joints.set(VFIT_JOINT_LEFT_ELBOW + side, {s * 0.48f, 1.40f, -z});
        figure.joints.set(VFIT_JOINT_LEFT_HAND + side, {s * 0.70f, 1.40f, -z});
    }
    const Lines lines = measure(take_picture(figure, level_camera()));
    // 40 mm of arm stand above the joint: the breadth must not run on to the hands.
    EXPECT_LT(value(lines, Line::kShoulderWidth), 0.50f);
    EXPECT_GT(value(lines, Line::kShoulderWidth), 2 * (kShoulderJoint_x + 0.04f) - kPixel_m);
    EXPECT_NEAR(value(lines, Line::kElbowFingertip), 0.32f, 0.02f);
}

TEST(BodyLines, LeaveOutWhatCannotBeSeen) {
    Picture picture = take_picture(standing_figure(), level_camera());
    for (const int joint : {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_HEAD, VFIT_JOINT_PELVIS,
                            VFIT_JOINT_LEFT_HIP})
        picture.body.joints[size_t(joint)].state = VFIT_JOINT_NOT_SEEN;
    const Lines lines = measure(picture);
    for (const Line line : {Line::kShoulderWidth, Line::kBodyHeight, Line::kHeadWidth, Line::kHeadHeight,
                            Line::kElbowFingertip, Line::kHipWidth, Line::kTorsoHeight})
        EXPECT_FALSE(at(lines, line).known) << line_key(line);
    EXPECT_TRUE(at(lines, Line::kHipHeight).known);
}

TEST(BodyLines, AreFiniteUnderACameraThatLooksStraightDown) {
    Picture picture = take_picture(standing_figure(), level_camera());
    set_floor(picture.camera, 2.5f, 0.5f * kPi, 0.0f, VFIT_FLOOR_GIVEN);
    for (const Estimate& line : measure(picture))
        if (line.known) {
            EXPECT_TRUE(std::isfinite(line.value_m));
            EXPECT_TRUE(std::isfinite(line.sigma_m));
        }
}

TEST(BodyLines, EndWhereAJointLiesBeforeTheLensOrTheFloorFarBelow) {
    Picture picture = take_picture(standing_figure(), level_camera());
    picture.body.joints[VFIT_JOINT_LEFT_FOOT].position = {0.0f, 0.0f, 1e-7f};
    picture.camera.floor_state = VFIT_FLOOR_DEFAULT;
    EXPECT_TRUE(at(measure(picture), Line::kBodyHeight).known);
    picture.camera.floor_state = VFIT_FLOOR_GIVEN;
    picture.camera.floor_distance_m = 1e9f;
    measure(picture);
}

TEST(BodyLines, HaveNoShoulderWidthWhereBothShouldersAreOnePlace) {
    Picture picture = take_picture(standing_figure(), level_camera());
    picture.body.joints[VFIT_JOINT_LEFT_SHOULDER] = picture.body.joints[VFIT_JOINT_RIGHT_SHOULDER];
    EXPECT_FALSE(at(measure(picture), Line::kShoulderWidth).known);
}

TEST(BodyLines, TakeAnUnseenSideFromTheOtherAndSaySo) {
    Picture picture = take_picture(standing_figure(), level_camera());
    const Lines both = measure(picture);
    picture.body.joints[VFIT_JOINT_LEFT_ELBOW].state = VFIT_JOINT_NOT_SEEN;
    const Lines one = measure(picture);
    EXPECT_NEAR(value(one, Line::kShoulderWidth), value(both, Line::kShoulderWidth), kPixel_m);
    EXPECT_GT(at(one, Line::kShoulderWidth).sigma_m, at(both, Line::kShoulderWidth).sigma_m);
}

TEST(BodyLines, AreNotTheHandsWhereThoseTouchTheHips) {
    Figure figure = standing_figure();
    figure.boxes.push_back(
        {{0.1f, 0.80f, -2.84f}, {kArmOutside_x, 0.90f, -2.76f}});  // a hand on the hip's side
    const Lines lines = measure(take_picture(figure, level_camera()));
    EXPECT_NEAR(value(lines, Line::kHipWidth), kSeenHipBreadth_m, kPixel_m);
}

}  // namespace
}  // namespace vfit
