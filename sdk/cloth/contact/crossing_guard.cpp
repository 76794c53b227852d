#include "cloth/contact/crossing_guard.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cloth/base/rigid_motion.h"

namespace vfit {

namespace {

// Rounds of a repair: projections, then zones that may grow, then crossing triangles go back to the begin.
constexpr int kProjections = 8, kZones = 24, kRounds = 40;
constexpr int kPasses = 4;  // over the hits of a round
constexpr float kTouch_m = 4e-6f;
// What is kept of the distance at the begin: half, but no less than rounding needs, nor more than 1 mm.
constexpr float kKept = 0.5f, kMinKept_m = 1e-4f, kMaxKept_m = 1e-3f;
// Two that begin within kResting_m of each other touch in the same way at the end, unless they come closer.
constexpr float kResting_m = 6e-6f, kCloser = 0.7f;
constexpr float kUntangles_m = 0.001f;  // a step
constexpr int kRoundsToPart = 60;
constexpr float kParts_m = 0.002f;  // a round

template <typename Body>
void for_all_pairs(const Proximity::Triangle& a, const Proximity::Triangle& b, Body&& body) {
    for (uint32_t j = 0; j < 3; ++j) {
        body(PairKind::vertex_face, std::array{a.vertex[j], b.vertex[0], b.vertex[1], b.vertex[2]});
        body(PairKind::vertex_face, std::array{b.vertex[j], a.vertex[0], a.vertex[1], a.vertex[2]});
        for (uint32_t k = 0; k < 3; ++k)
            body(PairKind::edge_edge,
                 std::array{a.vertex[j], a.vertex[(j + 1) % 3], b.vertex[k], b.vertex[(k + 1) % 3]});
    }
}

bool has_twice(const std::array<uint32_t, 4>& v) {
    return v[0] == v[1] || v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3] || v[2] == v[3];
}

Corners corners_of(const Proximity::Triangle& t, std::span<const Particle> at) {
    return {{at[t.vertex[0]].x, at[t.vertex[1]].x, at[t.vertex[2]].x}};
}

bool cross_at(const Proximity::Pair& pair, std::span<const Particle> at) {
    return !pair.shares_vertex() && cross(corners_of(*pair.first, at), corners_of(*pair.second, at));
}

}  // namespace

CrossingGuard::CrossingGuard(const Fabric& fabric)
    : cloth_vertices_(fabric.vertex_count()),
      length_limit_(fabric),
      inverse_mass_(fabric.data().inverse_mass),
      indices_(fabric.data().indices),
      piece_of_(fabric.piece_of()),
      has_pieces_(fabric.pieces().size() > 1),
      is_marked_(cloth_vertices_, 0),
      is_moved_(is_marked_),
      is_zoned_(is_marked_),
      is_beyond_(is_marked_),
      goes_back_(is_marked_),
      wanted_(cloth_vertices_),
      found_at_(cloth_vertices_),
      parent_(cloth_vertices_, kNone),
      places_(cloth_vertices_),
      outwards_(cloth_vertices_, Vec3(0.0f)),
      is_tangled_(cloth_vertices_, 0) {
    for (const float inverse : inverse_mass_) is_fixed_.push_back(inverse == 0.0f);
}

void CrossingGuard::add_mesh(size_t vertices, MeshOf what) {
    meshes_.push_back({what});
    const size_t count = inverse_mass_.size() + vertices;
    inverse_mass_.resize(count, 0.0f);
    for (std::vector<uint8_t>* flags : {&is_marked_, &is_moved_, &is_zoned_, &is_beyond_, &goes_back_})
        flags->resize(count, 0);
    is_fixed_.resize(count, 1);
    wanted_.resize(count), found_at_.resize(count), places_.resize(count);
    parent_.resize(count, kNone);
}

