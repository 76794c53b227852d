// Arms that are crossed before the chest, by an exact test of triangles.
#include <gtest/gtest.h>

#include <random>

#include "cloth/crossings.h"
#include "people.h"

namespace vfit {
namespace {

using namespace test;

std::vector<uint32_t> triangles_of(const Avatar& avatar, std::initializer_list<BodyPart> parts) {
    const std::vector<BodyPart>& part_of = avatar.topology().parts;
    const auto is_of = [&](uint32_t v) {
        return std::find(parts.begin(), parts.end(), part_of[v]) != parts.end();
    };
    std::vector<uint32_t> out;
    const auto& indices = avatar.topology().indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        if (is_of(indices[i]) && is_of(indices[i + 1]) && is_of(indices[i + 2]))
            out.insert(out.end(), &indices[i], &indices[i] + 3);
    return out;
}

/// Forearms across the chest, the left one further in front, bent and twisted at the elbows.
Pose crossed(const Avatar& avatar, float further, float bend, float twist) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    for (const float side : {1.0f, -1.0f}) {
        const bool left = side > 0.0f;
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM] =
            glm::angleAxis(-0.9f - side * further, Vec3(1, 0, 0)) *
            glm::angleAxis(-side * 1.3f, Vec3(0, 0, 1)) * glm::angleAxis(1.4f, Vec3(1, 0, 0));
        pose.rotation[left ? VFIT_BONE_LEFT_LOWER_ARM : VFIT_BONE_RIGHT_LOWER_ARM] =
            glm::angleAxis(-side * bend, Vec3(0, 1, 0)) * glm::angleAxis(twist, Vec3(1, 0, 0));
    }
    return pose;
}

class CrossedArms : public testing::TestWithParam<vfit_sex> {
protected:
    static AvatarDesc desc() {
        AvatarDesc out{GetParam()};
        out.limbs_clear = true;
        return out;
    }
    size_t crossings(float further, float bend, float twist) {
        avatar.pose(crossed(avatar, further, bend, twist), *jobs);
        return crossed_triangles({avatar.positions(), left}, {avatar.positions(), right}).size();
    }
    Avatar avatar{body_model(), desc(), body_model()->default_shape(GetParam()), Vec2(1.0f)};
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    std::vector<uint32_t> left = triangles_of(avatar, {BodyPart::kLeftForearm, BodyPart::kLeftHand}),
                          right = triangles_of(avatar, {BodyPart::kRightForearm, BodyPart::kRightHand});
};

/// The man's poses are those by which the size of a hand was chosen (kHandSize).
TEST_P(CrossedArms, HandsAndForearmsStayOutOfEachOther) {
    for (const float further : {-0.1f, -0.02f, 0.02f, 0.1f})
        for (const float bend : {1.0f, 1.2f, 1.4f, 1.55f, 1.7f, 1.9f})
            for (const float twist : {-0.8f, 0.0f, 0.8f, 1.57f})
                EXPECT_EQ(crossings(further, bend, twist), 0u) << further << " " << bend << " " << twist;
}

/// By which nothing was chosen.
TEST_P(CrossedArms, InRandomPosesTheyHardlyCross) {
    std::mt19937 random(20261127);
    std::uniform_real_distribution<float> further(-0.15f, 0.15f), bend(0.9f, 2.0f), twist(-1.6f, 1.6f);
    int poses = 0;
    for (int i = 0; i < 200; ++i) {
        const float a = further(random), b = bend(random), c = twist(random);
        poses += crossings(a, b, c) > 0;
    }
    EXPECT_LE(poses, GetParam() == VFIT_SEX_MALE ? 6 : 0);
}

INSTANTIATE_TEST_SUITE_P(Both, CrossedArms, testing::Values(VFIT_SEX_MALE, VFIT_SEX_FEMALE));

}  // namespace
}  // namespace vfit
