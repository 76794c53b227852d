// How a person stands to the camera.
#include "scan/view_kind.h"

#include <gtest/gtest.h>

namespace vfit {
namespace {

/// A camera whose image has that way up.
Camera camera_with(const Vec3& up) {
    Camera camera;
    camera.floor_normal = up;
    return camera;
}

TEST(ViewKind, FacingIsCountedToThePersonsLeftHoweverTheCameraIsRolled) {
    struct Case {
        Vec3 up, right;  // right: where a viewer who stands upright sees the person's left
    };
    for (const auto& [up, right] : {Case{{0, -1, 0}, {1, 0, 0}},
                                    {{1, 0, 0}, {0, 1, 0}},
                                    {{0, 1, 0}, {-1, 0, 0}},
                                    {{-1, 0, 0}, {0, -1, 0}}}) {
        const Camera camera = camera_with(up);
        const Vec3 towards(0, 0, -1);
        EXPECT_NEAR(facing_rad(camera, towards), 0.0f, 1e-5f);
        EXPECT_NEAR(facing_rad(camera, right), 0.5f * kPi, 1e-5f);
        EXPECT_NEAR(facing_rad(camera, -right), -0.5f * kPi, 1e-5f);
        EXPECT_NEAR(facing_rad(camera, glm::normalize(right + towards)), 0.25f * kPi, 1e-5f);
        EXPECT_NEAR(std::abs(facing_rad(camera, -towards)), kPi, 1e-5f);
    }
}

TEST(ViewKind, TiltTurnsNoPerson) {
    Camera camera;
    set_floor(camera, 2.0f, 0.5f, 0.0f, VFIT_FLOOR_GIVEN);
    const Vec3 towards = Vec3(0, 0, -1) + glm::dot(Vec3(0, 0, 1), camera.floor_normal) * camera.floor_normal;
    EXPECT_NEAR(facing_rad(camera, glm::normalize(towards)), 0.0f, 1e-5f);
    EXPECT_NEAR(facing_rad(camera, glm::normalize(glm::normalize(towards) + Vec3(1, 0, 0))), 0.25f * kPi,
                1e-5f);
}

TEST(ViewKind, FrontAndSideAreTold) {
    EXPECT_EQ(view_kind_of(0.5f), ViewKind::kFront);
    EXPECT_EQ(view_kind_of(-0.5f), ViewKind::kFront);
    EXPECT_EQ(view_kind_of(0.8f), ViewKind::kOther);
    EXPECT_EQ(view_kind_of(-1.5f), ViewKind::kSide);
    EXPECT_EQ(view_kind_of(3.0f), ViewKind::kOther);
    EXPECT_EQ(view_kind_of(0.65f, 0.1f), ViewKind::kFront);
}

}  // namespace
}  // namespace vfit
