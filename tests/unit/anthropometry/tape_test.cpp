// Tape measures of a body put together from solids, whose measures are known in closed form.
#include "anthropometry/tape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "geometry/section.h"
#include "unit/anthropometry/implicit_mesh.h"
#include "unit/geometry/mesh_shapes.h"

namespace vfit {
namespace {

using namespace test;

// Metres. Trunk, hip and head are ellipses and ellipsoids, the limbs round.
constexpr float kTrunkA = 0.15f, kTrunkB = 0.10f, kCrotch = 0.80f, kTrunkTop = 1.40f;
constexpr float kHipA = 0.18f, kHipB = 0.13f, kThigh = 0.07f, kArm = 0.045f, kNeck = 0.055f;
const Vec3 kHead(0, 1.65f, 0.02f), kHeadRadii(0.075f, 0.115f, 0.09f);
const Vec3 kShoulder(0.19f, 1.36f, 0), kElbow(0.30f, 1.08f, 0), kWrist(0.38f, 0.876364f, 0);
const Vec3 kBust(0.06f, 1.20f, 0.09f);
constexpr float kBustRadius = 0.05f, kHand = 0.10f;

float cylinder_field(const Vec3& p, float a, float b, float low, float high) {
    return std::max((glm::length(Vec2(p.x / a, p.z / b)) - 1.0f) * std::min(a, b),
                    std::max(low - p.y, p.y - high));
}
float ellipsoid_field(const Vec3& p, const Vec3& radii) {
    return (glm::length(p / radii) - 1.0f) * std::min(radii.x, std::min(radii.y, radii.z));
}
float capsule_field(const Vec3& p, const Vec3& a, const Vec3& b, float radius) {
    const float t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
    return glm::distance(p, glm::mix(a, b, t)) - radius;
}

struct Person {
    Mesh mesh;
    std::vector<BodyPart> parts;
    TapeBody body;

