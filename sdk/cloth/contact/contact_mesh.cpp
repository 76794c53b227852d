#include "cloth/contact/contact_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth/contact/contact_culling.h"
#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr uint32_t kNobody = UINT32_MAX;
constexpr float kFastest_m = 0.1f;      // further than that in a step, a mesh is not looked for
constexpr float kMetInside_m = 0.005f;  // deeper inside of a place, a particle has come from another
constexpr float kCornerReach =
    0.6f;  // of an edge: so far off may the corner be by which a place of a triangle is found

std::vector<uint32_t> counted(size_t vertices, std::span<const uint32_t> indices,
                              std::span<const uint8_t> counts) {
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k)
            if (indices[i + k] >= vertices)
                fail(VFIT_ERROR_DATA, "a contact mesh's triangle names vertex ", indices[i + k], " of ",
                     vertices);
        if (counts.empty() || (counts[indices[i]] && counts[indices[i + 1]] && counts[indices[i + 2]]))
            out.insert(out.end(), indices.begin() + std::ptrdiff_t(i),
                       indices.begin() + std::ptrdiff_t(i) + 3);
    }
    return out;
}

Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 across = glm::cross(b - a, c - a);
    const float length = glm::length(across);
    return length > 0.0f ? across / length : Vec3(0.0f);
}

}  // namespace

ContactMesh::ContactMesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts,
                         MeshOf what, const MeshFilter& filter)
    : vertex_count_(vertices),
      what_(what),
      category_(filter.category.begin(), filter.category.end()),
      mask_(filter.mask.begin(), filter.mask.end()),
      indices_(counted(vertices, indices, counts)) {}

bool ContactMesh::meets(uint32_t point, uint32_t cloth_vertex) const {
    return category_.empty() || (category_[vertex_of_[point]] & mask_[cloth_vertex]) != 0;
}

/// By categories, along a Morton curve of cells of 8 mm: neighbours in space follow each other.
void ContactMesh::order(std::span<const Vec3> positions) {
    Vec3 low(INFINITY);
    for (const Vec3& p : positions)
        if (finite(p)) low = glm::min(low, p);
    const auto spread = [](uint32_t x) {
        x = (x | x << 16) & 0x030000ff;
        x = (x | x << 8) & 0x0300f00f;
        x = (x | x << 4) & 0x030c30c3;
        return (x | x << 2) & 0x09249249;
    };
    std::vector<uint8_t> is_used(vertex_count_, 0);
    for (const uint32_t v : indices_) is_used[v] = 1;
    std::vector<std::array<uint32_t, 3>> codes;  // category, place on the curve, vertex
    for (uint32_t v = 0; v < vertex_count_; ++v) {
        if (!is_used[v]) continue;
        const Vec3 cell =
            finite(positions[v]) ? glm::clamp((positions[v] - low) * 128.0f, 0.0f, 1023.0f) : Vec3(0.0f);
        codes.push_back(
            {category_.empty() ? 0u : category_[v],
             spread(uint32_t(cell.x)) | spread(uint32_t(cell.y)) << 1 | spread(uint32_t(cell.z)) << 2, v});
    }
    std::sort(codes.begin(), codes.end());
    std::vector<uint32_t> point_of(vertex_count_, 0), corners;
    for (size_t i = 0; i < codes.size(); ++i) {
        if (i > 0 && codes[i][0] != codes[i - 1][0])
            while (vertex_of_.size() % kLanes != 0) vertex_of_.push_back(kNobody);
        if (vertex_of_.size() % kLanes == 0) run_category_.push_back(uint8_t(codes[i][0]));
        point_of[codes[i][2]] = uint32_t(vertex_of_.size());
        vertex_of_.push_back(codes[i][2]);
    }
    for (uint32_t v : indices_) corners.push_back(point_of[v]);
    fans_ = TriangleFans(vertex_of_.size(), corners);
    // Next to an edge within the mesh a point has two triangles: one where that edge comes first, one where
    // it comes last.
    on_border_.assign(vertex_of_.size(), 0);
    for (uint32_t i = 0; i < vertex_of_.size(); ++i)
        for (const TriangleFans::Corners& c : fans_.of(i)) {
            const auto ends_with = [&](const TriangleFans::Corners& other) {
                return other.third == c.second;
            };
            if (std::none_of(fans_.of(i).begin(), fans_.of(i).end(), ends_with))
                on_border_[i] = on_border_[c.second] = 1;
        }
    const size_t runs = (vertex_of_.size() + kLanes - 1) / kLanes;
    places_.assign(runs * kLanes, Particle{Vec3(NAN)});
    for (Particles* list : {&to_, &begin_, &end_}) list->resize(vertex_of_.size());
    from_.reserve(vertex_of_.size());
    boxes_.resize(runs);
    ways_m_.assign(runs, 0.0f);
    find_edges(positions);
}

