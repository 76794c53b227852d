// vfit_cloth_teleport and jumps of the avatar: the bones carry the cloth, which feels nothing of the way.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "contract/support.h"
#include "support/allocation_count.h"  // counted by carry_test.cpp

namespace {

constexpr float kTeleportStep_s = 1.0f / 60.0f;

class TeleportTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.sex = VFIT_SEX_MALE;
        ASSERT_EQ(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, &avatar), VFIT_OK)
            << contract::last_error();
        pose(0.0f, 0.0f);
        ASSERT_EQ(vfit_garment_open(context, "shirt_men", &garment), VFIT_OK) << contract::last_error();
    }
    vfit_cloth make(float carry_limits = 0.0f, uint32_t flags = VFIT_CLOTH_AWAKE) {
        vfit_cloth made{};
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = flags;
        desc.carry_speed_m_s = desc.carry_way_m = carry_limits;
        EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &made), VFIT_OK) << contract::last_error();
        return made;
    }
    /// Turned about the vertical axis and moved to the side.
    void pose(float turn_rad, float aside_m) {
        vfit_pose p = vfit_pose_init();
        vfit_bone hips = vfit_bone_init();
        hips.bone = VFIT_BONE_HIPS;
        hips.rotation[1] = std::sin(0.5f * turn_rad), hips.rotation[3] = std::cos(0.5f * turn_rad);
        hips.position[0] = aside_m, hips.position[1] = 1.0f;
        ASSERT_EQ(vfit_avatar_pose(avatar, &p, &hips, sizeof hips, 1), VFIT_OK) << contract::last_error();
    }
    static void step(vfit_cloth cloth, int times = 1) {
        for (int i = 0; i < times; ++i)
            ASSERT_EQ(vfit_cloth_step(cloth, kTeleportStep_s), VFIT_OK) << contract::last_error();
    }
    static std::vector<float> positions(vfit_cloth cloth) {
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK) << contract::last_error();
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK) << contract::last_error();
        std::vector<float> out(size_t(3) * view.width);
        std::memcpy(out.data(), view.data, out.size() * sizeof(float));
        vfit_frame_release(frame);
        return out;
    }
    /// How far cloth is from where pose(turn, aside) moves what was at `before` in pose(0, 0).
    static float off(const std::vector<float>& before, float turn_rad, float aside_m, vfit_cloth cloth) {
        const std::vector<float> now = positions(cloth);
        const float c = std::cos(turn_rad), s = std::sin(turn_rad);
        float most = now.size() == before.size() ? 0.0f : 1e9f;
        for (size_t i = 0; i + 2 < before.size(); i += 3) {
            const float x = c * before[i] + s * before[i + 2] + aside_m,
                        z = c * before[i + 2] - s * before[i];
            most = std::max(most, std::hypot(x - now[i], before[i + 1] - now[i + 1], z - now[i + 2]));
        }
        return most;
    }
    /// What a step moves hanging cloth by, on a body that stands still, with room for a worse one.
    static float own_way_m(vfit_cloth cloth) {
        const std::vector<float> before = positions(cloth);
        step(cloth);
        return own_way_m(before, cloth);
    }
    static float own_way_m(const std::vector<float>& before, vfit_cloth cloth) {
        return 1.5f * off(before, 0.0f, 0.0f, cloth) + 1e-3f;
    }
    static vfit_cloth_stats stats(vfit_cloth cloth) {
        vfit_cloth_stats out = vfit_cloth_stats_init();
        EXPECT_EQ(vfit_cloth_describe(cloth, &out), VFIT_OK) << contract::last_error();
        return out;
    }
    static uint64_t hash(vfit_cloth cloth) {
        uint64_t out = 0;
        EXPECT_EQ(vfit_cloth_state_hash(cloth, &out), VFIT_OK) << contract::last_error();
        return out;
    }
    vfit_avatar avatar{};
    vfit_garment garment{};
};

