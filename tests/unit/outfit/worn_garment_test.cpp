// A worn garment: its steps on a body that moves, jumps of the body, changes of size and refusals.
#include "outfit/worn_garment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cloth/crossings.h"
#include "people.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

constexpr Vec3 kJumpWay(0.4f, 0.0f, 0.2f), kStepWay(0.02f, 0.0f, 0.0f);

class WornGarmentTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
};

/// The largest distance between the vertices of one and those of the other, moved by `way`.
float distance_m(const WornGarment& a, const WornGarment& b, const Vec3& way = {}) {
    float max_m = 0.0f;
    for (size_t v = 0; v < a.positions().size(); ++v)
        max_m = std::max(max_m, glm::length(a.positions()[v] + way - b.positions()[v]));
    return max_m;
}

TEST_F(WornGarmentTest, IsHeldNearShouldersOrWaistAndPinnedNowhere) {
    const Person man(VFIT_SEX_MALE);
    for (const auto& [name, slides_m] :
         {std::pair("shirt_men", 0.01f), std::pair("pants_men", 0.002f), std::pair("sundress", 0.005f)}) {
        const WearableGarment garment = wearable(name);
        const Dress dress(garment.garment(), garment.bound(0, *jobs), garment.material(), man.wearer.body());
        EXPECT_TRUE(dress.fabric()->kinematic_vertices().empty()) << name;
        std::vector<uint8_t> is_held(dress.rest().size(), 0), is_tied(is_held);
        for (const uint32_t v : dress.held()) is_held[v] = 1;
        EXPECT_GT(dress.held().size(), 20u) << name;
        float carries_n = 0.0f;
        for (const DistanceLimit& limit : dress.fabric()->data().limits) {
            if (!is_held[limit.target]) continue;  // a hem
            is_tied[limit.vertex] = 1;
            const bool holds = is_held[limit.vertex] != 0;
            EXPECT_TRUE(holds ? limit.distance_m == slides_m : limit.distance_m > slides_m) << name;
            if (holds) carries_n += limit.pull_m_s2 / dress.fabric()->data().inverse_mass[limit.vertex];
        }
        float weight_n = 0.0f;
        for (const float inverse_mass : dress.fabric()->data().inverse_mass) weight_n += 9.81f / inverse_mass;
        EXPECT_NEAR(carries_n / weight_n, 2.0f, 1e-3f) << name;
        EXPECT_EQ(std::count(is_tied.begin(), is_tied.end(), 0), 0) << name;
    }
}

TEST_F(WornGarmentTest, InASquatWhatHangsGoesBeyondItsReachAndComesBack) {
    Person man(VFIT_SEX_MALE);
    const WearableGarment trousers = wearable("pants_men");
    WearOptions options;
    options.on_skin = true;
    options.cloth.self_thickness_m = 0.004f;
    WornGarment worn(trousers, man.wearer, options, *jobs);
    const Dress dress(trousers.garment(), trousers.bound(0, *jobs), trousers.material(), man.wearer.body());
    const auto bent = [&](float share) {
        Pose pose;
        const Vec3 hips = man.avatar.skeleton().offset[VFIT_BONE_HIPS];
        pose.hips_position = hips;
        for (const vfit_bone_id leg : {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG})
            pose.rotation[leg] = glm::angleAxis(-2.0f * share, Vec3(1, 0, 0));
        for (const vfit_bone_id leg : {VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG})
            pose.rotation[leg] = glm::angleAxis(2.2f * share, Vec3(1, 0, 0));
        man.avatar.move(pose);
    };
    const auto beyond_m = [&] {
        std::vector<Vec3> targets;
        Dress::Scratch scratch;
        dress.place(man.avatar.skinning_matrices(), targets, scratch, *jobs);
        float max_m = 0.0f;
        for (const DistanceLimit& limit : dress.fabric()->data().limits)
            max_m = std::max(max_m, glm::distance(worn.positions()[limit.vertex], targets[limit.target]) -
                                        limit.distance_m);
        return max_m;
    };
    for (int i = 0; i < 60; ++i) step(worn);
    const float standing_m = beyond_m();
    for (int i = 1; i <= 60; ++i) bent(float(i) / 60.0f), step(worn);
    for (int i = 0; i < 30; ++i) step(worn);
    EXPECT_GT(beyond_m(), 0.025f) << "the trousers are too short there";
    EXPECT_LT(worn.stats().strain_p99, 0.2f);
    for (int i = 59; i >= 0; --i) bent(float(i) / 60.0f), step(worn);
    for (int i = 0; i < 60; ++i) step(worn);
    EXPECT_NEAR(beyond_m(), standing_m, 0.002f);
}

