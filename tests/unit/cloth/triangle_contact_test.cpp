// Contact between triangles: closest points, times of touch, pairs that are found, and steps in which nothing
// crosses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/contact_pair.h"
#include "cloth/contact/crossing_guard.h"
#include "cloth/contact/flat_distances.h"
#include "cloth/contact/proximity.h"
#include "cloth/contact/triangle_contact.h"
#include "cloth/crossings.h"
#include "cloth_support.h"
#include "cloth_targets.h"
#include "two_sheets.h"

namespace vfit::test {
namespace {

std::vector<Particle> particles_of(std::span<const Vec3> places) {
    std::vector<Particle> out;
    for (const Vec3& p : places) out.push_back({p});
    return out;
}
std::vector<Vec3> places_of(std::span<const Particle> particles) {
    std::vector<Vec3> out;
    for (const Particle& p : particles) out.push_back(p.x);
    return out;
}
std::array<Vec3, 4> random_four(std::mt19937& random, float size) {
    return {random_point(random, size), random_point(random, size), random_point(random, size),
            random_point(random, size)};
}

constexpr PairKind kKinds[] = {PairKind::vertex_face, PairKind::edge_edge};

TEST(ContactPair, NoPointsAreCloserThanTheClosest) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i)
        for (const PairKind kind : kKinds) {
            const auto at = random_four(random, 1.0f);
            const ClosestPoints closest = closest_points(kind, at);
            EXPECT_NEAR(closest.weights[0] + closest.weights[1] + closest.weights[2] + closest.weights[3],
                        0.0f, 1e-5f);
            const float distance = glm::length(closest.way);
            for (float u = 0.0f; u <= 1.0f; u += 0.1f)
                for (float v = 0.0f; v <= 1.0f; v += 0.1f) {
                    if (kind == PairKind::vertex_face && u + v > 1.0f) continue;
                    const Vec3 way = kind == PairKind::vertex_face
                                         ? at[0] - ((1 - u - v) * at[1] + u * at[2] + v * at[3])
                                         : glm::mix(at[0], at[1], u) - glm::mix(at[2], at[3], v);
                    EXPECT_LE(distance, glm::length(way) + 1e-4f);
                }
        }
}

TEST(ContactPair, TheTimeOfTouchIsTheFirst) {
    std::mt19937 random(2);
    int touched = 0, missed = 0;
    for (int i = 0; i < 2000; ++i)
        for (const PairKind kind : kKinds) {
            const auto from = random_four(random, 0.1f), to = random_four(random, 0.1f);
            std::array<float, 4> weights;
            const std::optional<float> time = first_touch(kind, from, to, 1e-5f, weights);
            const auto distance_at = [&](float t) {
                std::array<Vec3, 4> at;
                for (size_t k = 0; k < 4; ++k) at[k] = glm::mix(from[k], to[k], t);
                return glm::length(closest_points(kind, at).way);
            };
            float least = INFINITY;  // before that
            for (float t = 0.0f; t < time.value_or(1.0f) - 0.01f; t += 0.005f)
                least = std::min(least, distance_at(t));
            EXPECT_GT(least, 0.0f);
            if (time) {
                EXPECT_LT(distance_at(*time), 2e-5f);
            }
            (time ? touched : missed) += 1;
        }
    EXPECT_GT(touched, 100);
    EXPECT_GT(missed, 100);
}

