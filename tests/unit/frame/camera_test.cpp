#include "frame/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "frame/floor.h"
#include "frame/in_view.h"

namespace vfit {
namespace {

Camera kinect() {
    Camera c;
    c.width = 640;
    c.height = 480;
    c.fx = 594.2f;
    c.fy = 591.0f;
    c.cx = 339.3f;
    c.cy = 242.7f;
    return c;
}

TEST(Camera, ProjectingUndoesUnprojecting) {
    const Camera c = kinect();
    const Vec2 pixel = c.project(c.unproject(100.25f, 321.5f, 2.7f));
    EXPECT_NEAR(pixel.x, 100.25f, 1e-3f);
    EXPECT_NEAR(pixel.y, 321.5f, 1e-3f);
}

class CameraPoseTest : public testing::TestWithParam<std::tuple<float, float, float>> {};

TEST_P(CameraPoseTest, HeightTiltAndRollComeBackAndWorldIsRigidAndUpright) {
    const auto [height, tilt, roll] = GetParam();
    Camera c = kinect();
    set_floor(c, height, tilt, roll, VFIT_FLOOR_GIVEN);
    validate(c);
    EXPECT_NEAR(c.camera_height_m(), height, 1e-5f);
    EXPECT_NEAR(c.tilt_rad(), tilt, 1e-5f);
    EXPECT_NEAR(c.roll_rad(), roll, 1e-5f);
    const Mat4 m = c.world_from_camera();
    EXPECT_LT(glm::length(Vec3(m[3]) - Vec3(0, height, 0)), 1e-5f) << "the camera stands over the origin";
    EXPECT_LT(glm::length(glm::normalize(Mat3(m) * c.floor_normal) - Vec3(0, 1, 0)), 1e-5f);
    EXPECT_NEAR(glm::determinant(Mat3(m)), 1.0f, 1e-5f);
    const Mat4 unit = m * c.camera_from_world();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) EXPECT_NEAR(unit[i][j], i == j ? 1.0f : 0.0f, 1e-5f);
    // What lies before the camera lies towards -Z of the world, and the image's right stays right.
    EXPECT_LT((Mat3(m) * Vec3(0, 0, 1)).z, 0.0f);
    EXPECT_GT((Mat3(m) * Vec3(1, 0, 0)).x, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Poses, CameraPoseTest,
                         testing::Combine(testing::Values(0.4f, 1.0f, 2.2f),
                                          testing::Values(-0.3f, 0.0f, 0.5f),
                                          testing::Values(-0.2f, 0.0f, 0.1f)));

TEST(Camera, NonsenseIsRefusedByName) {
    Camera c = kinect();
    c.fx = 0.0f;
    EXPECT_THROW(validate(c), Error);
    c = kinect();
    c.width = 0;
    EXPECT_THROW(validate(c), Error);
    c = kinect();
    c.cx = std::nanf("");
    EXPECT_THROW(validate(c), Error);
    c = kinect();
    c.floor_normal = Vec3(0, -3, 0);
    EXPECT_THROW(validate(c), Error);
    c = kinect();
    c.depth_unit_m = -1.0f;
    EXPECT_THROW(validate(c), Error);
}

TEST(Floor, LiesBelowTheLowestFoot) {
    Camera c = kinect();
    Body body;
    body.set(VFIT_JOINT_LEFT_FOOT, {0.1f, 1.00f, 2.5f});
    body.set(VFIT_JOINT_RIGHT_FOOT, {-0.1f, 0.80f, 2.3f});  // lifted
    ASSERT_TRUE(estimate_floor(c, body));
    EXPECT_EQ(c.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_NEAR(c.camera_height_m(), 1.08f, 1e-4f);
    const Body world = to_world(body, c);
    EXPECT_NEAR(world.at(VFIT_JOINT_LEFT_FOOT).y, 0.08f, 1e-4f);
    EXPECT_NEAR(world.at(VFIT_JOINT_LEFT_FOOT).z, -2.5f, 1e-4f);
    const Body back = to_camera(world, c);
    EXPECT_LT(glm::length(back.at(VFIT_JOINT_RIGHT_FOOT) - body.at(VFIT_JOINT_RIGHT_FOOT)), 1e-5f);
}

TEST(Floor, IsNotGuessedWithoutFeet) {
    Camera c = kinect();
    Body body;
    body.set(VFIT_JOINT_HEAD, {0, 0, 2});
    EXPECT_FALSE(estimate_floor(c, body));
    EXPECT_EQ(c.floor_state, VFIT_FLOOR_DEFAULT);
}

TEST(Floor, IsNotGuessedFromFeetThatAreInferred) {
    Camera c = kinect();
    Body body;
    body.set(VFIT_JOINT_LEFT_FOOT, {0.1f, 1.00f, 2.5f}, VFIT_JOINT_INFERRED, 0.4f);
    EXPECT_FALSE(estimate_floor(c, body));
    body.set(VFIT_JOINT_RIGHT_FOOT, {-0.1f, 0.80f, 2.3f});
    ASSERT_TRUE(estimate_floor(c, body));
    EXPECT_NEAR(c.camera_height_m(), 0.88f, 1e-4f);
}

TEST(InView, NoJointOutsideTheImageIsMeasured) {
    const Camera c = kinect();
    Body body;
    const auto put = [&](int joint, float u, float v, vfit_joint_state state = VFIT_JOINT_MEASURED) {
        body.set(joint, c.unproject(u, v, 2.0f), state);
    };
    put(VFIT_JOINT_PELVIS, 0.5f * float(c.width), 0.5f * float(c.height));
    put(VFIT_JOINT_LEFT_HAND, -2.0f, 100.0f);
    put(VFIT_JOINT_RIGHT_HAND, float(c.width) + 2.0f, 100.0f);
    put(VFIT_JOINT_HEAD, 100.0f, -2.0f);
    put(VFIT_JOINT_LEFT_FOOT, 100.0f, float(c.height) + 2.0f);
    put(VFIT_JOINT_RIGHT_FOOT, 100.0f, float(c.height) - 2.0f);
    body.set(VFIT_JOINT_LEFT_KNEE, {0, 0, -2});  // behind the camera
    limit_states(body, c);
    const auto state = [&](int joint) { return body.joints[size_t(joint)].state; };
    for (const int joint : {VFIT_JOINT_PELVIS, VFIT_JOINT_RIGHT_FOOT})
        EXPECT_EQ(state(joint), VFIT_JOINT_MEASURED) << joint_name(joint);
    for (const int joint : {VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND, VFIT_JOINT_HEAD,
                            VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_KNEE})
        EXPECT_EQ(state(joint), VFIT_JOINT_INFERRED) << joint_name(joint);
    EXPECT_EQ(state(VFIT_JOINT_NECK), VFIT_JOINT_NOT_SEEN);
}

}  // namespace
}  // namespace vfit
