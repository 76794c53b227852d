// Props: their meshes, and cloth that meets them.
#include "outfit/prop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cloth/crossings.h"
#include "outfit/props_met.h"
#include "people.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

double volume(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    double sum = 0.0;
    for (size_t t = 0; t < indices.size(); t += 3)
        sum += glm::dot(positions[indices[t]],
                        glm::cross(positions[indices[t + 1]], positions[indices[t + 2]])) /
               6.0;
    return sum;
}

float longest_edge(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    float most = 0.0f;
    for (size_t i = 0; i < indices.size(); ++i)
        most = std::max(most,
                        glm::distance(positions[indices[i]], positions[indices[i % 3 == 2 ? i - 2 : i + 1]]));
    return most;
}

/// How deep the middles of triangles lie below a sphere about the origin.
float depth_below(float radius, const Mesh& mesh) {
    float most = 0.0f;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        Vec3 middle(0.0f);
        for (size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.indices[t + k]] / 3.0f;
        most = std::max(most, radius - glm::length(middle));
    }
    return most;
}

TEST(PropMesh, ShapesEncloseTheirVolumeWithShortEdges) {
    for (const float radius : {0.01f, 0.1f, 1.0f}) {
        const Prop ball(sphere_mesh(radius));
        const double whole = 4.0 / 3.0 * 3.14159265 * std::pow(radius, 3.0);
        EXPECT_NEAR(volume(ball.positions(), ball.indices()) / whole, 1.0, 0.1) << radius;
        EXPECT_LT(depth_below(radius, sphere_mesh(radius)), 6e-4f) << radius;
        EXPECT_LE(longest_edge(ball.positions(), ball.indices()), std::max(0.0301f, radius / 19.9f))
            << radius;

        const float half = 3.0f * radius;
        const Prop rod(capsule_mesh(radius, half));
        EXPECT_NEAR(
            volume(rod.positions(), rod.indices()) / (whole + 2.0 * half * 3.14159265 * radius * radius), 1.0,
            0.1)
            << radius;
    }
    const Prop box(box_mesh({0.2f, 0.3f, 0.4f}));
    EXPECT_NEAR(volume(box.positions(), box.indices()), 8.0 * 0.2 * 0.3 * 0.4, 1e-4);
    EXPECT_LE(longest_edge(box.positions(), box.indices()), 0.0301f);
    EXPECT_LT(Prop(box_mesh(Vec3(10.0f))).vertex_count(), PropMesh::kMaxVertices) << "a floor";
}

TEST(PropMesh, VerticesAtOnePlaceAreOneAndMiddlesFollowTheirEnds) {
    Mesh box = box_mesh(Vec3(0.1f));
    Mesh seams;  // each triangle with vertices of its own, as meshes with texture seams have them
    for (const uint32_t v : box.indices)
        seams.indices.push_back(uint32_t(seams.positions.size())),
            seams.positions.push_back(box.positions[v]);
    Prop whole(box), sewn(seams);
    EXPECT_EQ(sewn.vertex_count(), whole.vertex_count());

    for (Vec3& p : box.positions) p *= 2.0f;
    whole.deform(box.positions);
    EXPECT_NEAR(volume(whole.positions(), whole.indices()), 0.4 * 0.4 * 0.4, 1e-5);
    EXPECT_EQ(error_of([&] { whole.deform(std::vector<Vec3>(7)); }).substr(0, 2),
              std::to_string(VFIT_ERROR_ARGUMENT));
}

/// Each edge has a triangle on either side.
bool is_closed(std::span<const uint32_t> indices) {
    std::map<std::pair<uint32_t, uint32_t>, int> sides;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t a = indices[i], b = indices[i % 3 == 2 ? i - 2 : i + 1];
        sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 0; });
}

TEST(PropMesh, SmallHolesAreFilled) {
    Mesh box = box_mesh(Vec3(0.1f));
    box.indices.resize(box.indices.size() - 6);  // a sixth
    Prop open(box);
    EXPECT_TRUE(is_closed(open.indices()));
    EXPECT_NEAR(volume(open.positions(), open.indices()), 0.008, 1e-5);
    for (Vec3& p : box.positions) p *= 2.0f;
    open.deform(box.positions);
    EXPECT_NEAR(volume(open.positions(), open.indices()), 0.064, 1e-4);
    std::swap(box.indices[1], box.indices[2]);  // one triangle looks the other way: no rim is simple
    EXPECT_TRUE(is_closed(Prop(box).indices()));
}

