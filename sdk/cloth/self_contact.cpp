#include "cloth/self_contact.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace vfit {

namespace {

// Ways along edges are up to sqrt(2) longer than straight ones, and a triangle reaches nearer than the corner by which it is
// found.
constexpr float kAlong = 1.8f;
// Layers are looked at before they touch: so far they may come nearer between two looks, and in a step.
constexpr float kMargin_m = 0.01f, kFarthestWay_m = 0.05f;

// A piece whose triangles all face one way does not meet itself (Volino and Thalmann 1994).
constexpr float kAlike = 0.6f;  // cosine

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
    list_neighbours();
    counts_.assign(layout.count(), 0);
    for (uint32_t particle : layout.particle_of) counts_[particle] = 1;
    boxes_.resize(layout.count() / kLanes);
    wide_boxes_.resize(layout.count() / kLanes);
    facing_.resize(layout.count() / kLanes);
    ways_m_.resize(layout.count() / kLanes);
    normals_.resize(layout.count());
    for (auto* list : {&seen_[0], &seen_[1], &seen_now_[0], &seen_now_[1]}) list->resize(layout.count());
    parts_.resize(layout.parts.size());
    for (size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].meeting.reserve(layout.count() / kLanes);
        parts_[i].runs.reserve(layout.count() / kLanes);
        parts_[i].first.reserve(layout.count() / kLanes + 1);
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

/// Of each vertex, those that share a triangle with it.
void SelfContact::list_neighbours() {
    const std::vector<uint32_t>& indices = fabric_->data().indices;
    first_beside_.assign(1, 0);
    for (uint32_t v = 0; v < fabric_->vertex_count(); ++v) {
        const auto first = std::ptrdiff_t(beside_.size());
        for (uint32_t t : fans_.of(v))
            for (size_t k = 0; k < 3; ++k)
                if (indices[3 * size_t(t) + k] != v) beside_.push_back(indices[3 * size_t(t) + k]);
        std::sort(beside_.begin() + first, beside_.end());
        beside_.erase(std::unique(beside_.begin() + first, beside_.end()), beside_.end());
        first_beside_.push_back(uint32_t(beside_.size()));
    }
}

void SelfContact::forget() {
    for (auto& list : seen_) std::fill(list.begin(), list.end(), Seen());
}

void SelfContact::find_runs(const Particles& places, const Particles& velocities, float dt, Jobs& jobs) {
    const ParticleLayout& layout = fabric_->layout();
    Vec3 drift(0.0f);  // what all share brings nothing nearer
    for (const Particle& v : velocities) drift += v.x / float(velocities.size());
    parallel_for(jobs, uint32_t(parts_.size()), [&](uint32_t part) {
        for (uint32_t run = layout.parts[part].begin / uint32_t(kLanes); run < layout.parts[part].end / kLanes; ++run)
            look_at(places, velocities, drift, dt, run);
    });
    wide_boxes_.find_blocks();
    parallel_for(jobs, uint32_t(parts_.size()), [&](uint32_t part) { find_runs_of(places, part); });
}

void SelfContact::look_at(const Particles& places, const Particles& velocities, const Vec3& drift, float dt, uint32_t run) {
    Vec3 low(INFINITY), high(-INFINITY), wide_low(INFINITY), wide_high(-INFINITY), slowest(0.0f), fastest(0.0f);
    for (size_t i = run * kLanes; i < (run + 1) * kLanes; ++i) {
        if (!counts_[i]) continue;
        low = glm::min(low, places[i].x), high = glm::max(high, places[i].x);
        const Vec3 way = glm::clamp((velocities[i].x - drift) * dt, Vec3(-kFarthestWay_m), Vec3(kFarthestWay_m));
        slowest = glm::min(slowest, way), fastest = glm::max(fastest, way);
        for (const Fabric::Corners& c : fabric_->fan(uint32_t(i))) wide_low = glm::min(wide_low, places[c.second].x), wide_high = glm::max(wide_high, places[c.second].x);
    }
    boxes_.set(run, low + slowest, high + fastest);
    wide_boxes_.runs.set(run, glm::min(low, wide_low) + slowest, glm::max(high, wide_high) + fastest);
    ways_m_[run] = glm::length(glm::max(glm::abs(slowest), glm::abs(fastest)));
    facing_[run] = facing_of(places, run);
}

/// By one triangle of each particle: all that is asked is who is before it and who behind.
void SelfContact::find_normals(const Particles& places, uint32_t run) {
    for (uint32_t i = run * uint32_t(kLanes); i < (run + 1) * kLanes; ++i) {
        const std::span<const Fabric::Corners> fan = fabric_->fan(i);
        if (!fan.empty()) normals_[i].x = glm::cross(places[fan[0].second].x - places[i].x, places[fan[0].third].x - places[i].x);
    }
}

/// By the same triangles.
Vec3 SelfContact::facing_of(const Particles& places, uint32_t run) const {
    Vec3 normals[kLanes], sum(0.0f);
    size_t count = 0;
    for (uint32_t i = run * uint32_t(kLanes); i < (run + 1) * kLanes; ++i) {
        const std::span<const Fabric::Corners> fan = fabric_->fan(i);
        if (fan.empty()) continue;
        const Vec3 across = glm::cross(places[fan[0].second].x - places[i].x, places[fan[0].third].x - places[i].x);
        normals[count] = across / std::max(glm::length(across), 1e-12f);
        sum += normals[count++];
    }
    const Vec3 mean = sum / std::max(glm::length(sum), 1e-12f);
    for (size_t i = 0; i < count; ++i)
        if (glm::dot(normals[i], mean) < kAlike) return Vec3(0.0f);
    return mean;
}

void SelfContact::find_runs_of(const Particles& places, uint32_t number) {
    const ParticleLayout::Part& p = fabric_->layout().parts[number];
    Part& part = parts_[number];
    part.runs.clear(), part.first.clear(), part.near.clear(), part.excluded.clear();
    for (uint32_t run = p.begin / uint32_t(kLanes); run < p.moving_end / kLanes; ++run) {
        const Vec3 low = boxes_.low_of(run), high = boxes_.high_of(run);
        find_meeting(wide_boxes_, low - reach_m_, high + reach_m_, part.meeting);
        const size_t before = part.near.size();
        float way_m = 0.0f;
        uint32_t own = first_neighbour_[run];
        for (uint32_t other : part.meeting) {
            while (own < first_neighbour_[run + 1] && neighbours_[own].run < other) ++own;
            const bool beside = own < first_neighbour_[run + 1] && neighbours_[own].run == other;
            if (beside && glm::dot(facing_[run], facing_[other]) > kAlike) continue;
            uint64_t excluded = beside ? neighbours_[own].excluded : 0;
            for (size_t i = 0; i < kLanes; ++i)
                if (!counts_[other * kLanes + i]) excluded |= uint64_t(0xff) << (8 * i);
            if (~excluded == 0) continue;
            part.near.push_back(other);
            part.excluded.push_back(excluded);
            way_m = std::max(way_m, ways_m_[other]);
        }
        const size_t kept = before + keep_near(&places[run * kLanes], places.data(), vertex_reach_m_ + ways_m_[run] + way_m,
                                               part.near.data() + before, part.excluded.data() + before, part.near.size() - before);
        part.near.resize(kept);
        part.excluded.resize(kept);
        if (kept == before) continue;
        part.runs.push_back(run);
        part.first.push_back(uint32_t(before));
    }
    part.first.push_back(uint32_t(part.near.size()));
}

void SelfContact::find(const Particles& places, uint32_t number) {
    const ParticleLayout& layout = fabric_->layout();
    const ParticleLayout::Part& p = layout.parts[number];
    Part& part = parts_[number];
    part.contacts.clear();
    for (auto& list : seen_now_) std::fill(list.begin() + p.begin, list.begin() + p.end, Seen());
    for (size_t at = 0; at < part.runs.size(); ++at) {
        const uint32_t run = part.runs[at];
        find_normals(places, run);
        NearestOfRun nearest(vertex_reach_m_);
        const size_t from = part.first[at], count = part.first[at + 1] - from;
        find_nearest_in_runs(&places[run * kLanes], &normals_[run * kLanes], places.data(), std::span(part.near).subspan(from, count),
                             std::span(part.excluded).subspan(from, count), nearest);
        for (size_t side = 0; side < 2; ++side)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const auto particle = uint32_t(run * kLanes + particle_at(lane));
                if (nearest.id[side][lane] != UINT32_MAX && counts_[particle])
                    meet(places, part, particle, layout.vertex_of[nearest.id[side][lane]], seen_now_[side][particle]);
            }
    }
}

