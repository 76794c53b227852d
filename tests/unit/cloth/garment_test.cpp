// Garment files and fabrics: what is read, and what is refused with which words.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// Two triangles, the lower vertices simulated.
const char* const kGarment = R"({"format": "vfit-garment", "version": 1, "name": "scarf", "kind": "dress",
 "fabric": "cotton", "body_sex": "f",
 "sizes": [{"label": "S", "chest_girth_m": 0.8}, {"label": "L", "chest_girth_m": 1.0, "hip_girth_m": 1.2}],
 "positions": [0,1,0, 1,1,0, 0,0,0, 1,0,0], "uvs": [0,0, 1,0, 0,1, 1,1], "indices": [0,2,1, 1,2,3],
 "simulated": [0,0,1,1], "backstop": [0,0,1,0]})";

Garment parse(const std::string& text) { return parse_garment(bytes_of(text), library()); }

std::string with(const std::string& from, const std::string& to) {
    std::string text = kGarment;
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& from, const std::string& to) {
    return error_of([&] { parse(with(from, to)); });
}

TEST(Garment, IsReadWhole) {
    const Garment g = parse(kGarment);
    EXPECT_EQ(g.name, "scarf");
    EXPECT_EQ(g.kind, "dress");
    EXPECT_EQ(g.fabric, "cotton");
    EXPECT_EQ(g.body_sex, VFIT_SEX_FEMALE);
    EXPECT_EQ(g.vertex_count(), 4u);
    EXPECT_EQ(g.simulated_count(), 2u);
    EXPECT_EQ(g.mesh.positions[1], Vec3(1, 1, 0));
    EXPECT_EQ(g.mesh.uvs[2], Vec2(0, 1));
    EXPECT_EQ(g.mesh.indices, (std::vector<uint32_t>{0, 2, 1, 1, 2, 3}));
    EXPECT_EQ(g.backstop, (std::vector<uint8_t>{0, 0, 1, 0}));
    EXPECT_NEAR(g.mesh.normals[0].z, 1.0f, 1e-6f);
    ASSERT_EQ(g.sizes.size(), 2u);
    EXPECT_EQ(g.sizes[1].nominal.size(), 2u);
}

TEST(Garment, MayBeMadeOnABodyOfItsOwn) {
    EXPECT_TRUE(parse(kGarment).body_shape.empty());
    const Garment g =
        parse(with("\"body_sex\": \"f\"", R"("body_sex": "f", "body_shape": {"weight": 0.75})"));
    ASSERT_EQ(g.body_shape.size(), 1u);
    EXPECT_EQ(g.body_shape[0].key, "weight");
    EXPECT_EQ(g.body_shape[0].value, 0.75f);
    EXPECT_EQ(refusal("\"body_sex\": \"f\"", R"("body_sex": "f", "body_shape": [0.75])"),
              "-11 garment: \"body_shape\" is not an object");
    EXPECT_EQ(refusal("\"body_sex\": \"f\"", R"("body_sex": "f", "body_shape": {"weight": "much"})"),
              "-11 garment: \"body_shape\": weight is not a number");
}

TEST(Garment, RefusesEndlessNestingAtOnce) {
    const char* const message = "-11 garment: nested deeper than 32 levels";
    EXPECT_EQ(error_of([] { parse(std::string(1u << 22, '[')); }), message);
    EXPECT_EQ(refusal("\"scarf\"", "\"scarf\", \"maker\": " + std::string(32, '[') + std::string(32, ']')),
              message);
    parse(with("\"scarf\"", "\"" + std::string(99, '[') + "\", \"maker\": [[{\"name\": []}]]"));
}

TEST(Garment, RefusesBadMeshesByName) {
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,2, 1,2,3]"), "-11 garment: triangle 0 names a vertex twice");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,1, 1,2,4]"), "-11 garment: triangle 1 names vertex 4 of 4");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,1, 1,2]"), "-11 garment: 5 indices are no list of triangles");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[]"), "-11 garment: 0 indices are no list of triangles");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,1, -1,2,3]"), "-11 garment: indices[3] is not an index");
    EXPECT_EQ(refusal("0,0,0, 1,0,0]", "0.5,1,0, 1,0,0]"), "-11 garment: triangle 0 is degenerate");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,1, 2,1,3]"),
              "-11 garment: edge 2-1 of triangle 1 is not manifold: triangle 0 runs along it in the same "
              "direction");
    EXPECT_EQ(refusal("[0,2,1, 1,2,3]", "[0,2,1, 1,2,3, 1,2,0]"),
              "-11 garment: edge 1-2 of triangle 2 is not manifold: triangle 1 runs along it in the same "
              "direction");
}