TEST(PropMesh, WhatIsOpenBecomesAShell) {
    constexpr float kThick_m = 0.004f;
    Mesh card;
    card.positions = {{0, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.3f, 0}, {0, 0.3f, 0}};
    card.indices = {0, 1, 2, 0, 2, 3};
    const Prop one(card);
    EXPECT_TRUE(is_closed(one.indices()));
    EXPECT_NEAR(volume(one.positions(), one.indices()), 0.2 * 0.3 * kThick_m, 1e-6);
    float low = 1.0f, high = -1.0f;
    for (const Vec3& p : one.positions()) low = std::min(low, p.z), high = std::max(high, p.z);
    EXPECT_NEAR(low, -kThick_m, 1e-6f);
    EXPECT_NEAR(high, 0.0f, 1e-6f);
    // With a back of its own, it is the same card.
    card.indices.insert(card.indices.end(), {0, 2, 1, 0, 3, 2});
    const Prop two(card);
    EXPECT_EQ(two.indices(), one.indices());
    // A pipe stays one: its ends are larger than its side. Beside it, a box is closed as it was.
    Mesh pipe = box_mesh(Vec3(0.1f));
    pipe.indices.resize(12);
    const Mesh box = box_mesh(Vec3(0.05f));
    for (const uint32_t i : box.indices) pipe.indices.push_back(uint32_t(pipe.positions.size()) + i);
    for (const Vec3& p : box.positions) pipe.positions.push_back(p + Vec3(1.0f, 0.0f, 0.0f));
    const Prop both(pipe);
    EXPECT_TRUE(is_closed(both.indices()));
    EXPECT_NEAR(volume(both.positions(), both.indices()), 0.001 + 2 * 0.04 * kThick_m, 2e-5);
}

TEST(PropMesh, WhatIsNoSolidIsRefused) {
    const auto refused = [](Mesh mesh) { return error_of([&] { Prop prop(mesh); }); };
    Mesh box = box_mesh(Vec3(0.1f));
    EXPECT_EQ(refused(box), "");
    Mesh bad = box;
    bad.indices[5] = 8;
    EXPECT_NE(refused(bad).find("names vertex 8 of 8"), std::string::npos) << refused(bad);
    bad = box;
    for (size_t t = 0; t < bad.indices.size(); t += 3) std::swap(bad.indices[t], bad.indices[t + 1]);
    EXPECT_NE(refused(bad).find("clockwise"), std::string::npos) << refused(bad);
    bad.indices.resize(3);
    EXPECT_EQ(refused(bad), "") << "an open surface has no inside";
    // Cards of hair have two sides, and nothing between them.
    for (int i = 0; i < 20; ++i) {
        Mesh card;
        const float f = 0.013f * float(i);
        card.positions = {{f, 1.0f, 0.3f}, {0.7f, f, 0.1f}, {0.2f, 0.4f - f, f}};
        card.indices = {0, 1, 2, 0, 2, 1};
        EXPECT_EQ(refused(card), "") << i;
    }
    bad.indices.assign(6, 0);
    EXPECT_NE(refused(bad).find("no triangle"), std::string::npos) << refused(bad);
    bad = box;
    for (Vec3& p : bad.positions) p.x *= 1000.0f;
    bad.positions.push_back(Vec3(0.0f));
    EXPECT_EQ(refused(bad), "") << "what is large has longer edges";
}

/// A sheet of 0.6 m, its vertices 2 cm apart, which falls on a prop.
struct FallingSheet {
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    Sheet sheet{31, 31, 0.02f};
    std::vector<Vec3> places;
    std::optional<Cloth> cloth;
    std::vector<Collider> body;
    PosedBody posed{{}};

    explicit FallingSheet(float height) {
        for (const Vec3& p : sheet.positions) places.emplace_back(p.x - 0.3f, height, -p.y - 0.3f);
        ClothSettings settings;
        settings.sleeps = false;
        cloth.emplace(fabric(cook_fabric({places, sheet.indices, {}, sheet.simulated}, cotton())), settings,
                      places);
    }
    void step(PropsMet& props) {
        posed.see({}, body);
        props.move({{Mat4(1.0f), Mat4(1.0f), 0.0f}, posed, 0.012f}, kFrame_s, {*cloth, 0}, *jobs);
        cloth->step(kFrame_s, places, body, *jobs,
                    [&](float share, float dt) { props.let_pass({*cloth, 0}, share, dt); });
        props.keep_step();
    }
    size_t crossings(const PropsMet& props) const {
        size_t pairs = 0;
        for (size_t i = 0; i < props.count(); ++i)
            pairs +=
                crossed_triangles({cloth->positions(), sheet.indices}, {props.positions(i), props.indices(i)})
                    .size();
        return pairs;
    }
    Vec3 middle() const { return cloth->positions()[sheet.at(15, 15)]; }
};