void ContactMesh::find_edges(std::span<const Vec3> positions) {
    edges_m_.assign(ways_m_.size(), 0.0f);
    for (uint32_t i = 0; i < vertex_of_.size(); ++i)
        for (const TriangleFans::Corners& c : fans_.of(i))
            for (uint32_t other : {c.second, c.third}) {
                const float length = glm::length(positions[vertex_of_[other]] - positions[vertex_of_[i]]);
                if (std::isfinite(length)) edges_m_[i / kLanes] = std::max(edges_m_[i / kLanes], length);
            }
}

void ContactMesh::accept(std::span<const Vec3> positions) {
    if (vertex_of_.empty() && !indices_.empty())
        order(positions);
    else if (what_ == MeshOf::prop)  // it grows, or is deformed
        find_edges(positions);
    for (size_t i = 0; i < vertex_of_.size(); ++i)
        if (vertex_of_[i] != kNobody) to_[i].x = positions[vertex_of_[i]];
    if (from_.size() != to_.size()) from_ = to_;
}

void ContactMesh::skip(float fraction) {
    for (size_t i = 0; i < from_.size(); ++i) from_[i].x = glm::mix(from_[i].x, to_[i].x, fraction);
}

void ContactMesh::start_at(std::span<const Vec3> positions) {
    for (size_t i = 0; i < vertex_of_.size(); ++i)
        if (vertex_of_[i] != kNobody) from_[i].x = positions[vertex_of_[i]];
}

void ContactMesh::look_at(const Interval& interval, const Vec3& low, const Vec3& high) {
    if (from_.size() != to_.size()) return;  // hidden
    for (size_t i = 0; i < to_.size(); ++i) {
        const Vec3 &from = from_[i].x, way = to_[i].x - from;
        begin_[i].x = from + way * interval.from;
        end_[i].x = from + way * interval.to;
    }
    const float share = interval.to - interval.from;
    float greatest_m = 0.0f;
    ways_ = {};
    for (size_t run = 0; run < ways_m_.size(); ++run) {
        Vec3 from(INFINITY), to(-INFINITY);
        float way2 = 0.0f;
        for (size_t i = run * kLanes; i < std::min((run + 1) * kLanes, vertex_of_.size()); ++i) {
            if (vertex_of_[i] == kNobody) continue;
            const Vec3 &p = begin_[i].x, &q = end_[i].x;
            const auto is_inside = [&](const Vec3& nearest) {
                return glm::all(glm::greaterThan(nearest, low)) && glm::all(glm::lessThan(nearest, high));
            };
            // A prop may come from further away within the interval.
            const bool inside = is_inside(p) || (what_ == MeshOf::prop && is_inside(q));
            places_[i].x = inside ? p : Vec3(NAN);
            if (!inside) continue;
            const Vec3 way = q - p;
            from = glm::min(from, glm::min(p, q)), to = glm::max(to, glm::max(p, q));
            way2 = std::max(way2, glm::dot(way, way));
            ways_.add(way / share);
        }
        greatest_m = std::max(greatest_m, std::sqrt(way2));
        ways_m_[run] = std::min(std::sqrt(way2), kFastest_m);
        const float reach = kCornerReach * edges_m_[run];
        boxes_.runs.set(run, from - reach, to + reach);
    }
    boxes_.find_blocks();
    greatest_way_ = greatest_m / share;
}

