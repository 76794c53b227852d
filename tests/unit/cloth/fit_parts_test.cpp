// What the fit of garments is made of: girths of a cut mesh, verdicts, hems, skin as cloth meets it,
// crossings.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/crossings.h"
#include "cloth/garment/fit.h"
#include "cloth/garment/hems.h"
#include "cloth/garment/wrapped_skin.h"

namespace vfit {
namespace {

/// A tube about the Y axis: `columns` around, rows from y = 0 up; in the flat, that much wider than it lies.
struct Tube {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<Vec2> cut;

    Tube(float radius, float height, uint32_t columns, uint32_t rows, float wider,
         uint32_t open_columns = 0) {
        const float step = 2.0f * kPi * radius / float(columns);
        for (uint32_t r = 0; r <= rows; ++r)
            for (uint32_t c = 0; c < columns; ++c) {
                const float angle = 2.0f * kPi * float(c) / float(columns);
                positions.emplace_back(radius * std::sin(angle), height * float(r) / float(rows),
                                       radius * std::cos(angle));
            }
        const auto flat = [&](uint32_t c, uint32_t r) {
            return Vec2(float(c) * step * wider, height * float(r) / float(rows));
        };
        for (uint32_t r = 0; r < rows; ++r)
            for (uint32_t c = 0; c + open_columns < columns; ++c) {
                const uint32_t a = r * columns + c, b = r * columns + (c + 1) % columns, d = a + columns,
                               e = b + columns;
                indices.insert(indices.end(), {a, b, e, a, e, d});
                const Vec2 fa = flat(c, r), fb = flat(c + 1, r), fe = flat(c + 1, r + 1), fd = flat(c, r + 1);
                cut.insert(cut.end(), {fa, fb, fe, fa, fe, fd});
            }
    }
};

TEST(FitParts, AGirthIsThatOfTheFlatCloth) {
    const Tube tube(0.15f, 0.4f, 48, 10, 1.1f);
    const GirthLevel level{"waist_girth_m", 0.22f, 0.8f, 0.0f};
    const auto fits = fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1));
    ASSERT_EQ(fits.size(), 1u);
    const float around = 2.0f * 48.0f * 0.15f * std::sin(kPi / 48.0f);  // of the polygon
    EXPECT_NEAR(fits[0].garment_m, 1.1f * 2.0f * kPi * 0.15f, 0.002f);
    EXPECT_NEAR(fits[0].strain, around / fits[0].garment_m - 1.0f, 1e-3f);
    EXPECT_NEAR(fits[0].ease_m, fits[0].garment_m - 0.8f, 1e-6f);
    EXPECT_EQ(fits[0].opening_m, 0.0f);
}

TEST(FitParts, AGirthIsTapedAcrossTheFoldsThatItsLevelRunsThrough) {
    Tube tube(0.15f, 0.4f, 96, 80, 1.0f);
    for (Vec3& p : tube.positions)
        p.y += 0.015f * std::sin(12.0f * std::atan2(p.x, p.z));  // hangs in waves of 8 cm
    const GirthLevel level{"waist_girth_m", 0.22f, 0.9f, 0.0f};
    const auto fits = fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1));
    ASSERT_EQ(fits.size(), 1u);
    // Up and down in the flat, the level's own way is a fourth longer.
    EXPECT_NEAR(fits[0].garment_m, 2.0f * kPi * 0.15f, 0.006f);
}

TEST(FitParts, APieceThatIsCutRoundIsTapedRound) {
    Tube tube(0.15f, 0.4f, 96, 40, 1.0f);
    constexpr float kApex_m = 0.18f,
                    kRound_m = kApex_m + 0.22f;  // four gores of a cone: the level is an arc of that radius
    const float gore_m = 0.25f * 2.0f * kPi * 0.15f;
    for (size_t i = 0; i < tube.cut.size(); ++i) {
        const auto gore = float(i / 6 % 96 / 24);
        const float angle = (tube.cut[i].x - gore * gore_m) / kRound_m, radius = kApex_m + tube.cut[i].y;
        tube.cut[i] = Vec2(gore + radius * std::sin(angle), radius * std::cos(angle));
    }
    const GirthLevel level{"hip_girth_m", 0.22f, 0.9f, 0.0f};
    const auto fits = fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1));
    ASSERT_EQ(fits.size(), 1u);
    // Straight across each gore it would be 0.986 of that.
    EXPECT_NEAR(fits[0].garment_m / (2.0f * kPi * 0.15f), 1.0f, 0.008f);
}

