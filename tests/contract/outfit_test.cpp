// Outfits: crossings of garments with themselves, the skin and each other; layers while they are stepped.
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "contract/support.h"
#include "support/allocation_count.h"  // counted by carry_test.cpp

namespace {

constexpr float kOutfitStep_s = 1.0f / 60.0f;

class OutfitTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        avatar = make_avatar();
        ASSERT_EQ(vfit_garment_open(context, "sundress", &garment), VFIT_OK) << contract::last_error();
    }
    vfit_avatar make_avatar() {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_FEMALE;
        vfit_avatar made{};
        EXPECT_EQ(vfit_avatar_create_from_shape(context, &desc, nullptr, 0, 0, &made), VFIT_OK)
            << contract::last_error();
        return made;
    }
    vfit_cloth make(uint32_t flags = 0, float self_thickness_m = 0.0f) {
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = flags | VFIT_CLOTH_AWAKE;
        desc.self_thickness_m = self_thickness_m;
        vfit_cloth cloth{};
        EXPECT_EQ(vfit_cloth_create(avatar, garment, &desc, &cloth), VFIT_OK) << contract::last_error();
        return cloth;
    }
    static std::vector<vfit_crossing> check(const std::vector<vfit_cloth>& cloths) {
        uint32_t count = 0;
        EXPECT_EQ(vfit_outfit_check(cloths.data(), uint32_t(cloths.size()), nullptr, 0, &count), VFIT_OK)
            << contract::last_error();
        std::vector<vfit_crossing> out(count);
        EXPECT_EQ(vfit_outfit_check(cloths.data(), uint32_t(cloths.size()), out.data(), sizeof(vfit_crossing),
                                    &count),
                  VFIT_OK)
            << contract::last_error();
        EXPECT_EQ(count, out.size());
        return out;
    }
    static uint32_t triangles(vfit_frame frame) {
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_INDEX, &view), VFIT_OK) << contract::last_error();
        vfit_frame_release(frame);
        return view.width / 3;
    }
    void stand_at(float x) {
        vfit_pose pose = vfit_pose_init();
        vfit_bone hips = vfit_bone_init();
        hips.bone = VFIT_BONE_HIPS;
        hips.position[0] = x, hips.position[1] = 0.95f;
        hips.rotation[3] = 1.0f;
        ASSERT_EQ(vfit_avatar_pose(avatar, &pose, &hips, sizeof hips, 1), VFIT_OK) << contract::last_error();
    }
    vfit_avatar avatar{};
    vfit_garment garment{};
};

TEST_F(OutfitTest, OneDressTwiceCrossesAndOneOverTheOtherDoesNot) {
    const vfit_cloth inner = make(VFIT_CLOTH_SKIN), outer = make(VFIT_CLOTH_SKIN);
    const auto twice = check({inner, outer});
    ASSERT_EQ(twice.size(), 1u);
    EXPECT_EQ(twice[0].struct_size, sizeof(vfit_crossing));
    EXPECT_EQ(twice[0].kind, VFIT_CROSSING_CLOTH);
    EXPECT_EQ(twice[0].cloth, 0u);
    EXPECT_EQ(twice[0].other, 1u);
    EXPECT_GT(twice[0].pair_count, 1000u);
    vfit_frame frame{};
    ASSERT_EQ(vfit_cloth_acquire(outer, &frame), VFIT_OK);
    const uint32_t count = triangles(frame);
    EXPECT_LT(twice[0].triangle, count);
    EXPECT_LT(twice[0].other_triangle, count);

    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_reset(outer), VFIT_OK) << contract::last_error();
    for (int i = 0; i < 60; ++i)
        for (const vfit_cloth cloth : {inner, outer})
            ASSERT_EQ(vfit_cloth_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    for (const vfit_crossing& c : check({inner, outer})) EXPECT_EQ(c.kind, VFIT_CROSSING_SELF);
}