/// With the nearest triangle about that vertex.
void SelfContact::meet(const Particles& places, Part& part, uint32_t particle, uint32_t vertex, Seen& now) {
    const std::vector<uint32_t>& indices = fabric_->data().indices;
    const std::vector<uint32_t>& particle_of = fabric_->layout().particle_of;
    const auto at = [&](uint32_t v) -> const Vec3& { return places[particle_of[v]].x; };
    const Vec3& p = places[particle].x;
    uint32_t best = UINT32_MAX;
    float best2 = reach_m_ * reach_m_;
    Vec3 weights(0.0f);
    for (uint32_t t : fans_.of(vertex)) {
        const uint32_t* v = &indices[3 * size_t(t)];
        const Vec3 &a = at(v[0]), &b = at(v[1]), &c = at(v[2]);
        const Vec3 w = nearest_on_triangle(p, a, b, c);
        const Vec3 way = p - (w.x * a + w.y * b + w.z * c);
        if (const float distance2 = glm::dot(way, way); distance2 < best2) best2 = distance2, best = t, weights = w;
    }
    if (best == UINT32_MAX) return;
    const uint32_t* v = &indices[3 * size_t(best)];
    const Vec3 &a = at(v[0]), &b = at(v[1]), &c = at(v[2]);
    const Vec3 off = p - (weights.x * a + weights.y * b + weights.z * c), across = glm::cross(b - a, c - a);
    const float before = glm::dot(off, across);
    if (before * before < kSquare * kSquare * best2 * glm::dot(across, across)) return;
    const float side = side_of(particle, vertex, before >= 0.0f ? 1.0f : -1.0f);
    now = {vertex, side};
    part.contacts.push_back({particle, {particle_of[v[0]], particle_of[v[1]], particle_of[v[2]]}, weights, side});
}