TEST(ContactPair, AVertexThatGoesThroughATriangleTouchesItOnTheWay) {
    const std::array<Vec3, 4> from{Vec3(0.2f, 0.3f, 1), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    std::array<Vec3, 4> to = from;
    to[0].z = -3.0f;
    std::array<float, 4> weights;
    const std::optional<float> time = first_touch(PairKind::vertex_face, from, to, 1e-5f, weights);
    ASSERT_TRUE(time);
    EXPECT_NEAR(*time, 0.25f, 1e-4f);
    EXPECT_NEAR(weights[2], -0.2f, 1e-4f);
    EXPECT_NEAR(weights[3], -0.3f, 1e-4f);
    to[0] = Vec3(2.0f, 2.0f, -3.0f);
    EXPECT_FALSE(first_touch(PairKind::vertex_face, from, to, 1e-5f, weights)) << "beside it";
}

TEST(ContactKernels, ClosestPointsAreThoseOfOnePair) {
    on_each_target([] {
        std::mt19937 random(5);
        std::vector<Particle> begin(40), end(40);
        for (Particle& p : begin) p.x = random_point(random, 0.1f);
        for (Particle& p : end) p.x = random_point(random, 0.1f);
        for (const PairKind kind : kKinds) {
            std::vector<PrimitivePairs> pairs(20);
            for (PrimitivePairs& eight : pairs)
                for (size_t lane = 0; lane < kLanes; ++lane) {
                    const uint32_t first = uint32_t(random() % 36);
                    for (uint32_t k = 0; k < 4; ++k) eight.at[k][lane] = first + k;
                }
            find_closest(pairs, kind == PairKind::edge_edge, begin.data(), end.data(), 0.25f);
            for (const PrimitivePairs& eight : pairs)
                for (size_t lane = 0; lane < kLanes; ++lane) {
                    std::array<Vec3, 4> at;
                    for (size_t k = 0; k < 4; ++k) at[k] = end[eight.at[k][lane]].x;
                    const ClosestPoints closest = closest_points(kind, at);
                    EXPECT_NEAR(eight.distance_m[lane], glm::length(closest.way), 2e-5f);
                    Vec3 way(0.0f);
                    for (size_t k = 0; k < 4; ++k) way += eight.weight[k][lane] * at[k];
                    EXPECT_NEAR(glm::length(way), eight.distance_m[lane], 2e-5f);
                    EXPECT_GE(eight.comes_m[lane], 0.0f);
                }
        }
    });
}

/// Pairs of triangles of random places and ways.
struct RandomTriangles {
    static constexpr uint32_t kCount = 400;
    std::vector<Particle> begin, end;

    explicit RandomTriangles(uint32_t seed) {
        std::mt19937 random(seed);
        for (uint32_t t = 0; t < kCount; ++t) {
            const Vec3 at = random_point(random, 0.06f), way = random_point(random, 0.02f);
            for (int k = 0; k < 3; ++k) {
                begin.push_back({at + random_point(random, 0.02f)});
                end.push_back({begin.back().x + way + random_point(random, 0.003f)});
            }
        }
    }
    /// Do the two cross somewhere on the way?
    bool cross_on_the_way(uint32_t a, uint32_t b) const {
        for (float t = 0.0f; t <= 1.0f; t += 0.02f) {
            Corners of[2];
            for (uint32_t k = 0; k < 3; ++k) {
                of[0].at[k] = glm::mix(begin[3 * a + k].x, end[3 * a + k].x, t);
                of[1].at[k] = glm::mix(begin[3 * b + k].x, end[3 * b + k].x, t);
            }
            if (cross(of[0], of[1])) return true;
        }
        return false;
    }
};

TEST(ContactKernels, WhatCrossesOnTheWayIsUncertain) {
    on_each_target([] {
        const RandomTriangles triangles(6);
        size_t certain = 0, crossed = 0;
        for (uint32_t first = 0; first + 1 < RandomTriangles::kCount; first += 7) {
            std::vector<TrianglePairs> pairs(RandomTriangles::kCount / kLanes);
            for (uint32_t other = 0; other < RandomTriangles::kCount; ++other)
                for (uint32_t k = 0; k < 3; ++k) {
                    pairs[other / kLanes].first[k][other % kLanes] = 3 * first + k;
                    pairs[other / kLanes].second[k][other % kLanes] = 3 * other + k;
                }
            std::vector<TrianglePairs> not_certified = pairs;
            classify(pairs, triangles.begin.data(), triangles.end.data(), 0.005f, true);
            classify(not_certified, triangles.begin.data(), triangles.end.data(), 0.005f, false);
            for (size_t i = 0; i < pairs.size(); ++i) {
                EXPECT_EQ(not_certified[i].close, pairs[i].close);
                EXPECT_EQ(not_certified[i].uncertain, 0);
            }
            for (uint32_t other = 0; other < RandomTriangles::kCount; ++other) {
                if (other == first) continue;
                const bool uncertain = pairs[other / kLanes].uncertain >> (other % kLanes) & 1;
                certain += !uncertain;
                if (!triangles.cross_on_the_way(first, other)) continue;
                ++crossed;
                EXPECT_TRUE(uncertain) << first << " " << other;
            }
        }
        EXPECT_GT(crossed, 50u);
        EXPECT_GT(certain, 10000u) << "most are far apart";
    });
}

TEST(Proximity, MissesNoPairThatCrossesOnTheWay) {
    const RandomTriangles triangles(7);
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 3 * RandomTriangles::kCount; ++i) indices.push_back(i);
    for (const unsigned workers : {0u, 2u}) {
        const auto jobs = Jobs::own(workers);
        Proximity proximity(places_of(triangles.begin), indices, 0.004f);
        proximity.find(triangles.begin, triangles.end, *jobs);
        std::set<TrianglePair> uncertain;
        proximity.for_uncertain([&](const Proximity::Pair& pair, uint32_t) {
            uncertain.insert(std::minmax(pair.first->number, pair.second->number));
        });
        size_t crossed = 0;
        for (uint32_t a = 0; a < RandomTriangles::kCount; ++a)
            for (uint32_t b = a + 1; b < RandomTriangles::kCount; ++b)
                if (triangles.cross_on_the_way(a, b)) {
                    ++crossed;
                    EXPECT_TRUE(uncertain.count({a, b})) << a << " " << b;
                }
        EXPECT_GT(crossed, 100u);
    }
}

