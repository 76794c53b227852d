#include "cloth/contact/triangle_groups.h"

#include <algorithm>
#include <cmath>

#include "cloth/base/triangles_about.h"
#include "math/closest_point.h"
#include "math/finite.h"

namespace vfit {

namespace {

/// Bits of x, each followed by two zeros.
uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

/// All corners of t on one side of the plane of the other triangle, and clear of it.
bool is_beside(const Vec3 (&t)[3], const Vec3 (&plane)[3]) {
    constexpr float kClear = 1e-5f;  // of the lengths: what rounding may bring
    const Vec3 across = glm::cross(plane[1] - plane[0], plane[2] - plane[0]), off = glm::abs(t[0] - plane[0]),
               size = glm::abs(across);
    const float a = glm::dot(t[0] - plane[0], across), b = glm::dot(t[1] - plane[0], across),
                c = glm::dot(t[2] - plane[0], across);
    const float clear = kClear * (size.x + size.y + size.z) * (off.x + off.y + off.z);
    return std::min({a, b, c}) > clear || std::max({a, b, c}) < -clear;
}

/// Does the way from p to q go through the triangle? (Moeller and Trumbore 1997)
bool goes_through(const Vec3& p, const Vec3& q, const Vec3 (&t)[3]) {
    const glm::dvec3 d(q - p), e1(t[1] - t[0]), e2(t[2] - t[0]), h = glm::cross(d, e2);
    const double det = glm::dot(e1, h);
    if (std::abs(det) < 1e-16) return false;
    const glm::dvec3 s(p - t[0]), k = glm::cross(s, e1);
    const double u = glm::dot(s, h) / det, v = glm::dot(d, k) / det, at = glm::dot(e2, k) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1;
}

Bounds bounds_of(const Corners& t) {
    return {glm::min(glm::min(t.at[0], t.at[1]), t.at[2]), glm::max(glm::max(t.at[0], t.at[1]), t.at[2])};
}

/// Places by the order in which the curve meets them.
std::vector<uint32_t> along_morton_curve(const std::vector<Vec3>& places) {
    Bounds all;
    for (const Vec3& p : places)
        if (finite(p)) all.add(p);
    const Vec3 size = all.high - all.low;
    const float most = std::max({size.x, size.y, size.z, 1e-6f});
    std::vector<std::pair<uint32_t, uint32_t>> codes;
    for (uint32_t i = 0; i < places.size(); ++i) {
        const Vec3 cell = finite(places[i])
                              ? glm::clamp((places[i] - all.low) / most * 1023.0f, 0.0f, 1023.0f)
                              : Vec3(0.0f);
        codes.emplace_back(
            spread(uint32_t(cell.x)) | spread(uint32_t(cell.y)) << 1 | spread(uint32_t(cell.z)) << 2, i);
    }
    std::sort(codes.begin(), codes.end());
    std::vector<uint32_t> out;
    for (const auto& [code, i] : codes) out.push_back(i);
    return out;
}

}  // namespace

bool cross(const Corners& a, const Corners& b) {
    if (is_beside(a.at, b.at) || is_beside(b.at, a.at)) return false;
    for (size_t e = 0; e < 3; ++e)
        if (goes_through(a.at[e], a.at[(e + 1) % 3], b.at) || goes_through(b.at[e], b.at[(e + 1) % 3], a.at))
            return true;
    return false;
}

TriangleGroups::TriangleGroups(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    const auto count = uint32_t(indices.size() / 3);
    std::vector<Vec3> middles;
    for (uint32_t t = 0; t < count; ++t)
        middles.push_back(
            (positions[indices[3 * t]] + positions[indices[3 * t + 1]] + positions[indices[3 * t + 2]]) /
            3.0f);
    const std::vector<uint32_t> seeds = along_morton_curve(middles);
    std::vector<uint32_t> around(indices.begin(), indices.begin() + std::ptrdiff_t(3 * count));
    const TrianglesAbout about(positions.size(), around);
    std::vector<uint8_t> taken(count, 0);
    triangles_.reserve(count + kSize * 8);
    std::vector<uint32_t> beside;
    for (const uint32_t seed : seeds) {
        if (taken[seed]) continue;
        beside.assign(1, seed);
        for (uint32_t size = 0; size < kSize; ++size) {
            // The nearest to the seed of those that touch the group.
            auto next = beside.end();
            for (auto it = beside.begin(); it != beside.end(); ++it)
                if (!taken[*it] && (next == beside.end() || glm::length(middles[*it] - middles[seed]) <
                                                                glm::length(middles[*next] - middles[seed])))
                    next = it;
            if (next == beside.end()) break;
            const uint32_t t = *next;
            taken[t] = 1;
            triangles_.push_back({{indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]}, t});
            for (const uint32_t v : triangles_.back().vertex)
                for (const uint32_t other : about.of(v))
                    if (!taken[other]) beside.push_back(other);
        }
        ends_.push_back(uint32_t(triangles_.size()));
    }
    corners_.resize(count);
    boxes_.resize(count);
    normals_.resize(ends_.size());
    slabs_.resize(ends_.size());
    groups_.resize(ends_.size());
    list_beside(positions.size());
    constexpr uint32_t kShare = 64;  // groups
    shares_.resize((group_count() + kShare - 1) / kShare);
}

