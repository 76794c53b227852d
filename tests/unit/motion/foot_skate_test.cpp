// Foot contact and foot-skate correction: planted feet stay, jumps are free, nothing pops.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "synthetic_walk.h"

namespace vfit {
namespace {

using testing::frame_ns;
using testing::SyntheticWalk;

constexpr uint32_t kContact[2] = {VFIT_CONTACT_LEFT, VFIT_CONTACT_RIGHT};

Motion make(uint32_t flags, const Skeleton* skeleton) {
    MotionSettings settings;
    settings.flags = flags;
    Motion motion(settings);
    if (skeleton) motion.bind(*skeleton);
    return motion;
}

struct Step {
    uint32_t contacts;
    Vec3 feet[2], joints[2], hips;
};

Step take(Motion& motion, const Body* body, int64_t now_ns) {
    EXPECT_TRUE(motion.step(body, now_ns));
    const PosedSkeleton p = forward_kinematics(motion.skeleton(), motion.pose());
    return {motion.pose().contacts,
            {p.position[VFIT_BONE_LEFT_FOOT], p.position[VFIT_BONE_RIGHT_FOOT]},
            {motion.joints().at(VFIT_JOINT_LEFT_FOOT), motion.joints().at(VFIT_JOINT_RIGHT_FOOT)},
            motion.pose().hips_position};
}

float level_distance(const Vec3& a, const Vec3& b) { return glm::length(Vec2(a.x - b.x, a.z - b.z)); }

struct Slide {
    double plain = 0, corrected = 0, plain_joint = 0, corrected_joint = 0;
    int frames = 0;
};

Slide walk_slide(const Skeleton* bound) {
    const Skeleton person = testing::test_skeleton();
    SyntheticWalk walk(person);
    Motion corrected = make(0, bound), plain = make(VFIT_MOTION_NO_FEET, bound);
    Slide slide;
    Step before{}, before_plain{};
    for (int f = 0; f < 300; ++f) {
        const testing::WalkFrame frame = walk.at(f);
        const Step now = take(corrected, &frame.body, frame.body.time_ns);
        const Step now_plain = take(plain, &frame.body, frame.body.time_ns);
        for (int side = 0; f > 0 && side < 2; ++side) {
            if (!(now.contacts & before.contacts & kContact[side])) continue;
            slide.corrected += level_distance(now.feet[side], before.feet[side]);
            slide.plain += level_distance(now_plain.feet[side], before_plain.feet[side]);
            slide.corrected_joint += level_distance(now.joints[side], before.joints[side]);
            slide.plain_joint += level_distance(now_plain.joints[side], before_plain.joints[side]);
            ++slide.frames;
        }
        before = now;
        before_plain = now_plain;
    }
    return slide;
}

TEST(FootSkate, CorrectionCutsTheSlideOfPlantedFeetFivefold) {
    const Skeleton skeleton = testing::test_skeleton();
    for (const Skeleton* bound : {&skeleton, static_cast<const Skeleton*>(nullptr)}) {
        const Slide slide = walk_slide(bound);
        ASSERT_GT(slide.frames, 100);
        EXPECT_LT(slide.corrected * 5, slide.plain);
        EXPECT_LT(slide.corrected_joint * 5, slide.plain_joint);
    }
}

TEST(FootSkate, ContactsOfAWalkAreRightMostOfTheTime) {
    const Skeleton skeleton = testing::test_skeleton();
    SyntheticWalk walk(skeleton);
    Motion motion = make(0, &skeleton);
    int found = 0, wrong = 0, truth = 0;
    for (int f = 0; f < 300; ++f) {
        const testing::WalkFrame frame = walk.at(f);
        const Step step = take(motion, &frame.body, frame.body.time_ns);
        for (int side = 0; side < 2; ++side) {
            const bool contact = (step.contacts & kContact[side]) != 0;
            truth += frame.planted[side];
            found += contact && frame.planted[side];
            wrong += contact && !frame.planted[side];
        }
    }
    EXPECT_GT(found, 0.6 * truth);
    EXPECT_LT(wrong, 0.15 * (found + wrong));
}

TEST(FootSkate, PlantsTheFeetOfOtherProportionsOnTheFloor) {
    const Skeleton person = testing::test_skeleton();
    Skeleton tall = person;
    for (Vec3& offset : tall.offset) offset *= 1.2f;
    tall.ankle_height *= 1.2f;
    Pose stand;
    testing::stand_on_floor(person, stand);
    Motion motion = make(0, &tall);
    Step step{};
    for (int f = 0; f < 60; ++f) {
        const Body body = testing::joints_of(person, stand, frame_ns(f));
        step = take(motion, &body, body.time_ns);
    }
    EXPECT_EQ(step.contacts, uint32_t(VFIT_CONTACT_LEFT | VFIT_CONTACT_RIGHT));
    for (int side = 0; side < 2; ++side) EXPECT_NEAR(step.feet[side].y, tall.ankle_height, 1e-3f);
    EXPECT_NEAR(step.hips.y, 1.2f * stand.hips_position.y, 0.01f);
}

TEST(FootSkate, AJumpHasNoContactInTheAir) {
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion = make(0, &skeleton);
    const float v0 = 2.5f, air_s = 2 * v0 / 9.81f;  // 0.32 m high
    int in_air = 0;
    for (int f = 0; f < 90; ++f) {
        const float t = static_cast<float>(f) / 30.0f - 1.0f;
        Pose pose;
        testing::stand_on_floor(skeleton, pose);
        if (t > 0 && t < air_s) pose.hips_position.y += v0 * t - 0.5f * 9.81f * t * t;
        const Body body = testing::joints_of(skeleton, pose, frame_ns(f));
        const Step step = take(motion, &body, body.time_ns);
        if (t <= 0) {
            EXPECT_EQ(step.contacts, 3u) << f;
        }
        if (t > 0.07f && t < air_s) {
            EXPECT_EQ(step.contacts, 0u) << f;
            ++in_air;
        }
        if (t > 0.2f && t < 0.3f) {
            EXPECT_GT(step.feet[0].y, skeleton.ankle_height + 0.15f);
        }
        if (t > air_s + 0.5f) {
            EXPECT_EQ(step.contacts, 3u) << f;
        }
    }
    EXPECT_GE(in_air, 10);
}

TEST(FootSkate, NothingPopsWhenAFootIsPlantedOrFreed) {
    // A correction moves feet by half of a step's own top speed at most: no more than their swing hides.
    // Those that are free go along with their hips, which a tracker may move by 3 cm at once.
    const Skeleton skeleton = testing::test_skeleton();
    SyntheticWalk walk(skeleton);
    walk.slide_m = 0.04f;
    // Without rotation smoothing, whose divisor the planting of feet changes, the two runs track alike.
    Motion corrected = make(VFIT_MOTION_NO_SMOOTHING, &skeleton);
    Motion plain = make(VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_FEET, &skeleton);
    Step before{}, before_plain{};
    float worst = 0;
    for (int f = 0; f < 1200; ++f) {  // 120 Hz rendering of 30 Hz bodies
        const testing::WalkFrame frame = walk.at(f / 4);
        const int64_t now_ns = frame_ns(f, 120);
        const Step now = take(corrected, &frame.body, now_ns), now_plain = take(plain, &frame.body, now_ns);
        for (int side = 0; f > 0 && side < 2; ++side) {
            const auto moved = [&](const Step& a, const Step& b) {
                const bool stands = now.contacts & before.contacts & kContact[side];
                return glm::length(a.feet[side] - b.feet[side] - (stands ? Vec3(0.0f) : a.hips - b.hips));
            };
            worst = std::max(worst, moved(now, before) - moved(now_plain, before_plain));
        }
        before = now;
        before_plain = now_plain;
    }
    EXPECT_LT(worst, 0.5f * walk.swing_speed() / 120.0f);
}

TEST(FootSkate, ReportsHowFarItMovedTheFootAndTheRoot) {
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion = make(VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_LIMITS, &skeleton);
    float largest = 0;
    for (int f = 0; f < 60; ++f) {
        Pose pose;
        testing::stand_on_floor(skeleton, pose);
        pose.hips_position.x +=
            0.04f * std::sin(static_cast<float>(f) * 0.1f);  // slow: both feet slide along
        const Body body = testing::joints_of(skeleton, pose, frame_ns(f));
        const Step step = take(motion, &body, body.time_ns);
        EXPECT_EQ(step.contacts, 3u) << f;
        EXPECT_NEAR(motion.pose().foot_correction_m, std::abs(pose.hips_position.x), 2e-3f);
        EXPECT_LT(level_distance(step.feet[0], {0.1f, 0, -0.01f}), 0.002f);
        largest = std::max(largest, glm::length(motion.pose().root_correction));
    }
    EXPECT_GT(largest, 1e-5f);  // straight legs reach aside only if the root gives way
    EXPECT_LT(largest, 0.02f);
}

TEST(FootSkate, PlantedFeetStandStillInSpaceUnderNoiseAndOutliers) {
    const Skeleton person = testing::test_skeleton();
    Pose pose;
    pose.hips_position = person.offset[VFIT_BONE_HIPS];
    std::mt19937 engine(5);
    std::normal_distribution<float> noise(0.0f, 0.01f);
    Motion motion = make(0, nullptr);
    Step before{};
    for (int f = 0; f < 300; ++f) {
        Body body = testing::joints_of(person, pose, frame_ns(f));
        for (Joint& joint : body.joints)
            if (joint.seen()) joint.position += Vec3(noise(engine), noise(engine), noise(engine));
        // Now and then a foot is reported 4 cm lower.
        if (f % 40 == 20) body.joints[VFIT_JOINT_LEFT_FOOT].position.y -= 0.04f;
        const Step now = take(motion, &body, body.time_ns);
        for (int side = 0; f > 45 && side < 2; ++side) {
            EXPECT_TRUE(now.contacts & kContact[side]) << f;
            EXPECT_LT(glm::distance(now.feet[side], before.feet[side]), 0.00025f) << f;
            EXPECT_LT(glm::distance(now.joints[side], before.joints[side]), 0.00025f) << f;
        }
        before = now;
    }
}

}  // namespace
}  // namespace vfit
