// Clothes of the virtual person: as thick as it is said, uneven, and without effect on the joints.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "person.h"
#include "random_body.h"
#include "virtual_host.h"

namespace vfit::virtual_person {
namespace {

BonePose t_pose() {
    BonePose pose;
    pose.rotation.fill(kNoRotation);
    return pose;
}

struct Dressed {
    OwnContext context;
    Person bare{context.get(), VFIT_SEX_FEMALE, 0, {}}, dressed{context.get(), VFIT_SEX_FEMALE, 0, {}};
    Dressed(float mean_m, uint64_t seed) : Dressed(Thickness{mean_m}, seed) {}
    Dressed(const Thickness& thickness, uint64_t seed) {
        dressed.wear(thickness, seed);
        for (Person* p : {&bare, &dressed}) p->pose(t_pose(), Vec3(0.0f));
    }
    float moved(size_t v) const {
        const float *a = bare.positions() + 3 * v, *b = dressed.positions() + 3 * v;
        return glm::distance(Vec3(a[0], a[1], a[2]), Vec3(b[0], b[1], b[2]));
    }
    Vec3 skin(size_t v) const {
        const float* p = bare.positions() + 3 * v;
        return {p[0], p[1], p[2]};
    }
};

TEST(Clothing, MovesTheCoveredSurfaceByItsThicknessOnAverage) {
    for (const float mean_m : {0.01f, 0.03f}) {
        for (const uint64_t seed : {1u, 2u, 3u}) {
            const Dressed d(mean_m, seed);
            const auto& triangles = d.bare.triangles();
            double area = 0, sum = 0;
            float most = 0;
            for (size_t i = 0; i < triangles.size(); i += 3) {
                const Vec3 a = d.skin(triangles[i]), b = d.skin(triangles[i + 1]),
                           c = d.skin(triangles[i + 2]);
                // Trunk and thighs, well within the hems.
                const Vec3 middle = (a + b + c) / 3.0f;
                if (std::abs(middle.x) > 0.3f || middle.y > 1.35f || middle.y < 0.3f) continue;
                const float size = glm::length(glm::cross(b - a, c - a));
                for (size_t k = 0; k < 3; ++k) {
                    const float moved = d.moved(triangles[i + k]);
                    area += double(size), sum += double(size * moved), most = std::max(most, moved);
                }
            }
            EXPECT_NEAR(sum / area, double(mean_m), 0.25 * double(mean_m)) << "seed " << seed;
            EXPECT_GT(most, 1.25f * mean_m) << "cloth is uneven";
            EXPECT_LT(most, 3.0f * mean_m);
        }
    }
}

TEST(Clothing, IsAsThickInEachZoneAsItIsSaid) {
    Thickness thickness{0.01f};
    thickness.sleeves_m = 0.0f, thickness.trousers_m = 0.03f;
    const Dressed d(thickness, 4);
    double sums[3] = {}, counts[3] = {};
    for (size_t v = 0; v < d.bare.vertex_count(); ++v) {
        const Vec3 p = d.skin(v);
        // Well within the hems.
        const int zone = std::abs(p.x) > 0.3f && std::abs(p.x) < 0.5f         ? 0
                         : std::abs(p.x) < 0.1f && p.y > 1.15f && p.y < 1.35f ? 1
                         : std::abs(p.x) < 0.3f && p.y > 0.3f && p.y < 0.8f   ? 2
                                                                              : -1;
        if (zone >= 0) sums[zone] += double(d.moved(v)), counts[zone] += 1;
    }
    EXPECT_EQ(sums[0], 0.0) << "sleeves";
    EXPECT_NEAR(sums[1] / counts[1], 0.01, 0.005) << "top, as thick as clothes are said to be";
    EXPECT_NEAR(sums[2] / counts[2], 0.03, 0.008) << "trousers";
}

TEST(Clothing, LeavesHeadHandsFeetAndJointsAsTheyAre) {
    const Dressed d(0.03f, 5);
    for (size_t i = 0; i < d.bare.joints().size(); ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(d.bare.joints()[i].position[k], d.dressed.joints()[i].position[k]) << "joint " << i;
    const auto joint = [&](vfit_joint_id id) { return d.bare.joints()[size_t(id)].position; };
    size_t bare = 0;
    for (size_t v = 0; v < d.bare.vertex_count(); ++v) {
        const Vec3 p = d.skin(v);
        const bool head = p.y > joint(VFIT_JOINT_HEAD)[1];
        const bool hand = std::abs(p.x) > joint(VFIT_JOINT_LEFT_HAND)[0];
        const bool foot = p.y < joint(VFIT_JOINT_LEFT_FOOT)[1];
        if (!head && !hand && !foot) continue;
        EXPECT_EQ(d.moved(v), 0.0f) << v;
        ++bare;
    }
    EXPECT_GT(bare, 2000u);
}

TEST(Clothing, DoesNotTearWhereVerticesAreDoubled) {
    Dressed d(0.03f, 5);
    std::map<std::array<float, 3>, Vec3> places;
    size_t doubled = 0;
    for (size_t v = 0; v < d.bare.vertex_count(); ++v) {
        const float *a = d.bare.positions() + 3 * v, *b = d.dressed.positions() + 3 * v;
        const Vec3 dressed(b[0], b[1], b[2]);
        const auto [at, is_new] = places.try_emplace({a[0], a[1], a[2]}, dressed);
        doubled += !is_new;
        ASSERT_LT(glm::distance(at->second, dressed), 1e-6f) << "vertex " << v;
    }
    EXPECT_GT(doubled, 100u) << "the body's buffer doubles vertices at seams";
}

TEST(Clothing, DiffersFromSeedToSeedAndIsEqualForEqualSeeds) {
    const Dressed a(0.02f, 1), same(0.02f, 1), other(0.02f, 2);
    float most = 0;
    for (size_t v = 0; v < a.bare.vertex_count(); ++v) {
        ASSERT_EQ(a.moved(v), same.moved(v));
        most = std::max(most, std::abs(a.moved(v) - other.moved(v)));
    }
    EXPECT_GT(most, 0.005f);
}

TEST(Clothing, IsSeenByTheCameraWithoutHolesInIt) {
    TestHost host;
    const std::string uri = "virtual:sensor=ideal&frames=4&rate=1&motion=wave&clothing=";
    const auto bare = host.run(uri + "0"), dressed = host.run(uri + "0.03");
    ASSERT_EQ(bare.size(), dressed.size());
    for (size_t n = 0; n < bare.size(); ++n) {
        const Taken &a = bare[n], &b = dressed[n];
        for (size_t j = 0; j < a.joints.size(); ++j)
            for (int k = 0; k < 3; ++k) EXPECT_EQ(a.joints[j].position[k], b.joints[j].position[k]);
        double sum = 0;
        int both = 0, holes = 0;
        for (size_t i = a.width; i + a.width < a.user.size(); ++i) {
            if (a.user[i] && b.user[i]) sum += double(a.depth[i]) - double(b.depth[i]), ++both;
            if (b.user[i] || !b.user[i - 1] || !b.user[i + 1] || !b.user[i - b.width] || !b.user[i + b.width])
                continue;
            const auto [near, far] =
                std::minmax({b.depth[i - 1], b.depth[i + 1], b.depth[i - b.width], b.depth[i + b.width]});
            holes += far - near < 30;
        }
        EXPECT_LE(holes, 2) << "gaps between sleeve and trunk that are one pixel wide";
        // Most of what the camera sees is covered, and most of that looks towards it.
        EXPECT_GT(sum / both, 15.0) << "mm";
        EXPECT_LT(sum / both, 45.0) << "mm";
        EXPECT_GT(b.pixels_of(1), a.pixels_of(1));
    }
}

TEST(RandomBody, FollowsItsNumberAndKeepsWhatIsGiven) {
    const RandomBody a = draw_body(7, VFIT_SEX_UNKNOWN, {}), same = draw_body(7, VFIT_SEX_UNKNOWN, {});
    EXPECT_EQ(a.shape, same.shape);
    EXPECT_EQ(a.sex, same.sex);
    EXPECT_NE(a.shape, draw_body(8, VFIT_SEX_UNKNOWN, {}).shape);
    const RandomBody given = draw_body(7, VFIT_SEX_MALE, {{"height", 0.4f}});
    EXPECT_EQ(given.sex, VFIT_SEX_MALE);
    EXPECT_EQ(given.shape.at("height"), 0.4f);
    EXPECT_EQ(given.shape.at("weight"), a.shape.at("weight"));
}

TEST(RandomBody, BothSexesAndManyHeightsAreDrawn) {
    int women = 0;
    float low = 1, high = 0;
    for (uint64_t n = 1; n <= 40; ++n) {
        const RandomBody body = draw_body(n, VFIT_SEX_UNKNOWN, {});
        women += body.sex == VFIT_SEX_FEMALE;
        low = std::min(low, body.shape.at("height")), high = std::max(high, body.shape.at("height"));
    }
    EXPECT_GT(women, 10);
    EXPECT_LT(women, 30);
    EXPECT_LT(low, 0.25f);
    EXPECT_GT(high, 0.75f);
}

}  // namespace
}  // namespace vfit::virtual_person