TEST_F(OutfitTest, OneDressPutOnOverTheOtherLiesOutsideOfItAtOnce) {
    const vfit_cloth inner = make(VFIT_CLOTH_SKIN, 0.004f), outer = make(VFIT_CLOTH_SKIN, 0.004f);
    ASSERT_EQ(vfit_cloth_step(inner, kOutfitStep_s), VFIT_OK);
    ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK);
    vfit_frame before{}, after{};
    ASSERT_EQ(vfit_cloth_acquire(outer, &before), VFIT_OK);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_acquire(outer, &after), VFIT_OK);
    EXPECT_NE(before.id, after.id) << "it has moved";
    for (int i = 0; i < 30; ++i) {
        for (const vfit_crossing& c : check({inner, outer})) EXPECT_NE(c.kind, VFIT_CROSSING_CLOTH) << i;
        for (const vfit_cloth cloth : {inner, outer})
            ASSERT_EQ(vfit_cloth_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    }
    for (const vfit_frame frame : {before, after}) ASSERT_EQ(vfit_frame_release(frame), VFIT_OK);
}

TEST_F(OutfitTest, AStepThatRunsIsNotWaitedFor) {
    const vfit_cloth cloth = make(VFIT_CLOTH_SKIN), twin = make(VFIT_CLOTH_SKIN);
    const auto before = check({cloth, twin});
    ASSERT_EQ(vfit_cloth_begin_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    const auto during = check({cloth, twin});
    ASSERT_EQ(during.size(), before.size());
    EXPECT_EQ(during[0].pair_count, before[0].pair_count);
    ASSERT_EQ(vfit_cloth_end_step(cloth), VFIT_OK);
    EXPECT_LT(check({cloth, twin})[0].pair_count, before[0].pair_count);
}

TEST_F(OutfitTest, WhileTheyStepNothingElseIsDoneWithThem) {
    const vfit_cloth inner = make(), outer = make(), second = make();
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_begin_step(inner, kOutfitStep_s), VFIT_OK) << contract::last_error();
    const float no_wind[3] = {};
    uint64_t hash = 0;
    EXPECT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_reset(outer), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_set_size(outer, "M"), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_set_wind(outer, no_wind), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_set_quality(outer, 8, 0.0f), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_state_hash(outer, &hash), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_wear_over(outer, second), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_wear_over(second, inner), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_cloth_end_step(outer), VFIT_ERROR_STATE) << "it has not begun";
    ASSERT_EQ(vfit_cloth_end_step(inner), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_cloth_reset(outer), VFIT_OK) << contract::last_error();
}

TEST_F(OutfitTest, WornOverEachOtherTheyAreOneStepInAnyOrder) {
    const vfit_cloth inner = make(VFIT_CLOTH_AWAKE), outer = make(VFIT_CLOTH_AWAKE);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    const auto hashes = [&] {
        std::array<uint64_t, 2> out{};
        EXPECT_EQ(vfit_cloth_state_hash(inner, &out[0]), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_cloth_state_hash(outer, &out[1]), VFIT_OK) << contract::last_error();
        return out;
    };
    for (const bool inner_first : {true, false}) {
        const vfit_cloth first = inner_first ? inner : outer, then = inner_first ? outer : inner;
        const auto before = hashes();
        ASSERT_EQ(vfit_cloth_step(first, kOutfitStep_s), VFIT_OK) << contract::last_error();
        const auto stepped = hashes();
        EXPECT_NE(stepped[0], before[0]);
        EXPECT_NE(stepped[1], before[1]);
        vfit_frame frame{}, same{};
        ASSERT_EQ(vfit_cloth_acquire(then, &frame), VFIT_OK);
        ASSERT_EQ(vfit_cloth_step(then, kOutfitStep_s), VFIT_OK) << contract::last_error();
        EXPECT_EQ(hashes(), stepped) << "it was stepped already";
        ASSERT_EQ(vfit_cloth_acquire(then, &same), VFIT_OK);
        EXPECT_EQ(frame.id == same.id || vfit_frame_release(frame) == VFIT_OK, true);
        vfit_frame_release(same);
    }
    // The same of steps that run beside the host, ended in any order.
    for (const bool inner_first : {true, false}) {
        const auto before = hashes();
        for (const vfit_cloth cloth : {inner, outer})
            ASSERT_EQ(vfit_cloth_begin_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_cloth_begin_step(outer, kOutfitStep_s), VFIT_ERROR_STATE);
        for (const vfit_cloth cloth : {inner_first ? inner : outer, inner_first ? outer : inner})
            ASSERT_EQ(vfit_cloth_end_step(cloth), VFIT_OK) << contract::last_error();
        EXPECT_NE(hashes(), before);
    }
    // Stepped alone, each step is one of both.
    for (int i = 0; i < 3; ++i) {
        const auto before = hashes();
        ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
        EXPECT_NE(hashes()[0], before[0]) << i;
    }
}

