// vfit_cloth_carry: between steps the cloth goes with the avatar, and the simulation knows nothing of it.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "contract/support.h"
#include "support/allocations.h"

namespace {

constexpr float kCarryStep_s = 1.0f / 60.0f;

class CarryTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.sex = VFIT_SEX_FEMALE;
        ASSERT_EQ(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, &avatar), VFIT_OK)
            << contract::last_error();
        pose(0.0f, 0.0f, 1);
        vfit_garment garment{};
        ASSERT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
        cloth = make(garment), twin = make(garment);
    }
    vfit_cloth make(vfit_garment garment) {
        vfit_cloth made{};
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_AWAKE | VFIT_CLOTH_PRESSURE;
        EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &made), VFIT_OK) << contract::last_error();
        return made;
    }
    /// Turned about the vertical axis and moved to the side; the left thigh forward.
    void pose(float turn_rad, float aside_m, int64_t time_ns, float thigh_rad = 0.3f) {
        vfit_pose p = vfit_pose_init();
        p.time_ns = time_ns;
        vfit_bone bones[2] = {vfit_bone_init(), vfit_bone_init()};
        bones[0].bone = VFIT_BONE_HIPS;
        bones[0].rotation[1] = std::sin(0.5f * turn_rad), bones[0].rotation[3] = std::cos(0.5f * turn_rad);
        bones[0].position[0] = aside_m, bones[0].position[1] = 1.0f;
        bones[1].bone = VFIT_BONE_LEFT_UPPER_LEG;
        bones[1].rotation[0] = -std::sin(0.5f * thigh_rad), bones[1].rotation[3] = std::cos(0.5f * thigh_rad);
        ASSERT_EQ(vfit_avatar_pose(avatar, &p, bones, sizeof bones[0], 2), VFIT_OK) << contract::last_error();
    }
    struct Mesh {
        std::vector<float> positions, normals, strain;
        int64_t time_ns = 0;
    };
    static std::vector<float> stream(vfit_frame frame, vfit_stream what, size_t floats, int64_t& time_ns) {
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, what, &view), VFIT_OK) << contract::last_error();
        std::vector<float> out(floats * view.width);
        std::memcpy(out.data(), view.data, out.size() * sizeof(float));
        time_ns = view.time_ns;
        return out;
    }
    static Mesh mesh(vfit_cloth cloth) {
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK) << contract::last_error();
        Mesh out;
        out.positions = stream(frame, VFIT_STREAM_POSITION, 3, out.time_ns);
        out.normals = stream(frame, VFIT_STREAM_NORMAL, 3, out.time_ns);
        out.strain = stream(frame, VFIT_STREAM_STRAIN, 1, out.time_ns);
        vfit_frame_release(frame);
        return out;
    }
    static float apart(const std::vector<float>& a, const std::vector<float>& b) {
        float most = a.size() == b.size() ? 0.0f : 1e9f;
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            most = std::max(most, std::fabs(a[i] - b[i]));
        return most;
    }
    /// As pose(turn, aside) moves what stands as pose(0, 0) does.
    static std::vector<float> moved(const std::vector<float>& all, float turn_rad, float aside_m) {
        std::vector<float> out(all.size());
        const float c = std::cos(turn_rad), s = std::sin(turn_rad);
        for (size_t i = 0; i < all.size(); i += 3) {
            out[i] = c * all[i] + s * all[i + 2] + aside_m;
            out[i + 1] = all[i + 1];
            out[i + 2] = -s * all[i] + c * all[i + 2];
        }
        return out;
    }
    static uint64_t hash(vfit_cloth cloth) {
        uint64_t out = 0;
        EXPECT_EQ(vfit_cloth_state_hash(cloth, &out), VFIT_OK) << contract::last_error();
        return out;
    }
    void step_both(int times) {
        for (int i = 0; i < times; ++i)
            for (const vfit_cloth c : {cloth, twin})
                ASSERT_EQ(vfit_cloth_step(c, kCarryStep_s), VFIT_OK) << contract::last_error();
    }
    vfit_avatar avatar{};
    vfit_cloth cloth{}, twin{};  // the twin is never carried
};

