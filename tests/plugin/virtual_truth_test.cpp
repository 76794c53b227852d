// The ground truth that comes with each frame of the virtual person agrees with its image.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "virtual_host.h"

namespace vfit::virtual_person {
namespace {

// Smallest distance in pixels from p to a pixel of the person, up to `reach`; reach + 1 if there is none.
int distance_to_person(const Taken& f, const Vec2& p, int reach) {
    const int cx = static_cast<int>(std::lround(p.x)), cy = static_cast<int>(std::lround(p.y));
    for (int r = 0; r <= reach; ++r)
        for (int y = cy - r; y <= cy + r; ++y)
            for (int x = cx - r; x <= cx + r; ++x)
                if (x >= 0 && y >= 0 && x < int(f.width) && y < int(f.height) &&
                    f.user[size_t(y) * f.width + size_t(x)])
                    return r;
    return reach + 1;
}

TEST(VirtualPerson, JointsOfTheFrontViewLieOnThePerson) {
    TestHost host;
    for (const char* motion : {"scan", "sway", "squat"}) {
        for (const Taken& f : host.run(std::string("virtual:noise=0&frames=20&rate=5&motion=") + motion)) {
            ASSERT_EQ(f.joints.size(), VFIT_JOINT_COUNT);
            for (const vfit_joint& j : f.joints) {
                if (j.joint > VFIT_JOINT_RIGHT_FOOT) continue;
                EXPECT_LE(distance_to_person(f, f.project(j), 2), 2) << motion << ", joint " << j.joint;
            }
        }
    }
}

TEST(VirtualPerson, JointsOfTheScanAreMeasuredAndOnTheirOwnSide) {
    TestHost host;
    const auto frames = host.run("virtual:noise=0&frames=1");
    ASSERT_EQ(frames.size(), 1u);
    const Taken& f = frames[0];
    EXPECT_EQ(f.body.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW, 0u);
    for (const vfit_joint& j : f.joints) {
        EXPECT_EQ(j.state, VFIT_JOINT_MEASURED) << j.joint;
        const float z =
            f.depth[size_t(std::lround(f.project(j).y)) * f.width + size_t(std::lround(f.project(j).x))] *
            0.001f;
        EXPECT_GT(j.position[2], z - 0.01f) << "joint " << j.joint << " lies before the skin";
    }
    // The person faces the camera: their left is on the right of the image.
    EXPECT_GT(f.joints[VFIT_JOINT_LEFT_HAND].position[0], 0.3f);
    EXPECT_LT(f.joints[VFIT_JOINT_RIGHT_HAND].position[0], -0.3f);
}

TEST(VirtualPerson, JointsBehindTheBodyAreInferred) {
    TestHost host;
    const auto frames = host.run("virtual:noise=0&frames=1&facing=90");
    ASSERT_EQ(frames.size(), 1u);
    // Turned to their left the person shows the right side.
    EXPECT_EQ(frames[0].joints[VFIT_JOINT_LEFT_HIP].state, VFIT_JOINT_INFERRED);
    EXPECT_EQ(frames[0].joints[VFIT_JOINT_RIGHT_HIP].state, VFIT_JOINT_MEASURED);
}

TEST(VirtualPerson, FloorPixelsLieOnTheFloorThatTheCameraStates) {
    TestHost host;
    for (const char* uri :
         {"virtual:sensor=ideal&frames=1", "virtual:sensor=ideal&frames=1&tilt=12&camera_height=1.7"}) {
        const auto frames = host.run(uri);
        ASSERT_EQ(frames.size(), 1u);
        const Taken& f = frames[0];
        const Vec3 up(f.camera.floor_normal[0], f.camera.floor_normal[1], f.camera.floor_normal[2]);
        EXPECT_EQ(f.camera.floor_state, VFIT_FLOOR_GIVEN);
        EXPECT_NEAR(glm::length(up), 1.0f, 1e-6f);
        int floor = 0;
        for (uint32_t x = 0; x < f.width; ++x) {
            const size_t i = size_t{470} * f.width + x;
            if (f.user[i] || !f.depth[i]) continue;
            const Vec3 p = f.unproject(x, 470);
            if (p.x < -1.6f) continue;  // the side wall
            EXPECT_NEAR(glm::dot(up, p) + f.camera.floor_distance_m, 0.0f, 0.001f);
            ++floor;
        }
        EXPECT_GT(floor, 200) << uri;
    }
}

TEST(VirtualPerson, StandsOnTheFloorWithBothSoles) {
    TestHost host;
    for (const char* uri :
         {"virtual:sensor=ideal&frames=1&tilt=15", "virtual:sensor=ideal&frames=1&tilt=15&sex=f&height=0.2",
          "virtual:sensor=ideal&frames=1&tilt=15&sex=m&height=0.9&weight=1"}) {
        const auto frames = host.run(uri);
        ASSERT_EQ(frames.size(), 1u);
        const Taken& f = frames[0];
        float lowest = 10;
        for (uint32_t y = 0; y < f.height; ++y)
            for (uint32_t x = 0; x < f.width; ++x)
                if (f.user[size_t{y} * f.width + x]) {
                    const Vec3 p = f.unproject(x, y);
                    lowest = std::min(lowest, f.camera.floor_normal[1] * p.y +
                                                  f.camera.floor_normal[2] * p.z + f.camera.floor_distance_m);
                }
        EXPECT_GT(lowest, -0.002f) << uri;
        EXPECT_LT(lowest, 0.010f) << uri;
    }
}

TEST(VirtualPerson, PersonHasNoHoles) {
    TestHost host;
    const auto frames = host.run("virtual:sensor=ideal&frames=12&rate=1&motion=turn");
    for (const Taken& f : frames) {
        int holes = 0, person = 0;
        for (uint32_t y = 1; y + 1 < f.height; ++y)
            for (uint32_t x = 1; x + 1 < f.width; ++x) {
                const size_t i = size_t{y} * f.width + x;
                person += f.user[i];
                if (f.user[i] || !f.user[i - 1] || !f.user[i + 1] || !f.user[i - f.width] ||
                    !f.user[i + f.width])
                    continue;
                // A gap between arm and trunk may be one pixel wide; a hole lies within one surface.
                const auto [near, far] =
                    std::minmax({f.depth[i - 1], f.depth[i + 1], f.depth[i - f.width], f.depth[i + f.width]});
                holes += far - near < 30;
            }
        EXPECT_GT(person, 12000);
        EXPECT_EQ(holes, 0);
    }
}

TEST(VirtualPerson, PlantedFeetDoNotSlideInCameraSpace) {
    TestHost host;
    for (const char* motion : {"walk", "turn", "demo"}) {
        std::array<Vec3, 2> before{};
        std::array<bool, 2> stood{false, false};
        int contacts = 0;
        for (const Taken& f :
             host.run(std::string("virtual:sensor=kinect_v1_320&noise=0&frames=300&motion=") + motion)) {
            const std::string& text = f.meta.at("contacts");
            for (size_t side = 0; side < 2; ++side) {
                const float* p = f.joints[VFIT_JOINT_LEFT_FOOT + side].position;
                const Vec3 ankle(p[0], p[1], p[2]);
                const bool stands =
                    text.find(side == 0 ? "\"left\": 1" : "\"right\": 1") != std::string::npos;
                if (stands && stood[side]) {
                    EXPECT_LT(glm::distance(ankle, before[side]), 0.001f)
                        << motion << " " << f.meta.at("index");
                    ++contacts;
                }
                stood[side] = stands, before[side] = ankle;
            }
        }
        EXPECT_GT(contacts, 200) << motion;
    }
}

TEST(VirtualPerson, MeasuresFollowTheShape) {
    TestHost host;
    const auto value = [&](const std::string& uri, const std::string& key) {
        const auto frames = host.run(uri);
        const std::string& json = frames.at(0).meta.at("measures");
        const size_t at = json.find("\"" + key + "\": ");
        EXPECT_NE(at, std::string::npos) << json;
        return at == std::string::npos ? 0.0 : std::stod(json.substr(at + key.size() + 4));
    };
    const double short_m = value("virtual:frames=1&height=0.2", "stature_m"),
                 tall_m = value("virtual:frames=1&height=0.8", "stature_m");
    EXPECT_GT(tall_m, short_m + 0.1);
    EXPECT_GT(short_m, 1.3);
    EXPECT_LT(tall_m, 2.2);
    EXPECT_GT(value("virtual:frames=1&weight=1", "waist_girth_m"),
              value("virtual:frames=1&weight=0.3", "waist_girth_m") + 0.05);
}

TEST(VirtualPerson, StandsAsTallAsItsMeasureSays) {
    TestHost host;
    const auto frames = host.run("virtual:sensor=ideal&frames=1&sex=m");
    const Taken& f = frames.at(0);
    float top = 0;
    for (uint32_t y = 0; y < f.height; ++y)
        for (uint32_t x = 0; x < f.width; ++x)
            if (f.user[size_t{y} * f.width + x])
                top = std::max(top, f.camera.floor_distance_m - f.unproject(x, y).y);
    const std::string& json = f.meta.at("measures");
    const double stature = std::stod(json.substr(json.find("\"stature_m\": ") + 13));
    // With the feet 0.25 m apart a person stands a few millimetres lower; half a pixel is 2 mm.
    EXPECT_NEAR(top, stature, 0.02);
    EXPECT_LT(top, stature + 0.004);
}

}  // namespace
}  // namespace vfit::virtual_person