/// The longest edge between two vertices that hold it, as a fraction of its length on the body at rest.
float stretch_of_held(const Dress& dress, const std::vector<Vec3>& places) {
    std::vector<uint8_t> holds(dress.rest().size(), 0);
    for (const uint32_t v : dress.held()) holds[v] = 1;
    float longest = 0.0f;
    for (const DistanceConstraint& e : dress.fabric()->data().edges)
        if (holds[e.a] && holds[e.b])
            longest = std::max(longest, glm::distance(places[e.a], places[e.b]) /
                                            glm::distance(dress.rest()[e.a], dress.rest()[e.b]));
    return longest;
}

TEST_F(WornGarmentTest, ABodiceStretchesLessThanTheSkinAndABandOnShouldersGoesWithIt) {
    Person woman(VFIT_SEX_FEMALE);
    Pose raised;
    raised.hips_position = woman.avatar.skeleton().offset[VFIT_BONE_HIPS];
    raised.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(1.2f, Vec3(0, 0, 1));
    woman.avatar.move(raised);
    for (const bool is_bodice : {true, false}) {
        const WearableGarment garment = wearable(is_bodice ? "sundress" : "shirt_men");
        const Dress dress(garment.garment(), garment.bound(0, *jobs), garment.material(),
                          woman.wearer.body());
        std::vector<Vec3> places;
        Dress::Scratch scratch;
        dress.place(woman.avatar.skinning_matrices(), places, scratch, *jobs);
        const float of_skin = stretch_of_held(dress, places);
        EXPECT_GT(of_skin, 1.35f);
        dress.follow(woman.avatar.skinning_matrices(), places, scratch, *jobs);
        if (is_bodice)
            EXPECT_LT(stretch_of_held(dress, places), 1.25f) << "of the skin " << of_skin;
        else
            EXPECT_FLOAT_EQ(stretch_of_held(dress, places), of_skin);
    }
}

/// Wide legs that begin through each other, where thighs touch, stay so.
TEST_F(WornGarmentTest, WhatIsPutOnDoesNotCrossItself) {
    WearOptions options;
    options.cloth.self_thickness_m = 0.004f;
    options.on_skin = true;
    for (const auto& [sex, weight] : {std::pair(VFIT_SEX_MALE, 1.1f), std::pair(VFIT_SEX_FEMALE, 1.15f)}) {
        const Person person(sex, "weight", weight);
        for (const char* name : {"martial_pants", "pants_men", "flight_suit"}) {
            const WearableGarment garment = wearable(name);
            WornGarment worn(garment, person.wearer, options, *jobs);
            alone(worn).put_on();
            EXPECT_EQ(crossed_triangles(worn.positions(), worn.dress().indices()).size(), 0u)
                << name << " " << weight;
        }
    }
}

TEST_F(WornGarmentTest, AJumpOfTheBodyCarriesTheCloth) {
    const WearableGarment dress = wearable("sundress");
    Person moves(VFIT_SEX_FEMALE), stays(VFIT_SEX_FEMALE);
    WornGarment jumps(dress, moves.wearer, {}, *jobs), hangs(dress, stays.wearer, {}, *jobs);
    for (int i = 0; i < 10; ++i) step(jumps), step(hangs);
    EXPECT_EQ(jumps.state_hash(), hangs.state_hash());
    moves.stand_at(kJumpWay);
    step(jumps), step(hangs);
    EXPECT_LT(distance_m(hangs, jumps, kJumpWay), 1e-3f) << "far enough to be a jump";
    moves.stand_at(kJumpWay + kStepWay);
    jumps.teleport();
    step(jumps, 0.0f);  // moves nothing, and the jump is still to come
    EXPECT_LT(distance_m(hangs, jumps, kJumpWay), 1e-3f);
    step(jumps), step(hangs);
    EXPECT_LT(distance_m(hangs, jumps, kJumpWay + kStepWay), 1e-3f) << "declared to be one";
    for (const Vec3& at : {kJumpWay, kJumpWay + kStepWay}) {
        moves.stand_at(at);
        step(jumps), step(hangs);
    }
    EXPECT_GT(distance_m(hangs, jumps, kJumpWay + kStepWay), 5e-3f)
        << "a step like others: the cloth lags behind";
}