TEST(Proximity, ACopyFindsTheSamePairsOfItsOwn) {
    const RandomTriangles triangles(7);
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 3 * RandomTriangles::kCount; ++i) indices.push_back(i);
    const auto jobs = Jobs::own(0);
    auto first = std::make_unique<Proximity>(places_of(triangles.begin), indices, 0.004f);
    first->find(triangles.begin, triangles.end, *jobs);
    const auto close = [](const Proximity& proximity) {
        std::set<TrianglePair> pairs;
        proximity.for_close([&](const Proximity::Pair& pair, uint32_t) {
            pairs.insert({pair.first->number, pair.second->number});
        });
        return pairs;
    };
    const std::set<TrianglePair> found = close(*first);
    Proximity copy(*first);
    first.reset();
    EXPECT_TRUE(close(copy).empty()) << "none before it looked";
    copy.find(triangles.begin, triangles.end, *jobs);
    EXPECT_EQ(close(copy), found);
    EXPECT_GT(found.size(), 100u);
}

/// Pairs that a step finds: those within reach, and those that may have crossed.
struct FoundPairs {
    std::set<TrianglePair> close, uncertain;

    explicit FoundPairs(const Proximity& proximity) {
        proximity.for_close([&](const Proximity::Pair& pair, uint32_t) { close.insert(numbers(pair)); });
        proximity.for_uncertain(
            [&](const Proximity::Pair& pair, uint32_t) { uncertain.insert(numbers(pair)); });
    }
    static TrianglePair numbers(const Proximity::Pair& pair) {
        return std::minmax(pair.first->number, pair.second->number);
    }
};

TEST(Proximity, FindsPairsAgainAboutWhatWentElsewhere) {
    const RandomTriangles triangles(7);
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 3 * RandomTriangles::kCount; ++i) indices.push_back(i);
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> places = places_of(triangles.begin);
    Proximity proximity(places, indices, 0.004f), fresh(places, indices, 0.004f);
    proximity.find(triangles.begin, triangles.end, *jobs);
    const FoundPairs before(proximity);
    std::vector<Particle> end = triangles.end;
    std::vector<uint8_t> marked(end.size(), 0);
    for (uint32_t t = 0; t < RandomTriangles::kCount; t += 20)
        for (uint32_t k = 0; k < 3; ++k) end[3 * t + k].x += Vec3(0.03f, 0, 0), marked[3 * t + k] = 1;
    proximity.find_again(marked, triangles.begin, end);
    proximity.find_close(triangles.begin, end, *jobs);
    fresh.find(triangles.begin, end, *jobs);
    const FoundPairs again(proximity), all(fresh);
    EXPECT_EQ(again.close, all.close);
    EXPECT_EQ(again.uncertain, all.uncertain);
    EXPECT_NE(again.close, before.close);
    size_t count = 0;
    proximity.for_close([&](const Proximity::Pair&, uint32_t) { ++count; });
    EXPECT_EQ(count, again.close.size()) << "each once";
}