TEST(PropsMet, ASheetThatFallsOnABoxDoesNotMeetItWithVerticesAlone) {
    FallingSheet fall(0.7f);
    Prop box(box_mesh(Vec3(0.1f)));
    box.move(Vec3(0.003f, 0.1f, 0.007f), glm::angleAxis(0.6f, Vec3(0.0f, 1.0f, 0.0f)));
    PropsMet props;
    EXPECT_TRUE(props.add(box, {*fall.cloth, 0}));
    EXPECT_FALSE(props.add(box, {*fall.cloth, 0}));
    size_t most = 0;
    for (int i = 0; i < 120; ++i) fall.step(props), most = std::max(most, fall.crossings(props));
    EXPECT_EQ(most, 0u);
    EXPECT_GT(fall.middle().y, 0.15f);
    EXPECT_LT(fall.cloth->stats().strain_max, 0.5f);
}

TEST(PropsMet, AThinRodThatIsSwungIntoASheetTakesItAlong) {
    FallingSheet fall(0.3f);
    Prop rod(capsule_mesh(0.006f, 0.6f));
    const Quat lying = glm::angleAxis(1.5707963f, Vec3(0.0f, 0.0f, 1.0f));
    PropsMet props;
    rod.move(Vec3(0.0f, 0.1f, 0.001f), lying);
    props.add(rod, {*fall.cloth, 0});
    size_t most = 0;
    for (int i = 0; i < 60; ++i) {
        const float t = float(i) * kFrame_s;
        rod.move(Vec3(0.0f, 0.1f + std::max(0.0f, t - 0.3f) * 2.0f, 0.001f), lying);
        fall.step(props);
        most = std::max(most, fall.crossings(props));
    }
    EXPECT_EQ(most, 0u);
    EXPECT_GT(fall.middle().y, 1.3f);
}

TEST(PropsMet, WhatComesInsideOfTheClothPushesItOut) {
    FallingSheet fall(0.3f);
    Prop floor(box_mesh({1.0f, 0.05f, 1.0f})), ball(sphere_mesh(0.1f));
    PropsMet props;
    props.add(floor, {*fall.cloth, 0});
    floor.move(Vec3(0.0f, -0.05f, 0.0f), Quat(1, 0, 0, 0));
    for (int i = 0; i < 60; ++i) fall.step(props);
    EXPECT_NEAR(fall.middle().y, 0.004f, 0.004f) << "it lies on the floor";
    ball.move(Vec3(0.0f, -0.01f, 0.0f), Quat(1, 0, 0, 0));
    props.add(ball, {*fall.cloth, 0});
    for (int i = 0; i < 60; ++i) fall.step(props);
    EXPECT_EQ(fall.crossings(props), 0u);
    EXPECT_NEAR(fall.middle().y, 0.094f, 0.01f);
    EXPECT_LT(fall.cloth->stats().strain_max, 0.5f);
    // Elsewhere, in one step: it does not sweep the cloth along.
    const Vec3 before = fall.middle();
    ball.move(Vec3(5.0f, 0.03f, 0.0f), Quat(1, 0, 0, 0));
    fall.step(props);
    EXPECT_LT(glm::distance(before, fall.middle()), 0.02f);
}

TEST(PropsMet, APropThatLeapsFromOneSideToTheOtherSweepsNothing) {
    for (const float aside_m : {0.5f, 1.5f}) {
        FallingSheet fall(0.7f), alone(0.7f);
        Prop ball(sphere_mesh(0.1f));
        PropsMet props, none;
        ball.move(Vec3(-aside_m, 0.6f, 0.0f), Quat(1, 0, 0, 0));
        props.add(ball, {*fall.cloth, 0});
        for (int i = 0; i < 24; ++i) {
            if (i == 8) ball.move(Vec3(aside_m, 0.6f, 0.0f), Quat(1, 0, 0, 0));
            fall.step(props), alone.step(none);
            ASSERT_LT(glm::distance(fall.middle(), alone.middle()), 0.01f) << aside_m << " " << i;
        }
    }
}