TEST(Garment, RefusesBadFieldsByName) {
    EXPECT_EQ(refusal("\"fabric\": \"cotton\"", "\"fabric\": \"tin\""),
              "-11 unknown fabric \"tin\"; there are: cotton");
    EXPECT_EQ(refusal("[0,1,0, 1,1,0,", "[1e99,1,0, 1,1,0,"), "-11 garment: position 0 is not finite");
    EXPECT_EQ(refusal("[0,1,0, 1,1,0,", "[0,100,0, 1,1,0,"),
              "-11 garment: position 0 is more than 10 m from the body: positions are metres");
    EXPECT_EQ(refusal("[0,1,0, 1,1,0,", "[\"x\",1,0, 1,1,0,"), "-11 garment: positions[0] is not a number");
    EXPECT_EQ(refusal("[0,0,1,1]", "[0,0,1]"), "-11 garment: \"simulated\" has 3 flags for 4 vertices");
    EXPECT_EQ(refusal("[0,0,1,1]", "[0,0,1,2]"), "-11 garment: simulated[3] is neither 0 nor 1");
    EXPECT_EQ(refusal("[0,0, 1,0, 0,1, 1,1]", "[0,0, 1,0]"), "-11 garment: 2 uvs for 4 vertices and copies");
    EXPECT_EQ(refusal("\"uvs\"", "\"vus\""), "-11 garment: field \"uvs\" is missing");
    EXPECT_EQ(refusal("\"body_sex\": \"f\"", "\"body_sex\": \"x\""),
              "-11 garment: body_sex is neither \"f\" nor \"m\"");
    EXPECT_EQ(refusal("\"label\": \"L\"", "\"label\": \"S\""), "-11 garment: size S occurs twice");
    EXPECT_EQ(refusal("\"hip_girth_m\"", "\"tail_girth_m\""),
              "-11 garment: size L names the unknown measure tail_girth_m");
    EXPECT_EQ(refusal("0.8}", "-0.8}"), "-11 garment: chest_girth_m of size S is -0.8 m");
    EXPECT_EQ(refusal("\"version\": 1", "\"version\": 5"), "-8 garment: version 5 is not known, 1 to 4 are");
    EXPECT_EQ(refusal("vfit-garment", "garment"), "-11 garment: format is not \"vfit-garment\"");
}

TEST(Garment, AShapeOfItsOwnLengthsIsReadAndChecked) {
    const std::string sizes =
        "\"sizes\": [{\"label\": \"S\", \"chest_girth_m\": 0.8}, {\"label\": \"L\", \"chest_girth_m\": 1.0, "
        "\"hip_girth_m\": 1.2}]";
    const auto with_shape = [&](const std::string& more) {
        return with(sizes, "\"sizes\": [{\"label\": \"M\"}], " + more);
    };
    const auto refused = [&](const std::string& more) { return error_of([&] { parse(with_shape(more)); }); };
    const Garment g = parse(with_shape("\"shape\": [0,2,0, 2,2,0, 0,0,0, 2,0,0]"));
    EXPECT_EQ(g.cut_shape[1], Vec3(2, 2, 0));
    EXPECT_TRUE(g.size("M").nominal.empty());  // its own lengths are the size
    EXPECT_EQ(refused("\"note\": 1"), "-11 garment: size M names no girth");
    EXPECT_EQ(refused("\"shape\": [0,2,0, 2,2,0]"), "-11 garment: \"shape\" has 2 places for 4 vertices");
    EXPECT_EQ(refused("\"shape\": [0,2,0, 2,2,0, 0,0,0, 1e39,0,0]"),
              "-11 garment: place 3 of \"shape\" is not finite or further than 10 m away");
    EXPECT_EQ(refused("\"shape\": [0,2,0, 0,1,0, 0,0,0, 2,0,0]"),
              "-11 garment: triangle 0 has no area in \"shape\"");
    EXPECT_EQ(refused("\"shape\": [0,2]"), "-11 garment: \"shape\" is not a flat array of 3 numbers an item");
    EXPECT_EQ(refused("\"shape\": [0,2,0, 2,2,0, 0,0,0, 2,0,0], \"flat\": [0,0, 1,0, 0,1, 1,1]"),
              "-11 garment: there are both \"flat\" and \"shape\": its lengths are the one or the other");
}