TEST_F(TeleportTest, HandlesThatAreNoClothAreRefused) {
    EXPECT_EQ(vfit_cloth_teleport({}), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_cloth_teleport({avatar.id}), VFIT_ERROR_HANDLE);
    const vfit_cloth cloth = make();
    EXPECT_EQ(vfit_cloth_teleport({cloth.id ^ (uint64_t(1) << 40)}), VFIT_ERROR_HANDLE) << "stale";
    EXPECT_EQ(vfit_cloth_teleport(cloth), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_destroy(cloth), VFIT_OK);
    EXPECT_EQ(vfit_cloth_teleport(cloth), VFIT_ERROR_HANDLE);
}

TEST_F(TeleportTest, ANearJumpIsNotFeltWhereItIsDeclared) {
    const vfit_cloth cloth = make(), twin = make();
    step(cloth, 90), step(twin, 90);
    const float way_m = std::max(own_way_m(cloth), own_way_m(twin));
    const std::vector<float> before = positions(cloth);
    pose(0.02f, 0.02f);
    ASSERT_EQ(vfit_cloth_teleport(cloth), VFIT_OK) << contract::last_error();
    step(cloth), step(twin);
    EXPECT_LT(off(before, 0.02f, 0.02f, cloth), way_m);
    EXPECT_GT(off(before, 0.02f, 0.02f, twin), way_m) << "felt";
    pose(0.0f, 0.0f);
    step(cloth);
    EXPECT_GT(off(before, 0.0f, 0.0f, cloth), way_m) << "that one step alone";
}

TEST_F(TeleportTest, AFarJumpNeedsNoWord) {
    const vfit_cloth cloth = make(), bound = make(-1.0f);
    step(cloth, 90), step(bound, 91);
    const float way_m = own_way_m(cloth);
    const std::vector<float> before = positions(cloth);
    const float strain = stats(cloth).strain_max;
    int steps = 0;
    for (const auto& [turn_rad, aside_m] :
         {std::pair(3.0f, 0.0f), std::pair(0.0f, 0.4f), std::pair(1.0f, 2.0f)}) {
        pose(turn_rad, aside_m);
        step(cloth);
        EXPECT_LT(off(before, turn_rad, aside_m, cloth), float(++steps) * way_m);
    }
    step(cloth, 60);
    EXPECT_LT(stats(cloth).strain_max, 1.2f * strain + 0.02f);
    pose(0.0f, 0.5f);
    step(bound);
    EXPECT_GT(off(before, 0.0f, 0.5f, bound), 0.1f) << "no motion is a jump to it";
}

TEST_F(TeleportTest, DuringAStepTheNextOneIsMeant) {
    const vfit_cloth cloth = make(), twin = make();
    step(cloth, 90), step(twin, 90);
    pose(0.0f, 0.02f);
    for (const vfit_cloth c : {cloth, twin})
        ASSERT_EQ(vfit_cloth_begin_step(c, kTeleportStep_s), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_cloth_teleport(cloth), VFIT_OK) << contract::last_error();
    for (const vfit_cloth c : {cloth, twin})
        ASSERT_EQ(vfit_cloth_end_step(c), VFIT_OK) << contract::last_error();
    EXPECT_EQ(hash(cloth), hash(twin));
    pose(0.0f, 0.06f);
    step(cloth), step(twin);
    EXPECT_NE(hash(cloth), hash(twin));
}

TEST_F(TeleportTest, AStepOfNoTimeLeavesItForTheNextAndAResetTakesItBack) {
    const vfit_cloth cloth = make(), twin = make();
    step(cloth, 90), step(twin, 90);
    const float way_m = std::max(own_way_m(cloth), own_way_m(twin));
    const std::vector<float> before = positions(cloth);
    pose(0.0f, 0.05f);
    ASSERT_EQ(vfit_cloth_teleport(cloth), VFIT_OK);
    ASSERT_EQ(vfit_cloth_step(cloth, 0.0f), VFIT_OK);
    step(cloth);
    EXPECT_LT(off(before, 0.0f, 0.05f, cloth), way_m);
    ASSERT_EQ(vfit_cloth_teleport(cloth), VFIT_OK);
    for (const vfit_cloth c : {cloth, twin}) ASSERT_EQ(vfit_cloth_reset(c), VFIT_OK);
    pose(0.0f, 0.1f);
    step(cloth), step(twin);
    EXPECT_EQ(hash(cloth), hash(twin));
}

