#include "outfit/posed_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vfit {

namespace {

constexpr int kTries = 4;            // out of one limb may be into another
constexpr float kDeepest_m = 0.25f;  // within a body
constexpr float kAhead_m = 0.03f;    // looked further than is needed, so that it need not be done each step

/// One flag a triangle: it has an edge that no other triangle shares.
std::vector<uint8_t> border_of(std::span<const uint32_t> indices) {
    std::map<std::pair<uint32_t, uint32_t>, int> sides;
    const auto edge = [&](size_t i) { return std::minmax(indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]); };
    for (size_t i = 0; i < indices.size(); ++i) ++sides[edge(i)];
    std::vector<uint8_t> out(indices.size() / 3, 0);
    for (size_t i = 0; i < indices.size(); ++i)
        if (sides[edge(i)] == 1) out[i / 3] = 1;
    return out;
}

}  // namespace

PosedBody::PosedBody(std::span<const uint32_t> indices)
    : indices_(indices.begin(), indices.end()), at_border_(border_of(indices)) {}

void PosedBody::see(std::span<const Vec3> skin, std::span<const Collider> colliders) {
    skin_ = skin, colliders_ = colliders;
    is_found_ = false;
}

void PosedBody::find_skin(Jobs& jobs) {
    if (!triangles_) triangles_.emplace(skin_, indices_);
    triangles_->move(skin_, jobs);
    float way2 = 0.0f;
    for (size_t i = 0; i < last_skin_.size(); ++i) {
        const Vec3 way = skin_[i] - last_skin_[i];
        way2 = std::max(way2, glm::dot(way, way));
    }
    skin_way_m_ = std::sqrt(way2);
    last_skin_.assign(skin_.begin(), skin_.end());
    is_found_ = true;
}

/// How far outside of the skin it was, at least; negative: inside.
float PosedBody::push_out_of_skin(float reach_m, float clearance_m, Vec3& p) const {
    constexpr float kOnIt_m = 1e-6f;
    float outside_m = reach_m;
    for (int i = 0; i < kTries; ++i) {
        const TriangleGroups::Closest on = triangles_->closest(p, reach_m);
        if (!std::isfinite(on.distance)) break;
        // Beyond a border there is no inside.
        const float distance = at_border_[on.triangle] ? std::abs(on.distance) : on.distance;
        if (i == 0) outside_m = distance;
        if (distance >= clearance_m || at_border_[on.triangle]) break;
        const Vec3 outward = std::abs(distance) > kOnIt_m ? (p - on.point) / distance : on.normal;
        p = on.point + outward * clearance_m;
    }
    return outside_m;
}

void PosedBody::push_out_of_colliders(float clearance_m, Vec3& p) const {
    for (int i = 0; i < kTries; ++i) {
        bool is_near = false;
        for (const CapsuleShape& shape : shapes_) {
            const NearestBall ball = nearest_ball(shape, p);
            if (ball.distance >= clearance_m) continue;
            p += (clearance_m - ball.distance) * ball.normal;
            is_near = true;
        }
        if (!is_near) return;
    }
}

void PosedBody::move(std::span<const Vec3> places, float clearance_m, const Bounds& bounds, Points& points,
                     Jobs& jobs) {
    const auto is_near = [&](const Vec3& p) { return bounds.overlaps({p, p}); };
    const bool is_first = points.before.size() != places.size();
    points.at.assign(places.begin(), places.end());
    if (is_first) points.before = points.at;
    const bool any = std::any_of(places.begin(), places.end(), is_near);
    if (is_first || !any) points.outside_m.assign(places.size(), -1.0f);
    if (any) {
        const bool on_skin = !indices_.empty();
        if (on_skin && !is_found_) find_skin(jobs);
        shapes_.clear();
        for (const Collider& c : colliders_) shapes_.emplace_back(capsule_of(c, 0.0f));
        parallel_for_vertices(&jobs, uint32_t(places.size()), [&](uint32_t i) {
            float& outside_m = points.outside_m[i];
            if (!is_near(places[i])) {
                outside_m = -1.0f;
            } else if (!on_skin) {
                push_out_of_colliders(clearance_m, points.at[i]);
            } else if (outside_m < 0.0f) {
                outside_m = push_out_of_skin(kDeepest_m, clearance_m, points.at[i]);
            } else {
                // A point that was further outside of the skin than both have moved is outside still.
                outside_m -= glm::distance(places[i], points.before[i]) + skin_way_m_;
                if (outside_m <= clearance_m)
                    outside_m = push_out_of_skin(std::max(clearance_m, -outside_m) + kAhead_m, clearance_m,
                                                 points.at[i]);
            }
        });
    }
    points.before.assign(places.begin(), places.end());
}

}  // namespace vfit
