// Maps to joints, sides that stay with the person, and joints that do not tremble.
#include "track/skeleton.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>

#include "crop_scene.h"
#include "track/joint_steady.h"
#include "track/tracker.h"

namespace vfit {
namespace {

using testing::camera_320, testing::view_at;

/// Heat in one cell, the depth map flat.
void peak(JointMaps& maps, int joint, int x, int y, float z) {
    const size_t first = size_t(joint) * JointMaps::kCells;
    maps.heat[first + size_t(y * JointMaps::kSide + x)] = 30.0f;
    std::fill_n(maps.depth.begin() + std::ptrdiff_t(first), JointMaps::kCells, z);
}

/// A person who stands: left joints on the image's right.
SeenJoints standing() {
    SeenJoints joints;
    for (int j = 0; j < kJointCount; ++j) {
        const float side = mirrored_joint(j) == j ? 0.0f : mirrored_joint(j) > j ? 0.2f : -0.2f;
        joints[size_t(j)] = {Vec3(side, 0.05f * float(j), 2.5f), 1.0f};
    }
    return joints;
}

SeenJoints exchanged(const SeenJoints& joints) {
    SeenJoints out = joints;
    for (int j = 0; j < kJointCount; ++j) out[size_t(j)] = joints[size_t(mirrored_joint(j))];
    return out;
}

TEST(ReadMaps, APeakIsTheJointAndAllItsHeatIsNear) {
    auto maps = std::make_unique<JointMaps>();
    for (int j = 0; j < kJointCount; ++j) peak(*maps, j, 20, 10, 0.1f);
    SeenJoints joints;
    const Camera camera = camera_320();
    const CropView view = view_at(2.5f);
    read_maps(*maps, view, camera, joints);
    const Vec3 crop = view.from_camera(camera, joints[VFIT_JOINT_HEAD].position);
    EXPECT_NEAR(crop.x, 20.5f / 16.0f - 1.0f, 1e-4f);
    EXPECT_NEAR(crop.y, 10.5f / 16.0f - 1.0f, 1e-4f);
    EXPECT_NEAR(joints[VFIT_JOINT_HEAD].position.z, 2.5f + 0.1f * 1.15f, 1e-4f);
    EXPECT_NEAR(joints[VFIT_JOINT_HEAD].confidence, 1.0f, 1e-5f);
}

TEST(ReadMaps, HeatInTwoPlacesIsNoConfidence) {
    auto maps = std::make_unique<JointMaps>();
    peak(*maps, VFIT_JOINT_LEFT_HAND, 4, 10, 0.0f);
    peak(*maps, VFIT_JOINT_LEFT_HAND, 28, 10, 0.0f);
    SeenJoints joints;
    read_maps(*maps, view_at(2.5f), camera_320(), joints);
    EXPECT_LT(joints[VFIT_JOINT_LEFT_HAND].confidence, 0.05f);
    EXPECT_LT(joints[VFIT_JOINT_HEAD].confidence, 0.1f);  // a map without any peak
}

TEST(ReadMaps, ACellThatIsNoNumberDoesNotCount) {
    auto maps = std::make_unique<JointMaps>();
    peak(*maps, VFIT_JOINT_HEAD, 20, 10, 0.0f);
    maps->heat[size_t(VFIT_JOINT_HEAD) * JointMaps::kCells + 77] = std::numeric_limits<float>::quiet_NaN();
    SeenJoints joints;
    const Camera camera = camera_320();
    const CropView view = view_at(2.5f);
    read_maps(*maps, view, camera, joints);
    EXPECT_NEAR(view.from_camera(camera, joints[VFIT_JOINT_HEAD].position).x, 20.5f / 16.0f - 1.0f, 1e-4f);
    EXPECT_NEAR(joints[VFIT_JOINT_HEAD].confidence, 1.0f, 1e-5f);
}

TEST(Facing, OneWrongAnswerDoesNotTurnAnybody) {
    Facing facing;
    for (int frame = 0; frame < 100; ++frame) {
        SeenJoints joints = standing();
        facing.apply(frame % 7 == 3 ? 3.0f : -2.0f, Vec3(0, -1, 0), joints);
        ASSERT_GT(joints[VFIT_JOINT_LEFT_HAND].position.x, 0.0f) << frame;
    }
}

TEST(Facing, FirmAnswersTurnThemInAThirdOfASecond) {
    Facing facing;
    SeenJoints joints;
    for (int i = 0; i < 30; ++i) joints = standing(), facing.apply(-3.0f, Vec3(0, -1, 0), joints);
    int frame = 0;
    do {
        joints = standing();
        facing.apply(3.0f, Vec3(0, -1, 0), joints);
    } while (joints[VFIT_JOINT_LEFT_HAND].position.x > 0.0f && ++frame < 100);
    EXPECT_GE(frame, 5);
    EXPECT_LE(frame, 10);
    EXPECT_TRUE(facing.away());
}

TEST(Facing, ToesSayWhereThePersonFaces) {
    for (const float ahead : {-1.0f, 1.0f}) {
        Facing facing;
        for (int i = 0; i < 3; ++i) {
            SeenJoints joints = standing();
            for (const int foot : {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT}) {
                const int toes = foot == VFIT_JOINT_LEFT_FOOT ? VFIT_JOINT_LEFT_TOES : VFIT_JOINT_RIGHT_TOES;
                joints[size_t(toes)].position = joints[size_t(foot)].position + Vec3(0, 0, -0.13f * ahead);
            }
            facing.apply(0.0f, Vec3(0, -1, 0), joints);
        }
        EXPECT_EQ(facing.away(), ahead < 0.0f) << ahead;
    }
}

// Toes then point back, as those of a person who stands and faces the other way.
TEST(Facing, WhoKneelsFacesAsTheKneesBend) {
    for (const float ahead : {-1.0f, 1.0f}) {
        Facing facing;
        for (int i = 0; i < 3; ++i) {
            SeenJoints joints = standing();
            const auto leg = [&](int hip, int knee, int foot, int toes) {
                const Vec3 at = joints[size_t(hip)].position;
                joints[size_t(knee)].position = at + Vec3(0, 0.45f, 0);
                joints[size_t(foot)].position = at + Vec3(0, 0.45f, 0.4f * ahead);
                joints[size_t(toes)].position = at + Vec3(0, 0.48f, 0.52f * ahead);
            };
            leg(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES);
            leg(VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES);
            facing.apply(0.0f, Vec3(0, -1, 0), joints);
        }
        EXPECT_EQ(facing.away(), ahead < 0.0f) << ahead;
    }
}

TEST(Facing, KneesThatBendSayItWhereNoToesAreSeen) {
    for (const float ahead : {-1.0f, 1.0f}) {
        Facing facing;
        for (int i = 0; i < 3; ++i) {
            SeenJoints joints = standing();
            for (const int side : {0, 1}) {
                const Vec3 hip = joints[size_t(VFIT_JOINT_LEFT_HIP + side)].position;
                joints[size_t(VFIT_JOINT_LEFT_KNEE + side)].position = hip + Vec3(0, 0.3f, -0.3f * ahead);
                joints[size_t(VFIT_JOINT_LEFT_FOOT + side)].position = hip + Vec3(0, 0.7f, 0.0f);
                joints[size_t(VFIT_JOINT_LEFT_TOES + side)].confidence = 0.0f;
            }
            facing.apply(0.0f, Vec3(0, -1, 0), joints);
        }
        EXPECT_EQ(facing.away(), ahead < 0.0f) << ahead;
    }
}

TEST(Facing, AfterACutTheNextAnswerCounts) {
    Facing facing;
    SeenJoints joints;
    for (int i = 0; i < 30; ++i) joints = standing(), facing.apply(-3.0f, Vec3(0, -1, 0), joints);
    joints = standing();
    for (SeenJoint& joint : joints) joint.position.z += 1.0f;
    facing.apply(1.0f, Vec3(0, -1, 0), joints);
    EXPECT_TRUE(facing.away());
}

/// The person of standing() as another camera sees them, in this one's camera space.
Body elsewhere(bool same_left, float logit) {
    Body out;
    const SeenJoints joints = same_left ? standing() : exchanged(standing());
    for (int j = 0; j < kJointCount; ++j) out.set(j, joints[size_t(j)].position + Vec3(0.1f, 0.0f, 0.1f));
    out.facing_logit = logit;
    return out;
}

TEST(Facing, OtherCamerasAreBelievedAsFarAsTheirFrameIsSure) {
    const auto away_after = [](float own_logit, const std::vector<Body>& others) {
        Facing facing;
        SeenJoints joints;
        for (int i = 0; i < 5; ++i)
            joints = standing(), facing.apply(own_logit, Vec3(0, -1, 0), joints, others);
        return facing.away();
    };
    EXPECT_TRUE(away_after(2.0f, {}));
    EXPECT_FALSE(away_after(2.0f, {elsewhere(true, 3.0f)}));
    EXPECT_TRUE(away_after(2.0f, {elsewhere(true, 1.0f)})) << "its frame is not sure";
    EXPECT_TRUE(away_after(-2.0f, {elsewhere(false, 3.0f)}));
    EXPECT_TRUE(away_after(2.0f, {elsewhere(true, -1.0f)})) << "its frame contradicts what it decided";
    EXPECT_FALSE(away_after(-2.0f, {elsewhere(true, 3.0f), elsewhere(true, 3.0f), elsewhere(false, 3.0f)}));
}

TEST(Facing, WhoStandsElsewhereSaysNothing) {
    Facing facing;
    Body other = elsewhere(false, 3.0f);
    for (Joint& joint : other.joints) joint.position += Vec3(0.6f, 0.0f, 0.0f);
    Body cut = elsewhere(false, 3.0f);
    cut.set(VFIT_JOINT_LEFT_HIP, Vec3(0.0f), VFIT_JOINT_NOT_SEEN);
    for (int i = 0; i < 5; ++i) {
        SeenJoints joints = standing();
        facing.apply(-0.5f, Vec3(0, -1, 0), joints, std::vector<Body>{other, cut});
    }
    EXPECT_FALSE(facing.away());
}

TEST(Facing, TwoThatAreWrongOfFourAreNoEcho) {
    // Each hears the others' frames: two are wrong and less sure, whatever was decided first.
    Facing cameras[4];
    const float says[] = {-3.0f, 2.0f, 2.0f, -2.5f};
    std::vector<Body> bodies(4);
    for (int frame = 0; frame < 20; ++frame)
        for (size_t k = 0; k < 4; ++k) {
            std::vector<Body> others;
            for (size_t other = 0; other < 4; ++other)
                if (other != k && frame > 3) others.push_back(bodies[other]);
            SeenJoints joints = standing();
            cameras[k].apply(says[k], Vec3(0, -1, 0), joints, others);
            bodies[k] = elsewhere(!cameras[k].away(), cameras[k].agreement());
        }
    for (const Facing& camera : cameras) EXPECT_FALSE(camera.away());
    EXPECT_LT(cameras[1].agreement(), 0.0f) << "its own frames say otherwise";
}

TEST(Facing, AnAnswerThatIsNoNumberDoesNotCount) {
    Facing facing;
    SeenJoints joints = standing();
    facing.apply(2.0f, Vec3(0, -1, 0), joints);
    joints = standing(), facing.apply(std::numeric_limits<float>::quiet_NaN(), Vec3(0, -1, 0), joints);
    EXPECT_TRUE(facing.away());
}

TEST(Facing, WhoTurnsPastTheSideViewKeepsTheirLeft) {
    Facing facing;
    SeenJoints joints = standing();
    facing.apply(-3.0f, Vec3(0, -1, 0), joints);
    // At the side view the same limbs take the labels of the other side.
    joints = exchanged(standing());
    facing.apply(0.0f, Vec3(0, -1, 0), joints);
    EXPECT_TRUE(facing.away());
    EXPECT_GT(joints[VFIT_JOINT_LEFT_HAND].position.x, 0.0f);
}

TEST(JointSteady, TremblingShrinksAndAMovingJointIsFollowed) {
    JointSteady steady;
    std::mt19937 random(1);
    float before = 0.0f, after = 0.0f, lag = 0.0f;
    for (int frame = 0; frame < 200; ++frame) {
        SeenJoints joints = standing();
        const float noise = 0.01f * (float(random()) / float(std::mt19937::max()) - 0.5f);
        joints[VFIT_JOINT_HEAD].position.x += noise;
        const float place = float(frame) / 30.0f;  // 1 m/s
        joints[VFIT_JOINT_LEFT_HAND].position.x = place;
        steady.run(int64_t(frame) * 33'333'333, joints);
        if (frame < 20) continue;
        before += noise * noise;
        after += joints[VFIT_JOINT_HEAD].position.x * joints[VFIT_JOINT_HEAD].position.x;
        lag = std::max(lag, place - joints[VFIT_JOINT_LEFT_HAND].position.x);
    }
    EXPECT_LT(after, 0.5f * before);
    EXPECT_LT(lag, 0.025f);
}

TEST(JointSteady, AJointThatNobodyIsSureOfHardlyMoves) {
    JointSteady steady;
    SeenJoints joints = standing();
    steady.run(0, joints);
    joints = standing();
    joints[VFIT_JOINT_LEFT_HAND].position.x += 1.0f;
    joints[VFIT_JOINT_LEFT_HAND].confidence = 0.02f;
    steady.run(33'333'333, joints);
    EXPECT_LT(joints[VFIT_JOINT_LEFT_HAND].position.x, 0.2f + 0.15f);
}

TEST(FindTargets, GivesEachPersonTheirBoxTheLargestFirst) {
    std::vector<uint16_t> depth(320 * 240, 2000);
    std::vector<uint8_t> users(320 * 240, 0);
    for (int y = 50; y < 60; ++y)
        for (int x = 10; x < 30; ++x) users[size_t(y * 320 + x)] = 3;
    for (int y = 100; y < 130; ++y)
        for (int x = 200; x < 240; ++x) users[size_t(y * 320 + x)] = 7;
    users[0] = 9;  // too few
    std::vector<TrackTarget> targets;
    find_targets({depth.data(), users.data(), camera_320()}, 8, targets);
    ASSERT_EQ(targets.size(), 2u);
    EXPECT_EQ(targets[0].id, 7u);
    EXPECT_EQ(targets[1].id, 3u);
    EXPECT_EQ(targets[1].box.x0, 10);
    EXPECT_EQ(targets[1].box.y1, 60);
    find_targets({depth.data(), users.data(), camera_320()}, 1, targets);
    EXPECT_EQ(targets.size(), 1u);
}

}  // namespace
}  // namespace vfit
