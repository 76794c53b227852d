// Everybody's fit: bodies get rotations, places where they are wanted, and people are kept apart.
#include "fit/people_fit.h"

#include <gtest/gtest.h>

#include "fit_scene.h"

namespace vfit {
namespace {

Body seen_body(const FitScene& scene, uint32_t id, float error_m, int64_t time_ns) {
    Body body;
    body.id = id;
    body.time_ns = time_ns;
    const FitJoints seen = scene.seen(error_m, uint32_t(time_ns / kFrameNs));
    for (int j = 0; j < kJointCount; ++j) body.set(j, seen[size_t(j)].place, VFIT_JOINT_MEASURED, 0.9f);
    return body;
}

TEST(PeopleFit, GivesRotationsAndLeavesPlacesUnlessTheyAreWanted) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    const FitScene scene = shoot(avatar, easy_pose(avatar.skeleton()));
    std::vector<TrackTarget> targets;
    find_targets(scene.image(), 8, targets);
    ASSERT_EQ(targets.size(), 1u);
    for (const bool places : {false, true}) {
        PeopleFit people(fit_model());
        float before = 0.0f, after = 0.0f;
        for (int i = 1; i <= 4; ++i) {
            const Body seen = seen_body(scene, 1, 0.06f, i * kFrameNs);
            std::vector<Body> bodies = {seen};
            people.run(scene.image(), i * kFrameNs, targets, places, bodies);
            for (int j = 0; j < kPaperJointCount; ++j) {
                ASSERT_TRUE(bodies[0].joints[size_t(j)].has_rotation);
                before += glm::distance(seen.at(j), scene.joints.at(j));
                after += glm::distance(bodies[0].at(j), scene.joints.at(j));
            }
        }
        if (places)
            EXPECT_LT(after, 0.6f * before);
        else
            EXPECT_EQ(after, before);
    }
}

TEST(PeopleFit, ABodyWithoutPixelsStaysAsItIs) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    const FitScene scene = shoot(avatar, easy_pose(avatar.skeleton()));
    PeopleFit people(fit_model());
    std::vector<TrackTarget> targets = {{1, {}, 0}, {2, {}, 0}};
    std::vector<Body> bodies = {seen_body(scene, 2, 0.0f, kFrameNs), seen_body(scene, 1, 0.0f, kFrameNs)};
    people.run(scene.image(), kFrameNs, targets, true, bodies);
    EXPECT_FALSE(bodies[0].joints[0].has_rotation);
    EXPECT_TRUE(bodies[1].joints[0].has_rotation);
}

}  // namespace
}  // namespace vfit
