#include "cook/model/stand.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cook/drape/upper_edge.h"
#include "geometry/borders.h"

namespace vfit {

namespace {

constexpr float kHigh_m = 4.0f;  // above all bodies

class Stander {
public:
    Stander(const Surface& surface, const BodyOutline& outline, const MeshQuery& skin)
        : surface_(surface), outline_(outline), skin_(skin), cloth_(surface.positions, surface.indices) {}

    /// What brings the cloth over the shoulders onto the body's: none where there is no such cloth on both
    /// sides.
    std::optional<Vec3> by_shoulders(float thickness_m) const {
        constexpr float kInner_m = 0.04f, kSlope_m = 0.08f;
        constexpr float kAnywhere_m = 0.25f;
        const Vec3 joint = outline_.left_shoulder();
        const float lowest = 0.5f * (outline_.levels().waist + outline_.levels().shoulder);
        std::vector<float> raise;
        float forward = 0.0f;
        for (const float side : {-1.0f, 1.0f}) {
            std::vector<std::pair<Vec3, Vec3>> ridges;  // of cloth and body
            float top = -INFINITY;
            for (float x = kInner_m; x < joint.x; x += kStep_m) {
                const auto cloth = ridge(cloth_, {side * x, kHigh_m, 0.0f}, kAnywhere_m),
                           body = outline_.shoulder_ridge(side * x);
                if (!cloth || !body || cloth->y < lowest || body->y < lowest) continue;
                ridges.emplace_back(*cloth, *body);
                top = std::max(top, cloth->y);
            }
            if (ridges.empty()) return std::nullopt;
            // Beyond the shoulder's end the highest is the chest, or a sleeve.
            for (const auto& [cloth, body] : ridges) {
                if (cloth.y < top - kSlope_m) continue;
                raise.push_back(body.y + thickness_m - cloth.y);
                forward += body.z - cloth.z;
            }
        }
        forward /= float(raise.size());
        // The median: shoulders slope as they like, and beside a strap there is a neckline.
        const size_t at = raise.size() / 2;
        std::nth_element(raise.begin(), raise.begin() + std::ptrdiff_t(at), raise.end());
        return Vec3(0.0f, raise[at], only_if_far(forward));
    }

    std::vector<uint32_t> upper_edge() const {
        return vfit::upper_edge(surface_.positions, surface_.openings, outline_.axis_z());
    }

    Vec3 by_waist(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float own = mean_height(surface_.positions, edge);
        constexpr float kAboveWaist_m = 0.12f;
        if (own > levels.waist + kAboveWaist_m) return Vec3(0.0f);
        const auto crotch = by_crotch();
        float raised = sits_at(edge) - own;
        if (crotch) raised = std::min(raised, *crotch);
        float front = -INFINITY, back = INFINITY;
        for (const uint32_t v : edge)
            front = std::max(front, surface_.positions[v].z), back = std::min(back, surface_.positions[v].z);
        return {0.0f, raised, only_if_far(outline_.axis_z() - 0.5f * (front + back))};
    }

private:
    static constexpr float kStep_m = 0.01f;

    /// Bodies stand in one place but for a little.
    static float only_if_far(float forward_m) {
        constexpr float kFar_m = 0.03f;
        return std::abs(forward_m) > kFar_m ? forward_m : 0.0f;
    }

    /// The nearest height to its own, between hips and waist, at which the body about fills the opening. One
    /// that is wider than the hips is worn at the waist, with a belt.
    float sits_at(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float around = length_around(surface_.positions, edge),
                    own = mean_height(surface_.positions, edge);
        constexpr float kStep_m = 0.005f, kTight_m = 0.02f,
                        kLoose = 0.85f;  // stretched around by so much; filled by so much
        float best = levels.waist, least = INFINITY;
        for (float y = levels.waist; y > levels.hip; y -= kStep_m) {
            const float girth = outline_.at(y).perimeter();
            if (girth > around + kTight_m || girth < kLoose * around || std::abs(y - own) >= least) continue;
            least = std::abs(y - own);
            best = y;
        }
        // Between two steps it stays where it is.
        return least < kStep_m ? own : best;
    }

    std::optional<float> by_crotch() const {
        constexpr float kBelow_m = 0.02f;
        const Vec3 from(0.0f, -kHigh_m, outline_.axis_z());
        const auto cloth = cloth_.cast(from, {0, 1, 0}, 2.0f * kHigh_m),
                   body = skin_.cast(from, {0, 1, 0}, 2.0f * kHigh_m);
        if (!cloth || !body) return std::nullopt;
        return body->distance - kBelow_m - cloth->distance;
    }

    const Surface& surface_;
    const BodyOutline& outline_;
    const MeshQuery& skin_;
    MeshQuery cloth_;
};

}  // namespace

std::vector<Vec3> pushed_out(std::vector<Vec3> places, const MeshQuery& skin, float thickness_m) {
    push_out(skin, thickness_m, places);
    return places;
}

Standing stand(const Surface& surface, const BodyOutline& outline, const MeshQuery& skin, float thickness_m) {
    Standing out;
    const Stander stander(surface, outline, skin);
    if (const auto by = stander.by_shoulders(thickness_m)) {
        out.hangs_on = HangsOn::shoulders;
        out.moved = *by;
    } else if (const std::vector<uint32_t> edge = stander.upper_edge(); !edge.empty()) {
        out.hangs_on = HangsOn::waist;
        out.moved = stander.by_waist(edge);
        out.hold.of.assign(surface.positions.size(), 0);
        for (const uint32_t v : edge) out.hold.of[v] = 1;
    }
    size_t inside = 0;
    for (const Vec3& p : surface.positions) {
        constexpr float kDeep_m = 0.01f;
        out.places.push_back(p + out.moved);
        const float distance = skin.signed_distance(out.places.back());
        inside += distance < -kDeep_m;
        out.deepest_m = std::max(out.deepest_m, -distance);
    }
    out.inside_share = float(inside) / float(surface.positions.size());
    return out;
}

}  // namespace vfit