TEST(TrianglePatches, OfASolidOnlyWhatLiesBeforeItsPlanesIsLeftOut) {
    constexpr float kReach_m = 0.003f;
    on_each_target([] {
        const auto jobs = Jobs::own(0);
        const RandomTriangles triangles(11);
        const uint32_t half = RandomTriangles::kCount / 2;
        std::vector<uint32_t> indices;
        for (uint32_t i = 0; i < 3 * half; ++i) indices.push_back(i);
        const std::vector<Vec3> places = places_of(triangles.end);
        const std::span<const Vec3> of_all(places);
        TrianglePatches cloth(of_all.first(3 * half), indices);
        TrianglePatches solid(of_all.subspan(3 * half, 3 * half), indices, 3 * half);
        cloth.move(triangles.end, triangles.end, *jobs), solid.move(triangles.end, triangles.end, *jobs);
        std::vector<TrianglePatches::Pair> all, kept;
        cloth.find_pairs(solid, kReach_m, all, *jobs);
        cloth.find_pairs_with_solid(solid, triangles.end, kReach_m, kept, *jobs);
        std::set<TrianglePair> left;
        for (const auto& pair : kept) left.insert({pair.first->number, pair.second->number});
        size_t dropped = 0;
        for (const auto& [a, b] : all) {
            const Vec3 *first = &places[b->vertex[0]],
                       normal = glm::normalize(
                           glm::cross(places[b->vertex[1]] - *first, places[b->vertex[2]] - *first));
            float lowest_m = INFINITY;
            for (const uint32_t v : a->vertex)
                lowest_m = std::min(lowest_m, glm::dot(places[v] - *first, normal));
            if (std::abs(lowest_m - kReach_m) < 1e-5f) continue;  // rounding decides
            EXPECT_EQ(left.count({a->number, b->number}) == 0, lowest_m > kReach_m) << lowest_m;
            dropped += lowest_m > kReach_m;
        }
        EXPECT_GT(dropped, 50u);
        EXPECT_GT(kept.size(), 50u);
    });
}

TEST(Proximity, TrianglesMeetWhatTheirMasksSay) {
    const auto jobs = Jobs::own(0);
    const TwoSheets sheets(6, 0.02f, {0.004f, 0.003f, 0.005f});
    const std::span<const Vec3> all(sheets.positions);
    const std::vector<uint32_t> indices(sheets.indices.begin(),
                                        sheets.indices.begin() + std::ptrdiff_t(sheets.indices.size() / 2));
    const std::vector<Particle> places = particles_of(all);
    const auto close_with = [&](uint8_t category, uint8_t mask) {
        const std::vector<uint8_t> categories(sheets.of_one, category), masks(sheets.of_one, mask);
        Proximity proximity(all.first(sheets.of_one), indices, 0.0f);
        proximity.add_mesh(sheets.of_one, indices, 0.004f, MeshOf::prop, {categories, masks});
        proximity.show_mesh(0, all.subspan(sheets.of_one));
        proximity.find(places, places, *jobs);
        size_t count = 0;
        proximity.for_close([&](const Proximity::Pair&, uint32_t) { ++count; });
        return count;
    };
    EXPECT_GT(close_with(1, 3), 50u);
    EXPECT_EQ(close_with(4, 3), 0u);
}