TEST_F(OutfitTest, AnotherIsPutOnBeforeAllHaveEndedTheirStep) {
    const vfit_cloth inner = make(VFIT_CLOTH_AWAKE), outer = make(VFIT_CLOTH_AWAKE),
                     last = make(VFIT_CLOTH_AWAKE);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    for (const vfit_cloth cloth : {inner, outer})
        ASSERT_EQ(vfit_cloth_begin_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_end_step(inner), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_wear_over(last, outer), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_end_step(outer), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_begin_step(last, kOutfitStep_s), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_cloth_set_quality(inner, 8, 0.0f), VFIT_ERROR_STATE) << "its step has not been ended";
    ASSERT_EQ(vfit_cloth_end_step(last), VFIT_OK) << contract::last_error();
}

TEST_F(OutfitTest, AStepOfNoTimeIsNotThatOfTheOthers) {
    const vfit_cloth inner = make(VFIT_CLOTH_AWAKE), outer = make(VFIT_CLOTH_AWAKE);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    uint64_t before = 0, after = 0;
    ASSERT_EQ(vfit_cloth_state_hash(outer, &before), VFIT_OK);
    ASSERT_EQ(vfit_cloth_step(inner, 0.0f), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_state_hash(outer, &after), VFIT_OK);
    EXPECT_NE(after, before);
}

TEST_F(OutfitTest, StepsOfClothsThatAreWornTogetherDoNotAllocate) {
    const vfit_cloth inner = make(VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE, 0.004f),
                     outer = make(VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE, 0.004f);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    const auto step = [&] {
        for (const vfit_cloth cloth : {inner, outer}) vfit_cloth_step(cloth, kOutfitStep_s);
        for (const vfit_cloth cloth : {inner, outer}) vfit_cloth_begin_step(cloth, kOutfitStep_s);
        for (const vfit_cloth cloth : {inner, outer}) vfit_cloth_end_step(cloth);
    };
    for (int i = 0; i < 20; ++i) step();
    const uint64_t before = vfit::test::allocations;
    for (int i = 0; i < 4; ++i) step();
    EXPECT_EQ(vfit::test::allocations - before, 0u);
}

TEST_F(OutfitTest, StepsBesideTheHostAreProfiledAndOneOfAnOutfitIsOne) {
    const auto calls = [&] {
        std::array<vfit_profile, 32> items{};
        uint32_t count = uint32_t(items.size());
        EXPECT_EQ(vfit_profile_list(context, items.data(), sizeof(vfit_profile), &count), VFIT_OK);
        for (uint32_t i = 0; i < count; ++i)
            if (std::strcmp(items[i].stage, "cloth") == 0) return items[i].calls;
        return 0u;
    };
    const vfit_cloth inner = make(VFIT_CLOTH_AWAKE), outer = make(VFIT_CLOTH_AWAKE);
    ASSERT_EQ(vfit_cloth_wear_over(outer, inner), VFIT_OK) << contract::last_error();
    const uint32_t before = calls();
    for (const vfit_cloth cloth : {inner, outer}) ASSERT_EQ(vfit_cloth_step(cloth, kOutfitStep_s), VFIT_OK);
    EXPECT_EQ(calls(), before + 1);
    for (const vfit_cloth cloth : {inner, outer})
        ASSERT_EQ(vfit_cloth_begin_step(cloth, kOutfitStep_s), VFIT_OK);
    for (const vfit_cloth cloth : {inner, outer}) ASSERT_EQ(vfit_cloth_end_step(cloth), VFIT_OK);
    EXPECT_EQ(calls(), before + 2);
}