bool CrossingGuard::keep(std::span<const Particle> begin, std::span<Particle> end, Proximity& proximity,
                         Jobs& jobs, std::optional<float> shortens_m) {
    for (const uint32_t v : zoned_) parent_[v] = kNone, is_zoned_[v] = 0;
    for (const uint32_t v : moved_) is_moved_[v] = 0;
    zoned_.clear(), moved_.clear();
    if (has_pieces_) untangle(end, kUntangles_m), come_outwards(end, kUntangles_m);
    forget();
    zones_grow_ = crosses_mesh_ = false;
    for (Mesh& mesh : meshes_) mesh.is_crossed = false;
    if (shortens_m) mark(length_limit_.keep(begin, end, *shortens_m));
    proximity.find(begin, end, jobs);
    bool solved = false;
    for (int round = 0; round < kRounds; ++round) {
        find_hits(begin, end, proximity, round < kProjections);
        solved = hits_.empty() && crossed_.empty();
        if (solved) break;
        if (round == 0) {
            std::copy(end.begin(), end.end(), wanted_.begin());
            for (size_t v = 0; v < end.size(); ++v) found_at_[v] = end[v].x;
        }
        std::fill(is_marked_.begin(), is_marked_.end(), uint8_t(0));
        if (hits_.empty()) round = std::max(round, kProjections);
        if (round < kProjections) {
            project(end);
        } else if (round < kZones) {
            zones_grow_ = true;
            unite_hits();
            move_zones(begin, end);
        } else {
            take_back(begin, end);
        }
        if (shortens_m) mark(length_limit_.keep_about(moved_, is_zoned_, begin, end, *shortens_m));
        // Those that cross are looked at again, whether they were moved or not.
        for (const auto& [first, second] : crossed_)
            for (const Proximity::Triangle* t : {first, second})
                for (const uint32_t v : t->vertex) is_marked_[v] = 1;
        find_pairs_again(begin, end, proximity);
        proximity.find_uncertain_of(is_marked_, begin, end, jobs);
    }
    if (!tangles_.empty()) keep_tangles_of(end);
    if (!solved)
        for (const auto& [first, second] : crossed_)
            if (is_of_cloth(*second)) tangles_.emplace_back(first->number, second->number);
    const bool is_free = solved && tangles_.empty() && !crosses_mesh_ && proximity.is_complete();
    sort_tangles();
    if (!has_pieces_) untangle(end, kUntangles_m);
    for (const uint32_t v : tangled_) is_tangled_[v] = 0;
    tangled_.clear();
    for (const auto& [first, second] : tangles_)
        for (const uint32_t triangle : {first, second})
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t v = indices_[3 * triangle + k];
                if (!is_tangled_[v]) tangled_.push_back(v);
                is_tangled_[v] = 1;
            }
    return is_free;
}

/// Pairs were found with a margin, which vertices that have moved may have used up.
void CrossingGuard::find_pairs_again(std::span<const Particle> begin, std::span<const Particle> end,
                                     Proximity& proximity) {
    bool is_any = false;
    for (const uint32_t v : moved_) {
        is_beyond_[v] = glm::distance(found_at_[v], end[v].x) > 0.5f * kMaxKept_m;
        if (!is_beyond_[v]) continue;
        found_at_[v] = end[v].x;
        is_any = true;
    }
    if (is_any) proximity.find_again(is_beyond_, begin, end);
    for (const uint32_t v : moved_) is_beyond_[v] = 0;
}

/// Each once, and only those that did not end on the way.
void CrossingGuard::keep_tangles_of(std::span<const Particle> end) {
    std::sort(tangles_.begin(), tangles_.end());
    tangles_.erase(std::unique(tangles_.begin(), tangles_.end()), tangles_.end());
    const auto triangle = [&](uint32_t number) {
        const uint32_t* v = &indices_[3 * number];
        return Corners{{end[v[0]].x, end[v[1]].x, end[v[2]].x}};
    };
    std::erase_if(tangles_, [&](const TrianglePair& pair) {
        return !cross(triangle(pair.first), triangle(pair.second));
    });
}