TEST(FitParts, TheLineThroughTheCrotchIsStretchedWhereTheBodyIsDeeper) {
    // A sling from front to back: a row of squares in a U.
    constexpr uint32_t kRows = 40;
    std::vector<Vec3> rest, deeper;
    std::vector<uint32_t> indices;
    std::vector<Vec2> cut;
    const auto along = [](uint32_t r, float depth) {
        const float angle = kPi * float(r) / float(kRows);
        return Vec3(0.0f, 1.0f - depth * std::sin(angle), 0.1f * std::cos(angle));
    };
    for (uint32_t r = 0; r <= kRows; ++r)
        for (const float x : {-0.05f, 0.05f})
            rest.push_back(along(r, 0.3f) + Vec3(x, 0, 0)), deeper.push_back(along(r, 0.36f) + Vec3(x, 0, 0));
    float way = 0.0f;
    for (uint32_t r = 0; r < kRows; ++r) {
        const float next = way + glm::length(along(r + 1, 0.3f) - along(r, 0.3f));
        const uint32_t a = 2 * r;
        indices.insert(indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
        cut.insert(cut.end(), {Vec2(0, way), Vec2(0.1f, way), Vec2(0.1f, next), Vec2(0, way),
                               Vec2(0.1f, next), Vec2(0, next)});
        way = next;
    }
    const CrotchLine as_cut = crotch_line({rest, indices, cut, {}, {}}, rest),
                     pulled = crotch_line({rest, indices, cut, {}, {}}, deeper);
    EXPECT_NEAR(as_cut.garment_m, way, 1e-4f);
    EXPECT_NEAR(as_cut.strain, 0.0f, 1e-3f);
    float wanted = 0.0f;
    for (uint32_t r = 0; r < kRows; ++r) wanted += glm::length(along(r + 1, 0.36f) - along(r, 0.36f));
    EXPECT_NEAR(pulled.strain, wanted / way - 1.0f, 1e-3f);
    const Tube skirt(0.15f, 0.4f, 48, 10, 1.0f);  // ends in a hem, in front and behind
    EXPECT_EQ(crotch_line({skirt.positions, skirt.indices, skirt.cut, {}, {}}, skirt.positions).garment_m,
              0.0f);
}

TEST(FitParts, AnOpenFrontIsToldApart) {
    const Tube tube(0.15f, 0.4f, 48, 10, 1.0f, 4);
    const GirthLevel level{"waist_girth_m", 0.22f, 0.95f, 0.0f};
    const auto fits = fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1));
    ASSERT_EQ(fits.size(), 1u);
    EXPECT_NEAR(fits[0].opening_m, 2.0f * 0.15f * std::sin(4.0f * kPi / 48.0f), 1e-3f);
    EXPECT_NEAR(fits[0].garment_m, 2.0f * kPi * 0.15f * 44.0f / 48.0f, 0.003f);
    EXPECT_EQ(needed_strain(fits, nullptr), 0.0f);  // what is open need not close
}

TEST(FitParts, AHemThatWaversAboutTheLevelIsNoGirth) {
    Tube tube(0.15f, 0.4f, 48, 40, 1.0f);
    for (size_t v = 0; v < tube.positions.size(); ++v)
        if (tube.positions[v].x > 0.12f) tube.positions[v].y += 0.05f;  // lifted at one side
    const GirthLevel level{"hip_girth_m", 0.02f, 0.9f, 0.0f};
    EXPECT_TRUE(fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1)).empty());
}

TEST(FitParts, ALevelThatTheGarmentDoesNotReachIsNone) {
    const Tube tube(0.15f, 0.4f, 48, 10, 1.0f);
    const GirthLevel level{"waist_girth_m", 0.6f, 0.8f, 0.0f};
    EXPECT_TRUE(fit_of({tube.positions, tube.indices, tube.cut, {}, {}}, std::span(&level, 1)).empty());
}

