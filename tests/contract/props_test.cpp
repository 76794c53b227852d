// Props: what the host puts beside a body, and how garments meet it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "contract/support.h"
#include "support/allocation_count.h"  // counted by carry_test.cpp

namespace {

constexpr float kPropStep_s = 1.0f / 60.0f, kUpright[4] = {0.0f, 0.0f, 0.0f, 1.0f};

class PropTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        vfit_avatar_desc body = vfit_avatar_desc_init();
        body.sex = VFIT_SEX_FEMALE;
        ASSERT_EQ(vfit_avatar_create_from_shape(context, &body, nullptr, 0, 0, &avatar), VFIT_OK)
            << contract::last_error();
        ASSERT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
    }
    vfit_cloth make(uint32_t flags = VFIT_CLOTH_SKIN) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = flags | VFIT_CLOTH_AWAKE;
        vfit_cloth cloth{};
        EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
        return cloth;
    }
    vfit_prop make_prop(vfit_prop_shape shape, float x, float y = 0.0f, float z = 0.0f) {
        vfit_prop_desc desc = vfit_prop_desc_init();
        desc.shape = shape;
        desc.size[0] = x, desc.size[1] = y, desc.size[2] = z;
        vfit_prop prop{};
        EXPECT_EQ(vfit_prop_create(context, &desc, &prop), VFIT_OK) << contract::last_error();
        return prop;
    }
    static void move(vfit_prop prop, float x, float y, float z) {
        const float position[3] = {x, y, z};
        ASSERT_EQ(vfit_prop_move(prop, position, kUpright), VFIT_OK) << contract::last_error();
    }
    void walk_to(float z) {
        vfit_pose p = vfit_pose_init();
        vfit_bone hips = vfit_bone_init();
        hips.bone = VFIT_BONE_HIPS;
        hips.rotation[3] = 1.0f;
        hips.position[1] = 0.93f, hips.position[2] = z;
        ASSERT_EQ(vfit_avatar_pose(avatar, &p, &hips, sizeof hips, 1), VFIT_OK) << contract::last_error();
    }
    static void step(vfit_cloth cloth, int times = 1) {
        for (int i = 0; i < times; ++i)
            ASSERT_EQ(vfit_cloth_step(cloth, kPropStep_s), VFIT_OK) << contract::last_error();
    }
    static std::vector<vfit_crossing> check(vfit_cloth cloth) {
        std::vector<vfit_crossing> out(80);
        uint32_t count = uint32_t(out.size());
        EXPECT_EQ(vfit_outfit_check(&cloth, 1, out.data(), sizeof(vfit_crossing), &count), VFIT_OK)
            << contract::last_error();
        out.resize(count);
        return out;
    }
    static uint32_t crossed_props(vfit_cloth cloth) {
        const auto crossings = check(cloth);
        return uint32_t(std::count_if(crossings.begin(), crossings.end(),
                                      [](const vfit_crossing& c) { return c.kind == VFIT_CROSSING_PROP; }));
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
    /// How far out cloth goes on the left side, at the height of a hem.
    static float reach_left(vfit_cloth cloth) {
        vfit_frame frame{};
        EXPECT_EQ(vfit_cloth_acquire(cloth, &frame), VFIT_OK) << contract::last_error();
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK) << contract::last_error();
        const auto* p = static_cast<const float*>(view.data);
        float most = -10.0f;
        for (uint32_t i = 0; i < view.width; ++i)
            if (p[3 * i + 1] > 0.45f && p[3 * i + 1] < 0.65f) most = std::max(most, p[3 * i]);
        vfit_frame_release(frame);
        return most;
    }
    vfit_avatar avatar{};
    vfit_garment garment{};
};

