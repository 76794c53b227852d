// vfit_cloth_reset in the middle of a stride: the skirt is around both legs, not between them.
#include <algorithm>
#include <cmath>

#include "contract/support.h"

namespace {

struct Point {
    float x, y, z;
};

Point mix(const Point& a, const Point& b, float t) {
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}

/// A thigh's middle line, and where it runs at a height.
struct Thigh {
    Point hip, knee;
    Point at(float y) const { return mix(hip, knee, (y - hip.y) / (knee.y - hip.y)); }
};

class ResetTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.sex = VFIT_SEX_FEMALE;
        ASSERT_EQ(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, &avatar), VFIT_OK);
        vfit_garment garment{};
        ASSERT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
        stride();
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_NO_HANDS;
        ASSERT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
    }

    Point joint(int32_t id) const {
        uint32_t count = 0;
        EXPECT_EQ(vfit_avatar_joints(avatar, nullptr, 0, &count), VFIT_OK);
        std::vector<vfit_joint> joints(count);
        EXPECT_EQ(vfit_avatar_joints(avatar, joints.data(), sizeof joints[0], &count), VFIT_OK);
        for (const vfit_joint& j : joints)
            if (int32_t(j.joint) == id) return {j.position[0], j.position[1], j.position[2]};
        ADD_FAILURE() << "no joint " << id;
        return {};
    }

    /// Left thigh forward, right thigh back, arms down.
    void stride() {
        const auto turned = [](vfit_bone_id id, int axis, float angle) {
            vfit_bone bone = vfit_bone_init();
            bone.bone = id;
            bone.rotation[axis] = std::sin(0.5f * angle);
            bone.rotation[3] = std::cos(0.5f * angle);
            return bone;
        };
        std::vector<vfit_bone> bones = {turned(VFIT_BONE_HIPS, 0, 0.0f),
                                        turned(VFIT_BONE_LEFT_UPPER_LEG, 0, -0.85f),
                                        turned(VFIT_BONE_RIGHT_UPPER_LEG, 0, 0.75f),
                                        turned(VFIT_BONE_RIGHT_LOWER_LEG, 0, 0.4f),
                                        turned(VFIT_BONE_LEFT_UPPER_ARM, 2, -1.3f),
                                        turned(VFIT_BONE_RIGHT_UPPER_ARM, 2, 1.3f)};
        const Point pelvis = joint(VFIT_JOINT_PELVIS);
        bones[0].position[0] = pelvis.x;
        bones[0].position[1] = pelvis.y;
        bones[0].position[2] = pelvis.z;
        vfit_pose pose = vfit_pose_init();
        ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof bones[0], uint32_t(bones.size())),
                  VFIT_OK)
            << contract::last_error();
    }

    /// Cloth vertices at the height of the thighs that lie on the line between them.
    int between_the_legs() const {
        const Thigh left{joint(VFIT_JOINT_LEFT_HIP), joint(VFIT_JOINT_LEFT_KNEE)};
        const Thigh right{joint(VFIT_JOINT_RIGHT_HIP), joint(VFIT_JOINT_RIGHT_KNEE)};
        const float top = std::min(left.hip.y, right.hip.y) - 0.12f,
                    low = std::max(left.knee.y, right.knee.y);
        int count = 0;
        for (const Point& p : vertices()) {
            if (p.y > top || p.y < low) continue;
            const Point a = left.at(p.y), b = right.at(p.y);
            const float bx = b.x - a.x, bz = b.z - a.z, length2 = bx * bx + bz * bz;
            const float along = ((p.x - a.x) * bx + (p.z - a.z) * bz) / length2;
            const float aside = std::abs((p.x - a.x) * bz - (p.z - a.z) * bx) / std::sqrt(length2);
            count += along > 0.0f && along < 1.0f && aside < 0.02f;
        }
        return count;
    }

    std::vector<Point> vertices() const {
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK);
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
        std::vector<Point> out(view.width);
        for (uint32_t i = 0; i < view.width; ++i) {
            const float* p = static_cast<const float*>(view.data) + 3 * i;
            out[i] = {p[0], p[1], p[2]};
        }
        vfit_frame_release(frame);
        return out;
    }

    void a_second() {
        for (int frame = 0; frame < 60; ++frame) ASSERT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK);
    }
    vfit_cloth_stats stats() const {
        vfit_cloth_stats out = vfit_cloth_stats_init();
        EXPECT_EQ(vfit_cloth_describe(cloth, &out), VFIT_OK);
        return out;
    }

    vfit_avatar avatar{};
    vfit_cloth cloth{};
};

}  // namespace

TEST_F(ResetTest, PutsTheSkirtAroundBothLegsOfAStride) {
    // Carried into the stride as it is, the skirt is held back by the legs.
    a_second();
    const std::vector<Point> carried = vertices();

    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK) << contract::last_error();
    EXPECT_EQ(between_the_legs(), 0);
    EXPECT_LT(stats().strain_p99, 0.1f);
    a_second();
    EXPECT_EQ(between_the_legs(), 0);
    EXPECT_LT(stats().strain_p99, 0.08f);
    EXPECT_LT(stats().strain_max, 0.2f);
    const std::vector<Point> now = vertices();
    float way_m = 0.0f;
    for (size_t i = 0; i < now.size(); ++i)
        way_m = std::max(
            way_m, std::hypot(now[i].x - carried[i].x, now[i].y - carried[i].y, now[i].z - carried[i].z));
    EXPECT_GT(way_m, 0.05f) << "the pose is no test";
}

TEST_F(ResetTest, GivesTheSameBitsEachTime) {
    uint64_t first = 0, second = 0;
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK);
    ASSERT_EQ(vfit_cloth_state_hash(cloth, &first), VFIT_OK);
    for (int frame = 0; frame < 10; ++frame) ASSERT_EQ(vfit_cloth_step(cloth, 1.0f / 60.0f), VFIT_OK);
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK);
    ASSERT_EQ(vfit_cloth_state_hash(cloth, &second), VFIT_OK);
    EXPECT_EQ(first, second);
}
