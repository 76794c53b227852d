#include "cloth/self_contact.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "math/finite.h"

namespace vfit {

namespace {

// Ways along edges are up to sqrt(2) longer than straight ones, and a triangle reaches nearer than the corner by which it is
// found.
constexpr float kAlong = 1.8f;
// Layers are looked at before they touch: so far they may come nearer in a step.
constexpr float kMargin_m = 0.01f;

// What lies beside a triangle rather than before it is the same layer, or passes its border.
constexpr float kSquare = 0.5f;  // cosine

float longest(std::span<const DistanceConstraint> edges) {
    float most = 0.0f;
    for (const DistanceConstraint& e : edges) most = std::max(most, e.rest_m);
    return most;
}

}  // namespace

SelfContact::SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m)
    : fabric_(std::move(fabric)),
      fans_(fabric_->vertex_count(), fabric_->data().indices),
      thickness_m_(thickness_m),
      reach_m_(thickness_m + kMargin_m),
      vertex_reach_m_(reach_m_ + 0.6f * longest(fabric_->data().edges)) {
    const ParticleLayout& layout = fabric_->layout();
    exclude_neighbours(kAlong * vertex_reach_m_);
    positions_.resize(fabric_->vertex_count());
    seen_places_.assign(layout.count(), Particle{Vec3(NAN)});
    boxes_.resize(layout.count() / kLanes);
    normals_.resize(layout.count());
    for (auto* list : {&seen_[0], &seen_[1], &seen_now_[0], &seen_now_[1]}) list->resize(layout.count());
    parts_.resize(layout.parts.size());
    for (size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].near.reserve(layout.count() / kLanes);
        parts_[i].excluded.reserve(layout.count() / kLanes);
        parts_[i].contacts.reserve(2 * (layout.parts[i].moving_end - layout.parts[i].begin));
    }
    all_.reserve(2 * layout.count());
    batches_.reserve(2 * layout.count() / kLanes + 1);
}

/// Of each run, the vertices that are nearer than that to one of it along the flat cloth.
void SelfContact::exclude_neighbours(float radius_m) {
    const FabricData& data = fabric_->data();
    const ParticleLayout& layout = fabric_->layout();
    struct Link {
        uint32_t to;
        float length_m;
    };
    std::vector<std::vector<Link>> links(fabric_->vertex_count());
    for (const DistanceConstraint& e : data.edges) {
        links[e.a].push_back({e.b, e.rest_m});
        links[e.b].push_back({e.a, e.rest_m});
    }
    // Edges between two fixed vertices are no constraints, and still the cloth.
    for (size_t t = 0; t < data.indices.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = data.indices[t + k], b = data.indices[t + (k + 1) % 3];
            if (data.inverse_mass[a] == 0.0f && data.inverse_mass[b] == 0.0f) {
                links[a].push_back({b, 0.0f});
                links[b].push_back({a, 0.0f});
            }
        }
    std::vector<float> distance(fabric_->vertex_count(), INFINITY);
    std::vector<uint8_t> lanes(fabric_->vertex_count(), 0);
    std::vector<uint32_t> reached, of_run;
    first_neighbour_.assign(layout.count() / kLanes + 1, 0);
    for (uint32_t run = 0; run < layout.count() / kLanes; ++run) {
        of_run.clear();
        for (uint32_t i = 0; i < kLanes; ++i) {
            const uint32_t seed = layout.vertex_of[run * kLanes + i];
            if (seed == ParticleLayout::kNobody || data.inverse_mass[seed] == 0.0f) continue;
            using Entry = std::pair<float, uint32_t>;
            std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
            reached.assign(1, seed);
            distance[seed] = 0.0f;
            open.push({0.0f, seed});
            while (!open.empty()) {
                const auto [d, v] = open.top();
                open.pop();
                if (d > distance[v]) continue;
                if (lanes[v] == 0) of_run.push_back(v);
                lanes[v] |= uint8_t(1u << lane_of(i));
                for (const Link& link : links[v]) {
                    const float to = d + link.length_m;
                    if (to > radius_m || to >= distance[link.to]) continue;
                    if (distance[link.to] == INFINITY) reached.push_back(link.to);
                    distance[link.to] = to;
                    open.push({to, link.to});
                }
            }
            for (uint32_t v : reached) distance[v] = INFINITY;
        }
        std::sort(of_run.begin(), of_run.end(), [&](uint32_t a, uint32_t b) { return layout.particle_of[a] < layout.particle_of[b]; });
        for (uint32_t v : of_run) {
            const uint32_t particle = layout.particle_of[v], other = particle / uint32_t(kLanes);
            if (neighbours_.size() == first_neighbour_[run] || neighbours_.back().run != other) neighbours_.push_back({other, 0});
            neighbours_.back().excluded |= uint64_t(lanes[v]) << (8 * (particle % kLanes));
            lanes[v] = 0;
        }
        first_neighbour_[run + 1] = uint32_t(neighbours_.size());
    }
}