TEST(Garment, ADrawnMeshIsReadAndChecked) {
    const std::string good =
        R"("drawn": {"triangles": [0,1,1], "weights": [0,0, 1,0, 0,1], "offsets": [0,0,0.1, 0,0,0, 0,0,0],)"
        R"( "normals": [0,0,1, 0,0,1, 0,0,1], "uvs": [0,0, 1,0, 0,1], "indices": [0,1,2]})";
    const auto with_drawn = [&](const std::string& drawn) {
        return with("\"scarf\"", "\"scarf\", " + drawn);
    };
    const Garment g = parse(with_drawn(good));
    EXPECT_EQ(g.drawn_count(), 3u);
    EXPECT_EQ(g.drawn_indices().size(), 3u);
    EXPECT_EQ(g.uv_count(), 4u);
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string drawn = good;
        const size_t at = drawn.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return error_of([&] { parse(with_drawn(drawn.replace(at, from.size(), to))); });
    };
    EXPECT_EQ(refused("[0,1,1]", "[0,1,2]"), "-11 garment: vertex 2 of \"drawn\" names triangle 2 of 2");
    EXPECT_EQ(
        refused("[0,1,1]", "[0,1]"),
        "-11 garment: the lists of \"drawn\" are not of equal length: 2 triangles, 3 weights, 3 offsets, 3 "
        "normals, 3 uvs");
    EXPECT_EQ(refused("1,0, 0,1]", "1,0, 0.5,1]"),
              "-11 garment: the weights of vertex 2 of \"drawn\" are not in its triangle");
    EXPECT_EQ(
        refused("0,0,0.1", "0,0,1e39"),
        "-11 garment: vertex 0 of \"drawn\" has numbers that are not finite, or an offset of more than 10 m");
    EXPECT_EQ(refused("[0,1,2]", "[0,1,3]"), "-11 garment: index 2 of \"drawn\" names vertex 3 of 3");
    EXPECT_EQ(refused("[0,1,2]", "[0,1]"), "-11 garment: 2 indices of \"drawn\" are no list of triangles");
    EXPECT_EQ(refused("\"uvs\"", "\"vus\""), "-11 garment: field \"uvs\" is missing");
    EXPECT_EQ(error_of([&] { parse(with_drawn("\"drawn\": 3")); }),
              "-11 garment: \"drawn\" is not an object");
}

TEST(Garment, RefusesEveryCutOfItsText) {
    const std::string text = kGarment;
    for (size_t length = 0; length < text.size(); ++length)
        ASSERT_EQ(error_of([&] { parse(text.substr(0, length)); }).find("-11 garment: not JSON: "), 0u)
            << length;
    EXPECT_EQ(error_of([] { parse("[]"); }), "-11 garment: not a JSON object");
}

TEST(Garment, SizeRatioIsTheMeanOverCommonGirths) {
    const Garment g = parse(kGarment);
    const std::vector<Measurement> body{{"chest_girth_m", 0.9f}, {"hip_girth_m", 1.0f}};
    EXPECT_NEAR(size_ratio(g, "S", body), 0.8f / 0.9f, 1e-6f);
    EXPECT_NEAR(size_ratio(g, "L", body), 0.5f * (1.0f / 0.9f + 1.2f), 1e-6f);
    EXPECT_EQ(error_of([&] { size_ratio(g, "XS", body); }),
              "-2 garment scarf has no size \"XS\"; there are: S, L");
    EXPECT_EQ(error_of([&] { size_ratio(g, "S", {}); }),
              "-11 size S: none of its girths is known of the body");
}

TEST(Fabrics, ThoseOfTheProjectAreRead) {
    std::ifstream file(VFIT_SOURCE_DIR "/assets/fabrics.json");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const FabricLibrary fabrics = FabricLibrary::parse(bytes_of(text));
    EXPECT_FLOAT_EQ(fabrics.get("denim").density_kg_m2, 0.324f);
    EXPECT_FLOAT_EQ(fabrics.get("light_woven").friction, 0.3f);
    EXPECT_TRUE(fabrics.has("silk"));
    EXPECT_FALSE(fabrics.has("tin"));
}

TEST(Fabrics, RefusesBadNumbersByName) {
    const std::string start =
        R"({"format": "vfit-fabrics", "version": 1, "fabrics": {"felt": {"density_kg_m2": )";
    EXPECT_EQ(error_of([&] { FabricLibrary::parse(bytes_of(start + "0}}}")); }),
              "-11 fabric felt: density_kg_m2 must be above zero, is 0");
    EXPECT_EQ(error_of([&] { FabricLibrary::parse(bytes_of(start + "1}}}")); }),
              "-11 fabric felt: stretch_warp_n_m is not a number");
    EXPECT_EQ(error_of([&] { FabricLibrary::parse(bytes_of(start)); }).find("-11 fabrics: not JSON: "), 0u);
}

