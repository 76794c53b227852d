// Everybody's fit: bodies get rotations, places where they are wanted, and people are kept apart.
#include "fit/people_fit.h"

#include <gtest/gtest.h>

#include "fit_scene.h"
#include "track/tracker.h"

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

/// Mean distance of the paper's joints to the truth, metres.
float error_of(const Body& body, const FitScene& scene) {
    float sum = 0.0f;
    for (int j = 0; j < kPaperJointCount; ++j) sum += glm::distance(body.at(j), scene.joints.at(j));
    return sum / float(kPaperJointCount);
}

class PeopleFitTest : public ::testing::Test {
protected:
    PixelBox box() const {
        std::vector<TrackTarget> targets;
        find_targets(scene.image(), 8, targets);
        return targets.front().box;
    }
    Avatar avatar{body_model(), {}, shape_of({}), Vec2(1.0f)};
    FitScene scene = shoot(avatar, easy_pose(avatar.skeleton()));
    PeopleFit people{fit_model()};
};

TEST_F(PeopleFitTest, BringsJointsNearerAndGivesThemRotations) {
    float before = 0.0f, after = 0.0f;
    for (int i = 1; i <= 4; ++i) {
        const Body seen = seen_body(scene, 1, 0.06f, i * kFrameNs);
        Body body = seen;
        people.run(scene.image(), box(), body);
        for (const Joint& joint : body.joints) ASSERT_TRUE(joint.has_rotation);
        before += error_of(seen, scene);
        after += error_of(body, scene);
    }
    EXPECT_LT(after, 0.6f * before);
}

TEST_F(PeopleFitTest, ABodyWithoutPixelsStaysAsItIs) {
    const Body seen = seen_body(scene, 2, 0.0f, kFrameNs);
    Body body = seen;
    people.run(scene.image(), {}, body);
    EXPECT_FALSE(body.joints[0].has_rotation);
    EXPECT_EQ(error_of(body, scene), error_of(seen, scene));
}

TEST_F(PeopleFitTest, JointsThatAreNotSeenStayUnseen) {
    Body body = seen_body(scene, 1, 0.02f, kFrameNs);
    body.joints[VFIT_JOINT_LEFT_HAND] = Joint{};
    people.run(scene.image(), box(), body);
    EXPECT_TRUE(body.joints[VFIT_JOINT_RIGHT_HAND].has_rotation);
    EXPECT_FALSE(body.has(VFIT_JOINT_LEFT_HAND));
    EXPECT_EQ(body.at(VFIT_JOINT_LEFT_HAND), Vec3(0.0f));
}

TEST_F(PeopleFitTest, AJointThatWasWrongComesBackWithoutALeap) {
    const auto hand_at = [&](int64_t time_ns, uint32_t label) {
        Body body = seen_body(scene, label, 0.0f, time_ns);
        if (time_ns == kFrameNs) body.joints[VFIT_JOINT_LEFT_HAND].position.y -= 0.6f;
        people.run(scene.image(), {}, body);
        return body.at(VFIT_JOINT_LEFT_HAND);
    };
    // A label without pixels is not fitted: what comes out is what went in, but for the pace.
    const Vec3 wrong = hand_at(kFrameNs, 2), next = hand_at(2 * kFrameNs, 2);
    EXPECT_NEAR(glm::distance(wrong, next), 5.5f / 30.0f, 2e-3f);
    EXPECT_LT(glm::distance(hand_at(5 * kFrameNs, 2), scene.joints.at(VFIT_JOINT_LEFT_HAND)), 0.01f);
    const Vec3 late = hand_at(kFrameNs, 3), far = hand_at(20 * kFrameNs, 3);
    EXPECT_GT(glm::distance(late, far), 0.5f) << "after a gap";
}

TEST_F(PeopleFitTest, AfterACutJointsAreTakenWhereTheyAre) {
    Pose turned = easy_pose(avatar.skeleton());
    turned.rotation[VFIT_BONE_HIPS] =
        glm::angleAxis(0.5f * kPi, Vec3(0, 1, 0)) * turned.rotation[VFIT_BONE_HIPS];
    turned.hips_position.x += 0.5f;
    const FitScene other = shoot(avatar, turned);
    for (int i = 1; i <= 4; ++i) {
        Body body = seen_body(scene, 1, 0.02f, i * kFrameNs);
        people.run(scene.image(), box(), body);
    }
    Body body = seen_body(other, 1, 0.02f, 5 * kFrameNs);
    people.run(other.image(), {}, body);
    EXPECT_LT(error_of(body, other), 0.05f);
}

TEST_F(PeopleFitTest, AFitThatGoesBadLetsGoOfTheJointsStepByStep) {
    Body seen = seen_body(scene, 1, 0.0f, kFrameNs);
    for (Joint& joint : seen.joints) joint.position.x += 0.04f;  // what the fit takes back
    const auto moved_by_fit = [&](int frame) {
        Body body = seen;
        body.time_ns = frame * kFrameNs;
        people.run(scene.image(), {}, body);
        EXPECT_EQ(body.joints[0].has_rotation, frame <= 4);
        return glm::distance(body.at(VFIT_JOINT_CHEST), seen.at(VFIT_JOINT_CHEST));
    };
    for (int frame = 1; frame < 4; ++frame) moved_by_fit(frame);
    const float whole = moved_by_fit(4);
    EXPECT_GT(whole, 0.015f);
    // A board in the person's place.
    for (size_t i = 0; i < scene.depth.size(); ++i) {
        scene.users[i] = i % 640 > 200 && i % 640 < 500 && i / 640 > 150 && i / 640 < 300;
        if (scene.users[i]) scene.depth[i] = 2000;
    }
    for (int frame = 5; frame <= 9; ++frame)
        EXPECT_NEAR(moved_by_fit(frame), whole * std::max(0.0f, 1.0f - 0.25f * float(frame - 4)), 1e-5f)
            << frame;
}

}  // namespace
}  // namespace vfit
