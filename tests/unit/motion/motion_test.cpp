// The stages together: errors, time, persons, continuity, no allocation.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "core/error.h"
#include "math/finite.h"
#include "math/quaternion.h"
#include "motion/joint_limits.h"
#include "support/allocations.h"
#include "synthetic_walk.h"

namespace vfit {
namespace {

using testing::frame_ns;

Body standing(int64_t time_ns, uint32_t id = 1) {
    const Skeleton skeleton = testing::test_skeleton();
    Pose pose;
    testing::stand_on_floor(skeleton, pose);
    Body body = testing::joints_of(skeleton, pose, time_ns);
    body.id = id;
    return body;
}

vfit_result code_of(Motion& motion, const Body& body, std::string& message) {
    try {
        motion.step(&body, body.time_ns);
    } catch (const Error& e) {
        message = e.what();
        return e.code();
    }
    return VFIT_OK;
}

TEST(Motion, SaysThatNobodyWasSeen) {
    Motion motion{MotionSettings{}};
    EXPECT_FALSE(motion.step(nullptr, 0));
    Body empty;
    EXPECT_FALSE(motion.step(&empty, 0));
    const Body body = standing(frame_ns(1));
    EXPECT_TRUE(motion.step(&body, body.time_ns));
    EXPECT_TRUE(motion.step(nullptr, frame_ns(2)));
    EXPECT_EQ(motion.pose().time_ns, frame_ns(2));
    motion.reset();
    EXPECT_FALSE(motion.step(nullptr, frame_ns(3)));
}

TEST(Motion, RefusesAJointThatIsNotFiniteAndNamesIt) {
    Motion motion{MotionSettings{}};
    Body body = standing(0);
    motion.step(&body, 0);
    const Vec3 hips = motion.pose().hips_position;
    body = standing(frame_ns(1));
    body.joints[VFIT_JOINT_LEFT_ELBOW].position.y = std::numeric_limits<float>::quiet_NaN();
    std::string message;
    EXPECT_EQ(code_of(motion, body, message), VFIT_ERROR_DATA);
    EXPECT_NE(message.find("LEFT_ELBOW"), std::string::npos) << message;
    EXPECT_EQ(motion.pose().hips_position, hips);
    EXPECT_EQ(motion.pose().time_ns, 0);

    body = standing(frame_ns(1));
    body.joints[VFIT_JOINT_HEAD].has_rotation = true;
    body.joints[VFIT_JOINT_HEAD].rotation = Quat(0, 0, 0, 0);
    EXPECT_EQ(code_of(motion, body, message), VFIT_ERROR_DATA);
    EXPECT_NE(message.find("HEAD"), std::string::npos) << message;
}

TEST(Motion, RefusesAJointOutsideOfAnyRoomAndGoesOn) {
    Motion motion{MotionSettings{}};
    Body body = standing(0);
    motion.step(&body, 0);
    body = standing(frame_ns(1));
    body.joints[VFIT_JOINT_LEFT_FOOT].position.z = 1e25f;  // finite, its square is not
    std::string message;
    EXPECT_EQ(code_of(motion, body, message), VFIT_ERROR_DATA);
    EXPECT_NE(message.find("LEFT_FOOT"), std::string::npos) << message;
    body = standing(frame_ns(1));
    body.joints[VFIT_JOINT_HEAD].has_rotation = true;
    body.joints[VFIT_JOINT_HEAD].rotation = Quat(1e25f, 0, 0, 0);
    EXPECT_EQ(code_of(motion, body, message), VFIT_ERROR_DATA);
    body = standing(frame_ns(2));
    EXPECT_TRUE(motion.step(&body, body.time_ns));
    for (const Quat& q : motion.pose().rotation) EXPECT_TRUE(finite(q));
}

TEST(Motion, StandsWhereAllJointsOfTheLegsAreOnePoint) {
    // What some sources report of legs that they cannot see.
    Motion motion{MotionSettings{}};
    motion.bind(testing::test_skeleton());
    for (int f = 0; f < 10; ++f) {
        Body body = standing(frame_ns(f));
        for (int j = VFIT_JOINT_LEFT_HIP; j <= VFIT_JOINT_RIGHT_FOOT; ++j)
            body.joints[size_t(j)].position = Vec3(0, 0.9f, 0);
        for (int j : {VFIT_JOINT_LEFT_TOES, VFIT_JOINT_RIGHT_TOES}) body.joints[size_t(j)] = Joint();
        EXPECT_TRUE(motion.step(&body, body.time_ns));
        ASSERT_TRUE(finite(motion.pose().hips_position)) << f;
    }
}

TEST(Motion, RefusesSettingsOutOfRangeAndNamesThem) {
    const auto message_of = [](auto&& change) -> std::string {
        MotionSettings settings;
        change(settings);
        try {
            Motion motion(settings);
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
            return e.what();
        }
        return "";
    };
    EXPECT_NE(message_of([](auto& s) { s.filter.holt.smoothing = 2; }).find("smoothing"), std::string::npos);
    EXPECT_NE(message_of([](auto& s) { s.filter.holt.jitter_radius_m = -1; }).find("jitter_radius_m"),
              std::string::npos);
    EXPECT_NE(message_of([](auto& s) { s.rotation_divisor = 0.5f; }).find("rotation_divisor"),
              std::string::npos);
    EXPECT_EQ(message_of([](auto&) {}), "");
}

TEST(Motion, RefusesASkeletonThatCannotStand) {
    Motion motion{MotionSettings{}};
    EXPECT_THROW(motion.bind(Skeleton()), Error);
    Skeleton broken = testing::test_skeleton();
    broken.offset[VFIT_BONE_CHEST].x = std::numeric_limits<float>::infinity();
    EXPECT_THROW(motion.bind(broken), Error);
    broken = testing::test_skeleton();
    broken.ankle_height = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(motion.bind(broken), Error);
}

TEST(Motion, KeepsAStillPersonStill) {
    Motion motion{MotionSettings{}};
    Body body = standing(0);
    motion.step(&body, 0);
    const Pose first = motion.pose();
    for (int f = 1; f < 120; ++f) {
        body = standing(frame_ns(f));
        motion.step(&body, body.time_ns);
        ASSERT_LT(glm::length(motion.pose().hips_position - first.hips_position), 1e-3f);
        ASSERT_EQ(motion.pose().contacts, 3u);
    }
}

TEST(Motion, MeasuresThePersonWhereNoCharacterIsBound) {
    const Skeleton truth = testing::test_skeleton();
    Motion motion{MotionSettings{}};
    for (int f = 0; f < 30; ++f) {
        const Body body = standing(frame_ns(f));
        motion.step(&body, body.time_ns);
    }
    const Skeleton& s = motion.skeleton();
    for (int bone : {VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_HAND, VFIT_BONE_LEFT_LOWER_LEG,
                     VFIT_BONE_RIGHT_FOOT, VFIT_BONE_LEFT_TOES})
        EXPECT_NEAR(glm::length(s.offset[size_t(bone)]), glm::length(truth.offset[size_t(bone)]), 1e-3f)
            << bone_name(bone);
    EXPECT_NEAR(s.ankle_height, truth.ankle_height, 1e-3f);
}

TEST(Motion, StartsAnewWithAnotherPersonAndWhenTimeGoesBack) {
    for (const bool other : {true, false}) {
        Motion motion{MotionSettings{}};
        for (int f = 10; f < 20; ++f) {
            const Body body = standing(frame_ns(f));
            motion.step(&body, body.time_ns);
        }
        Body moved = standing(other ? frame_ns(20) : 0, other ? 2 : 1);
        for (Joint& joint : moved.joints) joint.position.x += 1.5f;
        motion.step(&moved, moved.time_ns);
        EXPECT_NEAR(motion.pose().hips_position.x, 1.5f, 1e-4f);  // no glide from the one before
    }
}

TEST(Motion, StartsAnewAfterALongGapAndGlidesOverAShortOne) {
    for (const int gap : {30, 270}) {  // frames
        Motion motion{MotionSettings{}};
        for (int f = 0; f < 30; ++f) {
            const Body body = standing(frame_ns(f));
            motion.step(&body, body.time_ns);
        }
        for (int f = 30; f < 30 + gap; ++f) motion.step(nullptr, frame_ns(f));
        Body moved = standing(frame_ns(30 + gap));
        for (Joint& joint : moved.joints) joint.position.x += 1.5f;
        motion.step(&moved, moved.time_ns);
        if (gap > 60)
            EXPECT_NEAR(motion.pose().hips_position.x, 1.5f, 1e-4f);
        else
            EXPECT_LT(motion.pose().hips_position.x, 0.5f);
    }
}

/// Somebody who walks on the spot, lifting one foot after the other.
Body stepping(const Skeleton& skeleton, int frame, int64_t time_ns) {
    Pose pose;
    const float phase = 0.2f * static_cast<float>(frame);
    for (const bool left : {true, false}) {
        const float lift = std::max(0.0f, left ? std::sin(phase) : -std::sin(phase));
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_LEG : VFIT_BONE_RIGHT_UPPER_LEG] =
            glm::angleAxis(-0.7f * lift, Vec3(1, 0, 0));
        pose.rotation[left ? VFIT_BONE_LEFT_LOWER_LEG : VFIT_BONE_RIGHT_LOWER_LEG] =
            glm::angleAxis(1.1f * lift, Vec3(1, 0, 0));
    }
    testing::stand_on_floor(skeleton, pose);
    return testing::joints_of(skeleton, pose, time_ns);
}

TEST(Motion, SurvivesGapsNoTimeAndTimeThatRunsWild) {
    const Skeleton skeleton = testing::test_skeleton();
    // Steps of no time, a nanosecond, a second, a minute, a year, back by a frame, back to the beginning.
    const int64_t jumps[] = {0,          1, 33'333'333, 1'000'000'000, 60'000'000'000, 31'536'000'000'000'000,
                             -33'333'333};
    for (const bool bound : {false, true}) {
        Motion motion{MotionSettings{}};
        if (bound) motion.bind(skeleton);
        int64_t now_ns = 5'000'000'000;
        testing::RandomPose random(17);
        for (int f = 0; f < 3000; ++f) {
            const auto pick = static_cast<size_t>(random.uniform(0.0f, 7.99f));
            now_ns = pick == 7 ? 0 : now_ns + (f % 3 == 0 ? jumps[pick] : 33'333'333);
            Body body = stepping(skeleton, f, now_ns);
            if (f % 11 == 0) body.joints[VFIT_JOINT_LEFT_FOOT] = body.joints[VFIT_JOINT_LEFT_KNEE] = Joint();
            if (f % 97 < 3) body.id = 2;
            const bool no_body = f % 7 == 0;
            motion.step(no_body ? nullptr : &body, now_ns);
            ASSERT_TRUE(finite(motion.pose().hips_position)) << f;
            ASSERT_LT(glm::length(motion.pose().hips_position), 3.0f) << f;
            for (const Quat& q : motion.pose().rotation) ASSERT_NEAR(glm::length(q), 1.0f, 1e-4f) << f;
        }
    }
}

TEST(Motion, SurvivesTheEndsOfTheClock) {
    const Skeleton skeleton = testing::test_skeleton();
    MotionSettings ahead;
    ahead.prediction_s = 0.2f;
    for (const int64_t first : {INT64_MIN, int64_t{0}, INT64_MAX - 300'000'000}) {
        Motion motion{ahead};
        for (int f = 0; f < 12; ++f) {
            const Body body = stepping(skeleton, f, first + f * int64_t{25'000'000});
            motion.step(&body, f % 3 == 0 ? INT64_MAX : f % 3 == 1 ? INT64_MIN : body.time_ns);
            ASSERT_TRUE(finite(motion.pose().hips_position)) << f;
            for (const Quat& q : motion.pose().rotation) ASSERT_NEAR(glm::length(q), 1.0f, 1e-4f) << f;
        }
        const Body last = stepping(skeleton, 12, INT64_MAX);
        motion.step(&last, INT64_MAX);
        ASSERT_TRUE(finite(motion.pose().hips_position));
    }
}

TEST(Motion, GivesTheSameBitsForTheSameBodies) {
    const Skeleton skeleton = testing::test_skeleton();
    Motion a{MotionSettings{}}, b{MotionSettings{}};
    Body other = standing(frame_ns(0), 2);
    for (int f = 0; f < 20; ++f) {  // b was used before
        other.time_ns = frame_ns(f);
        b.step(&other, other.time_ns);
    }
    b.reset();
    for (int f = 0; f < 200; ++f) {
        const Body body = stepping(skeleton, f, frame_ns(f));
        for (Motion* motion : {&a, &b}) {
            motion->step(&body, body.time_ns);
            motion->step(nullptr, body.time_ns + 11'000'000);
        }
        ASSERT_EQ(a.pose().hips_position, b.pose().hips_position) << f;
        for (size_t i = 0; i < size_t(kBoneCount); ++i)
            ASSERT_EQ(a.pose().rotation[i], b.pose().rotation[i]) << f;
    }
}

Pose knees_bent_by_16_degrees(const Skeleton& skeleton) {
    Pose pose;
    for (const int leg : {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG}) {
        pose.rotation[size_t(leg)] = glm::angleAxis(-8 * testing::kDeg, Vec3(1, 0, 0));
        pose.rotation[size_t(leg) + 1] = glm::angleAxis(16 * testing::kDeg, Vec3(1, 0, 0));
        pose.rotation[size_t(leg) + 2] = glm::angleAxis(-8 * testing::kDeg, Vec3(1, 0, 0));
    }
    testing::stand_on_floor(skeleton, pose);
    return pose;
}

TEST(Motion, AFootThatStandsKeepsTheKneeAsItWasSeen) {
    // All above the ankles bobs by a centimetre, as a sensor sees it. Where the root's height does not take
    // that, the distance from hip to ankle does, and near full stretch a centimetre of it is 17 degrees of
    // the knee.
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion{MotionSettings{}};
    motion.bind(skeleton);
    float least = 180.0f, most = 0.0f;
    for (int f = 0; f < 150; ++f) {
        Body body = testing::joints_of(skeleton, knees_bent_by_16_degrees(skeleton), frame_ns(f));
        for (Joint& joint : body.joints)
            if (joint.position.y > 0.2f) joint.position.y += 0.01f * std::sin(0.15f * static_cast<float>(f));
        motion.step(&body, body.time_ns);
        if (f < 60) continue;
        const float bend = angle_of(motion.pose().rotation[VFIT_BONE_LEFT_LOWER_LEG]) / testing::kDeg;
        least = std::min(least, bend);
        most = std::max(most, bend);
    }
    EXPECT_LT(most - least, 1.0f) << least << " to " << most << " degrees";
}

TEST(Motion, ALegSeenHigherThanTheOtherOnALevelFloorBendsNoKnee) {
    // Sensors see one leg, hip to toes, a centimetre higher than the other one. Both feet stand on the floor:
    // the pelvis rolls by what they differ in, or one knee would bend by another 15 degrees. Nothing above it
    // turns.
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion{MotionSettings{}};
    motion.bind(skeleton);
    Quat spine_level(1, 0, 0, 0);
    for (int f = 0; f < 240; ++f) {
        Body body = testing::joints_of(skeleton, knees_bent_by_16_degrees(skeleton), frame_ns(f));
        const float higher = 0.01f * std::clamp(static_cast<float>(f - 60) / 60.0f, 0.0f, 1.0f);
        for (const int j :
             {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES})
            body.joints[size_t(j)].position.y += higher;
        motion.step(&body, body.time_ns);
        const PosedSkeleton posed = forward_kinematics(skeleton, motion.pose());
        if (f == 59) spine_level = posed.rotation[VFIT_BONE_SPINE];
        if (f < 59) continue;
        ASSERT_EQ(motion.pose().contacts, uint32_t(VFIT_CONTACT_LEFT | VFIT_CONTACT_RIGHT)) << f;
        for (const int lower : {VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG}) {
            EXPECT_NEAR(angle_of(motion.pose().rotation[size_t(lower)]) / testing::kDeg, 16.0f, 2.0f) << f;
            EXPECT_NEAR(posed.position[size_t(lower) + 1].y, skeleton.ankle_height, 1e-3f) << f;
        }
        EXPECT_LT(angle_of(glm::conjugate(spine_level) * posed.rotation[VFIT_BONE_SPINE]) / testing::kDeg,
                  1.2f)
            << f;
    }
}

TEST(Motion, KeepsTheSignOfEveryQuaternion) {
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion{MotionSettings{}};
    motion.bind(skeleton);
    std::array<Quat, kBoneCount> before{};
    for (int f = 0; f < 240; ++f) {
        Pose pose;
        pose.rotation[VFIT_BONE_HIPS] =
            glm::angleAxis(3 * static_cast<float>(f) * testing::kDeg, Vec3(0, 1, 0));  // two full turns
        pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] =
            glm::angleAxis(70 * testing::kDeg * std::sin(0.1f * static_cast<float>(f)), Vec3(0, 0, 1));
        testing::stand_on_floor(skeleton, pose);
        const Body body = testing::joints_of(skeleton, pose, frame_ns(f));
        motion.step(&body, body.time_ns);
        for (size_t b = 0; f > 0 && b < before.size(); ++b)
            ASSERT_GT(glm::dot(motion.pose().rotation[b], before[b]), 0.9f)
                << bone_name(int(b)) << " at " << f;
        before = motion.pose().rotation;
    }
}