TEST_F(PropTest, ABallThatRollsIntoASkirtPushesItAsideAndItComesBack) {
    for (const uint32_t flags : {uint32_t(VFIT_CLOTH_SKIN), 0u}) {
        const vfit_cloth cloth = make(flags);
        step(cloth, 30);
        const float free = reach_left(cloth);
        const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.11f);
        ASSERT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK) << contract::last_error();
        uint32_t crossed = 0;
        for (int i = 0; i < 44; ++i) {
            move(ball, free + 0.2f - 0.005f * float(i), 0.55f, 0.0f);
            step(cloth);
            if (i % 6 == 0) crossed += crossed_props(cloth);
        }
        EXPECT_EQ(crossed, 0u) << flags;
        const float pushed = reach_left(cloth);
        EXPECT_LT(pushed, free - 0.015f) << flags;
        EXPECT_LT(stats(cloth).strain_max, 1.0f) << flags;
        ASSERT_EQ(vfit_cloth_remove_prop(cloth, ball), VFIT_OK) << contract::last_error();
        step(cloth, 60);
        EXPECT_GT(reach_left(cloth), pushed + 0.02f) << flags;
        EXPECT_EQ(vfit_prop_destroy(ball), VFIT_OK);
    }
}

TEST_F(PropTest, APropThatIsThereAtOnceComesThroughNoCloth) {
    const vfit_cloth cloth = make();
    step(cloth, 30);
    const float free = reach_left(cloth);
    const vfit_prop seat = make_prop(VFIT_PROP_BOX, 0.1f, 0.1f, 0.1f);
    move(seat, free + 0.03f, 0.5f, 0.0f);  // a third of it inside of the skirt
    ASSERT_EQ(vfit_cloth_add_prop(cloth, seat), VFIT_OK) << contract::last_error();
    uint32_t crossed = 0;
    for (int i = 0; i < 10; ++i) step(cloth, 4), crossed += crossed_props(cloth);
    EXPECT_EQ(crossed, 0u);
    EXPECT_LT(stats(cloth).strain_max, 1.0f);
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK) << contract::last_error();
    step(cloth, 60);
    EXPECT_EQ(crossed_props(cloth), 0u);
}

TEST_F(PropTest, APropThatIsDraggedAlongTheThighsTearsNothing) {
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE;
    desc.self_thickness_m = 0.004f;
    vfit_cloth cloth{};
    ASSERT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
    const auto strain = [&] {
        vfit_cloth_stats stats = vfit_cloth_stats_init();
        EXPECT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
        return stats.strain_max;
    };
    step(cloth, 20);
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.15f);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK);
    float most = 0.0f;
    int crossing = 0;
    for (int i = 0; i < 75; ++i) {
        // Round both thighs, 4 cm into them in the end.
        const float angle = 0.12f * float(i), away = 0.42f - 0.003f * float(std::min(i, 60));
        move(ball, away * std::sin(angle), 0.6f, away * std::cos(angle));
        step(cloth);
        most = std::max(most, strain());
        if (i % 8 == 0) crossing += !check(cloth).empty();
    }
    EXPECT_LT(most, 2.5f) << "without a way out, 7";
    EXPECT_GT(crossing, 0) << "what passes through the cloth is named";
    move(ball, 0.0f, 0.6f, 5.0f);
    step(cloth, 60);
    EXPECT_LT(strain(), 0.6f);
    EXPECT_TRUE(check(cloth).empty());
    vfit_cloth_destroy(cloth);
    vfit_prop_destroy(ball);
}

TEST_F(PropTest, ABoardThatStaysPressedIntoBothThighsLeavesClothBetween) {
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE;
    desc.self_thickness_m = 0.004f;
    vfit_cloth cloth{};
    ASSERT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
    const vfit_prop board = make_prop(VFIT_PROP_BOX, 0.18f, 0.03f, 0.2f);
    move(board, 0.0f, 0.62f, -0.6f);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, board), VFIT_OK);
    // From behind, 4 cm into them.
    for (int i = 0; i < 120; ++i) {
        move(board, 0.0f, 0.62f, -0.6f + 0.35f * std::min(float(i) / 80.0f, 1.0f));
        step(cloth);
        if (i % 10 == 9) {
            ASSERT_TRUE(check(cloth).empty()) << i;
        }
    }
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    ASSERT_EQ(vfit_cloth_describe(cloth, &stats), VFIT_OK);
    EXPECT_LT(stats.strain_max, 0.6f);
    vfit_cloth_destroy(cloth);
    vfit_prop_destroy(board);
}