    explicit Person(vfit_sex sex) {
        const Vec3 hand = kWrist + kHand * glm::normalize(kWrist - kElbow);
        const auto head = [](const Vec3& p) { return ellipsoid_field(p - kHead, kHeadRadii); };
        const auto trunk = [sex](const Vec3& p) {
            const Vec3 q(std::abs(p.x), p.y, p.z);
            float d = std::min(cylinder_field(q, kTrunkA, kTrunkB, kCrotch, kTrunkTop),
                               cylinder_field(q, kNeck, kNeck, kTrunkTop - 0.02f, kHead.y));
            d = std::min(
                d, std::max(ellipsoid_field(q - Vec3(0, 0.92f, 0), Vec3(kHipA, 0.1f, kHipB)), kCrotch - q.y));
            return sex == VFIT_SEX_FEMALE ? std::min(d, glm::distance(q, kBust) - kBustRadius) : d;
        };
        const auto leg = [](const Vec3& p) {
            return cylinder_field(Vec3(std::abs(p.x) - 0.1f, p.y, p.z), kThigh, kThigh, 0.0f,
                                  kCrotch + 0.05f);
        };
        const auto upper_arm = [](const Vec3& p) {
            return capsule_field({std::abs(p.x), p.y, p.z}, kShoulder, kElbow, kArm);
        };
        const auto lower_arm = [hand](const Vec3& p) {
            return capsule_field({std::abs(p.x), p.y, p.z}, kElbow, hand, 0.03f);
        };
        mesh = implicit_mesh(
            Vec3(-0.52f, -0.033f, -0.18f), Vec3(0.52f, 1.8f, 0.18f), 0.0117f,
            [&](const Vec3& p) { return std::min({head(p), trunk(p), leg(p), upper_arm(p), lower_arm(p)}); });
        for (const Vec3& p : mesh.positions) {
            const bool left = p.x > 0.0f;
            BodyPart part = BodyPart::kTorso;
            if (std::abs(head(p)) < 1e-4f && p.y > kTrunkTop) part = BodyPart::kHead;
            if (std::abs(leg(p)) < 1e-4f) part = left ? BodyPart::kLeftThigh : BodyPart::kRightThigh;
            if (std::abs(upper_arm(p)) < 1e-4f)
                part = left ? BodyPart::kLeftUpperArm : BodyPart::kRightUpperArm;
            if (std::abs(lower_arm(p)) < 1e-4f)
                part = p.y < kWrist.y ? (left ? BodyPart::kLeftHand : BodyPart::kRightHand)
                                      : (left ? BodyPart::kLeftForearm : BodyPart::kRightForearm);
            parts.push_back(part);
        }
        body = {mesh.positions, mesh.indices, parts, {}, sex};
        Body& j = body.joints;
        j.set(VFIT_JOINT_HEAD, {0, 1.65f, 0});
        j.set(VFIT_JOINT_NECK, {0, 1.42f, 0});
        j.set(VFIT_JOINT_TORSO, {0, 1.1f, 0});
        j.set(VFIT_JOINT_PELVIS, {0, 0.9f, 0});
        const auto pair = [&](int left_joint, const Vec3& p) {
            j.set(left_joint, p);
            j.set(mirrored_joint(left_joint), {-p.x, p.y, p.z});
        };
        pair(VFIT_JOINT_LEFT_CLAVICLE, {0.02f, 1.40f, 0});
        pair(VFIT_JOINT_LEFT_SHOULDER, kShoulder);
        pair(VFIT_JOINT_LEFT_ELBOW, kElbow);
        pair(VFIT_JOINT_LEFT_WRIST, kWrist);
        pair(VFIT_JOINT_LEFT_HIP, {0.1f, 0.88f, 0});
        pair(VFIT_JOINT_LEFT_KNEE, {0.1f, 0.45f, 0});
    }
    TapePostures postures() const { return {body, body, body}; }
};

const Person& man() {
    static const Person person(VFIT_SEX_MALE);
    return person;
}
const Person& woman() {
    static const Person person(VFIT_SEX_FEMALE);
    return person;
}

float value(const std::vector<Measurement>& list, const char* key) {
    const Measurement* m = find(list, key);
    EXPECT_NE(m, nullptr) << key;
    return m ? m->value : 0.0f;
}

vfit_result error_of(const TapeBody& body) {
    try {
        tape_measures({body, body, body});
    } catch (const Error& error) {
        return error.code();
    }
    return VFIT_OK;
}

TEST(Tape, GirthsAreThoseOfTheSolids) {
    const auto m = tape_measures(man().postures());
    EXPECT_NEAR(value(m, "chest_girth_m"), ellipse_perimeter(kTrunkA, kTrunkB), 2e-3f);
    EXPECT_NEAR(value(m, "waist_girth_m"), ellipse_perimeter(kTrunkA, kTrunkB), 2e-3f);
    EXPECT_NEAR(value(m, "hip_girth_m"), ellipse_perimeter(kHipA, kHipB), 2e-3f);
    EXPECT_NEAR(value(m, "neck_girth_m"), 2.0f * kPi * kNeck, 2e-3f);
    EXPECT_NEAR(value(m, "thigh_girth_m"), 2.0f * kPi * kThigh, 2e-3f);
    EXPECT_NEAR(value(m, "upper_arm_girth_m"), 2.0f * kPi * kArm, 2e-3f);
}

TEST(Tape, BreadthsAndDepthsAreTheExtentsOfTheirSections) {
    const auto m = tape_measures(man().postures());
    EXPECT_NEAR(value(m, "chest_breadth_m"), 2.0f * kTrunkA, 1e-3f);
    EXPECT_NEAR(value(m, "chest_depth_m"), 2.0f * kTrunkB, 1e-3f);
    EXPECT_NEAR(value(m, "waist_breadth_m"), 2.0f * kTrunkA, 1e-3f);
    EXPECT_NEAR(value(m, "waist_depth_m"), 2.0f * kTrunkB, 1e-3f);
    EXPECT_NEAR(value(m, "hip_breadth_m"), 2.0f * kHipA, 1e-3f);
    EXPECT_NEAR(value(m, "hip_depth_m"), 2.0f * kHipB, 1e-3f);
}

TEST(Tape, LengthsRunBetweenTheLandmarks) {
    const auto m = tape_measures(man().postures());
    EXPECT_NEAR(value(m, "stature_m"), kHead.y + kHeadRadii.y, 1e-3f);
    EXPECT_NEAR(value(m, "inside_leg_m"), kCrotch, 6e-3f);  // the mesh rounds the edge by half a step
    EXPECT_NEAR(value(m, "hip_height_m"), 0.88f, 2e-3f);
    EXPECT_NEAR(value(m, "torso_height_m"), 0.52f, 1e-5f);
    // The line from the shoulder's centre through the acromion leaves the cap of radius kArm.
    const Vec3 acromion = kShoulder + kArm * glm::normalize(Vec3(12, 33, 0));
    EXPECT_NEAR(value(m, "biacromial_breadth_m"), 2.0f * acromion.x, 1e-3f);
    const float forearm = glm::distance(kElbow, kWrist);
    EXPECT_NEAR(value(m, "arm_length_m"), glm::distance(acromion, kElbow) + forearm, 1e-3f);
    EXPECT_NEAR(value(m, "hand_length_m"), kHand + 0.03f, 1e-3f);
    EXPECT_NEAR(value(m, "elbow_fingertip_m"), forearm + kHand + 0.03f, 1e-3f);
    // Over the middle of the upper arms, whose outside leans.
    const float lean = std::cos(std::atan2(kElbow.x - kShoulder.x, kShoulder.y - kElbow.y));
    EXPECT_NEAR(value(m, "shoulder_breadth_m"), 2.0f * (0.5f * (kShoulder.x + kElbow.x) + kArm / lean),
                0.01f);
}

TEST(Tape, HeadIsMeasuredFromTheChinAndAboveTheEars) {
    const auto m = tape_measures(man().postures());
    const auto radius_at = [](float share) { return std::sqrt(1.0f - share * share); };
    const float front = 0.5f * (kNeck + kHead.z + kHeadRadii.z);  // halfway from throat to nose
    const float chin = kHead.y - kHeadRadii.y * radius_at((front - kHead.z) / kHeadRadii.z);
    const float crown = kHead.y + kHeadRadii.y;
    EXPECT_NEAR(value(m, "head_height_m"), crown - chin, 6e-3f);
    const float ears = crown - 0.4f * (crown - chin);
    EXPECT_NEAR(value(m, "head_width_m"), 2.0f * kHeadRadii.x * radius_at((ears - kHead.y) / kHeadRadii.y),
                3e-3f);
}

TEST(Tape, WomensChestIsTakenOverTheBustPointsAndBelowThem) {
    const auto m = tape_measures(woman().postures());
    std::vector<Vec2> outline;
    for (int i = 0; i < 3600; ++i) {
        const float a = 2.0f * kPi * float(i) / 3600.0f, c = std::cos(a), s = std::sin(a);
        outline.push_back({kTrunkA * c, kTrunkB * s});
        outline.push_back({kBust.x + kBustRadius * c, kBust.z + kBustRadius * s});
        outline.push_back({-kBust.x + kBustRadius * c, kBust.z + kBustRadius * s});
    }
    EXPECT_NEAR(value(m, "chest_girth_m"), hull_perimeter(outline), 3e-3f);
    EXPECT_NEAR(value(m, "chest_depth_m"), kTrunkB + kBust.z + kBustRadius, 1e-3f);
    // At the fold the breast has gone: within a step of the mesh the tape lies on the trunk again.
    EXPECT_NEAR(value(m, "underbust_girth_m"), ellipse_perimeter(kTrunkA, kTrunkB), 0.012f);
    const auto of_man = tape_measures(man().postures());
    EXPECT_EQ(find(of_man, "underbust_girth_m"), nullptr);
}

TEST(Tape, AnswersInTheOrderOfTheKeysAndKnowsAllLengths) {
    const auto m = tape_measures(woman().postures());
    size_t next = 0;
    for (const MeasureKey& key : measure_keys()) {
        if (is_mass(key.key)) continue;
        ASSERT_LT(next, m.size());
        EXPECT_EQ(m[next++].key, key.key);
    }
    EXPECT_EQ(next, m.size());
}

TEST(Tape, DoesNotCareWhereTheBodyStands) {
    Person moved(VFIT_SEX_MALE);
    const Vec3 shift(1.5f, 0.25f, -2.0f);
    for (Vec3& p : moved.mesh.positions) p += shift;
    for (Joint& joint : moved.body.joints.joints) joint.position += shift;
    const auto here = tape_measures(man().postures()), there = tape_measures(moved.postures());
    ASSERT_EQ(here.size(), there.size());
    for (size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i].value, there[i].value, 1e-3f) << here[i].key;
}

TEST(Tape, EndsWhereFloatsLieFarApart) {
    for (const float far : {1e4f, 1e6f, 1e30f}) {
        Person moved(VFIT_SEX_MALE);
        for (Vec3& p : moved.mesh.positions) p.y += far;
        for (Joint& joint : moved.body.joints.joints) joint.position.y += far;
        const vfit_result result = error_of(moved.body);
        EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_DATA) << result;
    }
}

TEST(Tape, RefusesWhatIsNoMeasurableBody) {
    TapeBody body = man().body;
    body.indices = {};
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    body = man().body;
    body.parts = body.parts.first(10);
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    body = man().body;
    body.joints.joints[VFIT_JOINT_LEFT_KNEE].state = VFIT_JOINT_NOT_SEEN;
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    body = man().body;
    body.joints.set(VFIT_JOINT_LEFT_ELBOW, {0.5f, kShoulder.y, 0});  // arms straight out
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    body = man().body;
    body.joints.set(VFIT_JOINT_LEFT_HIP, {0.1f, 0.7f, 0});  // below the crotch: legs never one
    body.joints.set(VFIT_JOINT_RIGHT_HIP, {-0.1f, 0.7f, 0});
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    for (const int joint : {VFIT_JOINT_HEAD, VFIT_JOINT_PELVIS}) {
        body = man().body;
        body.joints.set(joint, body.joints.at(VFIT_JOINT_NECK));
        EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
    }
    const std::vector<uint32_t> wrong = {0, 1, 99999999};
    body = man().body;
    body.indices = wrong;
    EXPECT_EQ(error_of(body), VFIT_ERROR_DATA);
}

}  // namespace
}  // namespace vfit