TEST_F(TeleportTest, WhatSleepsIsCarriedAsleep) {
    const vfit_cloth cloth = make(0.0f, 0);
    step(cloth, 60);
    for (int i = 0; i < 1800 && stats(cloth).substeps > 0; ++i) step(cloth);
    if (stats(cloth).substeps > 0) GTEST_SKIP() << "this garment trembles on this body";
    const std::vector<float> before = positions(cloth);
    pose(2.0f, 1.0f);
    step(cloth);
    EXPECT_EQ(stats(cloth).substeps, 0u);
    EXPECT_LT(off(before, 2.0f, 1.0f, cloth), 1e-5f);
}

TEST_F(TeleportTest, BothLayersOfAnOutfitAreCarried) {
    const vfit_cloth inner = make();
    ASSERT_EQ(vfit_garment_open(context, "vest", &garment), VFIT_OK) << contract::last_error();
    const vfit_cloth outer = make();
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    step(inner, 30);
    ASSERT_EQ(vfit_cloth_reset(outer), VFIT_OK) << contract::last_error();
    // A vest over a shirt comes to rest in 3 s: before, its strain still rises by itself.
    for (int i = 0; i < 210; ++i) step(inner), step(outer);
    // They tremble: the largest way of eight frames.
    float inner_m = 0.0f, outer_m = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const std::vector<float> inner_lay = positions(inner), outer_lay = positions(outer);
        step(inner), step(outer);
        inner_m = std::max(inner_m, own_way_m(inner_lay, inner));
        outer_m = std::max(outer_m, own_way_m(outer_lay, outer));
    }
    const std::vector<float> inner_before = positions(inner), outer_before = positions(outer);
    const float strain = stats(outer).strain_max;
    pose(2.0f, 0.7f);
    step(inner), step(outer);
    EXPECT_LT(off(inner_before, 2.0f, 0.7f, inner), inner_m);
    EXPECT_LT(off(outer_before, 2.0f, 0.7f, outer), outer_m);
    for (int i = 0; i < 60; ++i) step(inner), step(outer);
    EXPECT_LT(stats(outer).strain_max, 1.2f * strain + 0.02f);
}

TEST_F(TeleportTest, AChangeOfSizeAfterAJumpIsOfTheClothThere) {
    const vfit_cloth cloth = make(), twin = make();
    step(cloth, 60), step(twin, 60);
    ASSERT_EQ(vfit_cloth_set_size(twin, nullptr), VFIT_OK) << contract::last_error();
    step(twin, 60);
    pose(1.5f, 0.3f);
    ASSERT_EQ(vfit_cloth_set_size(cloth, nullptr), VFIT_OK) << contract::last_error();
    step(cloth, 60);
    EXPECT_LT(stats(cloth).strain_max, 1.2f * stats(twin).strain_max + 0.02f);
}

TEST_F(TeleportTest, DoesNotAllocate) {
    const vfit_cloth cloth = make();
    step(cloth, 30);
    const auto jump = [&](int i) {
        pose(0.5f * float(i), 0.2f * float(i));
        vfit_cloth_teleport(cloth);
    };
    for (int i = 0; i < 4; ++i) jump(i), step(cloth, 2);
    for (int i = 4; i < 10; ++i) {
        jump(i);
        const uint64_t before = vfit::test::allocations;
        vfit_cloth_step(cloth, kTeleportStep_s);
        vfit_cloth_step(cloth, kTeleportStep_s);
        EXPECT_EQ(vfit::test::allocations - before, 0u) << i;
    }
}

}  // namespace