TEST_F(PropTest, AnotherSizeMeetsTheSameProps) {
    const vfit_cloth cloth = make();
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.15f);
    move(ball, 0.0f, 0.5f, 0.3f);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK);
    step(cloth, 30);
    for (const char* size : {"L", "S"}) {
        ASSERT_EQ(vfit_cloth_set_size(cloth, size), VFIT_OK) << contract::last_error();
        for (int i = 0; i < 20; ++i) {
            step(cloth);
            for (const vfit_crossing& c : check(cloth)) ASSERT_NE(c.kind, VFIT_CROSSING_PROP) << size << i;
        }
    }
    vfit_cloth_destroy(cloth);
    vfit_prop_destroy(ball);
}

TEST_F(PropTest, ADestroyedPropIsMetNoLonger) {
    const vfit_cloth cloth = make(), twin = make(), third = make();
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.2f);
    move(ball, 0.3f, 0.5f, 0.0f);
    for (const vfit_cloth c : {cloth, twin, third}) {
        ASSERT_EQ(vfit_cloth_add_prop(c, ball), VFIT_OK) << contract::last_error();
        step(c, 30);
    }
    step(third, 30);
    ASSERT_EQ(vfit_cloth_remove_prop(twin, ball), VFIT_OK);
    ASSERT_EQ(vfit_prop_destroy(ball), VFIT_OK);
    step(cloth, 30), step(twin, 30);
    EXPECT_EQ(hash(cloth), hash(twin));
    EXPECT_NE(hash(cloth), hash(third));
    EXPECT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_cloth_remove_prop(cloth, ball), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_prop_destroy(ball), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_prop_destroy(vfit_prop{}), VFIT_OK);
}

TEST_F(PropTest, ClothPassesByAStandingPropHoweverFastTheBodyGoes) {
    struct Run {
        float inertia, speed_m_s;
    };
    // Of the first, the cloth feels all, and each step is a jump; of the second, it feels none.
    for (const Run& run : {Run{1.0f, 4.0f}, Run{-1.0f, 2.0f}}) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE;
        desc.inertia = run.inertia;
        vfit_cloth cloth{};
        ASSERT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
        const vfit_prop post = make_prop(VFIT_PROP_CAPSULE, 0.05f, 0.5f);
        move(post, 0.27f, 0.5f, 1.0f);  // beside the way, within the skirt's reach
        ASSERT_EQ(vfit_cloth_add_prop(cloth, post), VFIT_OK) << contract::last_error();
        step(cloth, 20);
        const float way_m = run.speed_m_s * kPropStep_s;
        uint32_t crossed = 0;
        for (int i = 0; float(i) * way_m < 1.5f; ++i) {
            walk_to(float(i) * way_m);
            step(cloth);
            if (i % 6 == 0) crossed += crossed_props(cloth);
        }
        EXPECT_EQ(crossed, 0u) << run.inertia << " " << run.speed_m_s;
        walk_to(0.0f);
        EXPECT_EQ(vfit_prop_destroy(post), VFIT_OK);
        EXPECT_EQ(vfit_cloth_destroy(cloth), VFIT_OK);
    }
}

