#include "cloth/contact/self_contact.h"

#include <algorithm>
#include <cmath>

#include "cloth/contact/flat_neighbours.h"

namespace vfit {

namespace {

// Ways along edges are up to sqrt(2) longer than straight ones, and a triangle reaches nearer than the corner
// by which it is found.
constexpr float kAlong = 1.8f;
// Layers are looked at before they touch. Between two looks they may come nearer by so much; the faster, the
// more often; in each sub-step those that would come nearer still. Nothing is looked for further than this
// off in a step.
constexpr float kMargin_m = 0.008f, kFarthestWay_m = 0.1f;

// Of a triangle's longest edge, how far its places may be from the nearest corner: 0.58 at most.
constexpr float kCorner = 0.6f;

// A piece whose triangles all face one way does not meet itself (Volino and Thalmann 1994).
constexpr float kAlike = 0.6f;  // cosine

// Sub-steps for which a particle that got onto the wrong side of a layer is pushed back. After that the two
// have grown into each other: pulling would stretch them, and bring nothing.
constexpr int kPatience = 24;

// What lies beside a triangle rather than before it is the same layer, or passes its border.
constexpr float kSquare = 0.5f;  // cosine

}  // namespace

float SelfContact::reach() const { return thickness_m_ + kMargin_m; }

SelfContact::SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m, Jobs* jobs)
    : fabric_(std::move(fabric)), thickness_m_(thickness_m) {
    const ParticleLayout& layout = fabric_->layout();
    corner_m_.assign(layout.count() / kLanes, 0.0f);
    for (const DistanceConstraint& e : fabric_->data().edges)
        for (uint32_t v : {e.a, e.b}) {
            float& most = corner_m_[layout.particle_of[v] / kLanes];
            most = std::max(most, kCorner * e.rest_m);
        }
    const float far_m = reach() + *std::max_element(corner_m_.begin(), corner_m_.end());
    FlatNeighbours along = flat_neighbours(*fabric_, kAlong * far_m, kAlong * thickness_m_, jobs);
    first_neighbour_ = std::move(along.first), neighbours_ = std::move(along.of_runs);
    list_neighbours();
    counts_.assign(layout.count(), 0);
    for (uint32_t particle : layout.particle_of) counts_[particle] = 1;
    is_let_go_.assign(layout.count(), 0);
    nobody_.assign(layout.count() / kLanes, 0);
    for (size_t i = 0; i < counts_.size(); ++i)
        if (!counts_[i]) nobody_[i / kLanes] |= uint64_t(0xff) << (8 * (i % kLanes));
    boxes_.resize(layout.count() / kLanes);
    facing_.resize(layout.count() / kLanes);
    ways_.resize(layout.count() / kLanes);
    for (auto* list : {&seen_[0], &seen_[1], &seen_now_[0], &seen_now_[1]}) list->resize(layout.count());
    parts_.resize(layout.parts.size());
    for (size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].meeting.reserve(layout.count() / kLanes);
        parts_[i].watched.reserve((layout.parts[i].moving_end - layout.parts[i].begin) / kLanes);
    }
    all_.reserve(2 * layout.count());
    batches_.reserve(2 * layout.count() / kLanes + 1);
}

/// Of each vertex, those that share a triangle with it.
void SelfContact::list_neighbours() {
    const ParticleLayout& layout = fabric_->layout();
    first_beside_.assign(1, 0);
    for (uint32_t v = 0; v < fabric_->vertex_count(); ++v) {
        const auto first = std::ptrdiff_t(beside_.size());
        for (const TriangleFans::Corners& c : fabric_->fans().of(layout.particle_of[v]))
            for (uint32_t other : {c.second, c.third}) beside_.push_back(layout.vertex_of[other]);
        std::sort(beside_.begin() + first, beside_.end());
        beside_.erase(std::unique(beside_.begin() + first, beside_.end()), beside_.end());
        first_beside_.push_back(uint32_t(beside_.size()));
    }
}