TEST_F(WornGarmentTest, SpeedThatIsGainedFromStepToStepIsNoJump) {
    const WearableGarment dress = wearable("sundress");
    WearOptions options;
    options.cloth.carry_way_m = INFINITY;  // speed alone
    const float step_m = 0.7f * kCarrySpeed_m_s / 60.0f;
    for (const bool at_once : {true, false}) {
        Person one(VFIT_SEX_FEMALE), other(VFIT_SEX_FEMALE);
        WornGarment worn(dress, one.wearer, options, *jobs), carried(dress, other.wearer, options, *jobs);
        const auto go_to = [&](float x) {
            one.stand_at({x, 0, 0}), other.stand_at({x, 0, 0});
            step(worn), step(carried);
        };
        for (int i = 0; i < 10; ++i) go_to(0.0f);
        if (!at_once) go_to(step_m);
        EXPECT_EQ(worn.state_hash(), carried.state_hash());
        carried.teleport();
        go_to((at_once ? 2.0f : 3.0f) * step_m);
        EXPECT_EQ(worn.state_hash() == carried.state_hash(), at_once);
    }
}

TEST_F(WornGarmentTest, BodyMotionIsFeltInTheGivenFraction) {
    const WearableGarment dress = wearable("sundress");
    Person moves(VFIT_SEX_FEMALE), stays(VFIT_SEX_FEMALE);
    WearOptions options;
    options.cloth.inertia = 0.0f;
    WornGarment carried(dress, moves.wearer, options, *jobs), hangs(dress, stays.wearer, options, *jobs);
    for (int i = 1; i <= 5; ++i) {
        moves.stand_at(float(i) * kStepWay);
        step(carried), step(hangs);
    }
    EXPECT_LT(distance_m(hangs, carried, 5.0f * kStepWay), 1e-3f);
}

TEST_F(WornGarmentTest, ARefusedSizeRollsBackCompletely) {
    const WearableGarment vest = wearable("vest");
    Person tall(VFIT_SEX_MALE, "height", 0.72f);
    WearOptions options;
    options.on_skin = true;
    options.size = "XXL";
    WornGarment refuses(vest, tall.wearer, options, *jobs), twin(vest, tall.wearer, options, *jobs);
    const auto step_both = [&](const Vec3& place) {
        tall.stand_at(place);
        step(refuses), step(twin);
    };
    const auto expect_equal = [&](const char* when) {
        EXPECT_EQ(refuses.state_hash(), twin.state_hash()) << when;
        EXPECT_EQ(refuses.finished().positions(), twin.finished().positions()) << when;
        EXPECT_EQ(refuses.tightness(), twin.tightness()) << when;
        const auto a = refuses.fit(), b = twin.fit();
        ASSERT_EQ(a.size(), b.size());
        for (size_t i = 0; i < a.size(); ++i) {
            EXPECT_EQ(a[i].girth.garment_m, b[i].girth.garment_m) << when;
            EXPECT_EQ(a[i].verdict, b[i].verdict) << when;
        }
    };
    for (int i = 1; i <= 5; ++i) step_both(float(i) * kStepWay);
    step_both(kJumpWay);
    tall.stand_at(kJumpWay + kStepWay);  // a pose that no step has seen
    EXPECT_NE(error_of([&] { refuses.in_size("XS"); }).find("does not close in size XS: chest_girth_m"),
              std::string::npos);
    EXPECT_NE(error_of([&] { refuses.in_size("huge"); }).find("no size \"huge\""), std::string::npos);
    WornGarment::Resized too_small = refuses.in_size("M");
    const std::string why = error_of([&] { alone(refuses).change_to(refuses, std::move(too_small)); });
    EXPECT_NE(why.find("garment vest is too small in size M"), std::string::npos) << why;
    expect_equal("after the refusal");
    step_both(kJumpWay + kStepWay);
    expect_equal("after a step: what the cloth felt of the jump before is known still");
    step_both({});
    expect_equal("after a jump");
}

