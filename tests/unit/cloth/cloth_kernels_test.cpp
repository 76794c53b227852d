// The hot loops on every instruction set that this machine has, against their formulas one particle at a time.
#include "cloth/cloth_kernels.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cloth/contact_culling.h"
#include "cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// Runs `test` on each instruction set.
template <typename Test>
void on_each_target(const Test& test) {
    const int64_t all = hwy::SupportedTargets();
    for (int64_t left = all; left; left &= left - 1) {
        const int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(hwy::TargetName(target));
        test();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

Vec3 random_point(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> u(-size, size);
    return {u(random), u(random), u(random)};
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance, size_t i) {
    EXPECT_LT(glm::length(a - b), tolerance) << i << ": " << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

TEST(ClothKernels, FreeFlightIsExact) {
    on_each_target([] {
        std::mt19937 random(1);
        Particles places(16), starts(16), predicted(16), velocities(16);
        for (auto* list : {&places, &velocities})
            for (Particle& p : *list) p.x = random_point(random, 1.0f);
        const Particles before = places, speeds = velocities;
        const float h = 1.0f / 480.0f, keep = 0.9f;
        const Vec3 half_fall(0.1f, -0.02f, 0.03f), pull(0.002f, 0.001f, 0.0f);
        const Moving moving{places.data(), starts.data(), predicted.data(), velocities.data(), 16};
        predict(moving, half_fall, h);
        for (size_t i = 0; i < 16; ++i) {
            expect_near(starts[i].x, before[i].x, 1e-9f, i);
            expect_near(places[i].x, before[i].x + (speeds[i].x + half_fall) * h, 1e-6f, i);
            EXPECT_EQ(predicted[i].x, places[i].x);
            EXPECT_EQ(places[i].zero, 0.0f);
            places[i].x += pull;
        }
        Particles next_places = places, next_starts = starts, next_predicted = predicted, next_velocities = velocities;
        const Moving next{next_places.data(), next_starts.data(), next_predicted.data(), next_velocities.data(), 16};
        find_velocities(moving, half_fall, h, keep);
        for (size_t i = 0; i < 16; ++i) expect_near(velocities[i].x, (speeds[i].x + 2.0f * half_fall + pull / h) * keep, 1e-4f, i);
        // Both at once.
        predict(moving, half_fall, h);
        find_velocities_and_predict(next, half_fall, h, keep);
        for (size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(next_starts[i].x, starts[i].x);
            expect_near(next_places[i].x, places[i].x, 1e-6f, i);
            EXPECT_EQ(next_predicted[i].x, next_places[i].x);
            expect_near(next_velocities[i].x, velocities[i].x, 1e-5f, i);
        }
    });
}

TEST(ClothKernels, DistancesAreThoseOfXpbd) {
    Sheet sheet(12, 11, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const DistanceBatches& batches = fabric.edge_batches();
    const float h = 1.0f / 480.0f;
    on_each_target([&] {
        std::mt19937 random(2);
        Particles particles(fabric.layout().count());
        for (uint32_t i = 0; i < particles.size(); ++i)
            if (fabric.layout().vertex_of[i] != ParticleLayout::kNobody)
                particles[i].x = sheet.positions[fabric.layout().vertex_of[i]] + random_point(random, 0.004f);
        Particles expected = particles;
        for (size_t i = 0; i < batches.joints.size(); ++i)
            for (size_t k = 0; k < kLanes; ++k) {
                const BatchMasses& m = batches.masses[i];
                Vec3& a = expected[batches.joints[i].a[k] / sizeof(Particle)].x;
                Vec3& b = expected[batches.joints[i].b[k] / sizeof(Particle)].x;
                if (m.a[k] + m.b[k] == 0.0f) continue;
                const Vec3 d = a - b;
                const Vec3 impulse = d / glm::length(d) * (batches.joints[i].rest_m[k] - glm::length(d)) /
                                     (m.a[k] + m.b[k] + m.compliance[k] / (h * h));
                a += impulse * m.a[k];
                b -= impulse * m.b[k];
            }
        std::vector<BatchGains> gains(batches.joints.size());
        find_gains(batches.masses, h, gains);
        solve_distances(batches.joints, gains, particles.data());
        for (size_t i = 0; i < particles.size(); ++i) {
            expect_near(particles[i].x, expected[i].x, 1e-6f, i);
            EXPECT_EQ(particles[i].zero, 0.0f);
        }
    });
}

TEST(ClothKernels, TethersPullBackWhatIsBeyondThem) {
    on_each_target([] {
        std::mt19937 random(3);
        Particles particles(18);
        for (Particle& p : particles) p.x = random_point(random, 1.0f);
        std::vector<uint32_t> anchors(16);
        std::vector<float> lengths(16);
        for (uint32_t i = 0; i < 16; ++i) anchors[i] = 16 + i % 2, lengths[i] = i % 5 == 0 ? 1e9f : 0.1f * float(i);
        const Particles before = particles;
        solve_tethers(anchors, lengths, particles.data());
        for (size_t i = 0; i < 16; ++i) {
            const Vec3 d = before[i].x - before[anchors[i]].x;
            const float length = glm::length(d);
            expect_near(particles[i].x, before[anchors[i]].x + d * std::min(1.0f, lengths[i] / length), 1e-6f, i);
        }
    });
}

/// Particles about a body of balls and capsules that moves, some deep inside, some passing through.
struct ContactScene {
    std::vector<SweptCapsule> colliders;
    Particles places, starts, velocities;
    NearColliders near;
    ContactSettings settings{0.3f, 0.25f, 0.002f};

    explicit ContactScene(uint32_t seed, float travel_m) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> radius(0.03f, 0.1f);
        for (int i = 0; i < 70; ++i) {  // more than one word of bits
            Capsule from{random_point(random, 0.5f), {}, radius(random), radius(random)};
            from.b = i % 3 == 0 ? from.a : from.a + random_point(random, 0.3f);
            if (from.is_ball()) from.radius_b = from.radius_a;
            Capsule to = from;
            const Vec3 way = random_point(random, 0.005f);
            to.a += way;
            to.b = from.is_ball() ? to.a : to.b + way + random_point(random, 0.003f);
            colliders.push_back(sweep(from, to, 0.0f, 1.0f));
        }
        for (int i = 0; i < 4096; ++i) {
            // In runs of neighbours, as on a cloth.
            const Vec3 start = i % int(kLanes) == 0 ? random_point(random, 0.6f) : starts.back().x + random_point(random, 0.01f);
            starts.push_back(Particle{start});
            places.push_back(Particle{start + random_point(random, travel_m)});
            velocities.push_back(Particle{});
        }
        reserve(near, places.size(), colliders.size());
        cull(starts, velocities, 1.0f / 60.0f, colliders, near);
    }
};

TEST(ClothKernels, CullingLeavesOutNothingThatCanTouch) {
    on_each_target([] {
        const ContactScene scene(4, 0.0f);
        for (size_t i = 0; i < scene.starts.size(); ++i)
            for (size_t c = 0; c < scene.colliders.size(); ++c)
                if (may_touch(scene.colliders[c], scene.starts[i].x, 0.0f)) {
                    EXPECT_TRUE(scene.near.bits[i / kLanes * scene.near.words() + c / 64] >> (c % 64) & 1) << i << " " << c;
                }
    });
}

TEST(ClothKernels, ContactsAreThoseOfOneParticleAtATime) {
    on_each_target([] {
        for (const float travel_m : {0.004f, 0.3f}) {
            ContactScene scene(5, travel_m);
            Particles expected = scene.places;
            size_t touched = 0, other = 0;
            for (size_t i = 0; i < expected.size(); ++i)
                for (const SweptCapsule& c : scene.colliders) touched += resolve_contact(c, scene.starts[i].x, scene.settings, expected[i].x);
            resolve_contacts({scene.places.data(), scene.starts.data(), scene.colliders, scene.settings, &scene.near}, 0,
                             uint32_t(scene.places.size() / kLanes));
            for (size_t i = 0; i < expected.size(); ++i) {
                other += glm::length(scene.places[i].x - expected[i].x) > 1e-4f;
                EXPECT_TRUE(std::isfinite(scene.places[i].x.x));
            }
            EXPECT_GT(touched, 400u);
            // A way that only grazes the bulge of a collider is left to the next sub-step.
            EXPECT_LT(other, expected.size() / 100) << travel_m;
        }
    });
}

TEST(ClothLayout, BatchesHoldEachConstraintOnceAndNoParticleTwice) {
    Sheet sheet(23, 17, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const auto& edges = fabric.data().edges;
    size_t lanes = 0;
    for (const DistanceBatch& batch : fabric.edge_batches().joints) {
        std::vector<uint32_t> seen;
        for (size_t k = 0; k < kLanes; ++k) {
            if (batch.a[k] == batch.b[k]) {
                EXPECT_EQ(batch.a[k], fabric.layout().spare * sizeof(Particle));
                continue;
            }
            ++lanes;
            seen.push_back(batch.a[k]);
            seen.push_back(batch.b[k]);
        }
        std::sort(seen.begin(), seen.end());
        EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
    }
    EXPECT_EQ(lanes, edges.size());
    EXPECT_LT(fabric.edge_batches().joints.size(), 1.1 * double(edges.size()) / double(kLanes) + 24) << "most lanes are filled";
}

TEST(ClothLayout, EveryVertexHasItsParticleAndThoseThatMoveComeFirst) {
    Sheet sheet(9, 7, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const ParticleLayout& layout = fabric.layout();
    EXPECT_EQ(layout.moving % kLanes, 0u);
    for (uint32_t v = 0; v < fabric.vertex_count(); ++v) {
        EXPECT_EQ(layout.vertex_of[layout.particle_of[v]], v);
        EXPECT_EQ(layout.particle_of[v] < layout.moving, sheet.simulated[v] != 0);
    }
    EXPECT_EQ(layout.vertex_of[layout.spare], ParticleLayout::kNobody);
}

}  // namespace
}  // namespace vfit