TEST(FitParts, TheStrainThatIsNeededIsTheGirthsWorst) {
    GirthFit waist, hip;
    waist.body_m = 0.8f, waist.garment_m = 0.9f;
    hip.body_m = 1.1f, hip.garment_m = 1.0f;
    const std::vector<GirthFit> fits{waist, hip};
    const GirthFit* at = nullptr;
    EXPECT_NEAR(needed_strain(fits, &at), 0.1f, 1e-5f);
    EXPECT_EQ(at, &fits[1]);
}

TEST(FitParts, VerdictsGoByTheGirthsOfTheSizes) {
    Garment g;
    for (const auto& [label, girth] : {std::pair("S", 0.86f), std::pair("M", 0.94f), std::pair("L", 1.04f)})
        g.sizes.push_back({label, {{"chest_girth_m", girth}}, {}});
    GirthFit fit;
    fit.key = "chest_girth_m";
    const auto verdict = [&](const char* label, float body) {
        fit.body_m = body;
        return judge_fit(g, label, fit);
    };
    EXPECT_EQ(verdict("M", 0.91f), Fit::right);
    EXPECT_EQ(verdict("M", 0.985f), Fit::right);
    EXPECT_EQ(verdict("M", 1.0f), Fit::tight);
    EXPECT_EQ(verdict("M", 0.89f), Fit::loose);
    EXPECT_EQ(verdict("L", 1.2f), Fit::tight);
    // Of a garment that tells of no such girth: by stretch and ease.
    fit.key = "hip_girth_m", fit.ease_m = 0.05f, fit.strain = 0.0f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::right);
    fit.strain = 0.05f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::tight);
    fit.strain = 0.0f, fit.ease_m = 0.2f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::loose);
}

TEST(FitParts, HemsAreTheBordersAtTheEndsOfLimbs) {
    const Tube tube(0.05f, 0.4f, 12, 10, 1.0f);
    std::vector<BodyPart> below(tube.positions.size(), BodyPart::kLeftUpperArm);
    for (uint32_t v = 0; v < 24; ++v) below[v] = BodyPart::kLeftForearm;
    std::vector<uint8_t> simulated(tube.positions.size(), 1);
    for (uint32_t v = 120; v < 132; ++v) simulated[v] = 0;
    const auto hems = limb_hems(tube.indices, below, simulated, tube.positions);
    ASSERT_EQ(hems.size(), 1u);
    EXPECT_TRUE(hems[0].of_arm);
    EXPECT_EQ(hems[0].vertices.size(), 12u);
    for (const uint32_t v : hems[0].vertices) EXPECT_LT(v, 12u);
    EXPECT_NEAR(hems[0].way_m, 0.4f, 0.01f);
}

/// A sleeve that hangs on its upper border, on a limb that is shorter by some share.
struct Sleeve {
    Tube tube{0.05f, 0.4f, 12, 10, 1.0f};
    std::vector<uint8_t> simulated = std::vector<uint8_t>(tube.positions.size(), 1);
    std::vector<LimbHem> hems;

    explicit Sleeve(float limb) {
        for (uint32_t v = 120; v < 132; ++v) simulated[v] = 0;
        std::vector<Vec3> carried = tube.positions;
        for (Vec3& p : carried) p.y *= limb;
        hems = limb_hems(tube.indices, std::vector<BodyPart>(tube.positions.size(), BodyPart::kLeftForearm),
                         simulated, carried);
        std::erase_if(hems, [&](const LimbHem& hem) { return hem.vertices[0] >= 12; });
    }
    FabricData fabric(const std::vector<Vec2>& cut) const {
        return cook_fabric({tube.positions, tube.indices, {}, simulated, 1.0f, cut},
                           {0.2f, 1000.0f, 1000.0f, 50.0f, 2e-5f, 0.3f});
    }
};

TEST(FitParts, HemsAreKeptWhereTheClothIsLongerThanTheLimb) {
    for (const float limb : {1.0f, 0.9f}) {
        const Sleeve sleeve(limb);
        FabricData fabric = sleeve.fabric(sleeve.tube.cut);
        keep_hems(sleeve.hems, fabric);
        EXPECT_EQ(fabric.limits.size(), limb < 1.0f ? 12u : 0u);
    }
}

