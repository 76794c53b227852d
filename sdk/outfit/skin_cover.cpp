#include "outfit/skin_cover.h"

#include <algorithm>
#include <cmath>

#include "body/mesh.h"
#include "cloth/contact/contact.h"
#include "cloth/garment/carried.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr float kLargest_m = 0.2f,
                kLongest_m = 0.25f;  // a ball's radius; from one end of a capsule to the other

/// A joint at the end of the limb that the part belongs to, as the paper's spheres are named.
int joint_of(BodyPart part) {
    switch (part) {
        case BodyPart::kHead: return VFIT_JOINT_HEAD;
        case BodyPart::kTorso: return VFIT_JOINT_TORSO;
        case BodyPart::kLeftUpperArm: return VFIT_JOINT_LEFT_ELBOW;
        case BodyPart::kLeftForearm:
        case BodyPart::kLeftHand: return VFIT_JOINT_LEFT_HAND;
        case BodyPart::kRightUpperArm: return VFIT_JOINT_RIGHT_ELBOW;
        case BodyPart::kRightForearm:
        case BodyPart::kRightHand: return VFIT_JOINT_RIGHT_HAND;
        case BodyPart::kLeftThigh: return VFIT_JOINT_LEFT_KNEE;
        case BodyPart::kLeftShank:
        case BodyPart::kLeftFoot: return VFIT_JOINT_LEFT_FOOT;
        case BodyPart::kRightThigh: return VFIT_JOINT_RIGHT_KNEE;
        case BodyPart::kRightShank:
        case BodyPart::kRightFoot: return VFIT_JOINT_RIGHT_FOOT;
    }
    return VFIT_JOINT_TORSO;
}

bool is_hand_or_foot(BodyPart part) {
    return part == BodyPart::kLeftHand || part == BodyPart::kRightHand || part == BodyPart::kLeftFoot ||
           part == BodyPart::kRightFoot;
}

struct Ball {
    Vec3 center;
    float radius;
};

/// The largest ball inside the skin that touches it at p (shrinking balls: Ma, Bae, Choi 2012).
Ball inner_ball(const MeshQuery& skin, const Vec3& p, const Vec3& normal) {
    constexpr int kMostSteps = 20;
    constexpr float kTouches_m = 1e-4f;
    float radius = kLargest_m;
    for (int i = 0; i < kMostSteps; ++i) {
        const Vec3 center = p - normal * radius;
        const MeshQuery::Closest closest = skin.closest(center);
        if (closest.distance > radius - kTouches_m) break;
        // Of the balls that touch at p, the one through that point as well.
        const Vec3 way = closest.point - p;
        const float along = -2.0f * glm::dot(way, normal);
        if (!(along > 0.0f)) break;
        radius = std::min(radius, glm::dot(way, way) / along);
    }
    return {p - normal * radius, radius};
}

/// Two balls, touched by the skin at two vertices, and all that are between them.
struct Pair {
    Ball a, b;
    uint32_t seed_a, seed_b;
};

/// Does what is between the balls stick out of the skin by no more than that?
bool is_inside(const MeshQuery& skin, const Ball& a, const Ball& b, float most_m) {
    for (const float share : {0.5f, 0.25f, 0.75f}) {
        const Vec3 center = glm::mix(a.center, b.center, share);
        if (skin.signed_distance(center) + glm::mix(a.radius, b.radius, share) > most_m) return false;
    }
    return true;
}

/// Inner balls of vertices, found when they are asked for; larger by what they may stick out.
class InnerBalls {
public:
    InnerBalls(const MeshQuery& skin, std::span<const Vec3> rest, std::span<const Vec3> normals, float out_m)
        : skin_(skin), rest_(rest), normals_(normals), out_m_(out_m), balls_(rest.size(), Ball{{}, -1.0f}) {}

    const Ball& at(uint32_t v) {
        if (balls_[v].radius < 0.0f) {
            balls_[v] = inner_ball(skin_, rest_[v], normals_[v]);
            balls_[v].radius += out_m_;
        }
        return balls_[v];
    }

private:
    const MeshQuery& skin_;
    std::span<const Vec3> rest_, normals_;
    float out_m_;
    std::vector<Ball> balls_;
};

}  // namespace

