// Arms that a tracker, or the pose of another person, puts into the trunk, the thighs or each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "body_fixture.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

const std::vector<BodyPart> kMiddle = {BodyPart::kTorso, BodyPart::kLeftThigh, BodyPart::kRightThigh};

/// How close the skin of one set of parts comes to that of another; negative: inside.
float gap_between(const Avatar& avatar, const std::vector<BodyPart>& of, const std::vector<BodyPart>& to) {
    std::vector<uint32_t> triangles;
    for (const BodyPart part : to) {
        const auto some = triangles_of(avatar.topology(), part);
        triangles.insert(triangles.end(), some.begin(), some.end());
    }
    const MeshQuery query(avatar.positions(), triangles);
    float least = INFINITY;
    for (size_t v = 0; v < avatar.topology().vertex_count; ++v) {
        if (std::find(of.begin(), of.end(), avatar.topology().parts[v]) == of.end()) continue;
        const auto nearest = query.closest(avatar.positions()[v]);
        // The parts are open at their ends: further away than a limb is thick, the side says nothing.
        constexpr float kLimb_m = 0.08f;
        const bool inside = nearest.distance < kLimb_m &&
                            glm::dot(avatar.positions()[v] - nearest.point, nearest.normal) < 0.0f;
        least = std::min(least, inside ? -nearest.distance : nearest.distance);
    }
    return least;
}

/// How deep any vertex of the hands is inside trunk and thighs.
float hand_depth(const Avatar& avatar) {
    return std::max(0.0f, -gap_between(avatar, {BodyPart::kLeftHand, BodyPart::kRightHand}, kMiddle));
}

/// Arms hanging, turned across the body by across_deg.
Pose hanging(const Avatar& avatar, float across_deg, float forward_deg = 0.0f, float lean_deg = 0.0f) {
    constexpr float kDeg = kPi / 180.0f;
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_SPINE] = glm::angleAxis(lean_deg * kDeg, Vec3(0, 0, 1));
    for (const float side : {1.0f, -1.0f}) {
        const auto arm = size_t(side > 0 ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM);
        pose.rotation[arm] = glm::angleAxis(-forward_deg * kDeg, Vec3(1, 0, 0)) *
                             glm::angleAxis(-side * (90.0f + across_deg) * kDeg, Vec3(0, 0, 1));
    }
    return pose;
}

TEST(LimbsClear, AreLedOutOfTheBody) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear), free_hands = make_avatar();
    const auto jobs = Jobs::own(0);
    for (const float across : {5.0f, 12.0f, 20.0f})
        for (const float forward : {0.0f, 15.0f})
            for (const float lean : {0.0f, 15.0f}) {
                const Pose pose = hanging(kept, across, forward, lean);
                free_hands.pose(pose, *jobs);
                kept.pose(pose, *jobs);
                const float before = hand_depth(free_hands), after = hand_depth(kept);
                // Fingers and thumb stand off the line that is led out: of a hand deep inside, a quarter may
                // touch.
                EXPECT_LT(after, std::max(0.012f, 0.25f * before))
                    << across << " " << forward << " " << lean << ": " << before << " m before";
                EXPECT_TRUE(before > 0.02f || across < 10.0f || forward > 0.0f);
                // The arm follows, and the hand keeps its own turn in world space.
                const PosedSkeleton posed = forward_kinematics(kept.skeleton(), kept.shown_pose());
                const PosedSkeleton was = forward_kinematics(kept.skeleton(), pose);
                EXPECT_GT(std::abs(glm::dot(posed.rotation[VFIT_BONE_LEFT_HAND],
                                            was.rotation[VFIT_BONE_LEFT_HAND])),
                          0.9999f);
            }
}

TEST(LimbsClear, ThatAreClearStayToTheBit) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear);
    for (const float across : {-90.0f, -40.0f}) {
        const Pose pose = hanging(kept, across);
        kept.move(pose);
        for (size_t b = 0; b < size_t(kBoneCount); ++b)
            EXPECT_EQ(kept.shown_pose().rotation[b], pose.rotation[b]) << bone_name(int(b));
    }
}

TEST(LimbsClear, MoveWithoutAJumpWhereTheyTouch) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear);
    Vec3 before(0.0f);
    float largest = 0.0f;
    for (int step = 0; step <= 400; ++step) {
        kept.move(hanging(kept, -20.0f + 0.1f * float(step)));
        const Vec3 hand = kept.joints().at(VFIT_JOINT_LEFT_HAND);
        if (step > 0) largest = std::max(largest, glm::distance(hand, before));
        before = hand;
    }
    EXPECT_LT(largest, 0.01f);  // a tenth of a degree moves a free hand by 1 mm, and the skin has edges
}

TEST(LimbsClear, ForearmsStayOutOfTheTrunkWithRoomForCloth) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear), as_posed = make_avatar();
    const auto jobs = Jobs::own(0);
    const std::vector<BodyPart> forearms = {BodyPart::kLeftForearm, BodyPart::kRightForearm};
    for (const float across : {0.0f, 8.0f, 15.0f}) {
        const Pose pose = hanging(kept, across);
        kept.pose(pose, *jobs);
        as_posed.pose(pose, *jobs);
        EXPECT_GT(gap_between(kept, forearms, kMiddle), 0.008f)
            << across << " degrees across, as posed " << gap_between(as_posed, forearms, kMiddle) << " m";
    }
}