void ContactMesh::hide() {
    forget();
    greatest_way_ = 0.0f;
    ways_ = {};
    boxes_.resize(ways_m_.size());
}

Vec3 ContactMesh::Place::at(const Particles& points) const {
    return weights.x * points[corner[0]].x + weights.y * points[corner[1]].x +
           weights.z * points[corner[2]].x;
}

Vec3 ContactMesh::Place::normal(const Particles& points) const {
    return unit_normal(points[corner[0]].x, points[corner[1]].x, points[corner[2]].x);
}

uint32_t ContactMesh::Place::nearest_corner() const {
    return corner[weights.x >= weights.y && weights.x >= weights.z ? 0 : weights.y >= weights.z ? 1 : 2];
}

ContactMesh::Place ContactMesh::place_of(const NearestOnFans& nearest, size_t lane, uint32_t point) const {
    const TriangleFans::Corners& c = fans_.corners()[nearest.corners[lane]];
    return {{point, c.second, c.third}, nearest.weights(lane)};
}

/// On the triangles about the points; where the nearest place is at another corner, about that one too.
/// points: in the end those about which the places are.
void ContactMesh::find_nearest(const Particle* run, uint32_t* points, int max_steps,
                               NearestOnFans& out) const {
    find_nearest_on_fans(run, points, fans_, begin_.data(), out);
    uint32_t at[kLanes];
    std::copy(points, points + kLanes, at);
    for (int step = 0; step < max_steps; ++step) {
        bool any = false;
        for (size_t lane = 0; lane < kLanes; ++lane) {
            uint32_t next = NearestOnFans::kNone;
            // Where the last step brought nothing, `at` is not where the place is any more.
            if (at[lane] == points[lane] && out.corners[lane] != NearestOnFans::kNone)
                next = place_of(out, lane, points[lane]).nearest_corner();
            at[lane] = next == points[lane] ? NearestOnFans::kNone : next;
            any |= at[lane] != NearestOnFans::kNone;
        }
        if (!any) return;
        NearestOnFans other;
        find_nearest_on_fans(run, at, fans_, begin_.data(), other);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (!(other.distance2[lane] < out.distance2[lane])) continue;
            points[lane] = at[lane];
            out.distance2[lane] = other.distance2[lane], out.corners[lane] = other.corners[lane];
            out.at_second[lane] = other.at_second[lane], out.at_third[lane] = other.at_third[lane];
        }
    }
}

/// Which way is out there: on an edge or a corner, by all triangles about it.
Vec3 ContactMesh::outward_at(const Place& place) const {
    constexpr float kInside = 1e-4f;
    if (std::min({place.weights.x, place.weights.y, place.weights.z}) > kInside) return place.normal(begin_);
    Vec3 sum(0.0f);
    for (int k = 0; k < 3; ++k) {
        if (place.weights[k] <= kInside) continue;
        const uint32_t own = place.corner[k];
        for (const TriangleFans::Corners& c : fans_.of(own))
            sum += unit_normal(begin_[own].x, begin_[c.second].x, begin_[c.third].x);
    }
    return sum;
}

bool ContactMesh::is_at_border(const Place& place) const {
    constexpr float kInside = 1e-4f;
    bool inside = true, border = true;
    for (int k = 0; k < 3; ++k) {
        if (place.weights[k] > kInside)
            border = border && on_border_[place.corner[k]];
        else
            inside = false;
    }
    return !inside && border;
}

/// Fills near with the mesh's runs that a run of particles may meet; how near they have to be. 0: there is
/// none.
float ContactMesh::reach_of(const Moving& moving, uint32_t first, float dt, float thickness_m,
                            std::vector<uint32_t>& near) const {
    Vec3 low(INFINITY), high(-INFINITY);
    float speed2 = 0.0f;
    for (size_t i = first; i < first + kLanes; ++i) {
        low = glm::min(low, moving.places[i].x);
        high = glm::max(high, moving.places[i].x);
        speed2 = std::max(speed2, glm::dot(moving.velocities[i].x, moving.velocities[i].x));
    }
    const float own = thickness_m + std::min(expected_way_m(dt * std::sqrt(speed2)), kFastest_m);
    find_meeting(boxes_, low - own, high + own, near);
    float way = 0.0f;
    for (uint32_t other : near) way = std::max(way, ways_m_[other]);
    return own + way;
}