/// Layers of a piece, neither of which is outside, by the line along which they cross.
void CrossingGuard::untangle(std::span<Particle> places, float step_m) {
    if (own_tangles().empty()) return;
    for (size_t v = 0; v < places.size(); ++v) places_[v] = places[v].x;
    for (const uint32_t v : untangle_.move(own_tangles(), indices_, is_fixed_, step_m, places_)) {
        places[v].x = places_[v];
        mark(v);
    }
}

/// The later of two pieces, off the earlier one: towards its own outside, since the earlier one may have
/// folds that face elsewhere. A line from one border to another is nowhere shorter.
void CrossingGuard::come_outwards(std::span<Particle> places, float step_m) {
    const auto above = [&](const TrianglePair& pair) {
        return &indices_[3 * (piece_of(pair.first) < piece_of(pair.second) ? pair.second : pair.first)];
    };
    for (const TrianglePair& pair : other_tangles()) {
        const uint32_t* t = above(pair);
        const Vec3 across = glm::cross(places[t[1]].x - places[t[0]].x, places[t[2]].x - places[t[0]].x),
                   normal = across / std::max(glm::length(across), 1e-20f);
        for (uint32_t k = 0; k < 3; ++k) outwards_[t[k]] += normal;
    }
    for (const TrianglePair& pair : other_tangles())
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t v = above(pair)[k];
            const float length = glm::length(outwards_[v]);
            if (length > 0.0f && !is_fixed_[v]) places[v].x += outwards_[v] * (step_m / length), mark(v);
            outwards_[v] = Vec3(0.0f);
        }
}

/// Those of a piece with itself first.
void CrossingGuard::sort_tangles() {
    own_tangles_ = size_t(
        std::partition(tangles_.begin(), tangles_.end(),
                       [&](const TrianglePair& p) { return piece_of(p.first) == piece_of(p.second); }) -
        tangles_.begin());
}

void CrossingGuard::part(std::span<Particle> places, bool guarded, Proximity& proximity, Jobs& jobs) {
    forget();
    for (int round = 0; round < kRoundsToPart; ++round) {
        if (guarded) {
            parts_from_.assign(places.begin(), places.end());
            keep(parts_from_, places, proximity, jobs);
        } else {
            find_tangles(places, proximity, jobs);
            untangle(places, kParts_m);
        }
        if (tangles_.empty()) return;
    }
}

void CrossingGuard::find_tangles(std::span<const Particle> places, Proximity& proximity, Jobs& jobs) {
    proximity.find(places, places, jobs);
    forget();
    proximity.for_uncertain([&](const Proximity::Pair& pair, uint32_t surface) {
        if (surface == Proximity::kSelf && cross_at(pair, places))
            tangles_.emplace_back(pair.first->number, pair.second->number);
    });
    sort_tangles();
}

void CrossingGuard::find_hits(std::span<const Particle> begin, std::span<const Particle> end,
                              const Proximity& proximity, bool of_meshes) {
    hits_.clear(), crossed_.clear();
    proximity.for_uncertain([&](const Proximity::Pair& pair, uint32_t surface) {
        if (is_held(*pair.first) && is_held(*pair.second)) return;
        const bool is_own = surface == Proximity::kSelf;
        if (!is_own && !(of_meshes && meshes_[surface - 1].what == MeshOf::prop)) {
            crosses_mesh_ = true;  // perhaps
            return;
        }
        if (is_own && may_pass(pair)) {
            if (cross_at(pair, end)) tangles_.emplace_back(pair.first->number, pair.second->number);
            return;
        }
        if (cross_at(pair, begin)) {
            if (!cross_at(pair, end)) return;
            if (is_own)
                tangles_.emplace_back(pair.first->number, pair.second->number);
            else
                crosses_mesh_ = meshes_[surface - 1].is_crossed = true;
            return;
        }
        if (cross_at(pair, end)) crossed_.emplace_back(pair.first, pair.second);
        for_all_pairs(*pair.first, *pair.second,
                      [&](PairKind kind, const std::array<uint32_t, 4>& v) { test(kind, v, begin, end); });
    });
    std::erase_if(crossed_, [&](const auto& pair) {
        const uint32_t *a = pair.first->vertex, *b = pair.second->vertex;
        return in_one_zone(std::array{a[0], a[1], a[2], b[0], b[1], b[2]});
    });
}

