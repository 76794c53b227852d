#include "outfit/posed_body.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Out of one limb may be into another.
constexpr int kTries = 4;

void push_out_of(const TriangleGroups& skin, float clearance_m, Vec3& p) {
    constexpr float kOnIt_m = 1e-6f;
    for (int i = 0; i < kTries; ++i) {
        const TriangleGroups::Closest on = skin.closest(p);
        if (on.distance >= clearance_m) return;
        const Vec3 outward = std::abs(on.distance) > kOnIt_m ? (p - on.point) / on.distance : on.normal;
        p = on.point + outward * clearance_m;
    }
}

void push_out_of(std::span<const Collider> colliders, float clearance_m, Vec3& p) {
    for (int i = 0; i < kTries; ++i) {
        bool is_inside = false;
        for (const Collider& c : colliders) {
            const NearestBall ball = nearest_ball(CapsuleShape(capsule_of(c, clearance_m)), p);
            if (ball.distance >= 0.0f) continue;
            p -= ball.distance * ball.normal;
            is_inside = true;
        }
        if (!is_inside) return;
    }
}

}  // namespace

PosedBody::PosedBody(const DressBody& body, const ContactSkin& skin, const Creases& creases)
    : creases_(creases),
      skin_(skin_below(body, skin, std::vector<uint8_t>(body.positions.size(), 1), creases)) {}

void PosedBody::see(std::span<const Mat4> matrices, std::span<const Collider> colliders) {
    matrices_ = matrices, colliders_ = colliders;
    is_posed_ = false;
}

void PosedBody::pose_skin(Jobs& jobs) {
    skin_->skin.carry(matrices_, places_, scratch_, jobs);
    creases_.open(matrices_, skin_->creased, places_, jobs);
    if (!triangles_) triangles_.emplace(places_, skin_->indices);
    triangles_->move(places_, jobs);
    is_posed_ = true;
}

void PosedBody::push_out(float clearance_m, const Bounds& bounds, std::span<Vec3> points, Jobs& jobs) {
    const auto is_near = [&](const Vec3& p) { return bounds.overlaps({p, p}); };
    if (std::none_of(points.begin(), points.end(), is_near)) return;
    if (skin_ && !is_posed_) pose_skin(jobs);
    parallel_for_vertices(&jobs, uint32_t(points.size()), [&](uint32_t i) {
        if (!is_near(points[i])) return;
        if (triangles_)
            push_out_of(*triangles_, clearance_m, points[i]);
        else
            push_out_of(colliders_, clearance_m, points[i]);
    });
}

}  // namespace vfit