/// Nothing where the place keeps no particle: too far off, or beyond a hem.
void ContactMesh::touch_at(const Place& place, const Vec3& particle, float reach, Touch& out) const {
    constexpr float kOnIt_m = 1e-5f;
    const Vec3 on = place.at(begin_), to = place.at(end_), off = particle - on;
    const float distance = glm::length(off);
    const Vec3 outward = outward_at(place);
    const bool inside = glm::dot(off, outward) < 0.0f;
    // What hangs beyond a hem is on neither side of it: a coat's sleeve is not to be drawn to the armhole of
    // a dress.
    if (inside && is_at_border(place)) return;
    if ((!inside && distance > reach) || !finite(on) || !finite(to)) return;
    const Vec3 normal = distance > kOnIt_m ? (inside ? -off : off) / distance
                                           : outward / std::max(glm::length(outward), 1e-12f);
    const Vec3 turned = normal + place.normal(end_) - place.normal(begin_);
    out = {on,
           to,
           normal,
           turned / std::max(glm::length(turned), 1e-12f) - normal,
           place.corner[0],
           inside ? -distance : distance};
}

/// The places that are nearest to a run's particles, on the way downhill from triangles about these points.
void ContactMesh::touch(const Particle* run, const uint32_t* from, int max_steps, float reach,
                        Touches& out) const {
    uint32_t points[kLanes];
    std::copy(from, from + kLanes, points);
    for (Touch& touch : out.of) touch.point = NearestOnFans::kNone;
    if (std::all_of(points, points + kLanes, [](uint32_t id) { return id == NearestOnFans::kNone; })) return;
    NearestOnFans nearest;
    find_nearest(run, points, max_steps, nearest);
    for (size_t lane = 0; lane < kLanes; ++lane)
        if (nearest.corners[lane] != NearestOnFans::kNone)
            touch_at(place_of(nearest, lane, points[lane]), run[particle_at(lane)].x, reach, out.of[lane]);
}

