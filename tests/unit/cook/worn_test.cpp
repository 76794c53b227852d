// By what a garment is held, and what it goes round.
#include "cook/worn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cook/cook_pattern.h"
#include "cook/drape/upper_edge.h"
#include "core/error.h"
#include "core/files.h"
#include "geometry/borders.h"
#include "pattern_support.h"

namespace vfit {
namespace {

struct Ring {
    std::vector<Vec3> places;
    std::vector<uint32_t> indices;

    /// About (x, z); share: fraction of a whole turn.
    Ring(float x, float y, float z, float radius, float height, float share) {
        constexpr uint32_t kColumns = 48;
        const uint32_t columns = uint32_t(share * float(kColumns));
        for (uint32_t c = 0; c <= columns; ++c) {
            const float a = 2.0f * kPi * float(c) / float(kColumns);
            for (const float way : {-0.5f, 0.5f})
                places.emplace_back(x + radius * std::sin(a), y + way * height, z + radius * std::cos(a));
        }
        for (uint32_t c = 0; c < columns; ++c)
            for (const uint32_t v : {0u, 2u, 1u, 1u, 2u, 3u}) indices.push_back(2 * c + v);
    }
};

class Worn : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        fabrics = FabricLibrary::parse(read_file(VFIT_SOURCE_DIR "/assets/fabrics.json"));
        jobs = Jobs::own(1);
        body = std::make_unique<CookBody>(*model, VFIT_SEX_FEMALE, std::vector<ShapeSetting>{});
    }
    static void TearDownTestSuite() { body.reset(); }
    static std::string round(const Ring& ring) {
        return listed(goes_round(ring.places, ring.indices, *body));
    }
    static CookedGarment cook(const Pattern& pattern, const CookOptions& options = {}) {
        return cook_pattern(*model, {{"", {}, pattern}}, 0, fabrics, options, *jobs);
    }
    static std::string refusal(const Pattern& pattern, const std::string& kind = "") {
        CookOptions options;
        if (!kind.empty()) options.kind = kind, options.kind_told = true;
        try {
            cook(pattern, options);
        } catch (const Error& error) {
            return error.what();
        }
        return "cooked";
    }
    static inline std::shared_ptr<const BodyModel> model;
    static inline FabricLibrary fabrics;
    static inline std::unique_ptr<Jobs> jobs;
    static inline std::unique_ptr<CookBody> body;
};

TEST_F(Worn, IsWhatClothIsMetAboutInNearlyAllDirections) {
    const float z = body->outline().axis_z(), hip = body->outline().levels().hip;
    EXPECT_EQ(round({0.0f, hip, z, 0.25f, 0.1f, 1.0f}), "hips");
    EXPECT_EQ(round({0.0f, hip, z, 0.25f, 0.1f, 0.8f}), "hips") << "it stands open in front";
    EXPECT_EQ(round({0.0f, hip, z, 0.25f, 0.1f, 0.6f}), "") << "an apron";
    EXPECT_EQ(round({1.0f, hip, z, 0.25f, 0.1f, 1.0f}), "") << "beside her";
    const Vec3 leg =
        glm::mix(body->joint(VFIT_BONE_LEFT_UPPER_LEG), body->joint(VFIT_BONE_LEFT_LOWER_LEG), 0.5f);
    EXPECT_EQ(round({leg.x, leg.y, leg.z, 0.12f, 0.2f, 1.0f}), "left leg");
    EXPECT_EQ(round({0.0f, leg.y, leg.z, 0.4f, 0.2f, 1.0f}), "") << "a wide skirt, which goes round hips";
}

TEST_F(Worn, HasToBeWhatTheKindGoesRound) {
    EXPECT_THROW(check_worn({}, ""), Error);
    EXPECT_NO_THROW(check_worn({"hips"}, ""));
    EXPECT_NO_THROW(check_worn({"hips"}, "skirt"));
    EXPECT_NO_THROW(check_worn({"neck"}, "scarf"));
    for (const char* kind : {"trousers", "dress", "shirt", "overall", "short_sleeves"})
        EXPECT_THROW(check_worn({"hips"}, kind), Error) << kind;
    const std::string told = refusal(tube(0.25f, 0.3f, 1.1f), "shirt");
    EXPECT_EQ(told.find("the garment does not go round the chest, as its kind (shirt) does: where it came to "
                        "rest it goes round"),
              0u)
        << told;
}

TEST_F(Worn, PanelsThatHangOnNothingAreNamed) {
    Pattern loose = tube(0.25f, 0.3f, 1.1f);
    loose.panels.push_back(
        straight_panel("pocket", {{0, 0}, {0.1f, 0}, {0.1f, 0.1f}, {0, 0.1f}}, {0, 0.9f, 0.4f}));
    EXPECT_EQ(refusal(loose),
              "panel pocket hangs on nothing: no seam joins it to what the garment is held by");
    Pattern far_off = tube(0.25f, 0.3f, 1.1f);
    for (Panel& panel : far_off.panels) panel.translation.x += 5.0f;
    EXPECT_EQ(refusal(far_off),
              "panel front is placed 5 m beside the body: panels have to stand around (0, 0)");
    Pattern apart = tube(0.25f, 0.3f, 1.1f);  // on both sides of the body, as far as numbers go
    apart.panels[0].translation.z = 3e38f, apart.panels[1].translation.z = -3e38f;
    EXPECT_EQ(refusal(apart).find("panel front is placed "), 0u);
    Pattern high = tube(0.25f, 0.3f, 1.1f);
    high.panels[1].translation.y = 1e30f;
    EXPECT_EQ(refusal(high).find("panel back is placed at 1e+30 m of height"), 0u);
}

