// The whole stage on virtual people: recovery, robustness, clear states, steady shape, no allocation.
#include "fit/body_fit.h"

#include <gtest/gtest.h>

#include "fit_scene.h"
#include "support/allocations.h"

namespace vfit {
namespace {

struct Person {
    Avatar avatar;
    FitScene scene;
    explicit Person(const std::vector<float>& components = {})
        : avatar(body_model(), {}, shape_of(components), Vec2(1.0f)),
          scene(shoot(avatar, easy_pose(avatar.skeleton()))) {}
};

TEST(BodyFit, RecoversAPersonFromJointsThatAreWrong) {
    for (const std::vector<float>& components : {std::vector<float>{}, {1.0f, -0.7f, 0.5f}, {-1.2f, 0.8f}}) {
        Person person(components);
        BodyFit fit(fit_model());
        const BodyFitOutput* out = nullptr;
        for (int i = 0; i < 5; ++i)
            out = &fit.run(input_of(person.scene, person.scene.seen(0.06f, uint32_t(i)), i * kFrameNs));
        ASSERT_EQ(out->state, BodyFitState::kGood);
        EXPECT_LT(mean_joint_error(*out, person.scene), 0.025f);
        EXPECT_LT(out->score.median_m, 0.008f);
        EXPECT_GT(out->score.iou, 0.90f);
    }
}

TEST(BodyFit, TellsHowJointsAreTurned) {
    Person person;
    BodyFit fit(fit_model());
    const BodyFitOutput* out = nullptr;
    for (int i = 0; i < 5; ++i)
        out = &fit.run(input_of(person.scene, person.scene.seen(0.02f, uint32_t(i)), i * kFrameNs));
    for (const int j : {VFIT_JOINT_PELVIS, VFIT_JOINT_CHEST, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_RIGHT_HIP,
                        VFIT_JOINT_LEFT_SHOULDER}) {
        const Quat& truth = person.scene.joints.joints[size_t(j)].rotation;
        const float angle = glm::length(log_of(glm::conjugate(truth) * out->rotations[size_t(j)]));
        EXPECT_LT(angle, 0.35f) << joint_name(j);
    }
}

TEST(BodyFit, KeepsNothingOfWhoWasForgotten) {
    Person person;
    BodyFit fit(fit_model());
    fit.run(input_of(person.scene, person.scene.seen(), 0));
    ASSERT_NE(fit.body().positions().front(), Vec3(0.0f));
    fit.reset();
    for (const Vec3& p : fit.body().positions()) ASSERT_EQ(p, Vec3(0.0f));
    for (const Vec3& p : fit.body().joints()) ASSERT_EQ(p, Vec3(0.0f));
    EXPECT_EQ(fit.output().state, BodyFitState::kNothing);
    EXPECT_EQ(fit.output().pose.shape, FitShape{});
    // And the next one is fitted as the first was.
    EXPECT_EQ(fit.run(input_of(person.scene, person.scene.seen(), kFrameNs)).state, BodyFitState::kGood);
}

TEST(BodyFit, ACutFromFrontToSideIsFittedAsWellAtOnceAsAfterAWhile) {
    Person person;
    Pose turned = easy_pose(person.avatar.skeleton());
    turned.rotation[VFIT_BONE_HIPS] =
        glm::angleAxis(0.5f * kPi, Vec3(0, 1, 0)) * turned.rotation[VFIT_BONE_HIPS];
    const FitScene side = shoot(person.avatar, turned);
    std::array<BodyFitOutput, 2> ends;
    for (size_t late = 0; late < 2; ++late) {
        BodyFit fit(fit_model());
        for (int i = 0; i < 5; ++i)
            fit.run(input_of(person.scene, person.scene.seen(0.02f, uint32_t(i)), i * kFrameNs));
        const int64_t gap_ns = late ? 2'000'000'000 : 3 * kFrameNs;
        for (int i = 5; i < 8; ++i) {
            ends[late] = fit.run(input_of(side, side.seen(0.02f, uint32_t(i)), i * kFrameNs + gap_ns));
            EXPECT_EQ(ends[late].cut, i == 5 && !late) << i;
        }
        EXPECT_EQ(ends[late].state, BodyFitState::kGood);
        EXPECT_LT(mean_joint_error(ends[late], side), 0.03f) << (late ? "after two seconds" : "at once");
    }
    for (size_t i = 0; i < ends[0].pose.shape.size(); ++i)
        EXPECT_NEAR(ends[0].pose.shape[i], ends[1].pose.shape[i], 0.03f) << i;
}

TEST(BodyFit, AHandThatLostItsWayIsPutWhereTheNetworkSeesIt) {
    Person person;
    Pose raised = easy_pose(person.avatar.skeleton());
    raised.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(1.2f, Vec3(0, 0, 1));
    raised.rotation[VFIT_BONE_LEFT_LOWER_ARM] = Quat(1, 0, 0, 0);
    const FitScene scene = shoot(person.avatar, raised);
    FitJoints at_the_head = scene.seen();
    for (const int j : {VFIT_JOINT_LEFT_HAND, VFIT_JOINT_LEFT_WRIST})
        at_the_head[size_t(j)].place = scene.joints.at(VFIT_JOINT_HEAD);
    at_the_head[VFIT_JOINT_LEFT_ELBOW].place = scene.joints.at(VFIT_JOINT_LEFT_SHOULDER) + Vec3(0.2f, 0, 0);
    BodyFit fit(fit_model());
    for (int i = 0; i < 4; ++i) fit.run(input_of(scene, at_the_head, i * kFrameNs));
    const BodyFitOutput* out = nullptr;
    for (int i = 4; i < 8; ++i) out = &fit.run(input_of(scene, scene.seen(0.02f, uint32_t(i)), i * kFrameNs));
    EXPECT_EQ(out->state, BodyFitState::kGood);
    EXPECT_LT(glm::distance(out->joints[VFIT_JOINT_LEFT_HAND], scene.joints.at(VFIT_JOINT_LEFT_HAND)), 0.05f);
}

TEST(BodyFit, HolesDoItLittleHarm) {
    Person person;
    FitScene holed = person.scene;
    uint32_t bits = 7;
    for (int y = 0; y < 480; y += 8)
        for (int x = 0; x < 640; x += 8) {
            bits = bits * 1664525u + 1013904223u;
            if ((bits >> 8) % 5 != 0) continue;  // a fifth of the blocks
            for (int dy = 0; dy < 8; ++dy)
                for (int dx = 0; dx < 8; ++dx) {
                    holed.depth[size_t((y + dy) * 640 + x + dx)] = 0;
                    holed.users[size_t((y + dy) * 640 + x + dx)] = 0;
                }
        }
    BodyFit fit(fit_model());
    const BodyFitOutput* out = nullptr;
    for (int i = 0; i < 5; ++i)
        out = &fit.run(input_of(holed, person.scene.seen(0.05f, uint32_t(i)), i * kFrameNs));
    EXPECT_EQ(out->state, BodyFitState::kGood);
    EXPECT_LT(mean_joint_error(*out, person.scene), 0.03f);
}

TEST(BodyFit, TheOutlinePullsAnArmThatDepthDoesNotShow) {
    // Joints put the left arm 12 cm too high; without depth rows only the outline can lower it.
    Person person;
    FitJoints joints = person.scene.seen();
    for (const int j : {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND, VFIT_JOINT_LEFT_WRIST})
        joints[size_t(j)].place.y -= 0.12f;
    const auto error = [&](bool outline) {
        BodyFitOptions options;
        options.depth_rows = false;
        options.shape = false;
        options.outline_rows = outline;
        BodyFit fit(fit_model(), options);
        const BodyFitOutput* out = nullptr;
        for (int i = 0; i < 4; ++i) out = &fit.run(input_of(person.scene, joints, i * kFrameNs));
        return glm::distance(out->joints[VFIT_JOINT_LEFT_HAND], person.scene.joints.at(VFIT_JOINT_LEFT_HAND));
    };
    const float with = error(true), without = error(false);
    EXPECT_LT(with, 0.75f * without);
}

TEST(BodyFit, SaysSoWhereThereIsNothingToFit) {
    Person person;
    BodyFit fit(fit_model());
    FitScene empty = person.scene;
    std::fill(empty.users.begin(), empty.users.end(), uint8_t{0});
    EXPECT_EQ(fit.run(input_of(empty, person.scene.seen(), 0)).state, BodyFitState::kNothing);
    EXPECT_EQ(fit.run(input_of(person.scene, FitJoints{}, kFrameNs)).state, BodyFitState::kNothing);
    EXPECT_EQ(fit.run(input_of(person.scene, person.scene.seen(), 2 * kFrameNs)).state, BodyFitState::kGood);
}

TEST(BodyFit, SaysSoWhereTheBodyIsSomethingElse) {
    // A board as wide as it is high.
    FitScene scene;
    scene.depth.assign(640 * 480, 0);
    scene.users.assign(640 * 480, 0);
    for (int y = 60; y < 420; ++y)
        for (int x = 140; x < 500; ++x)
            scene.depth[size_t(y * 640 + x)] = 2500, scene.users[size_t(y * 640 + x)] = 1;
    Person person;
    BodyFit fit(fit_model());
    EXPECT_EQ(fit.run(input_of(scene, person.scene.seen(), 0)).state, BodyFitState::kPoor);
}

TEST(BodyFit, NeverGivesNumbersThatAreNone) {
    Person person;
    BodyFit fit(fit_model());
    FitJoints joints = person.scene.seen();
    const float none = std::numeric_limits<float>::quiet_NaN(),
                endless = std::numeric_limits<float>::infinity();
    joints[VFIT_JOINT_LEFT_HAND].place = Vec3(none);
    joints[VFIT_JOINT_RIGHT_HAND].place.x = endless;
    joints[VFIT_JOINT_HEAD].confidence = none;
    joints[VFIT_JOINT_LEFT_KNEE].place = Vec3(100.0f);
    joints[VFIT_JOINT_RIGHT_FOOT].place = Vec3(0.0f);
    for (int i = 0; i < 4; ++i) {
        const BodyFitOutput& out = fit.run(input_of(person.scene, joints, i * kFrameNs));
        for (int j = 0; j < kJointCount; ++j) {
            EXPECT_TRUE(std::isfinite(glm::length(out.joints[size_t(j)])));
            EXPECT_TRUE(std::isfinite(glm::dot(out.rotations[size_t(j)], out.rotations[size_t(j)])));
        }
    }
    for (FitJoint& joint : joints) joint.place = Vec3(1.0f, 1.0f, 2.0f);  // all in one place
    const BodyFitOutput& out = fit.run(input_of(person.scene, joints, 4 * kFrameNs));
    for (const float sd : out.shape_sd) EXPECT_TRUE(std::isfinite(sd));
}

TEST(BodyFit, TheShapeSettlesAndIsForgottenOnReset) {
    Person person({1.2f, -0.6f});
    BodyFit fit(fit_model());
    FitShape first_sd{}, at_second{}, later{};
    for (int i = 0; i < 60; ++i) {
        const BodyFitOutput& out =
            fit.run(input_of(person.scene, person.scene.seen(0.03f, uint32_t(i)), i * kFrameNs));
        if (i == 0) first_sd = out.shape_sd;
        if (i == 30) at_second = out.pose.shape;
        later = out.pose.shape;
    }
    const FitShape sd = fit.output().shape_sd;
    for (size_t s = 0; s < size_t(kFitShapes); ++s) {
        EXPECT_LT(sd[s], first_sd[s]);
        EXPECT_NEAR(later[s], at_second[s], 0.1f) << s;
    }
    EXPECT_NEAR(later[0], 1.2f, 0.15f);
    fit.reset();
    EXPECT_GT(fit.run(input_of(person.scene, person.scene.seen(), 0)).shape_sd[0], sd[0]);
}

TEST(BodyFit, DoesNotAllocateAfterItsFirstFrames) {
    Person person;
    BodyFit fit(fit_model());
    BodyFitInput input = input_of(person.scene, person.scene.seen(0.03f), 0);
    for (int i = 0; i < 3; ++i) {
        input.time_ns = i * kFrameNs;
        fit.run(input);
    }
    const uint64_t before = test::allocations;
    for (int i = 3; i < 8; ++i) {
        input.time_ns = i * kFrameNs;
        fit.run(input);
    }
    EXPECT_EQ(test::allocations - before, 0u);
}

}  // namespace
}  // namespace vfit