void ContactMesh::find_planes(const PartOfCloth& part, std::vector<uint32_t>& runs,
                              std::vector<Touched>& touched, std::vector<RunPlanes>& out) const {
    const auto& [moving, vertex_of, dt, thickness_m] = part;
    constexpr uint32_t kNone = NearestOnFans::kNone;
    constexpr int kStepsNearby = 2, kStepsAlong = 32;
    touched.resize(moving.count);
    for (uint32_t first = 0; first < moving.count; first += uint32_t(kLanes)) {
        const Particle* run = moving.places + first;
        Touched* const known = &touched[first];
        const float reach = reach_of(moving, first, dt, thickness_m, runs);
        const auto is_met = [&](size_t lane, uint32_t point) {
            const uint32_t v = vertex_of[first + particle_at(lane)];
            return v == kNobody || meets(point, v);
        };
        uint8_t common = 255;
        if (!category_.empty()) {
            uint8_t mask = 0;
            for (size_t i = first; i < first + kLanes; ++i)
                if (vertex_of[i] != kNobody) mask |= mask_[vertex_of[i]], common &= mask_[vertex_of[i]];
            std::erase_if(runs, [&](uint32_t other) { return (run_category_[other] & mask) == 0; });
        }
        const bool follows = std::any_of(known, known + kLanes, [](const Touched& t) { return t.any(); });
        if (runs.empty() && !follows) continue;
        Touches now, before[2];
        float edge = 0.0f;
        for (uint32_t other : runs) edge = std::max(edge, edges_m_[other]);
        NearestOfRun nearest_points(reach + kCornerReach * edge);
        find_nearest_in_runs(run, places_.data(), runs, nearest_points);
        const auto is_filtered_out = [&](size_t lane) {
            return nearest_points.id[lane] != kNone && !is_met(lane, nearest_points.id[lane]);
        };
        bool any_filtered_out = false;
        for (size_t lane = 0; lane < kLanes && !category_.empty(); ++lane)
            any_filtered_out = any_filtered_out || is_filtered_out(lane);
        if (any_filtered_out) {
            // A particle whose nearest point is filtered out takes the nearest that all of its run meet.
            std::erase_if(runs, [&](uint32_t other) { return (run_category_[other] & common) == 0; });
            NearestOfRun met_points(reach + kCornerReach * edge);
            find_nearest_in_runs(run, places_.data(), runs, met_points);
            for (size_t lane = 0; lane < kLanes; ++lane)
                if (is_filtered_out(lane)) nearest_points.id[lane] = met_points.id[lane];
        }
        touch(run, nearest_points.id, kStepsNearby, reach, now);
        if (follows)
            for (size_t k = 0; k < 2; ++k) {
                uint32_t points[kLanes];
                uint8_t same = 0;  // as found from the nearest point: there is nowhere else to go
                for (size_t lane = 0; lane < kLanes; ++lane) {
                    points[lane] = known[lane].points[k];
                    if (points[lane] == kNone ||
                        (points[lane] != nearest_points.id[lane] && points[lane] != now.of[lane].point))
                        continue;
                    points[lane] = kNone, same |= uint8_t(1u << lane);
                }
                touch(run, points, kStepsAlong, reach, before[k]);
                for (size_t lane = 0; lane < kLanes; ++lane)
                    if (same >> lane & 1) before[k].of[lane] = now.of[lane];
            }
        RunPlanes planes[2]{};
        bool any[2] = {false, false};
        for (RunPlanes& p : planes) {
            p.run = first / uint32_t(kLanes);
            for (float& keeps : p.thickness_m) keeps = RunPlanes::kNone;
        }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            Touch chosen[2];
            if (follows)
                for (size_t k = 0; k < 2; ++k)
                    if (const Touch& t = before[k].of[lane]; t.point != kNone && is_met(lane, t.point))
                        chosen[k] = t;
            choose(now.of[lane], chosen);
            if (chosen[0].point != kNone && !is_met(lane, chosen[0].point)) chosen[0] = {};
            if (chosen[1].point != kNone && !is_met(lane, chosen[1].point)) chosen[1] = {};
            for (size_t k = 0; k < 2; ++k) {
                known[lane].points[k] = chosen[k].point;
                if (chosen[k].point == kNone) continue;
                any[k] = true;
                planes[k].set(lane, chosen[k].on, chosen[k].to - chosen[k].on, chosen[k].normal,
                              chosen[k].turn, thickness_m);
            }
        }
        for (size_t k = 0; k < 2; ++k)
            if (any[k]) out.push_back(planes[k]);
    }
}

/// A contact stays where it slides to along the mesh, as long as the particle is within reach of that place,
/// or inside. Another place is met from outside alone.
void ContactMesh::choose(const Touch& now, Touch (&known)[2]) {
    const auto is_there = [](const Touch& t) { return t.point != NearestOnFans::kNone; };
    const auto is_same = [](const Touch& a, const Touch& b) {
        constexpr float kSame_m = 0.01f, kSameSide = 0.5f;
        return a.point == b.point ||
               (glm::distance(a.on, b.on) < kSame_m && glm::dot(a.normal, b.normal) > kSameSide);
    };
    if (is_there(known[0]) && is_there(known[1]) && is_same(known[0], known[1])) known[1] = {};
    if (!is_there(known[0])) std::swap(known[0], known[1]);
    if (!is_there(now)) return;
    if (!is_there(known[0])) {
        known[0] = now;
        return;
    }
    for (Touch& k : known)
        if (is_there(k) && is_same(k, now)) return;
    if (now.before_m < -kMetInside_m) return;
    if (!is_there(known[1]))
        known[1] = now;
    else if (std::max(known[0].before_m, known[1].before_m) > now.before_m)
        known[known[1].before_m > known[0].before_m] = now;
}

}  // namespace vfit