TEST(Motion, StepDoesNotAllocate) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::SyntheticWalk walk(skeleton);
    for (const bool bound : {false, true}) {
        Motion motion{MotionSettings{}};
        if (bound) motion.bind(skeleton);
        const uint64_t before = test::allocations.load();
        for (int f = 0; f < 200; ++f) {
            const testing::WalkFrame frame = walk.at(f / 2);
            motion.step(f % 4 == 3 ? nullptr : &frame.body, frame_ns(f, 60));
        }
        EXPECT_EQ(test::allocations.load() - before, 0u);
    }
}

TEST(Motion, StepsFasterThanThePapersHalfMillisecond) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::SyntheticWalk walk(skeleton);
    std::vector<Body> bodies;
    for (int f = 0; f < 300; ++f) bodies.push_back(walk.at(f).body);
    Motion motion{MotionSettings{}};
    motion.bind(skeleton);
    const auto start = std::chrono::steady_clock::now();
    for (const Body& body : bodies) motion.step(&body, body.time_ns);
    const std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
    EXPECT_LT(spent.count() / 300, 520.0) << "microseconds a step with a new body";
}

TEST(Motion, LooksAheadByTheTimeThatHidesLatency) {
    const Skeleton skeleton = testing::test_skeleton();
    const auto hips_after = [&](float prediction_s) {
        MotionSettings settings;
        settings.flags = VFIT_MOTION_NO_FEET;
        settings.prediction_s = prediction_s;
        Motion motion(settings);
        motion.bind(skeleton);
        for (int f = 0; f < 90; ++f) {
            Pose pose;
            testing::stand_on_floor(skeleton, pose);
            pose.hips_position.x = 0.6f * static_cast<float>(f) / 30.0f;  // m/s
            const Body body = testing::joints_of(skeleton, pose, testing::frame_ns(f));
            motion.step(&body, body.time_ns);
        }
        return motion.pose().hips_position.x;
    };
    // A trend is damped: of a tenth of a second 63 hundredths are foretold.
    EXPECT_NEAR(hips_after(0.1f) - hips_after(0.0f), 0.6f * 0.0632f, 0.006f);
}