TEST(FabricCooking, RefusesExplicitDataThatDoNotFit) {
    const auto cook = [](auto change) {
        FabricData data;
        data.inverse_mass = {0.0f, 1.0f};
        data.edges = {{0, 1, 1.0f, 0.0f}};
        change(data);
        return error_of([&] { Fabric fabric(std::move(data)); });
    };
    EXPECT_EQ(cook([](FabricData&) {}), "");
    EXPECT_EQ(cook([](FabricData& d) { d.edges[0].b = 2; }), "-11 edge 0 joins vertices 0 and 2 of 2");
    EXPECT_EQ(cook([](FabricData& d) { d.edges[0].rest_m = 0; }), "-11 edge 0 has rest length 0 m");
    EXPECT_EQ(cook([](FabricData& d) { d.inverse_mass[0] = -1; }), "-11 vertex 0 has inverse mass -1");
    EXPECT_EQ(cook([](FabricData& d) { d.indices = {0, 1}; }),
              "-11 the fabric's indices are not whole triangles");
    EXPECT_EQ(cook([](FabricData& d) { d.backstops = {{0, 0.1f}}; }),
              "-11 backstop of vertex 0 with radius 0.1 m");
    EXPECT_EQ(cook([](FabricData& d) { d.hinges = {{{0, 1, 2, 3}, {}, 1.0f}}; }),
              "-11 hinge 0 joins vertices 0, 1, 2 and 3 of 2");
    EXPECT_EQ(cook([](FabricData& d) { d.tethers = {{1, 1, 0.1f}}; }),
              "-11 tether of vertex 1 to vertex 1, which is not fixed");
    EXPECT_EQ(cook([](FabricData& d) { d.inverse_mass.clear(); }), "-11 the fabric has no vertices");
}

TEST(FabricCooking, AHingeIsFlatAtRestAndCountsTheFoldsAngle) {
    Sheet sheet(2, 2, 0.02f);  // one fold: the diagonal
    const FabricData data = sheet.cook(cotton());
    ASSERT_EQ(data.hinges.size(), 1u);
    const Hinge& hinge = data.hinges[0];
    const float length = 0.02f * std::sqrt(2.0f);
    const auto sum = [&](const std::vector<Vec3>& places) {
        Vec3 out(0.0f);
        for (size_t k = 0; k < 4; ++k) out += hinge.weights[k] * places[hinge.vertices[k]];
        return out;
    };
    EXPECT_LT(glm::length(sum(sheet.positions)), 1e-6f);
    // One corner turned about the diagonal.
    const float angle = 0.1f;
    std::vector<Vec3> folded = sheet.positions;
    const Vec3 &a = folded[hinge.vertices[0]], &b = folded[hinge.vertices[1]];
    Vec3& corner = folded[hinge.vertices[2]];
    corner = a + glm::angleAxis(angle, glm::normalize(b - a)) * (corner - a);
    EXPECT_NEAR(glm::length(sum(folded)), length * angle, 0.01f * length * angle);
    // Its energy is that of a hinge of stiffness B l^2 / (A1 + A2).
    const float stiffness = cotton().bend_n_m * length * length / (0.02f * 0.02f);
    EXPECT_NEAR(length * length / hinge.compliance_m_n, stiffness, 1e-3f * stiffness);
}

TEST(FabricCooking, ADistanceOverAFoldStoresAt30DegreesWhatTheHingeDoes) {
    Sheet sheet(2, 2, 0.02f);
    const FabricData data = sheet.cook(cotton());
    ASSERT_EQ(data.bends.size(), 1u);
    const DistanceConstraint& limit = data.bends[0];
    const Hinge& hinge = data.hinges[0];
    const auto energies = [&](float angle) {
        std::vector<Vec3> folded = sheet.positions;
        const Vec3 &a = folded[hinge.vertices[0]], &b = folded[hinge.vertices[1]];
        folded[limit.a] = a + glm::angleAxis(angle, glm::normalize(b - a)) * (folded[limit.a] - a);
        const float shorter = limit.rest_m - glm::length(folded[limit.a] - folded[limit.b]),
                    length = glm::length(b - a);
        return std::pair{0.5f * shorter * shorter / limit.compliance_m_n,
                         0.5f * angle * angle * length * length / hinge.compliance_m_n};
    };
    const auto [fold, bent] = energies(kPi / 6.0f);
    EXPECT_NEAR(fold, bent, 0.05f * bent);
    const auto [flat_fold, flat_bent] = energies(0.1f);
    EXPECT_LT(flat_fold, 0.1f * flat_bent);
}

TEST(FabricCooking, MassIsDensityTimesArea) {
    const Sheet sheet(11, 6, 0.02f);
    double mass = 0.0;
    for (const float w : sheet.cook(cotton()).inverse_mass) mass += 1.0 / double(w);
    EXPECT_NEAR(mass, 0.2 * 0.2 * 0.1, 1e-6);
}

}  // namespace
}  // namespace vfit
