// Patterns that are cooked: sewn on a body, at rest, in their own lengths.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cloth/crossings.h"
#include "cook/cook_file.h"
#include "cook/garment_writer.h"
#include "core/error.h"
#include "core/files.h"
#include "pattern_support.h"
#include "support/shared_folder.h"

namespace vfit {
namespace {

class Cooking : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        fabrics = FabricLibrary::parse(read_file(VFIT_SOURCE_DIR "/assets/fabrics.json"));
        jobs = Jobs::own(1);
    }
    static CookedGarment cook(const Pattern& pattern, const std::string& label = "") {
        return cook_pattern(*model, {{label, {{"waist_girth_m", 0.7f}}, pattern}}, 0, fabrics, {}, *jobs);
    }
    static inline std::shared_ptr<const BodyModel> model;
    static inline FabricLibrary fabrics;
    static inline std::unique_ptr<Jobs> jobs;
};

float mean_length_ratio(const Garment& g) {
    double sum = 0.0;
    for (size_t i = 0; i < g.corners.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const size_t n = (k + 1) % 3;
            sum += glm::length(g.mesh.positions[g.mesh.indices[i + k]] -
                               g.mesh.positions[g.mesh.indices[i + n]]) /
                   glm::length(g.flat[g.corners[i + k]] - g.flat[g.corners[i + n]]);
        }
    return float(sum / double(g.corners.size()));
}

TEST_F(Cooking, ATubeBecomesASkirtOnTheWaist) {
    const CookedGarment cooked = cook(tube(0.25f, 0.5f, 1.1f), "M");
    const Garment& g = cooked.garment;
    EXPECT_EQ(cooked.report.hangs_on, HangsOn::waist);
    EXPECT_EQ(cooked.report.skin_crossings, 0u);
    EXPECT_EQ(cooked.report.self_crossings, 0u);
    EXPECT_LT(cooked.report.widest_seam_m, 0.006f);
    EXPECT_NEAR(mean_length_ratio(g), 1.0f, 0.02f);  // it keeps the lengths that it was cut to
    EXPECT_LT(g.simulated_count(), g.vertex_count());
    // In world space, with its outside out: normals point away from the body's axis.
    size_t out = 0;
    for (size_t i = 0; i < g.mesh.positions.size(); ++i)
        out += glm::dot(g.mesh.normals[i], Vec3(g.mesh.positions[i].x, 0, g.mesh.positions[i].z)) > 0.0f;
    EXPECT_GT(out, g.mesh.positions.size() * 9 / 10);
}

TEST_F(Cooking, TurnsTheOutsideOut) {
    Pattern pattern = tube(0.25f, 0.3f, 1.1f);
    for (Panel& panel : pattern.panels) {  // all edges the other way round
        std::reverse(panel.edges.begin(), panel.edges.end());
        for (PatternEdge& edge : panel.edges) std::swap(edge.from, edge.to);
    }
    pattern.stitches = {{{0, 2}, {1, 0}}, {{0, 0}, {1, 2}}};
    const Garment g = cook(pattern).garment;
    size_t out = 0;
    for (size_t i = 0; i < g.mesh.positions.size(); ++i)
        out += glm::dot(g.mesh.normals[i], Vec3(g.mesh.positions[i].x, 0, g.mesh.positions[i].z)) > 0.0f;
    EXPECT_GT(out, g.mesh.positions.size() * 9 / 10);
}

TEST_F(Cooking, IsTheSameEachTimeAndReadsBackAsWritten) {
    const Garment a = cook(tube(0.25f, 0.3f, 1.1f), "M").garment,
                  b = cook(tube(0.25f, 0.3f, 1.1f), "M").garment;
    EXPECT_EQ(write_garment(a), write_garment(b));
    const Garment read = parse_garment(bytes_of_text(write_garment(a)), fabrics);
    EXPECT_EQ(read.copies, a.copies);
    EXPECT_EQ(read.corners, a.corners);
    EXPECT_EQ(read.simulated, a.simulated);
    EXPECT_EQ(read.parts.size(), a.parts.size());
    ASSERT_EQ(read.flat.size(), a.flat.size());
    for (size_t i = 0; i < a.flat.size(); ++i) EXPECT_LT(glm::length(read.flat[i] - a.flat[i]), 2e-5f);
    ASSERT_EQ(read.sizes.size(), 1u);
    EXPECT_EQ(read.sizes[0].flat.size(), a.flat.size());
}

