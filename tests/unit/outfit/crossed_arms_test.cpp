// Arms that are crossed before the chest, by an exact test of triangles.
#include <gtest/gtest.h>

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

TEST(CrossedArms, HandsAndForearmsStayOutOfEachOther) {
    AvatarDesc desc{VFIT_SEX_MALE};
    desc.limbs_clear = true;
    Avatar avatar(body_model(), desc, body_model()->default_shape(VFIT_SEX_MALE), Vec2(1.0f));
    const auto jobs = Jobs::own(0);
    const auto left = triangles_of(avatar, {BodyPart::kLeftForearm, BodyPart::kLeftHand}),
               right = triangles_of(avatar, {BodyPart::kRightForearm, BodyPart::kRightHand});
    for (const float further : {-0.1f, -0.02f, 0.02f, 0.1f})
        for (const float bend : {1.0f, 1.2f, 1.4f, 1.55f, 1.7f, 1.9f})
            for (const float twist : {-0.8f, 0.0f, 0.8f, 1.57f}) {
                avatar.pose(crossed(avatar, further, bend, twist), *jobs);
                EXPECT_EQ(crossed_triangles({avatar.positions(), left}, {avatar.positions(), right}).size(),
                          0u)
                    << further << " " << bend << " " << twist;
            }
}

}  // namespace
}  // namespace vfit