TEST_F(CarryTest, ARigidMotionCarriesTheClothExactly) {
    step_both(20);
    const Mesh before = mesh(cloth);
    ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
    EXPECT_LT(apart(mesh(cloth).positions, before.positions), 3e-6f) << "no motion, no change";
    for (int i = 1; i <= 5; ++i) {  // from the last step's pose, not from the last carry's
        pose(0.25f * float(i), 0.3f * float(i), 1 + i);
        ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
    }
    const Mesh after = mesh(cloth);
    EXPECT_LT(apart(after.positions, moved(before.positions, 1.25f, 1.5f)), 5e-6f);
    EXPECT_LT(apart(after.normals, moved(before.normals, 1.25f, 0.0f)), 1e-5f);
    EXPECT_EQ(after.strain, before.strain);
    EXPECT_EQ(after.time_ns, 6) << "the pose's";
}

TEST_F(CarryTest, TheSimulationKnowsNothingOfIt) {
    step_both(5);
    for (int i = 0; i < 10; ++i) {
        const uint64_t before = hash(cloth);
        pose(0.02f * float(i), 0.01f * float(i), 2 + i, 0.3f + 0.02f * float(i));
        ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
        EXPECT_EQ(hash(cloth), before);
        step_both(1);
        EXPECT_EQ(hash(cloth), hash(twin));
        EXPECT_EQ(mesh(cloth).positions, mesh(twin).positions) << "the step's own, not the carried";
    }
}

TEST_F(CarryTest, WhileAStepRunsTheOneBeforeIsCarried) {
    step_both(10);
    const Mesh before = mesh(cloth);
    pose(0.1f, 0.0f, 2);
    for (const vfit_cloth c : {cloth, twin})
        ASSERT_EQ(vfit_cloth_begin_step(c, kCarryStep_s), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 3; ++i) {
        pose(0.5f, 0.2f, 3);
        ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
        EXPECT_LT(apart(mesh(cloth).positions, moved(before.positions, 0.5f, 0.2f)), 5e-6f);
    }
    for (const vfit_cloth c : {cloth, twin})
        ASSERT_EQ(vfit_cloth_end_step(c), VFIT_OK) << contract::last_error();
    EXPECT_EQ(hash(cloth), hash(twin));
    const Mesh stepped = mesh(cloth);
    EXPECT_EQ(stepped.time_ns, 2) << "of the pose at its beginning";
    ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK);
    EXPECT_LT(apart(mesh(cloth).positions, moved(stepped.positions, 0.4f, 0.2f)), 0.2f)
        << "now from the new step";
    EXPECT_EQ(mesh(cloth).time_ns, 3);
}

TEST_F(CarryTest, AfterAResetAndAStepOfNoTimeToo) {
    pose(0.3f, 0.0f, 2);
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK) << contract::last_error();
    const Mesh put_on = mesh(cloth);
    pose(0.7f, 0.0f, 3);
    ASSERT_EQ(vfit_cloth_step(cloth, 0.0f), VFIT_OK)
        << contract::last_error();  // changes nothing, whatever the pose
    ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
    EXPECT_LT(apart(mesh(cloth).positions, moved(put_on.positions, 0.4f, 0.0f)), 5e-6f);
}

TEST_F(CarryTest, DoesNotAllocateAndIsBusyWhereTheHostHoldsAllFrames) {
    step_both(2);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
    const uint64_t before = vfit::test::allocations;
    for (int i = 0; i < 10; ++i) vfit_cloth_carry(cloth);
    EXPECT_EQ(vfit::test::allocations - before, 0u);

    std::vector<vfit_frame> held;
    vfit_result result = VFIT_OK;
    for (int i = 0; i < 20 && result == VFIT_OK; ++i) {
        held.push_back({});
        ASSERT_EQ(vfit_cloth_acquire(cloth, &held.back()), VFIT_OK);
        result = vfit_cloth_carry(cloth);
    }
    EXPECT_EQ(result, VFIT_ERROR_BUSY);
    for (const vfit_frame frame : held) vfit_frame_release(frame);
    EXPECT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
}

}  // namespace
