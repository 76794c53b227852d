// The sundress: a sound garment, outside the body, of the intended size, and the same each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "cook/body/body_outline.h"
#include "cook/garment_writer.h"
#include "cook/sundress.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

std::string file(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string design() { return file(VFIT_SOURCE_DIR "/assets/garments/sundress.json"); }

class Sundress : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        garment = cook_sundress(*model, parse_sundress(bytes_of(design())));
        model->evaluate(model->default_shape(VFIT_SEX_FEMALE), body);
    }
    static inline std::shared_ptr<const BodyModel> model;
    static inline Garment garment;
    static inline EvaluatedBody body;
};

TEST_F(Sundress, HasThePapersVertexCounts) {  // Table 5: 1,048 skinned, 3,096 simulated
    EXPECT_EQ(garment.simulated_count(), 3096u);
    EXPECT_EQ(garment.vertex_count() - garment.simulated_count(), 1048u);
}

TEST_F(Sundress, IsASoundGarmentAndReadsBackAsWritten) {
    const FabricLibrary fabrics =
        FabricLibrary::parse(bytes_of(file(VFIT_SOURCE_DIR "/assets/fabrics.json")));
    validate_garment(garment, fabrics);
    const std::string text = write_garment(garment);
    EXPECT_LT(text.size(), 600'000u);
    const Garment read = parse_garment(bytes_of(text), fabrics);
    ASSERT_EQ(read.vertex_count(), garment.vertex_count());
    for (size_t i = 0; i < read.vertex_count(); ++i)
        ASSERT_LT(glm::length(read.mesh.positions[i] - garment.mesh.positions[i]), 1e-5f);
    EXPECT_EQ(read.mesh.indices, garment.mesh.indices);
    EXPECT_EQ(read.simulated, garment.simulated);
    EXPECT_EQ(read.backstop, garment.backstop);
    ASSERT_EQ(read.sizes.size(), garment.sizes.size());
    EXPECT_EQ(write_garment(read), text);
}

TEST_F(Sundress, LiesOutsideTheBodyByItsEase) {
    const MeshQuery skin(body.positions, model->topology(0).indices);
    for (const Vec3& p : garment.mesh.positions) ASSERT_GT(skin.signed_distance(p), 0.0045f);
}

TEST_F(Sundress, TrianglesFaceOutwards) {
    // Away from the axis inside the trunk; the straps' undersides would show as many negatives.
    const float axis_z = BodyOutline(*model, VFIT_SEX_FEMALE).axis_z();
    size_t outward = 0, all = 0;
    for (size_t i = 0; i < garment.mesh.indices.size(); i += 3) {
        const Vec3 &a = garment.mesh.positions[garment.mesh.indices[i]],
                   &b = garment.mesh.positions[garment.mesh.indices[i + 1]],
                   &c = garment.mesh.positions[garment.mesh.indices[i + 2]];
        const Vec3 from_inside = (a + b + c) / 3.0f - Vec3(0, std::min(a.y, 1.1f), axis_z);
        outward += glm::dot(glm::cross(b - a, c - a), from_inside) > 0.0f;
        ++all;
    }
    EXPECT_GT(double(outward), 0.995 * double(all));
}

TEST_F(Sundress,
       HasFourOpenEdgesAndNoOther) {  // hem, and the top edge in three parts between and beside the straps
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t i = 0; i < garment.mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = garment.mesh.indices[i + k], b = garment.mesh.indices[i + (k + 1) % 3];
            ++edges[{std::min(a, b), std::max(a, b)}];
        }
    std::map<uint32_t, std::vector<uint32_t>> border;
    for (const auto& [edge, uses] : edges)
        if (uses == 1) {
            border[edge.first].push_back(edge.second);
            border[edge.second].push_back(edge.first);
        }
    int loops = 0;
    while (!border.empty()) {
        ++loops;
        std::vector<uint32_t> open{border.begin()->first};
        while (!open.empty()) {
            const uint32_t v = open.back();
            open.pop_back();
            const auto it = border.find(v);
            if (it == border.end()) continue;
            ASSERT_EQ(it->second.size(), 2u);
            open.insert(open.end(), it->second.begin(), it->second.end());
            border.erase(it);
        }
    }
    EXPECT_EQ(loops, 4);  // hem, neckline with the back, two armholes
}