void SelfContact::forget() {
    for (auto& list : seen_) std::fill(list.begin(), list.end(), Seen());
}

void SelfContact::find_runs(const Particles& places, const Particles& velocities, const Particles& normals,
                            float dt, int substeps, Jobs& jobs) {
    const ParticleLayout& layout = fabric_->layout();
    Vec3 drift(0.0f);  // what all share brings nothing nearer
    for (const Particle& v : velocities) drift += v.x / float(velocities.size());
    parallel_for(jobs, uint32_t(parts_.size()), [&](uint32_t part) {
        for (uint32_t run = layout.parts[part].begin / uint32_t(kLanes);
             run < layout.parts[part].end / kLanes; ++run)
            look_at(places, velocities, normals, drift, dt, run);
    });
    boxes_.find_blocks();
    parallel_for(jobs, uint32_t(parts_.size()),
                 [&](uint32_t part) { find_runs_of(places, normals, substeps, part); });
}

void SelfContact::look_at(const Particles& places, const Particles& velocities, const Particles& normals,
                          const Vec3& drift, float dt, uint32_t run) {
    Vec3 low(INFINITY), high(-INFINITY);
    Ways ways{Vec3(INFINITY), Vec3(-INFINITY)};
    for (size_t i = run * kLanes; i < (run + 1) * kLanes; ++i) {
        if (!counts_[i]) continue;
        low = glm::min(low, places[i].x), high = glm::max(high, places[i].x);
        const Vec3 way =
            glm::clamp((velocities[i].x - drift) * dt, Vec3(-kFarthestWay_m), Vec3(kFarthestWay_m));
        ways.least = glm::min(ways.least, way), ways.most = glm::max(ways.most, way);
    }
    ways_[run] = ways;
    const Vec3 back = glm::min(ways.least, Vec3(0.0f)), forth = glm::max(ways.most, Vec3(0.0f));
    boxes_.runs.set(run, low + back - corner_m_[run], high + forth + corner_m_[run]);
    facing_[run] = facing_of(normals, run);
}

/// The mean normal of a run; zero where they differ.
Vec3 SelfContact::facing_of(const Particles& normals, uint32_t run) const {
    Vec3 sum(0.0f);
    for (size_t i = run * kLanes; i < (run + 1) * kLanes; ++i)
        if (counts_[i]) sum += normals[i].x;
    const Vec3 mean = sum / std::max(glm::length(sum), 1e-12f);
    for (size_t i = run * kLanes; i < (run + 1) * kLanes; ++i)
        if (counts_[i] && glm::dot(normals[i].x, mean) < kAlike) return Vec3(0.0f);
    return mean;
}

void SelfContact::let_go(std::span<const uint32_t> vertices) {
    for (const uint32_t particle : let_go_) is_let_go_[particle] = 0;
    let_go_.clear();
    for (const uint32_t v : vertices) let_go_.push_back(fabric_->layout().particle_of[v]);
    for (const uint32_t particle : let_go_) is_let_go_[particle] = 1;
}