/// Where two pieces cross, the line along which they do moves on as one of them comes outwards.
bool CrossingGuard::may_pass(const Proximity::Pair& pair) const {
    const auto is_tangled = [&](uint32_t v) { return is_tangled_[v] != 0; };
    const auto any_tangled = [&](const Proximity::Triangle& t) {
        return std::any_of(t.vertex, t.vertex + 3, is_tangled);
    };
    return piece_of_[pair.first->vertex[0]] != piece_of_[pair.second->vertex[0]] &&
           any_tangled(*pair.first) && any_tangled(*pair.second);
}

bool CrossingGuard::is_held(const Proximity::Triangle& t) const {
    return is_fixed_[t.vertex[0]] && is_fixed_[t.vertex[1]] && is_fixed_[t.vertex[2]];
}

void CrossingGuard::test(PairKind kind, const std::array<uint32_t, 4>& v, std::span<const Particle> begin,
                         std::span<const Particle> end) {
    if (has_twice(v)) return;
    if (is_fixed_[v[0]] && is_fixed_[v[1]] && is_fixed_[v[2]] && is_fixed_[v[3]]) return;
    if (zones_grow_ && in_one_zone(v)) return;
    std::array<Vec3, 4> from, to;
    for (size_t k = 0; k < 4; ++k) from[k] = begin[v[k]].x, to[k] = end[v[k]].x;
    const size_t second = kind == PairKind::edge_edge ? 2 : 1;
    Bounds box, other;
    for (size_t k = 0; k < 4; ++k) {
        Bounds& of = k < second ? box : other;
        of.add(from[k]), of.add(to[k]);
    }
    box.low -= 2.0f * kTouch_m, box.high += 2.0f * kTouch_m;
    if (!box.overlaps(other)) return;
    Hit hit;
    const std::optional<float> time = first_touch(kind, from, to, kTouch_m, hit.weights);
    if (!time) return;
    const ClosestPoints began = closest_points(kind, from);
    const float distance = glm::length(began.way);
    if (*time == 1.0f && distance < kResting_m) {
        const ClosestPoints ended = closest_points(kind, to);
        if (glm::length(ended.way) >= kCloser * distance && glm::dot(ended.way, began.way) > 0.0f) return;
    }
    hit.vertices = v;
    hit.normal = distance > 1e-7f ? began.way / distance : Vec3(0, 1, 0);
    hit.margin_m = std::clamp(kKept * distance, kMinKept_m, kMaxKept_m);
    hits_.push_back(hit);
}

void CrossingGuard::mark(uint32_t v) {
    is_marked_[v] = 1;
    if (!is_moved_[v]) moved_.push_back(v);
    is_moved_[v] = 1;
}
void CrossingGuard::mark(std::span<const uint32_t> vertices) {
    for (const uint32_t v : vertices) mark(v);
}

/// Gauss-Seidel over the hits: each pair gets its margin back.
void CrossingGuard::project(std::span<Particle> end) {
    for (int pass = 0; pass < kPasses; ++pass)
        for (const Hit& hit : hits_) {
            Vec3 between(0.0f);
            float sum = 0.0f, lightest = 0.0f;
            for (size_t k = 0; k < 4; ++k) {
                const float inverse_mass = inverse_mass_[hit.vertices[k]];
                between += hit.weights[k] * end[hit.vertices[k]].x;
                sum += inverse_mass * hit.weights[k] * hit.weights[k];
                lightest = std::max(lightest, inverse_mass);
            }
            sum = std::max(sum, kMinMobility * lightest);
            const float depth = hit.margin_m - glm::dot(between, hit.normal);
            if (depth <= 0.0f || sum <= 0.0f) continue;
            for (size_t k = 0; k < 4; ++k) {
                const uint32_t v = hit.vertices[k];
                if (is_fixed_[v]) continue;
                end[v].x += hit.normal * (depth / sum * inverse_mass_[v] * hit.weights[k]);
                mark(v);
            }
        }
}

