#include "cook/model/stand.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cloth/cloth.h"
#include "geometry/section.h"

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
        constexpr float kNear_m = 0.08f, kAnywhere_m = 0.25f, kBelowChin_m = 0.1f;
        const Vec3 joint = outline_.left_shoulder();
        const float lowest = 0.5f * (outline_.levels().waist + outline_.levels().shoulder);
        std::vector<float> raise;
        float forward = 0.0f;
        for (const float side : {-1.0f, 1.0f}) {
            std::vector<std::pair<Vec3, Vec3>> ridges;  // of cloth and body
            float top = -INFINITY;
            for (float x = kInner_m; x < joint.x; x += kStep_m) {
                const auto cloth = ridge(cloth_, {side * x, kHigh_m, 0.0f}, kAnywhere_m),
                           body =
                               ridge(outline_.skin(), {side * x, joint.y + kBelowChin_m, joint.z}, kNear_m);
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

    /// The highest opening around the body's axis; else the upper edge of what is open in front. Vertices.
    std::vector<uint32_t> upper_edge() const {
        const std::vector<uint32_t>* best = nullptr;
        for (const auto& opening : surface_.openings) {
            std::vector<Vec2> seen;
            for (const uint32_t v : opening)
                seen.emplace_back(surface_.positions[v].x, surface_.positions[v].z);
            if (encloses(seen, {0.0f, outline_.axis_z()}) && (!best || height(opening) > height(*best)))
                best = &opening;
        }
        std::vector<uint32_t> edge;
        if (best)
            edge = *best;
        else
            for (const auto& opening : surface_.openings)
                edge.insert(edge.end(), opening.begin(), opening.end());
        float top = -INFINITY, low = INFINITY;
        for (const uint32_t v : edge)
            top = std::max(top, surface_.positions[v].y), low = std::min(low, surface_.positions[v].y);
        // A waist may be lower in front, but a slit, a fly or a hem is no part of it.
        constexpr float kNearTop_m = 0.05f, kSlanted_m = 0.15f;
        if (best && top - low < kSlanted_m) return edge;
        std::erase_if(edge, [&](uint32_t v) { return surface_.positions[v].y < top - kNearTop_m; });
        return edge;
    }

    Vec3 by_waist(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float own = height(edge);
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

    /// The highest place where the mesh lies flat, seen from above over so much to the back and to the front.
    static std::optional<Vec3> ridge(const MeshQuery& mesh, const Vec3& above, float depth_m) {
        constexpr float kUpright = 0.6f;
        std::optional<Vec3> out;
        for (float z = -depth_m; z <= depth_m; z += kStep_m) {
            const Vec3 from = above + Vec3(0.0f, 0.0f, z);
            const auto hit = mesh.cast(from, {0, -1, 0}, 2.0f * kHigh_m);
            if (!hit || std::abs(hit->normal.y) < kUpright) continue;
            if (const float y = from.y - hit->distance; !out || y > out->y) out = Vec3(from.x, y, from.z);
        }
        return out;
    }

    float height(const std::vector<uint32_t>& of) const {
        float sum = 0.0f;
        for (const uint32_t v : of) sum += surface_.positions[v].y;
        return sum / float(std::max<size_t>(of.size(), 1));
    }

    /// The nearest height to its own, between hips and waist, at which the body about fills the opening. One
    /// that is wider than the hips is worn at the waist, with a belt.
    float sits_at(const std::vector<uint32_t>& edge) const {
        const TailorLevels& levels = outline_.levels();
        const float around = surface_.length_of(edge), own = height(edge);
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

/// Each vertex's place among the bones that carry it, as if there was no flesh on them.
std::vector<Vec3> bones_below(const EvaluatedBody& body, const BodyTopology& topology) {
    std::vector<Vec3> out;
    for (size_t v = 0; v < body.positions.size(); ++v) {
        Vec3 sum(0.0f);
        for (size_t k = 0; k < size_t(kSkinBones); ++k) {
            const Vec3 &head = body.bone_heads[topology.skin_bones[v][k]],
                       along = body.bone_tails[topology.skin_bones[v][k]] - head;
            const float length2 = glm::dot(along, along),
                        t = length2 > 0.0f ? glm::dot(body.positions[v] - head, along) / length2 : 0.0f;
            sum += topology.skin_weights[v][k] * (head + std::clamp(t, 0.0f, 1.0f) * along);
        }
        out.push_back(sum);
    }
    return out;
}

}  // namespace

std::vector<Vec3> grow_body_into(const WholeCloth& cloth, std::vector<Vec3> places, const EvaluatedBody& body,
                                 const BodyTopology& topology, float thickness_m, Jobs& jobs) {
    constexpr int kFrames = 90;
    constexpr float kThinnest = 0.2f;  // of its thickness: thinner, the skin would fold into itself
    constexpr float kFrame_s = 1.0f / 60.0f;
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    settings.damping = 0.999f;
    settings.friction = 0.0f;
    settings.thickness_m = thickness_m;
    settings.sleeps = false;
    const std::vector<uint8_t> all(places.size(), 1);
    Cloth simulated(std::make_shared<const Fabric>(
                        cook_fabric({places, cloth.indices, {}, all, 1.0f, cloth.cut}, *cloth.material)),
                    settings, places);
    const uint32_t skin = simulated.add_mesh(body.positions.size(), topology.indices);
    const std::vector<Vec3> bones = bones_below(body, topology);
    std::vector<Vec3> grown(body.positions.size());
    for (int frame = 0; frame <= kFrames; ++frame) {
        const float share = glm::mix(kThinnest, 1.0f, float(frame) / float(kFrames));
        for (size_t v = 0; v < grown.size(); ++v) grown[v] = glm::mix(bones[v], body.positions[v], share);
        simulated.move_mesh(skin, grown);
        simulated.step(kFrame_s, places, {}, jobs);
    }
    return simulated.positions();
}

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
        out.band.of.assign(surface.positions.size(), 0);
        for (const uint32_t v : edge) out.band.of[v] = 1;
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