TEST(PropsMet, BetweenTheBodyAndAPropThatGoesIntoItIsRoomForCloth) {
    FallingSheet fall(0.35f);
    Collider trunk;
    trunk.radius = 0.3f;
    fall.body = {trunk};
    Prop ball(sphere_mesh(0.1f));
    PropsMet props;
    props.add(ball, {*fall.cloth, 0});
    size_t most = 0;
    float strain = 0.0f;
    for (int i = 0; i < 150; ++i) {
        ball.move(Vec3(0.02f, std::max(0.33f, 0.5f - 0.003f * float(i)), 0.0f), Quat(1, 0, 0, 0));
        fall.step(props);
        most = std::max(most, fall.crossings(props)),
        strain = std::max(strain, fall.cloth->stats().strain_max);
    }
    EXPECT_EQ(most, 0u);
    EXPECT_LT(strain, 0.3f);
    const float away = glm::length(fall.middle());
    EXPECT_GT(away, 0.302f);
    EXPECT_LT(away, 0.312f) << "on the body, below the ball's place";
}

TEST(PropsMet, ADeformedPropTakesTheClothAlong) {
    FallingSheet fall(0.4f);
    Mesh shape = box_mesh({0.5f, 0.1f, 0.5f});
    Prop box(shape);
    PropsMet props;
    props.add(box, {*fall.cloth, 0});
    for (int i = 0; i < 60; ++i) fall.step(props);
    EXPECT_NEAR(fall.middle().y, 0.104f, 0.005f);
    for (int i = 0; i < 30; ++i) {
        for (Vec3& p : shape.positions)
            if (p.y > 0.0f) p.y = 0.1f + 0.01f * float(i + 1);
        box.deform(shape.positions);
        fall.step(props);
        ASSERT_EQ(fall.crossings(props), 0u) << i;
    }
    EXPECT_GT(fall.middle().y, 0.4f);
}

TEST(PropsMet, ClothThatLiesOnAPropFallsOnceThatIsRemoved) {
    FallingSheet fall(0.7f);
    Prop box(box_mesh({0.5f, 0.05f, 0.5f}));
    box.move(Vec3(0.0f, 0.05f, 0.0f), Quat(1, 0, 0, 0));
    PropsMet props;
    props.add(box, {*fall.cloth, 0});
    for (int i = 0; i < 120; ++i) fall.step(props);
    // Above the middle of its triangles too, it keeps its thickness.
    std::vector<float> heights;
    for (const Vec3& p : fall.cloth->positions())
        if (std::max(std::abs(p.x), std::abs(p.z)) < 0.25f) heights.push_back(p.y);
    ASSERT_GT(heights.size(), 300u);
    std::sort(heights.begin(), heights.end());
    EXPECT_GT(heights.front(), 0.1030f);
    EXPECT_NEAR(heights[heights.size() / 2], 0.104f, 0.001f);
    const float before = fall.middle().y;
    props.remove(box, {*fall.cloth, 0});
    for (int i = 0; i < 20; ++i) fall.step(props);
    EXPECT_LT(fall.middle().y, before - 0.3f);
}

TEST(PropsMet, AMeshIsUsedAgainForAnotherProp) {
    FallingSheet fall(0.7f);
    PropsMet props;
    Prop first(sphere_mesh(0.05f)), last(box_mesh(Vec3(0.1f)));
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(props.add(first, {*fall.cloth, 0}));
        fall.step(props);
        ASSERT_TRUE(props.remove(first, {*fall.cloth, 0}));
        ASSERT_FALSE(props.remove(first, {*fall.cloth, 0}));
    }
    EXPECT_EQ(fall.cloth->add_mesh(3, std::vector<uint32_t>{0, 1, 2}), 1u) << "one mesh served them all";
    fall.cloth->reset(fall.places);
    props.add(last, {*fall.cloth, 0});
    last.move(Vec3(0.0f, 0.1f, 0.0f), Quat(1, 0, 0, 0));
    for (int i = 0; i < 60; ++i) fall.step(props);
    EXPECT_NEAR(fall.middle().y, 0.204f, 0.01f);
    EXPECT_EQ(fall.crossings(props), 0u);
}

}  // namespace
}  // namespace vfit