/// On which side of the layer about that vertex: where the particle was in the last look. One whose neighbours were all on the
/// other side slipped through alone, and goes back.
float SelfContact::side_of(uint32_t particle, uint32_t vertex, float now) const {
    constexpr float kAlone = 4.0f;  // neighbours that have to agree
    const float own = side_seen(particle, vertex), side = own != 0.0f ? own : now;
    float votes = 0.0f, voters = 0.0f;
    for (const Fabric::Corners& c : fabric_->fan(particle)) {
        const float vote = side_seen(c.second, vertex);
        votes += vote;
        voters += std::abs(vote);
    }
    return voters >= kAlone && votes * side == -voters ? -side : side;
}

/// On which side a particle was; 0: it was not near.
float SelfContact::side_seen(uint32_t particle, uint32_t vertex) const {
    for (const auto& list : seen_) {
        const Seen& seen = list[particle];
        if (seen.vertex == UINT32_MAX) continue;
        if (seen.vertex == vertex) return seen.side;
        const uint32_t first = first_beside_[vertex], end = first_beside_[vertex + 1];
        for (uint32_t i = first; i < end; ++i)
            if (beside_[i] == seen.vertex) return seen.side;
    }
    return 0.0f;
}

/// Lanes far apart on the cloth: what they push is seldom the same.
void SelfContact::pack() {
    std::swap(seen_, seen_now_);
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