void TriangleGroups::list_beside(size_t vertices) {
    std::vector<std::vector<uint32_t>> of_vertex(vertices);
    for (uint32_t group = 0; group < group_count(); ++group)
        for (uint32_t t = begin_of(group); t < ends_[group]; ++t)
            for (const uint32_t v : triangles_[t].vertex)
                if (of_vertex[v].empty() || of_vertex[v].back() != group) of_vertex[v].push_back(group);
    first_beside_.assign(1, 0);
    for (uint32_t group = 0; group < group_count(); ++group) {
        const auto begin = std::ptrdiff_t(beside_.size());
        for (uint32_t t = begin_of(group); t < ends_[group]; ++t)
            for (const uint32_t v : triangles_[t].vertex)
                beside_.insert(beside_.end(), of_vertex[v].begin(), of_vertex[v].end());
        std::sort(beside_.begin() + begin, beside_.end());
        beside_.erase(std::unique(beside_.begin() + begin, beside_.end()), beside_.end());
        first_beside_.push_back(uint32_t(beside_.size()));
    }
}

template <typename Body>
void TriangleGroups::for_shares(Jobs& jobs, Body&& body) {
    parallel_for(jobs, uint32_t(shares_.size()), [&](uint32_t i) {
        body(shares_[i], i * group_count() / uint32_t(shares_.size()),
             (i + 1) * group_count() / uint32_t(shares_.size()));
    });
}

void TriangleGroups::move(std::span<const Vec3> positions, Jobs& jobs) {
    for_shares(jobs, [&](Share&, uint32_t begin, uint32_t end) { move_groups(positions, begin, end); });
    groups_.find_blocks();
}

void TriangleGroups::move_groups(std::span<const Vec3> positions, uint32_t begin, uint32_t end) {
    for (uint32_t group = begin; group < end; ++group) {
        Bounds box, normals;
        Vec3 sum(0.0f);
        for (uint32_t t = begin_of(group); t < ends_[group]; ++t) {
            const auto& vertex = triangles_[t].vertex;
            const auto& at =
                (corners_[t] = {{positions[vertex[0]], positions[vertex[1]], positions[vertex[2]]}}).at;
            boxes_[t] = bounds_of(corners_[t]);
            box.add(boxes_[t].low), box.add(boxes_[t].high);
            const Vec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
            normals.add(across / std::max(glm::length(across), 1e-20f));
            sum += across;
        }
        Slab slab{sum / std::max(glm::length(sum), 1e-20f), INFINITY, -INFINITY};
        for (uint32_t t = begin_of(group); t < ends_[group]; ++t)
            for (const Vec3& p : corners_[t].at) {
                const float height = glm::dot(p, slab.normal);
                slab.low = std::min(slab.low, height), slab.high = std::max(slab.high, height);
            }
        slabs_[group] = slab;
        groups_.runs.set(group, box.low, box.high);
        normals_[group] = normals;
    }
}