TEST(FitParts, SleevesThatAreTooLongAreTakenUpAndKeepTheirGirth) {
    const Sleeve fits(1.0f), shorter(0.75f);
    std::vector<Vec2> cut = fits.tube.cut;
    const TakenUp none = take_up(fits.hems, fits.tube.indices, fits.simulated, cut);
    EXPECT_EQ(none.sleeves_m, 0.0f);
    EXPECT_EQ(cut, fits.tube.cut);
    const TakenUp taken = take_up(shorter.hems, shorter.tube.indices, shorter.simulated, cut);
    EXPECT_NEAR(taken.sleeves_m, 0.1f - 0.015f, 0.01f);
    EXPECT_EQ(taken.legs_m, 0.0f);
    const auto hem_of = [&](const std::vector<Vec2>& of) {
        float way = 0.0f;
        for (const Tether& t : shorter.fabric(of).tethers)
            way = t.vertex < 12 ? std::max(way, t.length_m) : way;
        return way;
    };
    EXPECT_NEAR(hem_of(shorter.tube.cut) - hem_of(cut), taken.sleeves_m, 0.015f);
    for (size_t i = 0; i < cut.size(); ++i) {  // sides around the arm
        const size_t n = i % 3 == 2 ? i - 2 : i + 1;
        const Vec2 before = shorter.tube.cut[n] - shorter.tube.cut[i];
        if (std::abs(before.y) < 1e-6f) {
            EXPECT_NEAR(glm::length(cut[n] - cut[i]), glm::length(before), 1e-5f);
        }
    }
}

TEST(FitParts, TheTightestOpeningIsTheOneThatIsStretched) {
    const Tube tube(0.05f, 0.4f, 48, 10, 1.0f);
    std::vector<Vec3> worn = tube.positions;
    for (uint32_t v = 0; v < 48; ++v) worn[v] = Vec3(1.2f * worn[v].x, worn[v].y, 1.2f * worn[v].z);
    const std::vector<uint8_t> all(worn.size(), 1);
    const Opening opening = tightest_opening({worn, tube.indices, tube.cut, {}, {}}, all);
    EXPECT_NEAR(opening.strain, 0.2f, 0.01f);
    EXPECT_NEAR(opening.garment_m, 2.0f * kPi * 0.05f, 0.01f);
    EXPECT_NEAR(opening.middle.y, worn[0].y, 1e-4f);
    std::vector<uint8_t> above = all;
    for (uint32_t v = 0; v < 48; ++v) above[v] = 0;  // that one slides
    EXPECT_LT(tightest_opening({worn, tube.indices, tube.cut, {}, {}}, above).strain, 0.01f);
}

TEST(FitParts, ATenthOfTheClothIsWhatIsMostStrained) {
    std::vector<float> strain(100, 0.01f);
    for (size_t i = 0; i < 9; ++i) strain[11 * i] = 0.5f;
    EXPECT_NEAR(most_strained(strain), 0.01f, 1e-6f);
    strain[1] = strain[2] = 0.5f;
    EXPECT_NEAR(most_strained(strain), 0.5f, 1e-6f);
    EXPECT_EQ(most_strained({}), 0.0f);
}

TEST(FitParts, SkinIsRaisedAroundABumpAndNeverLowered) {
    // A plate of 5 mm squares with a bump of one vertex, closed below.
    constexpr uint32_t kSide = 21;
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    for (const float y : {0.0f, -0.05f})
        for (uint32_t r = 0; r < kSide; ++r)
            for (uint32_t c = 0; c < kSide; ++c)
                positions.emplace_back(0.005f * float(c), y, 0.005f * float(r));
    const uint32_t bump = kSide * (kSide / 2) + kSide / 2;
    positions[bump].y = 0.01f;
    for (uint32_t r = 0; r + 1 < kSide; ++r)
        for (uint32_t c = 0; c + 1 < kSide; ++c) {
            const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1, below = kSide * kSide;
            indices.insert(indices.end(), {a, d, b, b, d, e, below + a, below + b, below + d, below + b,
                                           below + e, below + d});
        }
    const std::vector<Vec3> wrapped = wrapped_skin(positions, indices);
    for (uint32_t v = 0; v < kSide * kSide; ++v) EXPECT_GE(wrapped[v].y, positions[v].y - 1e-6f) << v;
    EXPECT_GT(wrapped[bump + 1].y, 0.002f);
    EXPECT_LT(wrapped[bump + 8].y, 0.002f);  // 4 cm away it is as it was, but for rounding
}

