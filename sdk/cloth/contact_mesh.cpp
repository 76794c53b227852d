#include "cloth/contact_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr float kFastest_m = 0.1f;  // further than that in a step, a mesh is not looked for
constexpr float kCornerReach = 0.6f;  // of an edge: so far off may the corner be by which a place of a triangle is found
constexpr float kFartherWay = 1.25f, kFartherWay_m = 0.002f;  // a particle may go further than its speed says

std::vector<uint32_t> counted(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts) {
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        for (size_t k = 0; k < 3; ++k)
            if (indices[i + k] >= vertices) fail(VFIT_ERROR_DATA, "a contact mesh's triangle names vertex ", indices[i + k], " of ", vertices);
        if (counts.empty() || (counts[indices[i]] && counts[indices[i + 1]] && counts[indices[i + 2]]))
            out.insert(out.end(), indices.begin() + std::ptrdiff_t(i), indices.begin() + std::ptrdiff_t(i) + 3);
    }
    return out;
}

}  // namespace

ContactMesh::ContactMesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts)
    : counts_(vertices, 0), indices_(counted(vertices, indices, counts)), fans_(vertices, indices_) {
    for (uint32_t v : indices_) counts_[v] = 1;
    current_.reserve(vertices);
    previous_.reserve(vertices);
}

/// Along a Morton curve of cells of 8 mm: neighbours in space follow each other.
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
    std::vector<std::pair<uint32_t, uint32_t>> codes;
    for (uint32_t v = 0; v < counts_.size(); ++v) {
        if (!counts_[v]) continue;
        const Vec3 cell = finite(positions[v]) ? glm::clamp((positions[v] - low) * 128.0f, 0.0f, 1023.0f) : Vec3(0.0f);
        codes.emplace_back(spread(uint32_t(cell.x)) | spread(uint32_t(cell.y)) << 1 | spread(uint32_t(cell.z)) << 2, v);
    }
    std::sort(codes.begin(), codes.end());
    vertex_of_.clear();
    for (const auto& [code, v] : codes) vertex_of_.push_back(v);
    const size_t runs = (vertex_of_.size() + kLanes - 1) / kLanes;
    places_.assign(runs * kLanes, Particle{Vec3(NAN)});
    boxes_.resize(runs);
    ways_m_.assign(runs, 0.0f);
    edges_m_.assign(runs, 0.0f);
    for (size_t i = 0; i < vertex_of_.size(); ++i)
        for (uint32_t t : fans_.of(vertex_of_[i]))
            for (size_t k = 0; k < 3; ++k) {
                const float length = glm::length(positions[indices_[3 * t + k]] - positions[vertex_of_[i]]);
                if (std::isfinite(length)) edges_m_[i / kLanes] = std::max(edges_m_[i / kLanes], length);
            }
}

void ContactMesh::accept(std::span<const Vec3> positions, const Vec3& low, const Vec3& high) {
    current_.assign(positions.begin(), positions.end());
    if (previous_.size() != current_.size()) previous_ = current_;
    if (vertex_of_.empty() && !indices_.empty()) order(positions);
    greatest_way_ = 0.0f;
    for (size_t run = 0; run < ways_m_.size(); ++run) {
        Vec3 from(INFINITY), to(-INFINITY);
        float way2 = 0.0f;
        for (size_t i = run * kLanes; i < std::min((run + 1) * kLanes, vertex_of_.size()); ++i) {
            const Vec3 &p = previous_[vertex_of_[i]], &q = current_[vertex_of_[i]];
            const bool inside = glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
            places_[i].x = inside ? p : Vec3(NAN);
            if (!inside) continue;
            const Vec3 way = q - p;
            from = glm::min(from, glm::min(p, q)), to = glm::max(to, glm::max(p, q));
            way2 = std::max(way2, glm::dot(way, way));
        }
        ways_m_[run] = std::min(std::sqrt(way2), kFastest_m);
        greatest_way_ = std::max(greatest_way_, std::sqrt(way2));
        const float reach = kCornerReach * edges_m_[run];
        boxes_.runs.set(run, from - reach, to + reach);
    }
    boxes_.find_blocks();
}

void ContactMesh::hide() {
    previous_.clear();
    greatest_way_ = 0.0f;
    boxes_.resize(ways_m_.size());
}

void ContactMesh::carry(const RigidMotion& motion) {
    for (Vec3& p : previous_) p = motion.point(p);
}

Vec3 ContactMesh::at(const std::vector<Vec3>& positions, const Place& place) const {
    const uint32_t* v = &indices_[3 * place.triangle];
    return place.weights.x * positions[v[0]] + place.weights.y * positions[v[1]] + place.weights.z * positions[v[2]];
}