void SelfContact::find_runs_of(const Particles& places, const Particles& normals, int substeps,
                               uint32_t number) {
    const ParticleLayout::Part& p = fabric_->layout().parts[number];
    Part& part = parts_[number];
    part.watched.clear(), part.near.clear();
    part.changed = true;
    for (uint32_t run = p.begin / uint32_t(kLanes); run < p.moving_end / kLanes; ++run) {
        const float wider = reach() - corner_m_[run];
        find_meeting(boxes_, boxes_.runs.low_of(run) - wider, boxes_.runs.high_of(run) + wider, part.meeting);
        const size_t before = part.near.size();
        uint32_t own = first_neighbour_[run];
        for (uint32_t other : part.meeting) {
            while (own < first_neighbour_[run + 1] && neighbours_[own].run < other) ++own;
            const bool beside = own < first_neighbour_[run + 1] && neighbours_[own].run == other;
            if (beside && glm::dot(facing_[run], facing_[other]) > kAlike) continue;
            NearRun near = beside ? neighbours_[own] : NearRun{other, 0, 0, 0, 0, false};
            const Vec3 towards =
                glm::max(ways_[run].most - ways_[other].least, ways_[other].most - ways_[run].least);
            near.way_m = glm::length(glm::max(towards, Vec3(0.0f)));
            near.reach_m = reach() + corner_m_[other];
            near.excluded |= nobody_[other];
            if (~near.excluded == 0) continue;
            part.near.push_back(near);
        }
        part.near.resize(before +
                         keep_near(run, places.data(), normals.data(), std::span(part.near).subspan(before)));
        if (part.near.size() == before) {
            for (auto* list : {&seen_[0], &seen_[1], &seen_now_[0], &seen_now_[1]})
                std::fill_n(list->begin() + run * kLanes, kLanes, Seen());
            continue;
        }
        float way_m = 0.0f, corner_m = 0.0f;
        for (size_t i = before; i < part.near.size(); ++i) {
            way_m = std::max(way_m, part.near[i].way_m);
            corner_m = std::max(corner_m, corner_m_[part.near[i].run]);
        }
        const float substep_way_m = way_m / float(substeps);
        const int every = std::clamp(int(kMargin_m / std::max(substep_way_m, 1e-6f)), 1, substeps);
        part.watched.push_back({run,
                                uint32_t(before),
                                uint32_t(part.near.size()),
                                every,
                                thickness_m_ + std::max(kMargin_m, substep_way_m),
                                corner_m,
                                0,
                                {}});
    }
}

void SelfContact::find(const Particles& places, const Particles& starts, const Particles& normals,
                       int substep, uint32_t number) {
    Part& part = parts_[number];
    Meetings meetings;
    for (Watched& watched : part.watched) {
        if (substep % watched.every != 0) {
            for (size_t side = 0; side < 2; ++side)
                std::copy_n(seen_[side].begin() + watched.run * kLanes, kLanes,
                            seen_now_[side].begin() + watched.run * kLanes);
            continue;
        }
        part.changed = true;
        watched.contact_count = 0;
        for (auto& list : seen_now_) std::fill_n(list.begin() + watched.run * kLanes, kLanes, Seen());
        NearestOfRun nearest(watched.reach_m + watched.corner_m);
        find_nearest_in_cloth(watched.run, places.data(), normals.data(),
                              std::span(part.near).subspan(watched.first, watched.end - watched.first),
                              nearest);
        for (size_t side = 0; side < 2; ++side)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const auto particle = uint32_t(watched.run * kLanes + particle_at(lane));
                if (nearest.id[side][lane] == NearestOnFans::kNone || !counts_[particle]) continue;
                const size_t at = meetings.count++;
                meetings.places[particle_at(at)] = places[particle];
                meetings.points[at] = nearest.id[side][lane];
                meetings.watched[at] = &watched;
                meetings.particles[at] = particle;
                meetings.sides[at] = uint8_t(side);
                if (meetings.count == kLanes) meet(places, starts, meetings);
            }
    }
    if (meetings.count > 0) meet(places, starts, meetings);
}

void SelfContact::meet(const Particles& places, const Particles& starts, Meetings& meetings) {
    std::fill(meetings.points + meetings.count, meetings.points + kLanes, NearestOnFans::kNone);
    NearestOnFans nearest;
    find_nearest_on_fans(meetings.places, meetings.points, fabric_->fans(), places.data(), nearest);
    for (size_t lane = 0; lane < meetings.count; ++lane) meet(places, starts, meetings, nearest, lane);
    meetings.count = 0;
}