TEST_F(Cooking, SizesShareTheMeshAndHaveTheirOwnLengths) {
    const std::vector<PatternSize> sizes{{"S", {{"waist_girth_m", 0.7f}}, tube(0.25f, 0.3f, 1.1f)},
                                         {"L", {{"waist_girth_m", 0.9f}}, tube(0.3f, 0.36f, 1.1f)}};
    const Garment g = cook_pattern(*model, sizes, 0, fabrics, {}, *jobs).garment;
    ASSERT_EQ(g.sizes.size(), 2u);
    const auto width = [&](const std::vector<Vec2>& flat) {
        float low = 1e9f, high = -1e9f;
        for (const Vec2& p : flat) low = std::min(low, p.x), high = std::max(high, p.x);
        return high - low;
    };
    EXPECT_NEAR(width(g.sizes[0].flat), 0.5f, 1e-4f);
    EXPECT_NEAR(width(g.sizes[1].flat), 0.6f, 1e-4f);
    std::vector<PatternSize> other = sizes;
    other[1].pattern.panels.pop_back();
    other[1].pattern.stitches.clear();
    EXPECT_THROW(cook_pattern(*model, other, 0, fabrics, {}, *jobs), Error);
}

TEST_F(Cooking, ASpecificationThatTellsOfNobodyIsTriedOnBoth) {
    const std::string shared = test::shared_data("patterns");
    if (shared.empty()) GTEST_SKIP() << "no shared/data/patterns";
    CookRequest request;
    request.path = shared + "/sundress_f/sundress_f_specification.json";
    EXPECT_EQ(cook_file(*model, fabrics, request, *jobs).front().garment.body_sex, VFIT_SEX_FEMALE);
}

TEST_F(Cooking, ASeamThatCannotCloseIsNamed) {
    try {
        cook(tube(0.1f, 0.3f, 1.1f));  // 40 cm around a waist of 69
        FAIL() << "a tube of 40 cm closed around a waist";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
        EXPECT_NE(std::string(error.what()).find("panel front, edge 1"), std::string::npos) << error.what();
    }
}

TEST_F(Cooking, DrapesEveryShippedDesign) {
    ASSERT_FALSE(shipped_designs().empty());
    for (const std::string& name : shipped_designs()) {
        SCOPED_TRACE(name);
        CookRequest request;
        request.path = design_path(name);
        const CookedGarment cooked = std::move(cook_file(*model, fabrics, request, *jobs).front());
        const Garment& garment = cooked.garment;
        EXPECT_EQ(garment.name, name) << "it is opened by the name of its file";
        EXPECT_GT(garment.simulated_count(), garment.vertex_count() / 2);
        std::set<std::string> labels;
        for (const GarmentSize& size : garment.sizes) {
            EXPECT_TRUE(labels.insert(size.label).second) << size.label;
            EXPECT_FALSE(size.nominal.empty()) << size.label;
        }
        EXPECT_GE(labels.size(), 1u);
        EXPECT_EQ(cooked.report.skin_crossings, 0u);
        EXPECT_EQ(cooked.report.self_crossings, 0u);
        EXPECT_LT(cooked.report.widest_seam_m, 0.01f) << "all stitches are closed";
        if (garment.flat.empty()) continue;  // the sundress that is made of numbers has no panels
        EXPECT_NEAR(mean_length_ratio(garment), 1.0f, 0.03f);
        for (const GarmentSize& size : garment.sizes) EXPECT_EQ(size.flat.size(), garment.flat.size());
    }
}

TEST_F(Cooking, DrapesRealSpecifications) {
    const std::string shared = test::shared_data("patterns");
    if (shared.empty()) GTEST_SKIP() << "no shared/data/patterns";
    for (const auto& [name, sex, hangs_on] : {std::tuple("sundress_f", VFIT_SEX_FEMALE, HangsOn::shoulders),
                                              std::tuple("jeans_m", VFIT_SEX_MALE, HangsOn::waist)}) {
        CookRequest request;
        request.path = shared + "/" + name + "/" + name + "_specification.json";
        request.sex = sex;
        const CookedGarment cooked = std::move(cook_file(*model, fabrics, request, *jobs).front());
        EXPECT_EQ(cooked.garment.name, name);
        EXPECT_EQ(cooked.report.hangs_on, hangs_on) << name;
        EXPECT_EQ(cooked.report.skin_crossings, 0u) << name;
        EXPECT_EQ(cooked.report.self_crossings, 0u) << name;
        EXPECT_LT(cooked.report.widest_seam_m, 0.006f) << name;
        EXPECT_NEAR(mean_length_ratio(cooked.garment), 1.0f, 0.03f) << name;
    }
}

}  // namespace
}  // namespace vfit
