// Posing allocates nothing once the avatar stands; vfit-bench stages prints its time.
#include <gtest/gtest.h>

#include <cmath>

#include "body_fixture.h"
#include "support/allocations.h"

namespace vfit {
namespace {

Pose step_of_a_walk(const Avatar& avatar, int frame) {
    const float phase = 0.2f * float(frame);
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS] + Vec3(0, 0, 0.02f * float(frame));
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(0.5f * std::sin(phase), Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] = glm::angleAxis(-0.5f * std::sin(phase), Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_LEFT_HAND] = glm::angleAxis(std::sin(phase), Vec3(1, 0, 0));
    return pose;
}

TEST(PoseCost, NothingIsAllocatedPerFrame) {
    Avatar avatar = make_avatar();
    const auto jobs = Jobs::own(1);
    std::vector<Collider> colliders;
    colliders.reserve(kColliderCount);
    avatar.pose(step_of_a_walk(avatar, 0), *jobs);
    const uint64_t before = test::allocations;
    for (int frame = 1; frame <= 20; ++frame) {
        avatar.pose(step_of_a_walk(avatar, frame), *jobs);
        avatar.colliders(colliders);
        EXPECT_GT(avatar.joints().at(VFIT_JOINT_HEAD).y, 1.0f);
    }
    EXPECT_EQ(test::allocations - before, 0u);
}

}  // namespace
}  // namespace vfit