/// By how much the bottom of a groove in the middle of a block of 20 cm is raised.
float raised_in_groove(float half_width_m, float depth_m) {
    constexpr uint32_t kSide = 41;
    constexpr float kStep_m = 0.005f;
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    for (const float y : {0.0f, -0.1f})
        for (uint32_t r = 0; r < kSide; ++r)
            for (uint32_t c = 0; c < kSide; ++c) {
                const float x = kStep_m * float(c), aside = std::abs(x - 0.1f);
                const float groove = depth_m * std::min(0.0f, aside / half_width_m - 1.0f);
                positions.emplace_back(x, y == 0.0f ? groove : y, kStep_m * float(r));
            }
    for (uint32_t r = 0; r + 1 < kSide; ++r)
        for (uint32_t c = 0; c + 1 < kSide; ++c) {
            const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1, below = kSide * kSide;
            indices.insert(indices.end(), {a, d, b, b, d, e, below + a, below + b, below + d, below + b,
                                           below + e, below + d});
        }
    const uint32_t bottom = kSide * (kSide / 2) + kSide / 2;
    EXPECT_NEAR(positions[bottom].y, -depth_m, 1e-6f);
    return wrapped_skin(positions, indices)[bottom].y - positions[bottom].y;
}

TEST(FitParts, ADeepHollowOfTheSkinIsNotFilledUp) {
    // Straps lie in the groove: three quarters of its depth stay.
    for (const float depth_m : {0.03f, 0.06f}) {
        EXPECT_GT(raised_in_groove(0.02f, depth_m), 0.002f) << depth_m;
        EXPECT_LT(raised_in_groove(0.02f, depth_m), 0.25f * depth_m) << depth_m;
    }
    // An edge of cloth spans a groove that is narrower than the edge is long.
    EXPECT_GT(raised_in_groove(0.01f, 0.004f), 0.5f * 0.004f);
    EXPECT_LE(raised_in_groove(0.01f, 0.004f), 0.004f);
}

TEST(FitParts, AnEdgeOfClothOnARoundLimbStaysOutOfTheSkin) {
    constexpr float kEdge_m = 0.022f;
    for (const float radius_m : {0.027f, 0.05f, 0.15f}) {  // wrist, upper arm, thorax
        const Tube limb(radius_m, 0.2f, 96, 40, 1.0f);
        const uint32_t middle = 20 * 96;
        const Vec3 on = wrapped_skin(limb.positions, limb.indices)[middle];
        const float proxy_m = std::hypot(on.x, on.z);
        // Both ends on the proxy, the edge's middle is nearest to the axis.
        EXPECT_GE(std::sqrt(proxy_m * proxy_m - 0.25f * kEdge_m * kEdge_m), radius_m) << radius_m;
        const float sagitta_m = radius_m - std::sqrt(radius_m * radius_m - 0.25f * kEdge_m * kEdge_m);
        EXPECT_LT(proxy_m - radius_m, 1.2f * sagitta_m) << "no further off than the edge needs";
    }
}

TEST(FitParts, CrossingsAreFoundOnceAndNeighboursAreNone) {
    const std::vector<Vec3> positions{{0, 0, 0},          {1, 0, 0},          {0, 0, 1}, {0.2f, -0.5f, 0.2f},
                                      {0.3f, 0.5f, 0.2f}, {0.2f, 0.5f, 0.4f}, {1, 0, 1}};
    const std::vector<uint32_t> crossed{0, 1, 2, 3, 4, 5}, beside{0, 1, 2, 1, 6, 2};
    ASSERT_EQ(crossed_triangles(positions, crossed).size(), 1u);
    EXPECT_TRUE(crossed_triangles(positions, beside).empty());
    const std::vector<uint32_t> a{0, 1, 2}, b{3, 4, 5, 1, 6, 2};
    const auto pairs = crossed_triangles({positions, a}, {positions, b});
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0], std::pair(0u, 0u));
}

}  // namespace
}  // namespace vfit