bool TriangleGroups::Slab::is_clear_of(const Corners& t) const {
    constexpr float kClear = 1e-6f;  // of the distance from the origin: what rounding may bring
    const float a = glm::dot(t.at[0], normal), b = glm::dot(t.at[1], normal), c = glm::dot(t.at[2], normal);
    const Vec3 size = glm::abs(t.at[0]);
    const float clear = kClear * (1.0f + size.x + size.y + size.z);
    return std::min({a, b, c}) > high + clear || std::max({a, b, c}) < low - clear;
}

struct TriangleGroups::Search {
    Vec3 p;
    float reach_m;  // to the closest so far
    Closest best{Vec3(0.0f), Vec3(0.0f), INFINITY, 0};
    float upright = 0.0f;  // cosine between its normal and the way to p

    bool is_within(const Vec3& low, const Vec3& high) const {
        const Vec3 off = glm::max(glm::max(low - p, p - high), Vec3(0.0f));
        return glm::dot(off, off) <= reach_m * reach_m;
    }
    /// Over an edge, several triangles are equally near: which side p is on, tells the one that faces it
    /// most.
    void look_at(const Corners& t, uint32_t triangle) {
        constexpr float kEqual = 1e-5f;  // of the distance
        const Vec3 point = closest_point({t.at[0], t.at[1], t.at[2]}, p).position, way = p - point;
        const float distance = glm::length(way);
        if (distance > reach_m) return;
        const Vec3 across = glm::cross(t.at[1] - t.at[0], t.at[2] - t.at[0]),
                   normal = across / std::max(glm::length(across), 1e-20f);
        const float cosine = glm::dot(way, normal) / std::max(distance, 1e-20f);
        if (distance > (1.0f - kEqual) * best.distance && std::abs(cosine) <= std::abs(upright)) return;
        best = {point, normal, distance, triangle}, upright = cosine, reach_m = distance;
    }
};

void TriangleGroups::search_block(uint32_t block, Search& search) const {
    for (uint32_t group = block * uint32_t(kLanes);
         group < std::min((block + 1) * uint32_t(kLanes), group_count()); ++group) {
        if (!search.is_within(groups_.runs.low_of(group), groups_.runs.high_of(group))) continue;
        for (uint32_t t = begin_of(group); t < ends_[group]; ++t)
            if (search.is_within(boxes_[t].low, boxes_[t].high))
                search.look_at(corners_[t], triangles_[t].number);
    }
}

TriangleGroups::Closest TriangleGroups::closest(const Vec3& p, float reach_m) const {
    const auto blocks = uint32_t((group_count() + kLanes - 1) / kLanes);
    Search search{p, reach_m};
    const auto is_within = [&](uint32_t block) {
        return search.is_within(groups_.blocks.low_of(block), groups_.blocks.high_of(block));
    };
    // The first one makes the reach of the others short.
    uint32_t first = 0;
    float least = INFINITY;
    for (uint32_t block = 0; block < blocks; ++block) {
        if (!is_within(block)) continue;
        const Vec3 middle = 0.5f * (groups_.blocks.low_of(block) + groups_.blocks.high_of(block));
        if (const float away = glm::distance(p, middle); away < least) least = away, first = block;
    }
    if (!std::isfinite(least)) return search.best;
    search_block(first, search);
    for (uint32_t block = 0; block < blocks; ++block)
        if (block != first && is_within(block)) search_block(block, search);
    if (search.upright < 0.0f) search.best.distance = -search.best.distance;
    return search.best;
}

bool TriangleGroups::are_beside(uint32_t group, uint32_t other) const {
    const auto begin = beside_.begin() + std::ptrdiff_t(first_beside_[group]),
               end = beside_.begin() + std::ptrdiff_t(first_beside_[group + 1]);
    return std::find(begin, end, other) != end;
}

