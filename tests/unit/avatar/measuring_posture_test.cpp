// The posture of the tape measures: upright, feet at the distance asked for, arms clear of the trunk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "body_fixture.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

TEST(MeasuringPosture, StandsOnTheFloorWithTheFeetAsFarApartAsAsked) {
    const Avatar avatar = make_avatar();
    for (const float apart : {0.15f, 0.25f, 0.35f}) {
        Body joints;
        MeasuringPosture posture;
        posture.feet_apart_m = apart;
        const Mesh mesh = avatar.measuring_mesh(posture, &joints);
        EXPECT_EQ(mesh.positions.size(), avatar.topology().vertex_count);
        EXPECT_NEAR(joints.at(VFIT_JOINT_LEFT_FOOT).x - joints.at(VFIT_JOINT_RIGHT_FOOT).x, apart, 1e-4f);
        EXPECT_NEAR(joints.at(VFIT_JOINT_LEFT_FOOT).y, joints.at(VFIT_JOINT_RIGHT_FOOT).y, 0.002f);
        float low = 1.0f;
        for (const Vec3& p : mesh.positions) low = std::min(low, p.y);
        EXPECT_EQ(low, 0.0f);
    }
}

TEST(MeasuringPosture, FeetTogetherTouchWithoutCrossing) {
    const Avatar avatar = make_avatar();
    const Mesh mesh = avatar.measuring_mesh(kStaturePosture);
    float left = 1.0f, right = -1.0f;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        if (avatar.parts()[v] == BodyPart::kLeftFoot) left = std::min(left, mesh.positions[v].x);
        if (avatar.parts()[v] == BodyPart::kRightFoot) right = std::max(right, mesh.positions[v].x);
    }
    EXPECT_GT(left - right, -0.004f);
    EXPECT_LT(left - right, 0.01f);
}

TEST(MeasuringPosture, UpperArmsHangAtTheAngleAskedFor) {
    const Avatar avatar = make_avatar();
    for (const MeasuringPosture& posture : {MeasuringPosture{}, kBideltoidPosture}) {
        Body joints;
        avatar.measuring_mesh(posture, &joints);
        for (const auto& [shoulder, elbow] : {std::pair(VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW),
                                              std::pair(VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW)}) {
            const Vec3 arm = glm::normalize(joints.at(elbow) - joints.at(shoulder));
            EXPECT_NEAR(std::acos(-arm.y), posture.arm_angle_rad, 1e-3f);
        }
    }
}

TEST(MeasuringPosture, ForearmsAndHandsStayClearOfLightAndHeavyBodies) {
    const auto model = body_model();
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE})
        for (const float weight : {0.0f, 0.5f, 1.0f}) {
            std::vector<float> shape = model->default_shape(sex);
            shape[static_cast<size_t>(model->parameter("weight"))] = weight;
            const Avatar avatar(model, {}, shape, Vec2(1.0f));
            const Mesh mesh = avatar.measuring_mesh();
            const auto of_arm = [&](uint32_t v) {
                return avatar.parts()[v] >= BodyPart::kLeftUpperArm &&
                       avatar.parts()[v] <= BodyPart::kRightHand;
            };
            std::vector<uint32_t> trunk;  // and legs
            for (size_t t = 0; t < mesh.indices.size(); t += 3) {
                if (of_arm(mesh.indices[t]) || of_arm(mesh.indices[t + 1]) || of_arm(mesh.indices[t + 2]))
                    continue;
                trunk.insert(trunk.end(), mesh.indices.begin() + std::ptrdiff_t(t),
                             mesh.indices.begin() + std::ptrdiff_t(t) + 3);
            }
            const MeshQuery query(mesh.positions, trunk);
            float clearance = 1.0f;
            for (uint32_t v = 0; v < mesh.positions.size(); ++v)
                if (of_arm(v) && avatar.parts()[v] != BodyPart::kLeftUpperArm &&
                    avatar.parts()[v] != BodyPart::kRightUpperArm)
                    clearance = std::min(clearance, query.signed_distance(mesh.positions[v]));
            EXPECT_GT(clearance, 0.01f) << "sex " << sex << ", weight " << weight;
        }
}

TEST(MeasuringPosture, StatureIsTheHeightWithTheFeetTogether) {
    const Avatar avatar = make_avatar();
    float top = 0.0f;
    for (const Vec3& p : avatar.measuring_mesh(kStaturePosture).positions) top = std::max(top, p.y);
    EXPECT_EQ(avatar.stature(), top);
    float apart = 0.0f;
    for (const Vec3& p : avatar.measuring_mesh({0.26f, 0.6f}).positions) apart = std::max(apart, p.y);
    EXPECT_LT(apart, top - 0.005f);
}

TEST(MeasuringPosture, MeasuringLeavesThePosedAvatarAlone) {
    const Avatar avatar = make_avatar();
    const std::vector<Vec3> before = avatar.positions();
    avatar.measuring_mesh();
    EXPECT_EQ(avatar.positions(), before);
}

TEST(MeasuringPosture, AngleOrDistanceThatNoBodyTakesIsRefused) {
    const Avatar avatar = make_avatar();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const MeasuringPosture& bad :
         {MeasuringPosture{-0.1f, 0.2f}, MeasuringPosture{2.0f, 0.2f}, MeasuringPosture{nan, 0.2f},
          MeasuringPosture{0.2f, -0.1f}, MeasuringPosture{0.2f, nan}}) {
        try {
            avatar.measuring_mesh(bad);
            ADD_FAILURE() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_ARGUMENT);
        }
    }
}

}  // namespace
}  // namespace vfit