TEST_F(WornGarmentTest, ASizeThatFitsIsWornFromHowTheOldOneHung) {
    const WearableGarment dress = wearable("sundress_pattern");
    Person she(VFIT_SEX_FEMALE);
    WearOptions options;
    options.size = "S";
    WornGarment worn(dress, she.wearer, options, *jobs);
    options.size = "XL";
    WornGarment large(dress, she.wearer, options, *jobs);
    const auto waist_m = [](const WornGarment& of) {
        for (const auto& zone : of.fit())
            if (zone.girth.key == "waist_girth_m") return zone.girth.garment_m;
        return 0.0f;
    };
    const float small_m = waist_m(worn);
    alone(worn).change_to(worn, worn.in_size("XL"));
    for (int i = 0; i < 60; ++i) step(worn), step(large);
    EXPECT_GT(waist_m(worn), small_m + 0.2f);
    EXPECT_NEAR(waist_m(worn), waist_m(large), 0.02f);
}

TEST_F(WornGarmentTest, OneThatIsTooSmallIsNotWornUnlessAnyFitIs) {
    const WearableGarment vest = wearable("vest");
    Person tall(VFIT_SEX_MALE, "height", 0.72f);
    for (const auto& [label, why] : {std::pair("XS", "does not close"), std::pair("M", "is too small")}) {
        WearOptions options;
        options.size = label;
        EXPECT_NE(error_of([&] { WornGarment(vest, tall.wearer, options, *jobs); }).find(why),
                  std::string::npos)
            << label;
        options.any_fit = true;
        WornGarment worn(vest, tall.wearer, options, *jobs);
        EXPECT_EQ(error_of([&] { alone(worn).change_to(worn, worn.in_size(label)); }), "");
    }
}

TEST_F(WornGarmentTest, AStepIsReskinnedWithTheBody) {
    const WearableGarment dress = wearable("sundress");
    Person she(VFIT_SEX_FEMALE);
    WearOptions options;
    options.cloth.pressure = true;
    WornGarment worn(dress, she.wearer, options, *jobs);
    for (int i = 0; i < 5; ++i) step(worn);
    const uint64_t before = worn.state_hash();
    for (const Vec3& way : {Vec3(0.0f), kJumpWay, Vec3(0.0f)}) {
        she.stand_at(way);
        const auto [positions, normals] = worn.reskin();
        for (size_t v = 0; v < positions.size(); ++v) {
            ASSERT_LT(glm::length(positions[v] - way - worn.finished().positions()[v]), 1e-5f) << v;
            ASSERT_LT(glm::length(normals[v] - worn.finished().normals()[v]), 1e-3f) << v;
        }
    }
    EXPECT_EQ(worn.state_hash(), before);
    EXPECT_EQ(worn.finished().pressure().size(), worn.positions().size());
}

TEST_F(WornGarmentTest, ItHidesSkinOfTheBodyThatWearsIt) {
    const WearableGarment dress = wearable("sundress");
    Person she(VFIT_SEX_FEMALE);
    WornGarment worn(dress, she.wearer, {}, *jobs);
    const std::vector<uint8_t> most = worn.hidden_skin(0.0f), less = worn.hidden_skin(0.05f);
    ASSERT_EQ(most.size(), she.wearer.indices().size() / 3);
    const auto count = [](const std::vector<uint8_t>& flags) {
        return std::count(flags.begin(), flags.end(), uint8_t(1));
    };
    EXPECT_GT(count(less), 100);
    EXPECT_GT(count(most), count(less));
}

}  // namespace
}  // namespace vfit