/// Half a disc with a waist cut out, before or behind the body.
Panel half_disc(const std::string& name, float waist_m, float length_m, float z, bool back) {
    constexpr int kSteps = 12;
    std::vector<Vec2> corners;
    for (int i = 0; i <= kSteps; ++i) {  // the hem, from the left of the picture to the right
        const float a = kPi * (1.0f + float(i) / float(kSteps)), r = waist_m + length_m;
        corners.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    for (int i = kSteps; i >= 0; --i) {
        const float a = kPi * (1.0f + float(i) / float(kSteps));
        corners.emplace_back(waist_m * std::cos(a), waist_m * std::sin(a));
    }
    if (back)
        for (Vec2& p : corners) p.x = -p.x;
    return straight_panel(name, std::move(corners), {0.0f, 1.15f, z});
}

TEST_F(Worn, ACircleSkirtIsHeldByItsWaistAndDoesNotStretch) {
    Pattern skirt;
    skirt.name = "circle";
    constexpr float kWaist_m = 0.115f, kLength_m = 0.6f;  // 72 cm around
    skirt.panels = {half_disc("front", kWaist_m, kLength_m, 0.25f, false),
                    half_disc("back", kWaist_m, kLength_m, -0.25f, true)};
    skirt.stitches = {{{0, 12}, {1, 25}}, {{0, 25}, {1, 12}}};
    const CookedGarment cooked = cook(skirt);
    EXPECT_EQ(cooked.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(cooked.report.crossings(), 0u);
    EXPECT_LT(cooked.report.strain_p99, 0.1f);
    EXPECT_NE(std::find(cooked.round.begin(), cooked.round.end(), "waist"), cooked.round.end());
    float low = INFINITY, top = -INFINITY;
    for (const Vec3& p : cooked.garment.mesh.positions) low = std::min(low, p.y), top = std::max(top, p.y);
    EXPECT_LT(top - low, kLength_m + 0.05f) << "it hangs no longer than it was cut";
    EXPECT_GT(top, body->outline().levels().waist - 0.05f);
}

TEST_F(Worn, AStraplessTopStaysWhereItIs) {
    const float bust = body->outline().levels().bust;
    const CookedGarment cooked = cook(tube(0.23f, 0.25f, bust + 0.06f));
    EXPECT_EQ(cooked.report.raised_m, 0.0f);
    EXPECT_NE(std::find(cooked.round.begin(), cooked.round.end(), "chest"), cooked.round.end());
}

TEST_F(Worn, StrapsStayOnTheShoulders) {
    // Front and back of a vest with straps of 4 cm, far apart: wide for what falls without a hand that holds
    // it.
    Pattern vest;
    vest.name = "vest";
    const std::vector<Vec2> corners = {{-0.27f, 0.9f},  {0.27f, 0.9f},  {0.26f, 1.18f},  {0.15f, 1.24f},
                                       {0.15f, 1.4f},   {0.11f, 1.41f}, {0.1f, 1.2f},    {-0.1f, 1.2f},
                                       {-0.11f, 1.41f}, {-0.15f, 1.4f}, {-0.15f, 1.24f}, {-0.26f, 1.18f}};
    vest.panels.push_back(straight_panel("front", corners, {0, 0, 0.3f}));
    std::vector<Vec2> mirrored = corners;
    for (Vec2& p : mirrored) p.x = -p.x;
    vest.panels.push_back(straight_panel("back", mirrored, {0, 0, -0.25f}));
    // Sides and shoulders: the mirrored panel has the same edges on the other side.
    vest.stitches = {{{0, 1}, {1, 11}}, {{0, 11}, {1, 1}}, {{0, 4}, {1, 8}}, {{0, 8}, {1, 4}}};
    for (Stitch& stitch : vest.stitches) stitch.turned = false;
    const CookedGarment cooked = cook(vest);
    EXPECT_EQ(cooked.report.hangs_on, HangsOn::shoulders);
    EXPECT_EQ(cooked.report.crossings(), 0u);
    float top = -INFINITY;
    for (const Vec3& p : cooked.garment.mesh.positions) top = std::max(top, p.y);
    EXPECT_GT(top, body->outline().left_shoulder().y) << "no strap slid down an arm";
}

TEST(UpperEdge, IsTheHighestOpeningAboutTheBody) {
    const Ring skirt(0.0f, 1.0f, 0.0f, 0.2f, 0.6f, 1.0f);
    // The ring's ends lie at one place but are not joined: one border, of which the upper edge is taken.
    const auto open = borders(skirt.indices);
    ASSERT_EQ(open.size(), 1u);
    for (const uint32_t v : upper_edge(skirt.places, open, 0.0f)) EXPECT_NEAR(skirt.places[v].y, 1.3f, 1e-5f);

    std::vector<uint32_t> joined = skirt.indices;
    for (uint32_t& v : joined)
        if (v >= skirt.places.size() - 2) v -= uint32_t(skirt.places.size()) - 2;
    const auto loops = borders(joined);
    ASSERT_EQ(loops.size(), 2u);
    const auto edge = upper_edge(skirt.places, loops, 0.0f);
    EXPECT_EQ(edge.size(), 48u);
    EXPECT_NEAR(mean_height(skirt.places, edge), 1.3f, 1e-5f);
    EXPECT_NEAR(length_around(skirt.places, edge), 2.0f * kPi * 0.2f, 0.01f);
}

}  // namespace
}  // namespace vfit
