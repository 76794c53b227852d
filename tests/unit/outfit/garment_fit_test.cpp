// The parts of the garment fit: girths of a cut mesh, verdicts, openings, strain.
#include <gtest/gtest.h>

#include <cmath>

#include "outfit/garment_fit.h"
#include "unit/cloth/tube.h"

namespace vfit {
namespace {

using test::Tube;

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
    const auto with_ease = [&](const char* label, float body, float ease_m) {
        fit.ease_m = ease_m;
        return verdict(label, body);
    };
    // What has much ease is not tight, what has none is not loose.
    EXPECT_EQ(with_ease("M", 1.0f, 0.02f), Fit::tight);
    EXPECT_EQ(with_ease("M", 1.0f, 0.184f), Fit::right);
    EXPECT_EQ(with_ease("M", 0.89f, 0.11f), Fit::loose);
    EXPECT_EQ(with_ease("M", 0.89f, -0.02f), Fit::right);
    EXPECT_EQ(with_ease("M", 0.91f, 0.09f), Fit::right);
    fit.pressure_pa = 3000.0f;
    EXPECT_EQ(with_ease("M", 0.94f, 0.0f), Fit::tight);
    fit.pressure_pa = 500.0f;
    EXPECT_EQ(with_ease("M", 0.94f, 0.0f), Fit::right);
    // By the size: half a step to the next one.
    fit.ease_m = 0.0f;
    EXPECT_EQ(verdict("M", 0.91f), Fit::right);
    EXPECT_EQ(verdict("M", 0.985f), Fit::right);
    EXPECT_EQ(verdict("M", 1.0f), Fit::tight);
    EXPECT_EQ(verdict("L", 1.2f), Fit::tight);
    fit.ease_m = 0.06f;
    EXPECT_EQ(verdict("M", 0.905f), Fit::right);
    EXPECT_EQ(verdict("M", 0.895f), Fit::loose);
    // Of a garment that tells of no such girth: by stretch and ease.
    fit.key = "hip_girth_m", fit.ease_m = 0.05f, fit.strain = 0.0f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::right);
    fit.strain = 0.05f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::tight);
    fit.strain = 0.0f, fit.ease_m = 0.2f;
    EXPECT_EQ(verdict("M", 1.0f), Fit::loose);
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

}  // namespace
}  // namespace vfit