TEST_F(OutfitTest, ThreadsStepAndDestroyClothsThatAreWornTogether) {
    constexpr size_t kInner = 5;
    const vfit_cloth outer = make(VFIT_CLOTH_AWAKE);
    std::vector<vfit_cloth> all;
    for (size_t i = 0; i < kInner; ++i) all.push_back(make(VFIT_CLOTH_AWAKE));
    std::atomic<size_t> now{0};
    ASSERT_EQ(vfit_cloth_wear_over(outer, all[0]), VFIT_OK) << contract::last_error();
    std::atomic<bool> ends{false};
    std::atomic<int> strange{0}, steps{0};
    const auto succeeds = [&](vfit_result result) {
        if (result != VFIT_OK && result != VFIT_ERROR_BUSY && result != VFIT_ERROR_STATE &&
            result != VFIT_ERROR_HANDLE)
            ++strange;
        return result == VFIT_OK;
    };
    const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
    const auto step = [&](bool of_inner) {
        while (!ends) {
            const vfit_cloth cloth = of_inner ? all[now] : outer;
            steps += succeeds(vfit_cloth_step(cloth, kOutfitStep_s));
            if (succeeds(vfit_cloth_begin_step(cloth, kOutfitStep_s))) {
                pause();
                succeeds(vfit_cloth_end_step(cloth));
            }
            pause();
        }
    };
    std::thread first(step, false), second(step, true);
    for (size_t next = 1; next < kInner; ++next) {
        for (int tries = 0; tries < 500 && !succeeds(vfit_cloth_wear_over(outer, all[next])); ++tries)
            std::this_thread::yield();
        EXPECT_EQ(vfit_cloth_destroy(all[now.exchange(next)]), VFIT_OK);
        pause();
    }
    ends = true;
    first.join(), second.join();
    EXPECT_EQ(strange, 0);
    EXPECT_GT(steps, 0);
    vfit_cloth_end_step(outer);  // if its end was refused while it was busy
    vfit_cloth_step(outer, kOutfitStep_s);
    EXPECT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
}

TEST_F(OutfitTest, WhatIsDestroyedIsWornNoLonger) {
    const vfit_cloth inner = make(VFIT_CLOTH_AWAKE), middle = make(VFIT_CLOTH_AWAKE),
                     outer = make(VFIT_CLOTH_AWAKE);
    ASSERT_EQ(vfit_cloth_wear_over(middle, inner), VFIT_OK) << contract::last_error();
    for (const vfit_cloth below : {inner, middle})
        ASSERT_EQ(vfit_cloth_wear_over(outer, below), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK);
    ASSERT_EQ(vfit_cloth_destroy(middle), VFIT_OK);
    for (int i = 0; i < 3; ++i)
        for (const vfit_cloth cloth : {inner, outer})
            ASSERT_EQ(vfit_cloth_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    for (const vfit_crossing& c : check({inner, outer})) EXPECT_NE(c.kind, VFIT_CROSSING_CLOTH);
    // While a step of both runs.
    ASSERT_EQ(vfit_cloth_begin_step(inner, kOutfitStep_s), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_destroy(inner), VFIT_OK);
    ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_cloth_step(outer, kOutfitStep_s), VFIT_OK) << contract::last_error();
}

TEST_F(OutfitTest, TheSkinBelowAnOutfitIsTheAvatarsMeshInThePoseOfTheStep) {
    const vfit_cloth cloth = make(VFIT_CLOTH_SKIN);
    ASSERT_EQ(vfit_cloth_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    vfit_frame own{}, below{}, later{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &own), VFIT_OK);
    uint32_t crossing = 7;
    ASSERT_EQ(vfit_outfit_skin(&cloth, 1, &below, &crossing), VFIT_OK) << contract::last_error();
    EXPECT_EQ(crossing, 0u);
    const auto streams = [](vfit_frame frame) {
        std::array<vfit_stream, 32> items{};
        uint32_t count = uint32_t(items.size());
        EXPECT_EQ(vfit_frame_streams(frame, items.data(), &count), VFIT_OK);
        return std::vector<vfit_stream>(items.begin(), items.begin() + count);
    };
    EXPECT_EQ(streams(below), streams(own));
    for (const vfit_stream stream : streams(own)) {
        vfit_view a = vfit_view_init(), b = vfit_view_init();
        ASSERT_EQ(vfit_frame_view(own, stream, &a), VFIT_OK);
        ASSERT_EQ(vfit_frame_view(below, stream, &b), VFIT_OK);
        ASSERT_EQ(a.row_stride, b.row_stride);
        EXPECT_EQ(std::memcmp(a.data, b.data, a.row_stride), 0) << "stream " << stream;
    }
    // The avatar moves on, the cloth does not.
    ASSERT_NO_FATAL_FAILURE(stand_at(2.0f));
    ASSERT_EQ(vfit_outfit_skin(&cloth, 1, &later, nullptr), VFIT_OK) << contract::last_error();
    const auto first = [](vfit_frame frame) {
        vfit_view view = vfit_view_init();
        EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
        return static_cast<const float*>(view.data)[0];
    };
    EXPECT_EQ(first(later), first(below));
    vfit_frame_release(later);
    ASSERT_EQ(vfit_cloth_carry(cloth), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_outfit_skin(&cloth, 1, &later, nullptr), VFIT_OK) << contract::last_error();
    vfit_frame shown{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &shown), VFIT_OK);
    EXPECT_EQ(first(later), first(shown));
    for (const vfit_frame frame : {own, below, later, shown}) vfit_frame_release(frame);
}