TEST(Proximity, AMeshIsMetWhileItIsShown) {
    const auto jobs = Jobs::own(0);
    const TwoSheets sheets(6, 0.02f, {0.004f, 0.003f, 0.005f});
    const std::span<const Vec3> all(sheets.positions);
    const std::vector<uint32_t> indices(sheets.indices.begin(),
                                        sheets.indices.begin() + std::ptrdiff_t(sheets.indices.size() / 2));
    Proximity proximity(all.first(sheets.of_one), indices, 0.0f);
    proximity.add_mesh(sheets.of_one, indices, 0.004f, MeshOf::prop);
    const std::vector<Particle> places = particles_of(all);
    const auto count = [&] {
        size_t close = 0;
        proximity.find(places, places, *jobs);
        proximity.for_close([&](const Proximity::Pair& pair, uint32_t surface) {
            EXPECT_EQ(surface, 1u);
            EXPECT_LT(pair.first->vertex[0], sheets.of_one);
            EXPECT_GE(pair.second->vertex[0], sheets.of_one);
            ++close;
        });
        return close;
    };
    EXPECT_EQ(count(), 0u);
    proximity.show_mesh(0, all.subspan(sheets.of_one));
    EXPECT_GT(count(), 50u);
    proximity.hide_mesh(0);
    EXPECT_EQ(count(), 0u);
}

TEST(ContactKernels, AContactOpensAndKeepsTheMomentum) {
    on_each_target([] {
        constexpr uint32_t kSpare = 4 * kLanes;
        Particles places(kSpare + 1);
        std::vector<ContactBatch> contacts(1);
        std::mt19937 random(8);
        const float heights[kLanes] = {0.001f, -0.001f, 0.01f, 0.001f, 0.003f, 0.0f, 0.002f, 0.0039f};
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            for (uint32_t k = 0; k < 4; ++k)
                contacts[0].at[k][lane] = (4 * lane + k) * uint32_t(sizeof(Particle));
            places[4 * lane].x = Vec3(0.005f, heights[lane], 0.005f);
            places[4 * lane + 1].x = Vec3(0), places[4 * lane + 2].x = Vec3(0, 0, 0.02f);
            places[4 * lane + 3].x = Vec3(0.02f, 0, 0);
            for (uint32_t k = 0; k < 4; ++k) contacts[0].inverse_mass[k][lane] = 1.0f + float(k);
            for (int k = 0; k < 3; ++k) contacts[0].normal[k][lane] = k == 1 ? 1.0f : 0.0f;
            contacts[0].distance_m[lane] = 0.004f;
            contacts[0].side[lane] = 1.0f;
        }
        const Particles starts = places;
        refresh_contacts(contacts, false, places.data());
        solve_contacts(contacts, {0.002f, 0.0f}, starts.data(), places.data());
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            const float expected = std::max(heights[lane], std::min(0.004f, heights[lane] + 0.002f));
            std::array<Vec3, 4> at;
            Vec3 momentum(0.0f);
            for (uint32_t k = 0; k < 4; ++k) {
                at[k] = places[4 * lane + k].x;
                momentum += (at[k] - starts[4 * lane + k].x) / (1.0f + float(k));
            }
            EXPECT_NEAR(at[0].y - (0.5f * at[1].y + 0.25f * at[2].y + 0.25f * at[3].y), expected, 1e-5f)
                << lane;
            EXPECT_LT(glm::length(momentum), 1e-6f);
        }
    });
}

TEST(ContactKernels, BesideFixedVerticesNothingIsThrown) {
    on_each_target([] {
        // The vertex is above the triangle's fixed corner; only the far corners, with weights of 1 %, move.
        Particles places(5);
        places[0].x = Vec3(0.0001f, 0.001f, 0.0001f);
        places[2].x = Vec3(0, 0, 0.01f), places[3].x = Vec3(0.01f, 0, 0);
        std::vector<ContactBatch> contacts(1);
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            for (uint32_t k = 0; k < 4; ++k) {
                contacts[0].at[k][lane] = (lane == 0 ? k : 4) * uint32_t(sizeof(Particle));
                contacts[0].inverse_mass[k][lane] = lane == 0 && k >= 2 ? 1000.0f : 0.0f;
            }
            for (int k = 0; k < 3; ++k) contacts[0].normal[k][lane] = k == 1 ? 1.0f : 0.0f;
            contacts[0].distance_m[lane] = lane == 0 ? 0.004f : -1.0f;
            contacts[0].side[lane] = 1.0f;
        }
        const Particles starts = places;
        refresh_contacts(contacts, false, places.data());
        solve_contacts(contacts, {0.002f, 0.0f}, starts.data(), places.data());
        for (size_t i = 0; i < places.size(); ++i)
            EXPECT_LT(glm::distance(places[i].x, starts[i].x), 0.01f) << i;
    });
}

