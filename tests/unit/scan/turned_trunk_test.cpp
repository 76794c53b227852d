// The trunk of a person who turned round: sections by views of a known form, and of a body.
#include "scan/turned_trunk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "avatar/avatar_measures.h"
#include "geometry/section.h"
#include "math/random.h"
#include "scan/seen_measures.h"
#include "scan_people.h"

namespace vfit {
namespace {

/// A trunk whose sections are superellipses, deeper behind than before, growing upwards.
struct Form {
    float half_breadth = 0.17f, before = 0.11f, behind = 0.13f, power = 2.6f, grows = 0.1f;
    float bust = 0.0f, bust_at = 0.6f;  // stands out so far before that level

    /// Person's axes: to the side x, ahead y.
    std::vector<Vec2> section(int level) const {
        constexpr int kPoints = 720;
        const float along = TrunkProfile::along(level), size = 1.0f + grows * along;
        const float from = (along - bust_at) / 0.06f;
        std::vector<Vec2> out;
        for (int i = 0; i < kPoints; ++i) {
            const float c = std::cos(2.0f * kPi * float(i) / kPoints),
                        s = std::sin(2.0f * kPi * float(i) / kPoints);
            const auto part = [&](float v) { return std::copysign(std::pow(std::abs(v), 2.0f / power), v); };
            const float depth = s > 0.0f ? before + bust * std::exp(-from * from) : behind;
            out.emplace_back(size * half_breadth * part(c), size * depth * part(s));
        }
        return out;
    }
    float girth_m(int level) const { return hull_perimeter(section(level)); }
};

/// What body fitting is off by in a view.
struct Slip {
    float across = 0.0f, towards = 0.0f, turned = 0.0f;
    float leans_across = 0.0f, leans_towards = 0.0f;  // from hips to neck
};

TrunkView view_of(const Form& form, float facing, const Slip& slip = {}) {
    TrunkView view;
    view.facing_rad = facing;
    const float c = std::cos(facing + slip.turned), s = std::sin(facing + slip.turned);
    for (int l = 0; l < TrunkView::kLevels; ++l) {
        const float lean = TrunkProfile::along(l) - 0.3f,
                    slip_across = slip.across + lean * slip.leans_across,
                    slip_towards = slip.towards + lean * slip.leans_towards;
        std::vector<Vec2> points = form.section(l);  // across and towards the camera
        for (Vec2& p : points) p = {p.x * c + p.y * s, p.y * c - p.x * s};
        auto& towards = view.towards_m[size_t(l)];
        towards.fill(std::nanf(""));
        float left = 0.0f, right = 0.0f;
        for (size_t i = 0; i < points.size(); ++i) {
            const Vec2 a = points[i], b = points[(i + 1) % points.size()];
            left = std::min(left, a.x), right = std::max(right, a.x);
            for (int column = 0; column < TrunkView::kColumns; ++column) {
                const float across = TrunkView::across_m(column) + slip_across;
                if ((a.x > across) == (b.x > across)) continue;
                const float here = std::lerp(a.y, b.y, (across - a.x) / (b.x - a.x)) - slip_towards;
                towards[size_t(column)] = std::fmax(towards[size_t(column)], here);
            }
        }
        view.reach_m[size_t(l)] = {-left + slip_across, right - slip_across};
        view.aside_rad[size_t(l)].fill(0.0f);
    }
    return view;
}

constexpr int kWays = 24;

std::vector<TrunkView> turn_of(const Form& form, float slips = 1.0f) {
    Random random(5);
    std::vector<TrunkView> views;
    const auto within = [&](float range) { return slips * range * random.between(-1.0f, 1.0f); };
    for (int way = 0; way < kWays; ++way)
        views.push_back(
            view_of(form, 2.0f * kPi * float(way) / kWays,
                    {within(0.015f), within(0.015f), within(0.04f), within(0.03f), within(0.03f)}));
    return views;
}

TEST(TurnedTrunk, SectionsAreMetThoughEveryViewIsMisplaced) {
    for (const Form& form :
         {Form{}, Form{0.14f, 0.09f, 0.09f, 2.0f}, Form{0.21f, 0.20f, 0.14f, 3.5f, -0.1f}}) {
        const TurnedTrunk trunk(turn_of(form));
        for (const int level : {4, 10, 16, 22})
            EXPECT_NEAR(trunk.girth_m(TrunkProfile::along(level)), form.girth_m(level), 0.004f) << level;
    }
}

TEST(TurnedTrunk, AllViewsTooFarOutAreDrawnBackByTheirOutlines) {
    const Form form;
    std::vector<TrunkView> views;
    for (int way = 0; way < kWays; ++way)
        views.push_back(view_of(form, 2.0f * kPi * float(way) / kWays, {0.0f, -0.015f, 0.0f}));
    EXPECT_NEAR(TurnedTrunk(views).girth_m(TrunkProfile::along(10)), form.girth_m(10), 0.004f);
}

TEST(TurnedTrunk, WhatEachSensorLosesOfOutlinesIsAdded) {
    const Form form;
    std::vector<TrunkView> blind = turn_of(form);
    for (size_t way = 0; way < blind.size(); ++way) {
        blind[way].outline_loss_m = way < blind.size() / 2 ? 0.012f : 0.002f;
        for (auto& level : blind[way].reach_m)
            for (float& reach : level) reach -= blind[way].outline_loss_m;
    }
    std::vector<TrunkView> alike = blind, none = blind;
    for (TrunkView& view : alike) view.outline_loss_m = 0.007f;
    for (TrunkView& view : none) view.outline_loss_m = 0.0f;
    const auto girth_m = [](const std::vector<TrunkView>& views) {
        return TurnedTrunk(views).girth_m(TrunkProfile::along(10));
    };
    EXPECT_NEAR(girth_m(blind), form.girth_m(10), 0.004f);
    EXPECT_LT(girth_m(none), girth_m(blind) - 0.004f);
    EXPECT_NE(girth_m(alike), girth_m(blind));
}

TEST(TurnedTrunk, OutlinesAloneMeetTheHull) {
    Form form;
    form.half_breadth = 0.20f, form.before = 0.10f, form.behind = 0.10f;  // a view that is turned is seen
    std::vector<TrunkView> views = turn_of(form);
    for (TrunkView& view : views)
        for (auto& level : view.towards_m) level.fill(std::nanf(""));
    EXPECT_NEAR(TurnedTrunk(views).girth_m(TrunkProfile::along(10)), form.girth_m(10), 0.01f);
}

TEST(TurnedTrunk, FourViewsSuffice) {
    for (const Form& form : {Form{}, Form{0.14f, 0.09f, 0.09f, 2.0f}, Form{0.19f, 0.16f, 0.14f, 3.0f}}) {
        const std::vector<TrunkView> all = turn_of(form);
        std::vector<TrunkView> views;
        for (size_t way = 0; way < all.size(); way += 6) views.push_back(all[way]);
        const TurnedTrunk trunk(views);
        for (const int level : {4, 10, 16})
            EXPECT_NEAR(trunk.girth_m(TrunkProfile::along(level)), form.girth_m(level), 0.004f) << level;
    }
}

TEST(TurnedTrunk, AnOutlineThatNoReadingSupportsMakesNoSpike) {
    const Form form;
    const std::vector<TrunkView> all = turn_of(form);
    std::vector<TrunkView> views = {all[0], all[6], all[12], all[18]};
    constexpr size_t kLevel = 10;
    for (TrunkView& view : views) {  // readings of the middle alone, and one outline, of a sleeve
        for (size_t column = 0; column < size_t(TrunkView::kColumns); ++column)
            if (column < 22 || column > 37) view.towards_m[kLevel][column] = std::nanf("");
        view.reach_m[kLevel].fill(std::nanf(""));
    }
    views[0].reach_m[kLevel][TrunkView::kRightOfPicture] = 0.30f;
    EXPECT_NEAR(TurnedTrunk(views).girth_m(TrunkProfile::along(int(kLevel))), form.girth_m(int(kLevel)),
                0.02f)
        << "0.15 m more where radii are not held to their neighbours";
}

TEST(TurnedTrunk, StrayReadingsHardlyCount) {
    const Form form;
    std::vector<TrunkView> views = turn_of(form);
    for (size_t way = 0; way < views.size(); way += 6)  // an arm before the trunk
        for (auto& level : views[way].towards_m)
            for (size_t column = 28; column < 34; ++column) level[column] += 0.08f;
    EXPECT_NEAR(TurnedTrunk(views).girth_m(TrunkProfile::along(10)), form.girth_m(10), 0.008f);
}

TEST(TurnedTrunk, LevelsBetweenAreBetween) {
    const Form form;
    const TurnedTrunk trunk(turn_of(form));
    const float low = TrunkProfile::along(10), high = TrunkProfile::along(11);
    EXPECT_NEAR(trunk.girth_m(std::lerp(low, high, 0.25f)),
                std::lerp(trunk.girth_m(low), trunk.girth_m(high), 0.25f), 1e-5f);
    EXPECT_TRUE(std::isnan(trunk.girth_m(TrunkProfile::along(0)))) << "two legs";
    EXPECT_TRUE(std::isnan(trunk.girth_m(0.9f)));
    EXPECT_TRUE(std::isnan(trunk.girth_m(std::nanf(""))));
    EXPECT_NEAR(trunk.largest_girth_m(0.0f, 0.5f), form.girth_m(15), 0.006f) << "it grows upwards";
}

TEST(TurnedTrunk, NothingSeenIsNotGuessed) {
    const Form form;
    const TurnedTrunk none({});
    EXPECT_TRUE(std::isnan(none.girth_m(0.3f)));
    EXPECT_TRUE(std::isnan(none.largest_girth_m(0.0f, 0.5f)));
    EXPECT_TRUE(std::isnan(none.bust(0.45f, 0.75f)));
    std::vector<TrunkView> blind = turn_of(form);
    for (TrunkView& view : blind) {
        for (auto& level : view.towards_m) level.fill(std::nanf(""));
        for (auto& level : view.reach_m) level.fill(std::nanf(""));
    }
    EXPECT_TRUE(std::isnan(TurnedTrunk(blind).girth_m(0.3f)));
    std::vector<TrunkView> front = turn_of(form);
    front.resize(4);
    EXPECT_TRUE(std::isnan(TurnedTrunk(front).girth_m(0.3f))) << "the back is open";
}

TEST(TurnedTrunk, TheBustIsWhereTheFrontStandsOut) {
    Form form;
    form.bust = 0.04f, form.bust_at = 0.61f;
    const TurnedTrunk trunk(turn_of(form));
    EXPECT_NEAR(trunk.bust(0.45f, 0.75f), 0.61f, 0.012f);
    form.bust = -0.03f;
    EXPECT_TRUE(std::isnan(TurnedTrunk(turn_of(form)).bust(0.45f, 0.75f))) << "nothing stands out";
    const SeenMeasures woman = seen_measures(trunk, true);
    EXPECT_NEAR(woman.chest_girth_m, trunk.girth_m(trunk.bust(0.45f, 0.75f)), 1e-5f);
    EXPECT_TRUE(std::isnan(woman.stature_m));
}

TEST(TurnedTrunk, AMansChestIsTheLargestGirthBelowTheArmpits) {
    Form form;
    form.grows = 0.3f;
    std::vector<TrunkView> views = turn_of(form);
    for (TrunkView& view : views)
        for (float& towards : view.towards_m[20]) towards += 0.05f;  // arms that are taken for the trunk
    const float along =
        (0.678f - TrunkProfile::along(19)) / (TrunkProfile::along(20) - TrunkProfile::along(19));
    EXPECT_NEAR(seen_measures(TurnedTrunk(views), false).chest_girth_m,
                std::lerp(form.girth_m(19), form.girth_m(20), along), 0.006f);
}

/// A person who turns once round in steps of 15 degrees to that side, 1 their left, or takes some of them.
TurnedTrunk turned(Avatar& avatar, float arms_rad, float side = 1.0f, int steps = kWays) {
    BodyScan scan(fit_model());
    int64_t time_ns = 0;
    const auto add = [&](float turned_rad, const auto& take) {
        Stance stance;
        stance.turned_rad = turned_rad, stance.arms_rad = arms_rad;
        const FitScene scene = standing_person(avatar, stance);
        Body body = scene.joints;
        body.time_ns = time_ns += 33333333;
        take(scene.image(), body);
    };
    for (int i = 0; i < 4; ++i)
        add(0.0f, [&](const auto& image, const Body& body) { scan.add(image, body); });
    for (int way = 0; way < steps; ++way)
        add(side * float(way) * kPi / 12.0f, [&](const auto& image, const Body& body) {
            ASSERT_TRUE(scan.fit_turning(image, body)) << way;
            scan.keep_turning(image, body);
        });
    return scan.turned_trunk();
}

TEST(TurnedTrunk, TheGirthIsThatOfATapeWhateverTheBody) {
    for (const auto& components : {std::vector<float>{}, {2.0f}, {-1.0f, 1.5f}}) {
        Avatar avatar(body_model(), {}, shape_of(components), Vec2(1.0f));
        const auto tape = measure_avatar(avatar, VFIT_SEX_FEMALE);
        const SeenMeasures seen = seen_measures(turned(avatar, 0.75f), true);
        EXPECT_NEAR(seen.chest_girth_m, find(tape, "chest_girth_m")->value, 0.02f);
        EXPECT_NEAR(seen.waist_girth_m, find(tape, "waist_girth_m")->value, 0.015f);
        EXPECT_NEAR(seen.hip_girth_m, find(tape, "hip_girth_m")->value, 0.015f);
    }
}

TEST(TurnedTrunk, ArmsAreNoPartOfIt) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    const TurnedTrunk wide = turned(avatar, 1.2f), low = turned(avatar, 0.6f);
    for (const float share : {0.05f, 0.2f, 0.33f, 0.45f, 0.55f})
        EXPECT_NEAR(low.girth_m(share), wide.girth_m(share), 0.015f) << share;
}

TEST(TurnedTrunk, ATurnToEitherSideTellsTheSame) {
    Avatar avatar(body_model(), {}, shape_of({2.0f}), Vec2(1.0f));
    const TurnedTrunk left = turned(avatar, 0.75f), right = turned(avatar, 0.75f, -1.0f);
    for (const float share : {0.05f, 0.2f, 0.33f, 0.45f, 0.6f})
        EXPECT_NEAR(left.girth_m(share), right.girth_m(share), 0.01f) << share;
}

TEST(TurnedTrunk, APartOfATurnIsNotTakenForAll) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    EXPECT_TRUE(std::isnan(turned(avatar, 0.75f, 1.0f, 4).girth_m(0.33f)));
}

}  // namespace
}  // namespace vfit
