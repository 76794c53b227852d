#include "cook/model/stand.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "measure/section.h"

namespace vfit {

namespace {

constexpr float kHigh_m = 4.0f;   // above all bodies
constexpr float kEase_m = 0.02f;  // around, that an opening may be wider than the body where it sits

class Stander {
public:
    Stander(const Surface& surface, const BodyOutline& outline, const MeshQuery& skin) : surface_(surface), outline_(outline), skin_(skin), cloth_(surface.positions, surface.indices) {}

    /// What raises the cloth over the shoulders onto the body's: none where there is no such cloth on both sides.
    std::optional<float> by_shoulders(float thickness_m) const {
        const Vec3 joint = outline_.left_shoulder();
        constexpr float kInner_m = 0.04f, kStep_m = 0.01f, kDepth_m = 0.06f, kUpright = 0.6f;
        const float lowest = 0.5f * (outline_.levels().waist + outline_.levels().shoulder);
        std::vector<float> raise;
        for (const float side : {-1.0f, 1.0f}) {
            const size_t before = raise.size();
            for (float x = kInner_m; x < joint.x; x += kStep_m) {
                // The ridge of the shoulder: the highest of the cloth there, and of the body.
                float cloth = -INFINITY, body = -INFINITY;
                for (float z = joint.z - kDepth_m; z <= joint.z + kDepth_m; z += kStep_m) {
                    const Vec3 from(side * x, kHigh_m, z);
                    const auto hit = cloth_.cast(from, {0, -1, 0}, 2.0f * kHigh_m);
                    if (hit && std::abs(hit->normal.y) > kUpright) cloth = std::max(cloth, kHigh_m - hit->distance);
                    if (const auto below = skin_.cast(from, {0, -1, 0}, 2.0f * kHigh_m)) body = std::max(body, kHigh_m - below->distance);
                }
                if (cloth > lowest && body > lowest) raise.push_back(body + thickness_m - cloth);
            }
            if (raise.size() == before) return std::nullopt;
        }
        // Shoulders slope as they like: with most of it above the skin, the rest gives.
        constexpr size_t kOfFour = 3;
        const size_t at = raise.size() * kOfFour / 4;
        std::nth_element(raise.begin(), raise.begin() + std::ptrdiff_t(at), raise.end());
        return raise[at];
    }

    /// The highest opening around the body's axis; else the upper edge of what is open in front. Vertices.
    std::vector<uint32_t> upper_edge() const {
        const std::vector<uint32_t>* best = nullptr;
        for (const auto& opening : surface_.openings) {
            std::vector<Vec2> seen;
            for (const uint32_t v : opening) seen.emplace_back(surface_.positions[v].x, surface_.positions[v].z);
            if (encloses(seen, {0.0f, outline_.axis_z()}) && (!best || height(opening) > height(*best))) best = &opening;
        }
        std::vector<uint32_t> edge;
        if (best) edge = *best;
        else
            for (const auto& opening : surface_.openings) edge.insert(edge.end(), opening.begin(), opening.end());
        float top = -INFINITY, low = INFINITY;
        for (const uint32_t v : edge) top = std::max(top, surface_.positions[v].y), low = std::min(low, surface_.positions[v].y);
        // A waist may be lower in front, but a slit, a fly or a hem is no part of it.
        constexpr float kNearTop_m = 0.05f, kSlanted_m = 0.15f;
        if (best && top - low < kSlanted_m) return edge;
        std::erase_if(edge, [&](uint32_t v) { return surface_.positions[v].y < top - kNearTop_m; });
        return edge;
    }

    float by_waist(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float own = height(edge);
        constexpr float kAboveWaist_m = 0.12f;
        if (own > levels.waist + kAboveWaist_m) return 0.0f;
        const auto crotch = by_crotch();
        const float raised = sits_at(edge) - own;
        return crotch ? std::min(raised, *crotch) : raised;
    }

private:
    float height(const std::vector<uint32_t>& of) const {
        float sum = 0.0f;
        for (const uint32_t v : of) sum += surface_.positions[v].y;
        return sum / float(std::max<size_t>(of.size(), 1));
    }

    /// Down from the waist to where the body fills the opening; one that is wider than the hips is worn with a belt.
    float sits_at(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float around = surface_.length_of(edge);
        constexpr float kStep_m = 0.005f;
        for (float y = levels.waist; y > levels.hip; y -= kStep_m)
            if (outline_.at(y).perimeter() + kEase_m >= around) return y;
        return levels.waist;
    }

    std::optional<float> by_crotch() const {
        constexpr float kBelow_m = 0.02f;
        const Vec3 from(0.0f, -kHigh_m, outline_.axis_z());
        const auto cloth = cloth_.cast(from, {0, 1, 0}, 2.0f * kHigh_m), body = skin_.cast(from, {0, 1, 0}, 2.0f * kHigh_m);
        if (!cloth || !body) return std::nullopt;
        return body->distance - kBelow_m - cloth->distance;
    }

    const Surface& surface_;
    const BodyOutline& outline_;
    const MeshQuery& skin_;
    MeshQuery cloth_;
};

}  // namespace

Standing stand(const Surface& surface, const BodyOutline& outline, const MeshQuery& skin, float thickness_m) {
    Standing out;
    const Stander stander(surface, outline, skin);
    if (const auto by = stander.by_shoulders(thickness_m)) {
        out.hangs_on = HangsOn::shoulders;
        out.raised_m = *by;
    } else if (const std::vector<uint32_t> edge = stander.upper_edge(); !edge.empty()) {
        out.hangs_on = HangsOn::waist;
        out.raised_m = stander.by_waist(edge);
        out.band.of.assign(surface.positions.size(), 0);
        for (const uint32_t v : edge) out.band.of[v] = 1;
    }
    size_t inside = 0;
    for (Vec3 p : surface.positions) {
        p.y += out.raised_m;
        constexpr int kTries = 4;  // between two thighs, out of one may be into the other
        constexpr float kDeep_m = 0.01f;
        for (int i = 0; i < kTries; ++i) {
            const float distance = skin.signed_distance(p);
            if (i == 0) inside += distance < -kDeep_m, out.deepest_m = std::max(out.deepest_m, -distance);
            if (distance >= thickness_m) break;
            const MeshQuery::Closest near = skin.closest(p);
            const Vec3 outward = near.distance > 1e-6f ? (p - near.point) / distance : near.normal;
            p = near.point + outward * thickness_m;
        }
        out.places.push_back(p);
    }
    out.inside_share = float(inside) / float(surface.positions.size());
    return out;
}

}  // namespace vfit