TEST_F(OutfitTest, WhileAStepRunsTheSkinIsThatOfTheOneBefore) {
    const vfit_cloth cloth = make(VFIT_CLOTH_SKIN);
    ASSERT_EQ(vfit_cloth_begin_step(cloth, kOutfitStep_s), VFIT_OK) << contract::last_error();
    vfit_frame frame{};
    EXPECT_EQ(vfit_outfit_skin(&cloth, 1, &frame, nullptr), VFIT_OK) << contract::last_error();
    vfit_frame_release(frame);
    EXPECT_EQ(vfit_cloth_end_step(cloth), VFIT_OK);
}

TEST_F(OutfitTest, SkinBelowAnOutfitUsesTheFramesOfTheAvatar) {
    const vfit_cloth cloth = make();
    std::vector<vfit_frame> held(16);
    size_t count = 0;
    while (count < held.size() && vfit_outfit_skin(&cloth, 1, &held[count], nullptr) == VFIT_OK) ++count;
    ASSERT_GT(count, 2u);
    ASSERT_LT(count, held.size());
    EXPECT_EQ(vfit_outfit_skin(&cloth, 1, &held[count], nullptr), VFIT_ERROR_BUSY);
    EXPECT_EQ(held[count].id, 0u);
    vfit_frame_release(held[0]);
    EXPECT_EQ(vfit_outfit_skin(&cloth, 1, &held[0], nullptr), VFIT_OK) << contract::last_error();
    for (size_t i = 0; i < count; ++i) vfit_frame_release(held[i]);
}

TEST_F(OutfitTest, WhatIsNoOutfitIsRefused) {
    const vfit_cloth a = make(), b = make();
    uint32_t count = 7;
    const auto refused = [&](std::vector<vfit_cloth> cloths, vfit_result code, const char* word) {
        EXPECT_EQ(vfit_outfit_check(cloths.data(), uint32_t(cloths.size()), nullptr, 0, &count), code);
        EXPECT_NE(contract::last_error().find(word), std::string::npos) << contract::last_error();
        vfit_frame frame{7};
        EXPECT_EQ(vfit_outfit_skin(cloths.data(), uint32_t(cloths.size()), &frame, nullptr), code);
        EXPECT_NE(contract::last_error().find(word), std::string::npos) << contract::last_error();
        EXPECT_EQ(frame.id, 0u);
    };
    refused({a, b, a}, VFIT_ERROR_ARGUMENT, "cloths 0 and 2 are the same");
    refused({a, {avatar.id}}, VFIT_ERROR_HANDLE, "");
    refused(std::vector<vfit_cloth>(65, a), VFIT_ERROR_ARGUMENT, "cloth_count 65");
    EXPECT_EQ(vfit_outfit_check(nullptr, 1, nullptr, 0, &count), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_outfit_check(&a, 0, nullptr, 0, &count), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_outfit_check(&a, 1, nullptr, 0, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(count, 7u);
    vfit_frame frame{};
    EXPECT_EQ(vfit_outfit_skin(nullptr, 1, &frame, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_outfit_skin(&a, 0, &frame, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_outfit_skin(&a, 1, nullptr, nullptr), VFIT_ERROR_ARGUMENT);
    std::vector<vfit_crossing> none(1);
    const vfit_cloth both[] = {a, b};
    count = 0;
    EXPECT_EQ(vfit_outfit_check(both, 2, none.data(), sizeof(vfit_crossing), &count), VFIT_ERROR_CAPACITY);
    EXPECT_EQ(count, 1u);
    avatar = make_avatar();
    refused({a, make()}, VFIT_ERROR_ARGUMENT, "another avatar");
}

}  // namespace