TEST(LimbsClear, CrossedForearmsStayOutOfEachOther) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear), as_posed = make_avatar();
    const auto jobs = Jobs::own(0);
    // Upper arms forward and down, forearms across the chest, at one height: they meet.
    Pose pose;
    pose.hips_position = kept.skeleton().offset[VFIT_BONE_HIPS];
    for (const float side : {1.0f, -1.0f}) {
        const bool left = side > 0.0f;
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM] =
            glm::angleAxis(-0.9f, Vec3(1, 0, 0)) * glm::angleAxis(-side * 1.3f, Vec3(0, 0, 1)) *
            glm::angleAxis(1.4f, Vec3(1, 0, 0));
        pose.rotation[left ? VFIT_BONE_LEFT_LOWER_ARM : VFIT_BONE_RIGHT_LOWER_ARM] =
            glm::angleAxis(-side * 1.7f, Vec3(0, 1, 0));
    }
    kept.pose(pose, *jobs);
    as_posed.pose(pose, *jobs);
    const float before = gap_between(as_posed, {BodyPart::kLeftForearm}, {BodyPart::kRightForearm}),
                after = gap_between(kept, {BodyPart::kLeftForearm}, {BodyPart::kRightForearm});
    EXPECT_LT(before, 0.0f);
    EXPECT_GT(after, 0.005f);
}

TEST(LimbsClear, ArmsThatHangFreelyAreLeftAlone) {
    AvatarDesc clear;
    clear.limbs_clear = true;
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        clear.sex = sex;
        Avatar kept = make_avatar(clear);
        const Pose pose = hanging(kept, -20.0f);
        kept.move(pose);
        for (size_t b = 0; b < size_t(kBoneCount); ++b)
            EXPECT_EQ(kept.shown_pose().rotation[b], pose.rotation[b]) << bone_name(int(b));
    }
}

/// Forearms across the chest, one of them further in front than the other.
Pose crossed(const Avatar& avatar, float left_further, int64_t time_ns) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.time_ns = time_ns;
    for (const float side : {1.0f, -1.0f}) {
        const bool left = side > 0.0f;
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM] =
            glm::angleAxis(-0.9f - side * left_further, Vec3(1, 0, 0)) *
            glm::angleAxis(-side * 1.3f, Vec3(0, 0, 1)) * glm::angleAxis(1.4f, Vec3(1, 0, 0));
        pose.rotation[left ? VFIT_BONE_LEFT_LOWER_ARM : VFIT_BONE_RIGHT_LOWER_ARM] =
            glm::angleAxis(-side * 1.7f, Vec3(0, 1, 0));
    }
    return pose;
}

/// Way from the right forearm to the left one where they are closest.
Vec3 way_between_forearms(const Avatar& avatar) {
    const Body joints = avatar.joints();
    const auto on = [&](int elbow, int hand, float share) {
        return glm::mix(joints.at(elbow), joints.at(hand), share);
    };
    Vec3 shortest(1.0f);
    for (int i = 0; i <= 40; ++i)
        for (int k = 0; k <= 40; ++k) {
            const Vec3 way = on(VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND, float(i) / 40.0f) -
                             on(VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_HAND, float(k) / 40.0f);
            if (glm::length(way) < glm::length(shortest)) shortest = way;
        }
    return shortest;
}

TEST(LimbsClear, AnArmDoesNotPassThroughTheOther) {
    constexpr int64_t kFrame_ns = 33'333'333;
    AvatarDesc clear;
    clear.limbs_clear = true;
    Avatar kept = make_avatar(clear), fresh = make_avatar(clear);
    int64_t time_ns = 0;
    const auto pose = [&](float left_further) {
        time_ns += kFrame_ns;
        kept.move(crossed(kept, left_further, time_ns));
        return way_between_forearms(kept);
    };
    const Vec3 before = pose(0.1f);
    Vec3 last = before;
    for (int frame = 0; frame < 30; ++frame) {
        const Vec3 now = pose(-0.1f);
        ASSERT_GT(glm::dot(now, last), 0.0f) << frame;
        ASSERT_GT(glm::length(now), 0.06f) << frame;
        last = now;
    }
    // Without a path there is no side to keep.
    fresh.move(crossed(fresh, -0.1f, 0));
    EXPECT_LT(glm::dot(way_between_forearms(fresh), before), 0.0f);
    time_ns += 1'000'000'000;
    EXPECT_LT(glm::dot(pose(-0.1f), before), 0.0f);
    for (const int64_t odd_ns : {INT64_MAX, INT64_MIN, int64_t(0)}) kept.move(crossed(kept, -0.1f, odd_ns));
    kept.move(crossed(kept, -0.1f, time_ns));
    // The same pose again changes nothing.
    const Vec3 once = way_between_forearms(kept);
    kept.move(crossed(kept, -0.1f, time_ns));
    EXPECT_EQ(way_between_forearms(kept), once);
}

}  // namespace
}  // namespace vfit