Vec3 ContactMesh::normal_of(const std::vector<Vec3>& positions, uint32_t triangle) const {
    const uint32_t* v = &indices_[3 * triangle];
    const Vec3 across = glm::cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]);
    const float length = glm::length(across);
    return length > 0.0f ? across / length : Vec3(0.0f);
}

/// Of the triangles about a vertex; where the nearest place is at another corner, about that one too.
ContactMesh::Place ContactMesh::nearest_about(uint32_t vertex, const Vec3& p) const {
    Place best{UINT32_MAX, {}};
    float best2 = INFINITY;
    constexpr int kSteps = 3;
    for (int step = 0; step < kSteps; ++step) {
        const float before2 = best2;
        for (uint32_t t : fans_.of(vertex)) {
            const uint32_t* v = &indices_[3 * t];
            const Place place{t, nearest_on_triangle(p, previous_[v[0]], previous_[v[1]], previous_[v[2]])};
            const Vec3 way = p - at(previous_, place);
            if (const float distance2 = glm::dot(way, way); distance2 < best2) best2 = distance2, best = place;
        }
        if (!(best2 < before2)) break;
        const uint32_t* v = &indices_[3 * best.triangle];
        const int heaviest = best.weights.x >= best.weights.y && best.weights.x >= best.weights.z ? 0 : best.weights.y >= best.weights.z ? 1 : 2;
        if (v[heaviest] == vertex) break;
        vertex = v[heaviest];
    }
    return best;
}

/// Which way is out there: on an edge or a corner, by all triangles about it.
Vec3 ContactMesh::outward_at(const Place& place) const {
    constexpr float kInside = 1e-4f;
    if (std::min({place.weights.x, place.weights.y, place.weights.z}) > kInside) return normal_of(previous_, place.triangle);
    Vec3 sum(0.0f);
    for (int k = 0; k < 3; ++k) {
        if (place.weights[k] <= kInside) continue;
        for (uint32_t t : fans_.of(indices_[3 * place.triangle + uint32_t(k)])) sum += normal_of(previous_, t);
    }
    return sum;
}

void ContactMesh::find_planes(const Moving& moving, float dt, float thickness_m, std::vector<uint32_t>& near, std::vector<RunPlanes>& out) const {
    static const Particle kNoNormals[kLanes] = {};
    for (uint32_t first = 0; first < moving.count; first += uint32_t(kLanes)) {
        const Particle* run = moving.places + first;
        Vec3 low(INFINITY), high(-INFINITY);
        float speed2 = 0.0f;
        for (size_t i = 0; i < kLanes; ++i) {
            low = glm::min(low, run[i].x);
            high = glm::max(high, run[i].x);
            speed2 = std::max(speed2, glm::dot(moving.velocities[first + i].x, moving.velocities[first + i].x));
        }
        const float own = thickness_m + std::min(kFartherWay * dt * std::sqrt(speed2) + kFartherWay_m, kFastest_m);
        find_meeting(boxes_, low - own, high + own, near);
        if (near.empty()) continue;
        float way = 0.0f, edge = 0.0f;
        for (uint32_t other : near) way = std::max(way, ways_m_[other]), edge = std::max(edge, edges_m_[other]);
        const float reach = own + way;
        NearestOfRun nearest(reach + kCornerReach * edge);
        find_nearest_in_runs(run, kNoNormals, places_.data(), near, {}, nearest);
        RunPlanes planes{};
        bool any = false;
        for (size_t lane = 0; lane < kLanes; ++lane) {
            planes.thickness_m[lane] = RunPlanes::kNone;
            if (nearest.id[0][lane] == UINT32_MAX) continue;
            const Vec3& p = run[particle_at(lane)].x;
            const Place place = nearest_about(vertex_of_[nearest.id[0][lane]], p);
            if (place.triangle == UINT32_MAX) continue;
            const Vec3 on = at(previous_, place), to = at(current_, place), off = p - on;
            const float distance = glm::length(off);
            const Vec3 outward = outward_at(place);
            const bool inside = glm::dot(off, outward) < 0.0f;
            if ((!inside && distance > reach) || !finite(on) || !finite(to)) continue;
            constexpr float kOnIt_m = 1e-5f;
            Vec3 normal = distance > kOnIt_m ? (inside ? -off : off) / distance : outward / std::max(glm::length(outward), 1e-12f);
            Vec3 turned = normal + normal_of(current_, place.triangle) - normal_of(previous_, place.triangle);
            turned /= std::max(glm::length(turned), 1e-12f);
            any = true;
            planes.set(lane, on, to - on, normal, turned - normal, thickness_m);
        }
        if (!any) continue;
        planes.run = first / uint32_t(kLanes);
        out.push_back(planes);
    }
}

}  // namespace vfit
