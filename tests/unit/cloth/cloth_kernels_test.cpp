// The hot loops on every instruction set that this machine has, against their formulas one particle at a
// time.
#include "cloth/solver/cloth_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "cloth/contact/contact_culling.h"
#include "cloth_support.h"
#include "cloth_targets.h"

namespace vfit {
namespace {

using namespace test;

void expect_near(const Vec3& a, const Vec3& b, float tolerance, size_t i) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << i << ": " << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

/// The end of a sub-step in which nothing but what a test adds acts on these particles.
struct End {
    std::vector<uint32_t> anchors;
    std::vector<float> tethers;
    NearColliders met;
    SubstepEnd job{};

    End(Particles& places, Particles& starts, Particles& velocities, size_t moving)
        : anchors(moving, uint32_t(places.size() - 1)), tethers(moving, 1e9f) {
        reserve(met, moving, 0);
        cull({places.data(), moving}, {velocities.data(), moving}, 1.0f, {}, met);
        job.moving = {places.data(), starts.data(), velocities.data(), uint32_t(moving)};
        job.anchors = places.data();
        job.anchor_index = anchors;
        job.tether_m = tethers;
        job.may_meet = &met;
        job.from = 0.0f;
        job.to = 1.0f;
        job.h = 1.0f / 480.0f;
        job.keep = 1.0f;
        job.last = true;
    }
};

TEST(ClothKernels, FreeFlightIsExact) {
    on_each_target([] {
        std::mt19937 random(1);
        Particles places(16), starts(16), velocities(16);
        for (auto* list : {&places, &velocities})
            for (Particle& p : *list) p.x = random_point(random, 1.0f);
        const Particles before = places, speeds = velocities;
        const Vec3 half_fall(0.1f, -0.02f, 0.03f), pull(0.002f, 0.001f, 0.0f);
        End end(places, starts, velocities, 16);
        const float h = end.job.h, keep = end.job.keep = 0.9f;
        end.job.half_fall = half_fall;
        predict(end.job.moving, half_fall, h);
        for (size_t i = 0; i < 16; ++i) {
            expect_near(starts[i].x, before[i].x, 1e-9f, i);
            expect_near(places[i].x, before[i].x + (speeds[i].x + half_fall) * h, 1e-6f, i);
            EXPECT_EQ(places[i].zero, 0.0f);
            places[i].x += pull;
        }
        Particles next_places = places, next_starts = starts, next_velocities = velocities;
        end_substep(end.job);
        for (size_t i = 0; i < 16; ++i)
            expect_near(velocities[i].x, (speeds[i].x + 2.0f * half_fall + pull / h) * keep, 1e-4f, i);
        // With the begin of the next one.
        predict(end.job.moving, half_fall, h);
        End both(next_places, next_starts, next_velocities, 16);
        both.job.half_fall = half_fall;
        both.job.keep = keep;
        both.job.last = false;
        end_substep(both.job);
        for (size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(next_starts[i].x, starts[i].x);
            expect_near(next_places[i].x, places[i].x, 1e-6f, i);
            expect_near(next_velocities[i].x, velocities[i].x, 1e-5f, i);
        }
    });
}

TEST(ClothKernels, DistancesAreThoseOfXpbd) {
    Sheet sheet(12, 11, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    ASSERT_EQ(fabric.edge_batches().size(), 1u);
    const DistanceBatches& batches = fabric.edge_batches()[0];
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
        const float most = find_gains(batches.masses, h, 1.0f, gains);
        EXPECT_GT(most, 0.5f);
        EXPECT_LE(most, 1.0f);
        solve_distances(batches.joints, gains, particles.data());
        for (size_t i = 0; i < particles.size(); ++i) {
            expect_near(particles[i].x, expected[i].x, 1e-6f, i);
            EXPECT_EQ(particles[i].zero, 0.0f);
        }
    });
}

TEST(ClothKernels, HingesAreThoseOfXpbd) {
    Sheet sheet(12, 11, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const HingeBatches& batches = fabric.hinge_batches()[0];
    const float h = 1.0f / 480.0f;
    on_each_target([&] {
        std::mt19937 random(8);
        Particles particles(fabric.layout().count());
        for (uint32_t i = 0; i < particles.size(); ++i)
            if (fabric.layout().vertex_of[i] != ParticleLayout::kNobody)
                particles[i].x = sheet.positions[fabric.layout().vertex_of[i]] + random_point(random, 0.004f);
        Particles expected = particles;
        size_t lanes = 0;
        for (size_t i = 0; i < batches.hinges.size(); ++i)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const HingeBatch& batch = batches.hinges[i];
                Vec3 sum(0.0f);
                float mass = 0.0f;
                for (size_t k = 0; k < 4; ++k) {
                    sum += batch.weight[k][lane] * expected[batch.at[k][lane] / sizeof(Particle)].x;
                    mass += batches.masses[i].inverse_mass[k][lane] * batch.weight[k][lane] *
                            batch.weight[k][lane];
                }
                lanes += batch.weight[2][lane] > 0.0f;
                const Vec3 impulse = -sum / (mass + batches.masses[i].compliance[lane] / (h * h));
                for (size_t k = 0; k < 4; ++k)
                    expected[batch.at[k][lane] / sizeof(Particle)].x +=
                        impulse * batches.masses[i].inverse_mass[k][lane] * batch.weight[k][lane];
            }
        EXPECT_EQ(lanes, fabric.data().hinges.size());
        std::vector<HingeGains> gains(batches.hinges.size());
        find_hinge_gains(batches.hinges, batches.masses, h, 0.0f, gains);
        for (const HingeGains& of_batch : gains) EXPECT_FALSE(of_batch.soft);
        solve_hinges(batches.hinges, gains, false, particles.data());
        for (size_t i = 0; i < particles.size(); ++i) expect_near(particles[i].x, expected[i].x, 1e-6f, i);
    });
}

TEST(ClothKernels, TwiceTheForceIsHalfTheCompliance) {
    Sheet sheet(5, 4, 0.02f);
    const Fabric fabric(sheet.cook(cotton()));
    const DistanceBatches& batches = fabric.edge_batches()[0];
    std::vector<BatchMasses> halved = batches.masses;
    for (BatchMasses& m : halved)
        for (float& c : m.compliance) c *= 0.5f;
    on_each_target([&] {
        std::vector<BatchGains> doubled(halved.size()), expected(halved.size());
        find_gains(batches.masses, 1.0f / 480.0f, 2.0f, doubled);
        find_gains(halved, 1.0f / 480.0f, 1.0f, expected);
        for (size_t i = 0; i < halved.size(); ++i)
            for (size_t k = 0; k < kLanes; ++k)
                EXPECT_NEAR(doubled[i].a[k], expected[i].a[k], 1e-5f * expected[i].a[k]);
    });
}

TEST(ClothKernels, TethersPullBackWhatIsBeyondThem) {
    on_each_target([] {
        std::mt19937 random(3);
        Particles particles(18), starts(18), velocities(18);
        for (Particle& p : particles) p.x = random_point(random, 1.0f);
        End end(particles, starts, velocities, 16);
        std::vector<float> lengths(16);
        std::vector<uint32_t> anchors(16);
        for (uint32_t i = 0; i < 16; ++i) {
            anchors[i] = 16 + i % 2, lengths[i] = i % 5 == 0 ? 1e9f : 0.1f * float(i);
            const size_t at = i / kLanes * kLanes + lane_of(i % kLanes);
            end.anchors[at] = anchors[i], end.tethers[at] = lengths[i];
        }
        const Particles before = particles;
        end_substep(end.job);
        for (size_t i = 0; i < 16; ++i) {
            const Vec3 d = before[i].x - before[anchors[i]].x;
            const float length = glm::length(d);
            expect_near(particles[i].x, before[anchors[i]].x + d * std::min(1.0f, lengths[i] / length), 1e-6f,
                        i);
        }
    });
}

TEST(ClothKernels, BackstopsAreBallsThatMove) {
    on_each_target([] {
        std::mt19937 random(6);
        Particles places(17), starts(17), velocities(17);
        RunBalls balls{};
        const float radius = 0.1f;
        const Vec3 way(0.002f, 0.0f, 0.001f);
        std::vector<Vec3> centers(8);
        for (uint32_t i = 0; i < 16; ++i) {
            starts[i].x = random_point(random, 1.0f);
            places[i].x = starts[i].x + random_point(random, 0.002f);
            if (i < 8) continue;
            const size_t lane = lane_of(i % kLanes);
            const Vec3 off = random_point(random, 1.0f);
            // Some inside by up to what comes out at once, some outside.
            const Vec3 center = centers[i - 8] =
                starts[i].x + off / glm::length(off) * (radius + 0.001f * (float(i) - 12.0f));
            balls.x[lane] = center.x, balls.y[lane] = center.y, balls.z[lane] = center.z;
            balls.way_x[lane] = 2.0f * way.x, balls.way_y[lane] = 2.0f * way.y,
            balls.way_z[lane] = 2.0f * way.z;
            balls.radius_m[lane] = i == 10 ? 0.0f : radius;
        }
        balls.run = 1;
        const Particles before = places;
        End end(places, starts, velocities, 16);
        end.job.backstops = {&balls, 1};
        end.job.contact = {0.3f, 0.25f, 0.01f};
        end.job.from = 0.0f, end.job.to = 0.5f;
        end_substep(end.job);
        int pushed = 0;
        for (uint32_t i = 0; i < 16; ++i) {
            Vec3 expected = before[i].x;
            if (i >= 8 && i != 10) {
                const Vec3 d = expected - (centers[i - 8] + way);
                const float depth = radius - glm::length(d);
                if (depth > 0.0f) {
                    ++pushed;
                    expected += d / glm::length(d) * depth;
                    apply_friction(starts[i].x, way, d / glm::length(d), depth, end.job.contact, expected);
                }
            }
            expect_near(places[i].x, expected, 1e-6f, i);
        }
        EXPECT_GT(pushed, 2);
    });
}

/// Particles about a body of balls and capsules that moves, some deep inside, some passing through.
struct ContactScene {
    std::vector<SweptCapsule> colliders;
    Particles places, starts, velocities;
    NearColliders met;
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
            const Vec3 start = i % int(kLanes) == 0 ? random_point(random, 0.6f)
                                                    : starts.back().x + random_point(random, 0.01f);
            starts.push_back(Particle{start});
            places.push_back(Particle{start + random_point(random, travel_m)});
            velocities.push_back(Particle{});
        }
        reserve(met, places.size(), colliders.size());
        cull(starts, velocities, 1.0f / 60.0f, colliders, met);
    }
};

