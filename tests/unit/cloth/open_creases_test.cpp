// The posed skin as an obstacle: where it crosses itself as skinned, opened creases keep it apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "avatar/avatar.h"
#include "cloth/crossings.h"

namespace vfit {
namespace {

constexpr float kDeg = kPi / 180.0f;

/// Pairs of crossing triangles, those of head, hands and feet alone left out.
size_t crossings_of(const Avatar& avatar) {
    const BodyTopology& topology = avatar.topology();
    const auto is_bare = [&](uint32_t triangle) {
        const BodyPart part = topology.parts[topology.indices[3 * triangle]];
        return part == BodyPart::kHead || part == BodyPart::kLeftHand || part == BodyPart::kRightHand ||
               part == BodyPart::kLeftFoot || part == BodyPart::kRightFoot;
    };
    const auto pairs =
        crossed_triangles(std::span(avatar.positions()).first(topology.vertex_count), topology.indices);
    return size_t(std::count_if(pairs.begin(), pairs.end(), [&](const TrianglePair& pair) {
        return !is_bare(pair.first) || !is_bare(pair.second);
    }));
}

struct Sides {
    Quat upper_arm{1, 0, 0, 0}, lower_arm{1, 0, 0, 0}, upper_leg{1, 0, 0, 0}, lower_leg{1, 0, 0, 0};
};
/// Rotations of the left side; the right one mirrors them.
Pose symmetric(const Avatar& avatar, const Sides& left) {
    const auto mirrored = [](const Quat& q) { return Quat(q.w, q.x, -q.y, -q.z); };
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = left.upper_arm;
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = left.lower_arm;
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = left.upper_leg;
    pose.rotation[VFIT_BONE_LEFT_LOWER_LEG] = left.lower_leg;
    pose.rotation[VFIT_BONE_RIGHT_UPPER_ARM] = mirrored(left.upper_arm);
    pose.rotation[VFIT_BONE_RIGHT_LOWER_ARM] = mirrored(left.lower_arm);
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] = mirrored(left.upper_leg);
    pose.rotation[VFIT_BONE_RIGHT_LOWER_LEG] = mirrored(left.lower_leg);
    return pose;
}

Quat about(const Vec3& axis, float deg) { return glm::angleAxis(deg * kDeg, axis); }

struct Case {
    const char* name;
    Sides left;
    float kept;  // fraction of the crossings of the skin alone
};

TEST(OpenCreases, KeepTheSkinOutOfItself) {
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const Case cases[] = {
        {"T-pose", {}, 0.0f},
        {"arms down", {about(z, -78.0f)}, 0.1f},
        {"legs closed", {about(z, -45.0f), {1, 0, 0, 0}, about(z, -5.0f)}, 0.4f},
        {"elbows bent", {about(z, -50.0f), about(y, -110.0f)}, 0.1f},
        {"squat", {about(z, -45.0f), {1, 0, 0, 0}, about(x, -75.0f), about(x, 90.0f)}, 0.4f},
        {"arms crossed",
         {about(x, -0.9f / kDeg) * about(z, -1.3f / kDeg) * about(x, 1.4f / kDeg), about(y, -1.7f / kDeg)},
         0.2f},
    };
    const auto model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    const auto jobs = Jobs::own(0);
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        AvatarDesc desc;
        desc.sex = sex;
        Avatar skinned(model, desc, {}, Vec2(1.0f));
        desc.limbs_clear = true;
        Avatar opened(model, desc, {}, Vec2(1.0f));
        for (const Case& c : cases) {
            skinned.pose(symmetric(skinned, c.left), *jobs);
            opened.pose(symmetric(opened, c.left), *jobs);
            EXPECT_LE(float(crossings_of(opened)), c.kept * float(crossings_of(skinned)))
                << c.name << (sex == VFIT_SEX_MALE ? ", man" : ", woman") << ": " << crossings_of(skinned)
                << " as skinned, " << crossings_of(opened) << " opened";
        }
    }
}

}  // namespace
}  // namespace vfit
