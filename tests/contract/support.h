// What the contract tests share: a context that closes itself, a small host frame with a person in it.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "vfit.h"

namespace contract {

inline std::string last_error() {
    char text[512];
    vfit_last_error(text, sizeof text);
    return text;
}

inline vfit_context_desc context_desc() {
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    desc.log = [](void*, vfit_log_level, const char*) {};
    return desc;
}

class ContextTest : public testing::Test {
protected:
    void SetUp() override {
        const vfit_context_desc desc = context_desc();
        ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK) << last_error();
    }
    void TearDown() override { EXPECT_EQ(vfit_context_destroy(context), VFIT_OK); }
    vfit_context context{};
};

/// 160 x 120 pixels of a box person 2 m away, and its user map.
struct HostImage {
    static constexpr uint32_t kWidth = 160, kHeight = 120;
    std::vector<uint16_t> depth = std::vector<uint16_t>(kWidth * kHeight, 3000);
    std::vector<uint8_t> users = std::vector<uint8_t>(kWidth * kHeight, 0);
    vfit_intrinsics intrinsics = vfit_intrinsics_init();
    vfit_stream streams[2] = {VFIT_STREAM_DEPTH, VFIT_STREAM_USER_MAP};
    vfit_view views[2] = {vfit_view_init(), vfit_view_init()};

    HostImage() {
        for (uint32_t y = 10; y < 110; ++y)
            for (uint32_t x = 65; x < 95; ++x) {
                depth[y * kWidth + x] = 2000;
                users[y * kWidth + x] = 1;
            }
        intrinsics.width = kWidth;
        intrinsics.height = kHeight;
        intrinsics.fx = intrinsics.fy = 120.0f;
        intrinsics.cx = 79.5f;
        intrinsics.cy = 59.5f;
        views[0].format = VFIT_FORMAT_U16;
        views[0].data = depth.data();
        views[1].format = VFIT_FORMAT_U8;
        views[1].data = users.data();
        for (vfit_view& view : views) {
            view.width = kWidth;
            view.height = kHeight;
        }
    }
    vfit_frame_desc desc() const {
        vfit_frame_desc d = vfit_frame_desc_init();
        d.count = 2;
        d.streams = streams;
        d.views = views;
        d.intrinsics = &intrinsics;
        return d;
    }
};

inline vfit_joint joint(vfit_joint_id id, float x, float y, float z) {
    vfit_joint j = vfit_joint_init();
    j.joint = id;
    j.state = VFIT_JOINT_MEASURED;
    j.confidence = 1.0f;
    j.position[0] = x;
    j.position[1] = y;
    j.position[2] = z;
    return j;
}

inline std::vector<vfit_joint> joints_of(vfit_frame frame, uint32_t body) {
    std::vector<vfit_joint> out(VFIT_JOINT_COUNT);
    uint32_t count = VFIT_JOINT_COUNT;
    EXPECT_EQ(vfit_frame_joints(frame, body, out.data(), sizeof(vfit_joint), &count), VFIT_OK)
        << last_error();
    out.resize(count);
    return out;
}

struct Pixel {
    float x, y;
};

/// Of a joint in that frame's image.
inline Pixel pixel_of(vfit_frame frame, const vfit_joint& joint) {
    vfit_camera camera = vfit_camera_init();
    vfit_intrinsics lens = vfit_intrinsics_init();
    EXPECT_EQ(vfit_frame_camera(frame, &camera), VFIT_OK) << last_error();
    EXPECT_EQ(vfit_frame_intrinsics(frame, &lens), VFIT_OK) << last_error();
    const float* to_world = camera.world_from_camera;  // rigid, by columns
    float p[3] = {};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            p[column] += to_world[4 * column + row] * (joint.position[row] - to_world[12 + row]);
    return {p[0] / p[2] * lens.fx + lens.cx, p[1] / p[2] * lens.fy + lens.cy};
}

/// The paper's 15 joints of someone 1.7 m tall in a T-pose, world space, 2 m before the camera.
inline std::vector<vfit_joint> standing_joints() {
    const float z = -2.0f;
    return {joint(VFIT_JOINT_HEAD, 0, 1.60f, z),
            joint(VFIT_JOINT_NECK, 0, 1.42f, z),
            joint(VFIT_JOINT_TORSO, 0, 1.15f, z),
            joint(VFIT_JOINT_LEFT_SHOULDER, 0.18f, 1.38f, z),
            joint(VFIT_JOINT_RIGHT_SHOULDER, -0.18f, 1.38f, z),
            joint(VFIT_JOINT_LEFT_ELBOW, 0.46f, 1.38f, z),
            joint(VFIT_JOINT_RIGHT_ELBOW, -0.46f, 1.38f, z),
            joint(VFIT_JOINT_LEFT_HAND, 0.75f, 1.38f, z),
            joint(VFIT_JOINT_RIGHT_HAND, -0.75f, 1.38f, z),
            joint(VFIT_JOINT_LEFT_HIP, 0.10f, 0.90f, z),
            joint(VFIT_JOINT_RIGHT_HIP, -0.10f, 0.90f, z),
            joint(VFIT_JOINT_LEFT_KNEE, 0.10f, 0.50f, z),
            joint(VFIT_JOINT_RIGHT_KNEE, -0.10f, 0.50f, z),
            joint(VFIT_JOINT_LEFT_FOOT, 0.10f, 0.08f, z),
            joint(VFIT_JOINT_RIGHT_FOOT, -0.10f, 0.08f, z)};
}

}  // namespace contract