TEST(Motion, RefusesFiltersAndRulesThatAreNone) {
    const auto refused = [](auto&& change) {
        MotionSettings settings;
        change(settings);
        try {
            Motion motion(settings);
        } catch (const Error& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(refused([](auto& s) { s.filter.kind = 3; }).find("filter"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.contact_rule = -1; }).find("contact_rule"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.prediction_s = 0.3f; }).find("prediction_s"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.filter.one_euro.beta = -1.0f; }).find("beta"), std::string::npos);
    EXPECT_NE(refused([](auto& s) { s.filter.one_euro.min_cutoff_hz = 0.0f; }).find("min_cutoff_hz"),
              std::string::npos);
    EXPECT_NE(
        refused([](auto& s) { s.filter.one_euro.derivative_cutoff_hz = NAN; }).find("derivative_cutoff_hz"),
        std::string::npos);
}

TEST(Motion, ItsPosesAreWithinTheJointLimits) {
    // Random bodies that jump from pose to pose: what smoothing and planting make of them bends no joint too
    // far.
    const Skeleton skeleton = testing::test_skeleton();
    Motion motion{MotionSettings()};
    motion.bind(skeleton);
    testing::RandomPose random(11);
    const RestPose rest(skeleton);
    for (int f = 0; f < 600; ++f) {
        const Body body = testing::joints_of(skeleton, random.next(skeleton), testing::frame_ns(f));
        ASSERT_TRUE(motion.step(&body, body.time_ns));
        const bool planted[2] = {(motion.pose().contacts & VFIT_CONTACT_LEFT) != 0,
                                 (motion.pose().contacts & VFIT_CONTACT_RIGHT) != 0};
        BoneRotations limited = motion.pose().rotation;
        apply_joint_limits(rest, planted, limited);
        for (size_t b = 0; b < limited.size(); ++b)
            ASSERT_LT(angle_of(glm::conjugate(limited[b]) * motion.pose().rotation[b]), 2.0f * testing::kDeg)
                << f << " " << bone_name(int(b));
    }
}

}  // namespace
}  // namespace vfit