SkinCover::SkinCover(const DressBody& body, std::span<const uint8_t> below,
                     std::span<const Collider> colliders, float tolerance_m) {
    constexpr size_t kTried = 64;  // other ends of a capsule
    const std::vector<Vec3> rest(body.positions.begin(), body.positions.end());
    std::vector<Vec3> normals;
    compute_normals(rest, {body.indices.begin(), body.indices.end()}, normals);
    const MeshQuery skin(body.positions, body.indices);
    InnerBalls balls(skin, rest, normals, 0.5f * tolerance_m);

    std::vector<uint32_t> open;  // what is not covered yet, and how far outside it is
    std::vector<float> outside_m(rest.size(), INFINITY);
    std::vector<CapsuleShape> shapes;
    for (const Collider& c : colliders) shapes.emplace_back(capsule_of(c, 0.0f));
    for (uint32_t v = 0; v < rest.size(); ++v) {
        if (!below[v] || (!body.parts.empty() && is_hand_or_foot(body.parts[v]))) continue;
        for (const CapsuleShape& shape : shapes)
            outside_m[v] = std::min(outside_m[v], nearest_ball(shape, rest[v]).distance);
        if (outside_m[v] > tolerance_m) open.push_back(v);
    }

    Carried carried;
    while (!open.empty()) {
        const uint32_t worst = *std::max_element(
            open.begin(), open.end(), [&](uint32_t a, uint32_t b) { return outside_m[a] < outside_m[b]; });
        // The two balls, or one, that together with all between them cover most, the worst place among it.
        const Ball first = balls.at(worst);
        Pair best{first, first, worst, worst};
        size_t most = 0;
        const auto try_pair = [&](const Ball& second, uint32_t seed) {
            const CapsuleShape shape(Capsule{first.center, second.center, first.radius, second.radius});
            const size_t count = size_t(std::count_if(open.begin(), open.end(), [&](uint32_t v) {
                return nearest_ball(shape, rest[v]).distance <= tolerance_m;
            }));
            if (count > most) most = count, best = {first, second, worst, seed};
        };
        try_pair(first, worst);
        std::vector<uint32_t> tried;
        for (const uint32_t v : open)
            if (v != worst && glm::length(rest[v] - rest[worst]) < kLongest_m) tried.push_back(v);
        const size_t step = 1 + tried.size() / kTried;
        for (size_t i = 0; i < tried.size(); i += step) {
            const Ball second = balls.at(tried[i]);
            if (is_inside(skin, first, second, tolerance_m)) try_pair(second, tried[i]);
        }
        Collider collider;
        collider.joint = body.parts.empty() ? int(VFIT_JOINT_TORSO) : joint_of(body.parts[best.seed_a]);
        collider.center = best.a.center;
        collider.radius = best.a.radius;
        carried.add(best.a.center, body.skin_bones[best.seed_a], body.skin_weights[best.seed_a]);
        if (best.seed_b != best.seed_a) {
            collider.joint_b = body.parts.empty() ? int(VFIT_JOINT_TORSO) : joint_of(body.parts[best.seed_b]);
            collider.center_b = best.b.center;
            collider.radius_b = best.b.radius;
            carried.add(best.b.center, body.skin_bones[best.seed_b], body.skin_weights[best.seed_b]);
        }
        shapes_.push_back(collider);
        const CapsuleShape shape(capsule_of(collider, 0.0f));
        std::erase_if(open, [&](uint32_t v) {
            outside_m[v] = std::min(outside_m[v], nearest_ball(shape, rest[v]).distance);
            return outside_m[v] <= tolerance_m;
        });
    }
    if (!shapes_.empty()) skin_.emplace(carried.skin());
}

void SkinCover::append(std::span<const Mat4> matrices, std::vector<Collider>& out, Skin::Scratch& scratch,
                       std::vector<Vec3>& places, Jobs& jobs) const {
    if (!skin_) return;
    skin_->carry(matrices, places, scratch, jobs);
    const Vec3* place = places.data();
    for (Collider shape : shapes_) {
        shape.center = *place++;
        if (shape.is_capsule()) shape.center_b = *place++;
        out.push_back(shape);
    }
}

}  // namespace vfit
