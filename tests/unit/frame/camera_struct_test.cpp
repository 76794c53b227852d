#include "frame/camera_struct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace vfit {
namespace {

vfit_intrinsics lens() {
    vfit_intrinsics in = vfit_intrinsics_init();
    in.width = 320;
    in.height = 240;
    in.fx = 285.5f;
    in.fy = 284.5f;
    in.cx = 159.0f;
    in.cy = 120.0f;
    in.distortion[1] = -0.25f;
    return in;
}

vfit_camera floor_given() {
    vfit_camera in = vfit_camera_init();
    in.floor_state = VFIT_FLOOR_GIVEN;
    in.floor_normal[1] = -std::cos(0.2f);
    in.floor_normal[2] = -std::sin(0.2f);
    in.floor_distance_m = 1.4f;
    in.depth_unit_m = 0.0001f;
    return in;
}

TEST(CameraStruct, WhatIsTakenComesOut) {
    Camera camera;
    set_intrinsics(camera, lens());
    set_placement(camera, floor_given());
    const vfit_intrinsics k = intrinsics_out(camera);
    EXPECT_EQ(k.width, 320u);
    EXPECT_EQ(k.height, 240u);
    EXPECT_EQ(k.fx, 285.5f);
    EXPECT_EQ(k.fy, 284.5f);
    EXPECT_EQ(k.cx, 159.0f);
    EXPECT_EQ(k.cy, 120.0f);
    EXPECT_EQ(k.distortion[1], -0.25f);
    const vfit_camera p = placement_out(camera);
    EXPECT_EQ(p.floor_state, VFIT_FLOOR_GIVEN);
    EXPECT_EQ(p.depth_unit_m, 0.0001f);
    EXPECT_NEAR(p.tilt_rad, 0.2f, 1e-5f);
    EXPECT_NEAR(p.height_m, 1.4f, 1e-5f);
}

TEST(CameraStruct, ANormalThatIsALittleLongScalesNobody) {
    vfit_camera in = floor_given();
    for (float& x : in.floor_normal) x *= 1.008f;
    Camera camera;
    set_placement(camera, in);
    const Mat4 m = camera.world_from_camera();
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(glm::length(Vec3(m[axis])), 1.0f, 1e-5f);
}

TEST(CameraStruct, WithoutAFloorTheNormalIsNotReadAndTheCameraIsLevel) {
    vfit_camera in = floor_given();
    in.floor_state = VFIT_FLOOR_DEFAULT;
    in.floor_normal[0] = std::numeric_limits<float>::quiet_NaN();
    in.depth_unit_m = 0.0f;
    Camera camera;
    set_placement(camera, in);
    EXPECT_EQ(camera.floor_normal, Vec3(0, -1, 0));
    EXPECT_EQ(camera.floor_distance_m, 1.0f);
    EXPECT_EQ(camera.depth_unit_m, 0.001f);
}

TEST(CameraStruct, WhatIsRefusedChangesNothing) {
    Camera camera;
    set_intrinsics(camera, lens());
    set_placement(camera, floor_given());
    vfit_intrinsics k = lens();
    k.width = 640;
    k.distortion[7] = std::numeric_limits<float>::infinity();
    EXPECT_THROW(set_intrinsics(camera, k), Error);
    vfit_camera p = floor_given();
    p.depth_unit_m = 0.5f;
    p.floor_normal[2] = 3.0f;
    EXPECT_THROW(set_placement(camera, p), Error);
    p = floor_given();
    p.floor_state = 3;
    EXPECT_THROW(set_placement(camera, p), Error);
    EXPECT_EQ(camera.width, 320u);
    EXPECT_EQ(camera.depth_unit_m, 0.0001f);
}

}  // namespace
}  // namespace vfit