TEST_F(PropTest, OnlyPropsOfTheStepAreTested) {
    const vfit_cloth cloth = make();
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.1f);
    move(ball, 0.4f, 0.6f, 0.0f);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK) << contract::last_error();
    step(cloth, 30);
    move(ball, 0.0f, 1.2f, 0.0f);  // into the chest
    ASSERT_EQ(vfit_cloth_step(cloth, 0.0f), VFIT_OK) << contract::last_error();
    EXPECT_EQ(crossed_props(cloth), 0u) << "nothing moves in no time";
    ASSERT_EQ(vfit_cloth_reset(cloth), VFIT_OK) << contract::last_error();
    EXPECT_EQ(crossed_props(cloth), 0u) << "it comes in with the next step";
    ASSERT_EQ(vfit_cloth_step(cloth, 0.0f), VFIT_OK) << contract::last_error();
    EXPECT_EQ(crossed_props(cloth), 0u);
}

TEST_F(PropTest, AStepThatRunsTakesNoProp) {
    const vfit_cloth cloth = make();
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.1f);
    ASSERT_EQ(vfit_cloth_begin_step(cloth, kPropStep_s), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_remove_prop(cloth, ball), VFIT_ERROR_STATE);
    ASSERT_EQ(vfit_cloth_end_step(cloth), VFIT_OK);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_begin_step(cloth, kPropStep_s), VFIT_OK) << contract::last_error();
    move(ball, 1.0f, 1.0f, 1.0f);
    EXPECT_EQ(vfit_prop_destroy(ball), VFIT_OK);
    EXPECT_EQ(vfit_cloth_end_step(cloth), VFIT_OK);
    step(cloth);
}

TEST_F(PropTest, BadInputIsRefusedByName) {
    const auto refused = [&](const vfit_prop_desc& desc) {
        vfit_prop prop{77};
        const vfit_result result = vfit_prop_create(context, &desc, &prop);
        EXPECT_EQ(prop.id != 0, result == VFIT_OK);
        return result;
    };
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    vfit_prop_desc desc = vfit_prop_desc_init();
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT) << "no size";
    desc.size[0] = kNaN;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT);
    desc.size[0] = 11.0f;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("radius"), std::string::npos) << contract::last_error();
    desc.size[0] = 0.1f, desc.shape = 4;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT);
    desc.shape = VFIT_PROP_MESH;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT) << "no mesh";
    float positions[12] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, 0.1f};
    uint32_t outside[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    desc.positions = positions, desc.vertex_count = 4;
    desc.indices = outside, desc.index_count = 12;
    EXPECT_EQ(refused(desc), VFIT_OK) << contract::last_error();
    desc.index_count = 11;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT);
    desc.index_count = 12, desc.vertex_count = 3;
    EXPECT_EQ(refused(desc), VFIT_ERROR_DATA) << "an index that names no vertex";
    desc.vertex_count = 4, positions[4] = kNaN;
    EXPECT_EQ(refused(desc), VFIT_ERROR_ARGUMENT);
    positions[4] = 0.0f;
    for (uint32_t t = 0; t < 12; t += 3) std::swap(outside[t], outside[t + 1]);
    EXPECT_EQ(refused(desc), VFIT_ERROR_DATA) << "inside out";
    EXPECT_EQ(vfit_prop_create(context, nullptr, nullptr), VFIT_ERROR_ARGUMENT);

    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.1f);
    const float at[3] = {0, 0, 0}, nowhere[3] = {0, kNaN, 0}, beyond[3] = {0, 0, 1e9f},
                zero[4] = {0, 0, 0, 0};
    EXPECT_EQ(vfit_prop_move(ball, at, kUpright), VFIT_OK);
    EXPECT_EQ(vfit_prop_move(ball, nowhere, kUpright), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_prop_move(ball, beyond, kUpright), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_prop_move(ball, at, zero), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_prop_move(ball, nullptr, kUpright), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_prop_move(ball, at, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_prop_deform(ball, positions, 4), VFIT_ERROR_ARGUMENT) << "another number of vertices";
    EXPECT_EQ(vfit_prop_deform(ball, nullptr, 4), VFIT_ERROR_ARGUMENT);

    const vfit_cloth cloth = make();
    const vfit_prop first = make_prop(VFIT_PROP_BOX, 0.01f, 0.01f, 0.01f);
    ASSERT_EQ(vfit_cloth_add_prop(cloth, first), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 63; ++i)
        ASSERT_EQ(vfit_cloth_add_prop(cloth, make_prop(VFIT_PROP_BOX, 0.01f, 0.01f, 0.01f)), VFIT_OK)
            << contract::last_error();
    EXPECT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_ERROR_CAPACITY);
    step(cloth, 2);
    EXPECT_EQ(vfit_prop_destroy(first), VFIT_OK);
    EXPECT_EQ(vfit_cloth_add_prop(cloth, ball), VFIT_OK) << "a destroyed prop leaves its place at once";

    vfit_context other{};
    const vfit_context_desc plain = contract::context_desc();
    ASSERT_EQ(vfit_context_create(&plain, &other), VFIT_OK);
    vfit_prop foreign{};
    desc = vfit_prop_desc_init();
    desc.size[0] = 0.1f;
    ASSERT_EQ(vfit_prop_create(other, &desc, &foreign), VFIT_OK);
    EXPECT_EQ(vfit_cloth_add_prop(cloth, foreign), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_context_destroy(other), VFIT_OK);
}