uint32_t CrossingGuard::root(uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
}

void CrossingGuard::unite(uint32_t a, uint32_t b) {
    for (const uint32_t v : {a, b}) {
        if (parent_[v] != kNone) continue;
        parent_[v] = v;
        is_zoned_[v] = 1;
        zoned_.push_back(v);
    }
    const uint32_t x = root(a), y = root(b);
    parent_[std::max(x, y)] = std::min(x, y);
}

/// All of which the zone moves: a fixed vertex does not go with it.
bool CrossingGuard::in_one_zone(std::span<const uint32_t> vertices) {
    return std::all_of(vertices.begin(), vertices.end(), [&](uint32_t v) {
        return !is_fixed_[v] && parent_[v] != kNone && root(v) == root(vertices[0]);
    });
}

void CrossingGuard::unite_hits() {
    for (const Hit& hit : hits_)
        for (const uint32_t v : hit.vertices) unite(hit.vertices[0], v);
    for (const auto& [first, second] : crossed_)
        for (const Proximity::Triangle* t : {first, second})
            for (const uint32_t v : t->vertex) unite(first->vertex[0], v);
}

void CrossingGuard::move_zones(std::span<const Particle> begin, std::span<Particle> end) {
    std::sort(zoned_.begin(), zoned_.end(),
              [&](uint32_t a, uint32_t b) { return std::pair(root(a), a) < std::pair(root(b), b); });
    for (size_t first = 0, last; first < zoned_.size(); first = last) {
        for (last = first + 1; last < zoned_.size() && root(zoned_[last]) == root(zoned_[first]);) ++last;
        move_zone(std::span(zoned_).subspan(first, last - first), begin, end);
    }
}

/// As the rigid motion that is closest to what the step wanted. With fixed vertices it goes as they do on
/// average, and does not turn about two or three of them.
void CrossingGuard::move_zone(std::span<const uint32_t> zone, std::span<const Particle> begin,
                              std::span<Particle> end) {
    Vec3 way(0.0f);
    float fixed = 0.0f;
    from_.clear(), to_.clear();
    for (const uint32_t v : zone) {
        from_.push_back(begin[v].x), to_.push_back(wanted_[v].x);
        if (is_fixed_[v]) way += wanted_[v].x - begin[v].x, fixed += 1.0f;
    }
    numbers_.resize(zone.size());
    std::iota(numbers_.begin(), numbers_.end(), 0u);
    RigidMotion motion;
    if (fixed > 0.0f)
        motion.to_center = way / fixed;
    else
        motion = fit_rigid_motion(numbers_, from_, to_);
    for (const uint32_t v : zone) {
        if (is_fixed_[v]) continue;
        end[v].x = motion.point(begin[v].x);
        mark(v);
    }
}

/// Zones in which something still crosses stay where they were: parts of them would cross the others.
void CrossingGuard::take_back(std::span<const Particle> begin, std::span<Particle> end) {
    unite_hits();
    for (const Hit& hit : hits_) goes_back_[root(hit.vertices[0])] = 1;
    for (const auto& [first, second] : crossed_) goes_back_[root(first->vertex[0])] = 1;
    for (const uint32_t v : zoned_)
        if (!is_fixed_[v] && goes_back_[root(v)]) end[v].x = begin[v].x, mark(v);
    for (const uint32_t v : zoned_) goes_back_[v] = 0;
}

}  // namespace vfit