TEST(ClothKernels, CullingLeavesOutNothingThatCanTouch) {
    on_each_target([] {
        const ContactScene scene(4, 0.0f);
        for (size_t i = 0; i < scene.starts.size(); ++i)
            for (size_t c = 0; c < scene.colliders.size(); ++c)
                if (may_touch(scene.colliders[c], scene.starts[i].x, 0.0f)) {
                    EXPECT_TRUE(scene.met.bits[i / kLanes * scene.met.words() + c / 64] >> (c % 64) & 1)
                        << i << " " << c;
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
                for (const SweptCapsule& c : scene.colliders)
                    touched += resolve_contact(c, scene.starts[i].x, scene.settings, expected[i].x);
            const size_t moving = scene.places.size();
            scene.places.emplace_back();
            End end(scene.places, scene.starts, scene.velocities, moving);
            end.job.may_meet = &scene.met;
            end.job.colliders = scene.colliders;
            end.job.contact = scene.settings;
            end_substep(end.job);
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
    Sheet sheet(73, 31, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const ParticleLayout& layout = fabric.layout();
    EXPECT_GT(layout.parts.size(), 2u);
    std::set<std::pair<uint32_t, uint32_t>> found;
    size_t batches = 0, lanes = 0;
    for (uint32_t group = 0; group < layout.group_count(); ++group)
        for (const DistanceBatch& batch : fabric.edge_batches()[group].joints) {
            ++batches;
            std::vector<uint32_t> seen;
            for (size_t k = 0; k < kLanes; ++k) {
                if (batch.a[k] == batch.b[k]) {
                    EXPECT_EQ(batch.a[k], layout.spare_of_group(group) * sizeof(Particle));
                    EXPECT_EQ(layout.vertex_of[layout.spare_of_group(group)], ParticleLayout::kNobody);
                    continue;
                }
                ++lanes;
                const uint32_t a = layout.vertex_of[batch.a[k] / sizeof(Particle)],
                               b = layout.vertex_of[batch.b[k] / sizeof(Particle)];
                found.insert(std::minmax(a, b));
                seen.push_back(batch.a[k]);
                seen.push_back(batch.b[k]);
            }
            std::sort(seen.begin(), seen.end());
            EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
        }
    EXPECT_EQ(lanes, fabric.data().edges.size());
    for (const DistanceConstraint& e : fabric.data().edges)
        EXPECT_TRUE(found.count(std::minmax(e.a, e.b))) << e.a << " " << e.b;
    EXPECT_LT(double(batches), 1.1 * double(lanes) / double(kLanes) + 24.0 * layout.group_count())
        << "most lanes are filled";
}

TEST(ClothLayout, WhatThreadsWorkOnSideBySideShareNoParticle) {
    Sheet sheet(73, 31, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const ParticleLayout& layout = fabric.layout();
    const auto parts = uint32_t(layout.parts.size());
    std::map<uint32_t, uint32_t> cut_of;
    for (const auto* list : {&fabric.edge_batches(), &fabric.bend_batches()})
        for (uint32_t group = 0; group < layout.group_count(); ++group)
            for (const DistanceBatch& batch : (*list)[group].joints)
                for (size_t k = 0; k < kLanes; ++k)
                    for (const uint32_t byte : {batch.a[k], batch.b[k]}) {
                        const auto particle = uint32_t(byte / sizeof(Particle));
                        if (group < parts) {
                            EXPECT_GE(particle, layout.parts[group].begin);
                            EXPECT_LT(particle, layout.parts[group].end);
                        } else {
                            const auto [place, fresh] = cut_of.insert({particle, group});
                            EXPECT_EQ(place->second, group) << particle << " is in two cuts";
                        }
                    }
    EXPECT_FALSE(cut_of.empty());
}

TEST(ClothLayout, EveryVertexHasItsParticleAndThoseThatMoveComeFirst) {
    Sheet sheet(9, 7, 0.02f);
    sheet.pin_top();
    const Fabric fabric(sheet.cook(cotton()));
    const ParticleLayout& layout = fabric.layout();
    for (uint32_t v = 0; v < fabric.vertex_count(); ++v) {
        const uint32_t particle = layout.particle_of[v];
        EXPECT_EQ(layout.vertex_of[particle], v);
        const ParticleLayout::Part& part = layout.parts[layout.part_of(particle)];
        EXPECT_EQ(part.begin % kLanes, 0u);
        EXPECT_EQ(part.moving_end % kLanes, 0u);
        EXPECT_EQ(particle < part.moving_end, sheet.simulated[v] != 0);
    }
}

TEST(ClothLayout, OddClothsAreLaidOutAsWell) {
    FabricData nothing_moves;
    nothing_moves.inverse_mass = {0.0f, 0.0f};
    EXPECT_EQ(Fabric(nothing_moves).layout().parts.size(), 1u);
    FabricData dust;  // no constraint at all
    dust.inverse_mass.assign(5000, 1.0f);
    const Fabric loose(dust);
    EXPECT_GT(loose.layout().parts.size(), 1u);
    FabricData star;  // everything hangs on one vertex
    star.inverse_mass.assign(3000, 1.0f);
    for (uint32_t v = 1; v < 3000; ++v) star.edges.push_back({0, v, 0.1f, 0.0f});
    EXPECT_EQ(Fabric(star).edge_batches().size(), size_t(Fabric(star).layout().group_count()));
    FabricData loop;  // two ends of a long strip are joined: no way to cut it across once
    loop.inverse_mass.assign(4000, 1.0f);
    for (uint32_t v = 0; v < 4000; ++v) loop.edges.push_back({v, (v + 1) % 4000, 0.1f, 0.0f});
    const Fabric ring(loop);
    EXPECT_GE(ring.layout().parts.size(), 1u);
}

}  // namespace
}  // namespace vfit