TEST(FlatDistances, AreTheShortestWaysAlongEdges) {
    Sheet sheet(12, 12, 0.02f);
    sheet.pin_top();
    const FabricData data = sheet.cook(cotton());
    constexpr float kRadius_m = 0.05f;
    const auto two = Jobs::own(2);
    const FlatDistances flat(data, kRadius_m), again(data, kRadius_m, two.get());
    // All ways at once (Floyd and Warshall), to compare.
    const auto n = uint32_t(data.inverse_mass.size());
    std::vector<float> way(size_t(n) * n, INFINITY);
    std::vector<uint8_t> joined(size_t(n) * n, 0);
    const auto join = [&](uint32_t a, uint32_t b, float length) {
        way[a * n + b] = way[b * n + a] = length, joined[a * n + b] = joined[b * n + a] = 1;
    };
    for (const DistanceConstraint& e : data.edges) join(e.a, e.b, e.rest_m);
    for (uint32_t c = 0; c + 1 < sheet.columns; ++c) join(c, c + 1, 0.0f);  // pinned: no constraints
    for (uint32_t v = 0; v < n; ++v) way[v * n + v] = 0.0f;
    for (uint32_t k = 0; k < n; ++k)
        for (uint32_t i = 0; i < n; ++i)
            for (uint32_t j = 0; j < n; ++j)
                way[i * n + j] = std::min(way[i * n + j], way[i * n + k] + way[k * n + j]);
    for (uint32_t a = 0; a < n; ++a)
        for (uint32_t b = 0; b < n; ++b) {
            EXPECT_EQ(flat.between(a, b), again.between(a, b));
            const float along = way[a * n + b];
            if (joined[a * n + b] || a == b) {
                ASSERT_EQ(flat.between(a, b), 0.0f);
            } else if (along < kRadius_m - 1e-4f) {
                ASSERT_NEAR(flat.between(a, b), along, 1e-5f);
            } else if (along > kRadius_m + 1e-4f) {
                ASSERT_EQ(flat.between(a, b), INFINITY);
            }
        }
}

/// A guard and what it needs, over one step of two sheets.
struct GuardedStep {
    explicit GuardedStep(const TwoSheets& sheets)
        : data(sheets.fabric()), guard(Fabric(data)), proximity(sheets.positions, sheets.indices, 0.005f) {}
    bool keep(const TwoSheets& before, TwoSheets& now) {
        std::vector<Particle> end = particles_of(now.positions);
        const bool is_free = guard.keep(particles_of(before.positions), end, proximity, *jobs);
        now.positions = places_of(end);
        return is_free;
    }

    const std::shared_ptr<Jobs> jobs = Jobs::own(0);
    FabricData data;
    CrossingGuard guard;
    Proximity proximity;
};

TEST(CrossingGuard, LayersThatBeginCrossedAreParted) {
    TwoSheets sheets(8, 0.02f, {0.004f, 0.004f, 0.005f});
    for (const uint32_t v : {27u, 28u, 35u, 36u})
        sheets.positions[sheets.of_one + v].y -= 0.012f;  // a bulge of the upper one
    ASSERT_GT(sheets.crossed().size(), 0u);
    GuardedStep step(sheets);
    std::vector<Particle> places = particles_of(sheets.positions);
    const std::vector<Vec3> before = sheets.positions;
    step.guard.part(places, false, step.proximity, *step.jobs);
    sheets.positions = places_of(places);
    EXPECT_EQ(sheets.crossed().size(), 0u);
    for (size_t v = 0; v < before.size(); ++v) EXPECT_LT(glm::length(sheets.positions[v] - before[v]), 0.03f);
}