TEST_F(PropTest, AMeshIsWoundAsTheContextWrites) {
    for (const vfit_axes axes : {VFIT_AXES_UNITY, VFIT_AXES_UNREAL}) {
        vfit_context_desc contexts = contract::context_desc();
        contexts.axes = axes;
        vfit_context engine{};
        ASSERT_EQ(vfit_context_create(&contexts, &engine), VFIT_OK);
        const float unit = axes == VFIT_AXES_UNREAL ? 100.0f : 1.0f;
        const float positions[12] = {0, 0, 0, unit, 0, 0, 0, unit, 0, 0, 0, unit};
        uint32_t wound[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};  // clockwise from outside, left-handed
        vfit_prop_desc desc = vfit_prop_desc_init();
        desc.shape = VFIT_PROP_MESH;
        desc.positions = positions, desc.vertex_count = 4;
        desc.indices = wound, desc.index_count = 12;
        vfit_prop prop{};
        const vfit_result as_is = vfit_prop_create(engine, &desc, &prop);
        for (uint32_t t = 0; t < 12; t += 3) std::swap(wound[t], wound[t + 1]);
        const vfit_result turned = vfit_prop_create(engine, &desc, &prop);
        EXPECT_EQ(as_is, VFIT_OK) << axes;
        EXPECT_EQ(turned, VFIT_ERROR_DATA) << axes;
        EXPECT_EQ(vfit_context_destroy(engine), VFIT_OK);
    }
}

TEST_F(PropTest, StepsWithMovingPropsDoNotAllocate) {
    const vfit_cloth cloth = make();
    const vfit_prop ball = make_prop(VFIT_PROP_SPHERE, 0.1f),
                    box = make_prop(VFIT_PROP_BOX, 0.1f, 0.2f, 0.1f);
    for (const vfit_prop prop : {ball, box})
        ASSERT_EQ(vfit_cloth_add_prop(cloth, prop), VFIT_OK) << contract::last_error();
    const auto swing = [&](int i) {
        move(ball, 0.35f + 0.1f * std::sin(0.2f * float(i)), 0.5f, 0.1f);
        move(box, -0.4f + 0.05f * std::sin(0.1f * float(i)), 0.5f, 0.0f);
        vfit_cloth_step(cloth, kPropStep_s);
    };
    // Until it has met as many contacts as there ever are.
    int i = 0;
    uint64_t allocated = 1;
    for (int round = 0; round < 8 && allocated > 0; ++round) {
        const uint64_t before = vfit::test::allocations;
        for (const int end = i + 32; i < end; ++i) swing(i);
        allocated = vfit::test::allocations - before;
    }
    EXPECT_EQ(allocated, 0u);
}

}  // namespace