/// A particle with the nearest triangle about the point.
void SelfContact::meet(const Particles& places, const Particles& starts, const Meetings& meetings,
                       const NearestOnFans& nearest, size_t lane) {
    Watched& watched = *meetings.watched[lane];
    if (!(nearest.distance2[lane] < watched.reach_m * watched.reach_m)) return;
    const uint32_t particle = meetings.particles[lane], point = meetings.points[lane];
    const TriangleFans::Corners& c = fabric_->fans().corners()[nearest.corners[lane]];
    if (is_let_go_[particle] && (is_let_go_[point] || is_let_go_[c.second] || is_let_go_[c.third])) return;
    const Vec3 &a = places[point].x, &b = places[c.second].x, &third = places[c.third].x,
               weights = nearest.weights(lane);
    const Vec3 off = places[particle].x - (weights.x * a + weights.y * b + weights.z * third),
               across = glm::cross(b - a, third - a);
    const float before = glm::dot(off, across);
    const uint32_t vertex = fabric_->layout().vertex_of[point];
    Seen& now = seen_now_[meetings.sides[lane]][particle];
    const Seen* seen = seen_about(particle, vertex);
    if (before * before < kSquare * kSquare * nearest.distance2[lane] * glm::dot(across, across)) {
        if (seen) now = *seen;
        return;
    }
    const float began = before_triangle(starts, particle, point, c) >= 0.0f ? 1.0f : -1.0f;
    // What is far counts if it has just come through.
    if (nearest.distance2[lane] > reach() * reach() && began * before >= 0.0f) return;
    now = {vertex, side_of(particle, vertex, seen ? seen->side : began), 0};
    if (now.side * before < 0.0f) {
        now.wrong = int16_t((seen ? seen->wrong : 0) + watched.every);
        if (now.wrong > kPatience) now.side = -now.side, now.wrong = 0;
    }
    watched.contacts[watched.contact_count++] = {particle, {point, c.second, c.third}, weights, now.side};
}

float SelfContact::before_triangle(const Particles& at, uint32_t particle, uint32_t corner,
                                   const TriangleFans::Corners& others) {
    const Vec3 &a = at[corner].x, across = glm::cross(at[others.second].x - a, at[others.third].x - a);
    return glm::dot(at[particle].x - a, across);
}

/// On which side of the layer about that vertex. One whose neighbours were all on the other side slipped
/// through alone, and goes back.
float SelfContact::side_of(uint32_t particle, uint32_t vertex, float own) const {
    constexpr float kAlone = 4.0f;  // neighbours that have to agree
    float votes = 0.0f, voters = 0.0f;
    for (const TriangleFans::Corners& c : fabric_->fans().of(particle))
        if (const Seen* seen = seen_about(c.second, vertex)) votes += seen->side, ++voters;
    return voters >= kAlone && votes * own == -voters ? -own : own;
}

/// What a particle saw of that layer in the last look; null: it was not near.
const SelfContact::Seen* SelfContact::seen_about(uint32_t particle, uint32_t vertex) const {
    for (const auto& list : seen_) {
        const Seen& seen = list[particle];
        if (seen.vertex == UINT32_MAX) continue;
        if (seen.vertex == vertex) return &seen;
        const uint32_t first = first_beside_[vertex], end = first_beside_[vertex + 1];
        for (uint32_t i = first; i < end; ++i)
            if (beside_[i] == seen.vertex) return &seen;
    }
    return nullptr;
}

/// Lanes far apart on the cloth: what they push is seldom the same.
void SelfContact::pack() {
    if (std::none_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.changed; })) return;
    std::swap(seen_, seen_now_);
    all_.clear();
    for (Part& part : parts_) {
        part.changed = false;
        for (const Watched& watched : part.watched)
            all_.insert(all_.end(), watched.contacts, watched.contacts + watched.contact_count);
    }
    const ParticleLayout& layout = fabric_->layout();
    const auto inverse_mass = [&](uint32_t particle) {
        return fabric_->data().inverse_mass[layout.vertex_of[particle]];
    };
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
            const Vec3 others(inverse_mass(c.corners[0]), inverse_mass(c.corners[1]),
                              inverse_mass(c.corners[2]));
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