TEST(CrossingGuard, SheetsThatWouldGoThroughEachOtherDoNot) {
    const TwoSheets sheets(3, 0.02f, {0.003f, 0.004f, 0.004f});
    ASSERT_TRUE(sheets.crossed().empty());
    // The upper one falls by 1 cm over one corner, the lower one rises by as much there.
    TwoSheets wanted = sheets;
    wanted.positions[sheets.of_one].y -= 0.01f;
    wanted.positions[sheets.of_one + 1].y -= 0.01f;
    wanted.positions[0].y += 0.004f;
    ASSERT_FALSE(wanted.crossed().empty());
    GuardedStep step(sheets);
    TwoSheets now = wanted;
    EXPECT_TRUE(step.keep(sheets, now));
    EXPECT_TRUE(now.crossed().empty());
    EXPECT_FALSE(step.guard.moved().empty());
    Vec3 wanted_way(0.0f), way(0.0f);
    for (size_t v = 0; v < now.positions.size(); ++v) {
        way += now.positions[v] - sheets.positions[v];
        wanted_way += wanted.positions[v] - sheets.positions[v];
    }
    EXPECT_NEAR(way.y, wanted_way.y, 1e-4f) << "the momentum is kept";
}

TEST(CrossingGuard, NoWayOfTwoSheetsCrosses) {
    std::mt19937 random(9);
    size_t changed = 0;
    for (int round = 0; round < 40; ++round) {
        const TwoSheets before(7, 0.02f, {0.003f, 0.004f, 0.004f});
        TwoSheets now = before;
        // Anything may happen: whole sheets pass each other, or single vertices go astray.
        const Vec3 way = random_point(random, 0.03f);
        for (size_t v = 0; v < now.positions.size(); ++v)
            now.positions[v] +=
                (v < now.of_one ? way : -way) + random_point(random, round % 2 ? 0.001f : 0.006f);
        GuardedStep step(before);
        const bool is_free = step.keep(before, now);
        changed += step.guard.moved().empty() ? 0 : 1;
        EXPECT_TRUE(is_free) << round;
        EXPECT_TRUE(now.crossed().empty()) << round;
        // The sheets may not have changed sides either: the lower one is below the upper one where they
        // overlap.
        for (uint32_t v = 0; v < now.of_one; ++v) {
            const Vec3 &low = now.positions[v], &high = now.positions[now.of_one + v];
            if (glm::length(Vec2(low.x - high.x, low.z - high.z)) < 0.002f) {
                EXPECT_LT(low.y, high.y) << round;
            }
        }
    }
    EXPECT_GT(changed, 20u) << "the scene would show it";
}

TEST(CrossingGuard, NoStepOfCrumpledClothCrosses) {
    std::mt19937 random(4);
    const TwoSheets flat(9, 0.02f, {0.003f, 0.004f, 0.004f});
    TwoSheets before = flat;
    size_t changed = 0;
    for (int i = 0; i < 100; ++i) {
        if (i % 10 == 0) before = flat;
        // All is squeezed to a point, and vertices go astray.
        TwoSheets now = before;
        const Vec3 middle = random_point(random, 0.1f) + Vec3(0.08f, 0.0f, 0.08f);
        for (Vec3& p : now.positions) p += 0.1f * (middle - p) + random_point(random, 0.004f);
        changed += now.crossed().empty() ? 0 : 1;
        GuardedStep step(before);
        EXPECT_TRUE(step.keep(before, now)) << i;
        ASSERT_TRUE(now.crossed().empty()) << i;
        before = now;
    }
    EXPECT_GT(changed, 50u) << "the scene would show it";
}

TEST(CrossingGuard, WhatDoesNotCrossIsLeftAlone) {
    const TwoSheets sheets(5, 0.02f, {0.0f, 0.01f, 0.0f});
    TwoSheets now = sheets;
    for (Vec3& p : now.positions) p.x += 0.3f;
    const std::vector<Vec3> wanted = now.positions;
    GuardedStep step(sheets);
    EXPECT_TRUE(step.keep(sheets, now));
    EXPECT_EQ(now.positions, wanted);
    EXPECT_TRUE(step.guard.moved().empty());
}