bool TriangleGroups::face_one_way(uint32_t group, uint32_t other) const {
    constexpr float kOneWay =
        0.5f;  // within 60 degrees: where a surface bends more, it may meet itself all the same
    const Bounds &a = normals_[group], &b = normals_[other];
    const Vec3 low = glm::min(a.low, b.low), high = glm::max(a.high, b.high), middle = low + high,
               least = glm::min(middle * low, middle * high);
    return least.x + least.y + least.z > kOneWay * glm::length(middle);
}

void TriangleGroups::find_crossings(bool flat_do_not, std::vector<TrianglePair>& out, Jobs& jobs) {
    find_in_shares(jobs, out, [&](Share& share, uint32_t group) {
        find_meeting(groups_, groups_.runs.low_of(group), groups_.runs.high_of(group), share.near);
        for (auto other = std::lower_bound(share.near.begin(), share.near.end(), group);
             other != share.near.end(); ++other)
            if (!flat_do_not || !face_one_way(group, *other) || !are_beside(group, *other))
                meet(group, *this, *other, share.pairs);
    });
}

void TriangleGroups::find_crossings(const TriangleGroups& other, std::vector<TrianglePair>& out, Jobs& jobs) {
    find_in_shares(jobs, out, [&](Share& share, uint32_t group) {
        find_meeting(other.groups_, groups_.runs.low_of(group), groups_.runs.high_of(group), share.near);
        for (const uint32_t of_other : share.near) meet(group, other, of_other, share.pairs);
    });
}

/// The same for any number of threads.
template <typename Find>
void TriangleGroups::find_in_shares(Jobs& jobs, std::vector<TrianglePair>& out, Find&& find) {
    for_shares(jobs, [&](Share& share, uint32_t begin, uint32_t end) {
        share.pairs.clear();
        for (uint32_t group = begin; group < end; ++group) find(share, group);
    });
    for (const Share& share : shares_) out.insert(out.end(), share.pairs.begin(), share.pairs.end());
}

void TriangleGroups::find_crossed(uint32_t group, const Corners& other,
                                  std::vector<uint32_t>& triangles) const {
    const Bounds box = bounds_of(other);
    if (!box.overlaps(box_of(group))) return;
    if (slabs_[group].is_clear_of(other)) return;
    for (uint32_t i = begin_of(group); i < ends_[group]; ++i)
        if (boxes_[i].overlaps(box) && cross(corners_[i], other)) triangles.push_back(triangles_[i].number);
}

void TriangleGroups::find_crossed(const Corners& other, std::vector<uint32_t>& met,
                                  std::vector<uint32_t>& triangles) const {
    const Bounds box = bounds_of(other);
    find_meeting(groups_, box.low, box.high, met);
    for (const uint32_t group : met) find_crossed(group, other, triangles);
}

void TriangleGroups::meet(uint32_t group, const TriangleGroups& other, uint32_t of_other,
                          std::vector<TrianglePair>& out) const {
    const bool own = this == &other;
    const Bounds reach{other.groups_.runs.low_of(of_other), other.groups_.runs.high_of(of_other)};
    for (uint32_t i = begin_of(group); i < ends_[group]; ++i) {
        if (!boxes_[i].overlaps(reach) || other.slabs_[of_other].is_clear_of(corners_[i])) continue;
        const uint32_t* u = triangles_[i].vertex;
        for (uint32_t k = own && group == of_other ? i + 1 : other.begin_of(of_other);
             k < other.ends_[of_other]; ++k) {
            if (!boxes_[i].overlaps(other.boxes_[k])) continue;
            const uint32_t* v = other.triangles_[k].vertex;
            if (own &&
                std::any_of(u, u + 3, [&](uint32_t at) { return at == v[0] || at == v[1] || at == v[2]; }))
                continue;
            if (cross(corners_[i], other.corners_[k]))
                out.emplace_back(triangles_[i].number, other.triangles_[k].number);
        }
    }
}

}  // namespace vfit