TEST_F(Sundress, TrianglesAreNearRegular) {
    size_t slim = 0;
    for (size_t i = 0; i < garment.mesh.indices.size(); i += 3) {
        float shortest = INFINITY, longest = 0.0f;
        for (size_t k = 0; k < 3; ++k) {
            const float length = glm::length(garment.mesh.positions[garment.mesh.indices[i + k]] -
                                             garment.mesh.positions[garment.mesh.indices[i + (k + 1) % 3]]);
            shortest = std::min(shortest, length);
            longest = std::max(longest, length);
        }
        slim += longest > 3.0f * shortest;
    }
    EXPECT_LT(double(slim), 0.02 * double(garment.mesh.indices.size() / 3));
}

TEST_F(Sundress, IsSymmetric) {
    for (uint32_t row = 0; row < 56; ++row)
        for (uint32_t c = 1; c < 36; ++c) {
            const Vec3 &left = garment.mesh.positions[row * 72 + c],
                       &right = garment.mesh.positions[row * 72 + 72 - c];
            ASSERT_NEAR(left.x, -right.x, 2e-3f);
            ASSERT_NEAR(left.z, right.z, 2e-3f);
        }
}

TEST_F(Sundress, ReachesFromTheShouldersToTheKnee) {
    const TailorLevels levels = BodyOutline(*model, VFIT_SEX_FEMALE).levels();
    EXPECT_LT(levels.ankle, levels.knee);
    EXPECT_LT(levels.knee, levels.hip);
    EXPECT_LT(levels.hip, levels.waist);
    EXPECT_LT(levels.waist, levels.bust);
    EXPECT_LT(levels.bust, levels.shoulder);
    float lowest = INFINITY, highest = 0.0f;
    for (const Vec3& p : garment.mesh.positions) {
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
    }
    EXPECT_LT(lowest, levels.knee);
    EXPECT_GT(lowest, levels.knee - 0.1f);
    EXPECT_GT(highest, levels.shoulder);
    EXPECT_LT(highest, levels.shoulder + 0.12f);
}

TEST_F(Sundress, UvsAreMetres) {
    double worst = 0.0;
    for (uint32_t row = 14; row < 55; ++row)
        for (uint32_t c = 0; c < 36; ++c) {
            const uint32_t a = row * 72 + c, b = a + 1;
            const float along = garment.mesh.uvs[b].x - garment.mesh.uvs[a].x;
            worst = std::max(
                worst,
                double(std::abs(along - glm::length(garment.mesh.positions[b] - garment.mesh.positions[a]))));
        }
    EXPECT_LT(worst, 1e-3);
}

TEST(SundressDesign, RefusesBadParametersByName) {
    const auto refusal = [](const std::string& from, const std::string& to) -> std::string {
        std::string text = design();
        text.replace(text.find(from), from.size(), to);
        try {
            parse_sundress(bytes_of(text));
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    };
    EXPECT_EQ(refusal("\"columns\": 72", "\"columns\": 71"), "sundress: \"columns\" must be even, is 71");
    EXPECT_EQ(refusal("\"columns\": 72", "\"columns\": 1"), "sundress: \"columns\" must be 24 to 400, is 1");
    EXPECT_EQ(refusal("\"flare\"", "\"flair\""), "sundress: \"flare\" is not a number");
    EXPECT_EQ(refusal("\"version\": 1", "\"version\": 3"), "sundress: version is not 1");
    EXPECT_NE(refusal("{", "").find("sundress: not JSON"), std::string::npos);
    EXPECT_EQ(refusal("\"name\": \"sundress\"", "\"name\": \"\""), "sundress: \"name\" is not a text");
    EXPECT_EQ(refusal("\"chest_girth_m\": 0.78", "\"chest_m\": 0.78"),
              "sundress: size XS names the unknown measure chest_m");
    EXPECT_EQ(refusal("{\"label\": \"XS\"", "7, {\"label\": \"XS\""), "sundress: \"label\" is not a text");
}

TEST(BodyOutline, SpreadsPointsEvenlyAlongACircle) {
    Outline circle;
    circle.grow(0.2f);
    EXPECT_NEAR(circle.perimeter(), 2.0f * kPi * 0.2f, 1e-3f);
    const std::vector<Vec2> points = circle.spread(40);
    ASSERT_EQ(points.size(), 40u);
    EXPECT_NEAR(points[0].y, 0.2f, 1e-6f);   // the front
    EXPECT_NEAR(points[10].x, 0.2f, 1e-4f);  // the left
    for (size_t i = 0; i < 40; ++i)
        EXPECT_NEAR(glm::length(points[(i + 1) % 40] - points[i]), circle.perimeter() / 40.0f, 2e-4f);
}

}  // namespace
}  // namespace vfit