TEST(CrossingGuard, FixedVerticesStayAndWhatMeetsThemGivesWay) {
    const TwoSheets sheets(5, 0.02f, {0.003f, 0.004f, 0.004f});
    TwoSheets now = sheets;
    for (uint32_t v = 0; v < now.of_one; ++v)
        now.positions[v].y += 0.02f;  // a fixed sheet lifts the other one
    GuardedStep step(sheets);
    for (uint32_t v = 0; v < now.of_one; ++v) step.data.inverse_mass[v] = 0.0f;
    step.guard = CrossingGuard(Fabric(step.data));
    const std::vector<Vec3> wanted = now.positions;
    EXPECT_TRUE(step.keep(sheets, now));
    EXPECT_TRUE(now.crossed().empty());
    for (uint32_t v = 0; v < now.of_one; ++v) EXPECT_EQ(now.positions[v], wanted[v]);
    EXPECT_GT(now.positions[now.of_one + 12].y, 0.02f);
}

TEST(CrossingGuard, AJumpOfTheBodyIsNoSpeedOfWhatCrosses) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(61, 3, 0.02f);  // two of them, through each other, both held at their upper borders
    FabricData data;
    std::vector<Vec3> start;
    for (const float lean : {-0.3f, 0.3f}) {
        Sheet held = sheet;
        held.pin_top();
        const FabricData one = held.cook(cotton());
        const auto first = uint32_t(start.size());
        for (const Vec3& p : sheet.positions)
            start.emplace_back(p.x + 0.003f * lean, p.y, (p.y + 0.09f) * lean);
        data.inverse_mass.insert(data.inverse_mass.end(), one.inverse_mass.begin(), one.inverse_mass.end());
        for (const uint32_t i : one.indices) data.indices.push_back(first + i);
        for (const DistanceConstraint& e : one.edges)
            data.edges.push_back({first + e.a, first + e.b, e.rest_m, e.compliance_m_n});
    }
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    settings.self_thickness_m = 0.004f;
    Cloth cloth(fabric(data), settings, start);
    cloth.step(kFrame_s, start, {}, *jobs);
    ASSERT_FALSE(crossed_triangles(cloth.positions(), data.indices).empty()) << "the scene would show it";
    std::vector<Vec3> there = start;
    for (Vec3& p : there) p.x += 3.0f;
    cloth.step(kFrame_s, there, {}, *jobs);
    const std::vector<Vec3> arrived = cloth.positions();
    cloth.step(kFrame_s, there, {}, *jobs);
    for (size_t v = 0; v < arrived.size(); ++v)
        EXPECT_LT(glm::length(cloth.positions()[v] - arrived[v]), 0.05f) << v;
}

TEST(CrossingGuard, LayersThatComeToTheirLengthsDoNotGoThroughEachOther) {
    const auto jobs = Jobs::own(0);
    for (const float ratio : {1.1f, 1.15f, 1.2f}) {
        const TwoSheets sheets(13, 0.02f, {0.007f, 0.006f, 0.006f});
        std::vector<uint8_t> simulated(sheets.positions.size(), 1);  // except their edges
        for (uint32_t sheet = 0; sheet < 2; ++sheet)
            for (uint32_t i = 0; i < 13; ++i)
                for (const uint32_t at : {i, 12 * 13 + i, 13 * i, 13 * i + 12})
                    simulated[sheet * sheets.of_one + at] = 0;
        ClothSettings settings;
        settings.self_thickness_m = 0.004f;
        Cloth cloth(fabric(cook_fabric({sheets.positions, sheets.indices, {}, simulated, ratio}, cotton())),
                    settings, sheets.positions);
        cloth.come_to_lengths(
            [&](float, std::vector<Vec3>& targets, std::vector<Collider>&) { targets = sheets.positions; },
            *jobs);
        EXPECT_TRUE(crossed_triangles(cloth.positions(), sheets.indices).empty()) << ratio;
    }
}

}  // namespace
}  // namespace vfit::test