void SelfContact::forget() {
    for (auto& list : seen_) std::fill(list.begin(), list.end(), Seen());
}

void SelfContact::find(const Particles& places, Jobs& jobs) {
    look_about(places);
    parallel_for(jobs, uint32_t(parts_.size()), [&](uint32_t part) { find_of_part(places, part); });
    std::swap(seen_, seen_now_);
    pack();
}

void SelfContact::look_about(const Particles& places) {
    const ParticleLayout& layout = fabric_->layout();
    for (size_t v = 0; v < positions_.size(); ++v)
        seen_places_[layout.particle_of[v]].x = positions_[v] = places[layout.particle_of[v]].x;
    for (size_t run = 0; run < layout.count() / kLanes; ++run) {
        Vec3 low(INFINITY), high(-INFINITY);
        for (size_t i = run * kLanes; i < (run + 1) * kLanes; ++i) low = glm::min(low, seen_places_[i].x), high = glm::max(high, seen_places_[i].x);
        boxes_.set(run, low, high);
    }
}

/// Who of the runs that are near does not count, as it is a neighbour on the flat cloth.
void SelfContact::exclude_of(uint32_t run, Part& part) const {
    part.excluded.assign(part.near.size(), 0);
    uint32_t own = first_neighbour_[run];
    for (size_t i = 0; i < part.near.size(); ++i) {
        while (own < first_neighbour_[run + 1] && neighbours_[own].run < part.near[i]) ++own;
        if (own < first_neighbour_[run + 1] && neighbours_[own].run == part.near[i]) part.excluded[i] = neighbours_[own].excluded;
    }
}

void SelfContact::find_of_part(const Particles& places, uint32_t number) {
    const ParticleLayout& layout = fabric_->layout();
    const ParticleLayout::Part& p = layout.parts[number];
    Part& part = parts_[number];
    part.contacts.clear();
    for (uint32_t first = p.begin; first < p.moving_end; first += uint32_t(kLanes)) {
        const uint32_t run = first / uint32_t(kLanes);
        for (uint32_t i = first; i < first + kLanes; ++i)
            for (auto& seen : seen_now_) seen[i] = Seen();
        const Vec3 low(boxes_.low[0][run], boxes_.low[1][run], boxes_.low[2][run]), high(boxes_.high[0][run], boxes_.high[1][run], boxes_.high[2][run]);
        find_meeting(boxes_, low - vertex_reach_m_, high + vertex_reach_m_, part.near);
        exclude_of(run, part);
        if (std::all_of(part.excluded.begin(), part.excluded.end(), [](uint64_t bits) { return ~bits == 0; })) continue;
        for (uint32_t i = first; i < first + kLanes; ++i) {
            Vec3 normal(0.0f);
            for (const Fabric::Corners& c : fabric_->fan(i))
                normal += glm::cross(places[c.second].x - places[i].x, places[c.third].x - places[i].x);
            normals_[i].x = normal;
        }
        NearestOfRun nearest(vertex_reach_m_);
        find_nearest_in_runs(&places[first], &normals_[first], seen_places_.data(), part.near, part.excluded, nearest);
        for (size_t side = 0; side < 2; ++side)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const auto particle = uint32_t(first + particle_at(lane));
                if (nearest.id[side][lane] != UINT32_MAX && layout.vertex_of[particle] != ParticleLayout::kNobody)
                    meet(places, part, particle, layout.vertex_of[nearest.id[side][lane]], seen_now_[side][particle]);
            }
    }
}

/// With the nearest triangle about that vertex.
void SelfContact::meet(const Particles& places, Part& part, uint32_t particle, uint32_t vertex, Seen& now) {
    const std::vector<uint32_t>& indices = fabric_->data().indices;
    const Vec3& p = places[particle].x;
    uint32_t best = UINT32_MAX;
    float best2 = reach_m_ * reach_m_;
    Vec3 weights(0.0f);
    for (uint32_t t : fans_.of(vertex)) {
        const uint32_t* v = &indices[3 * size_t(t)];
        const Vec3 &a = positions_[v[0]], &b = positions_[v[1]], &c = positions_[v[2]];
        const Vec3 w = nearest_on_triangle(p, a, b, c);
        const Vec3 way = p - (w.x * a + w.y * b + w.z * c);
        if (const float distance2 = glm::dot(way, way); distance2 < best2) best2 = distance2, best = t, weights = w;
    }
    if (best == UINT32_MAX) return;
    const uint32_t* v = &indices[3 * size_t(best)];
    const Vec3 &a = positions_[v[0]], &b = positions_[v[1]], &c = positions_[v[2]];
    const Vec3 off = p - (weights.x * a + weights.y * b + weights.z * c), across = glm::cross(b - a, c - a);
    const float before = glm::dot(off, across);
    if (before * before < kSquare * kSquare * best2 * glm::dot(across, across)) return;
    float side = side_seen(particle, vertex);
    if (side == 0.0f) side = before >= 0.0f ? 1.0f : -1.0f;
    now = {vertex, side};
    const ParticleLayout& layout = fabric_->layout();
    part.contacts.push_back({particle, {layout.particle_of[v[0]], layout.particle_of[v[1]], layout.particle_of[v[2]]}, weights, side});
}

/// On which side of the layer about that vertex the particle was in the last step; 0: it was not near.
float SelfContact::side_seen(uint32_t particle, uint32_t vertex) const {
    const std::vector<uint32_t>& indices = fabric_->data().indices;
    for (const auto& list : seen_) {
        const Seen& seen = list[particle];
        if (seen.vertex == UINT32_MAX) continue;
        if (seen.vertex == vertex) return seen.side;
        for (uint32_t t : fans_.of(vertex))
            for (size_t k = 0; k < 3; ++k)
                if (indices[3 * size_t(t) + k] == seen.vertex) return seen.side;
    }
    return 0.0f;
}

/// Lanes far apart on the cloth: what they push is seldom the same.
void SelfContact::pack() {
    all_.clear();
    for (const Part& part : parts_) all_.insert(all_.end(), part.contacts.begin(), part.contacts.end());
    const ParticleLayout& layout = fabric_->layout();
    const auto inverse_mass = [&](uint32_t particle) { return fabric_->data().inverse_mass[layout.vertex_of[particle]]; };
    batches_.resize((all_.size() + kLanes - 1) / kLanes);
    const auto spare = uint32_t(layout.parts[0].spare() * sizeof(Particle));
    for (size_t i = 0; i < batches_.size(); ++i) {
        SurfaceContacts& batch = batches_[i];
        for (size_t k = 0; k < kLanes; ++k) {
            const size_t at = k * batches_.size() + i;
            batch.vertex[k] = batch.a[k] = batch.b[k] = batch.c[k] = spare;
            batch.at_a[k] = batch.at_b[k] = batch.at_c[k] = batch.side[k] = batch.thickness_m[k] = 0.0f;
            batch.vertex_gain[k] = batch.a_gain[k] = batch.b_gain[k] = batch.c_gain[k] = 0.0f;
            if (at >= all_.size()) continue;
            const Contact& c = all_[at];
            const float own = inverse_mass(c.particle);
            const Vec3 others(inverse_mass(c.corners[0]), inverse_mass(c.corners[1]), inverse_mass(c.corners[2]));
            const float share = 1.0f / (own + glm::dot(c.weights * c.weights, others));
            batch.vertex[k] = uint32_t(c.particle * sizeof(Particle));
            batch.a[k] = uint32_t(c.corners[0] * sizeof(Particle));
            batch.b[k] = uint32_t(c.corners[1] * sizeof(Particle));
            batch.c[k] = uint32_t(c.corners[2] * sizeof(Particle));
            batch.at_a[k] = c.weights.x, batch.at_b[k] = c.weights.y, batch.at_c[k] = c.weights.z;
            batch.side[k] = c.side;
            batch.thickness_m[k] = thickness_m_;
            batch.vertex_gain[k] = own * share;
            batch.a_gain[k] = c.weights.x * others.x * share;
            batch.b_gain[k] = c.weights.y * others.y * share;
            batch.c_gain[k] = c.weights.z * others.z * share;
        }
    }
}

}  // namespace vfit
