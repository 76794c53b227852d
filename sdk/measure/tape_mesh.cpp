// Checks a body mesh and cuts it.
#include "measure/tape_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

const Vec3 kUp(0, 1, 0);

constexpr int kNeededJoints[] = {
    VFIT_JOINT_HEAD,          VFIT_JOINT_NECK,       VFIT_JOINT_TORSO,       VFIT_JOINT_PELVIS,
    VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST,  VFIT_JOINT_LEFT_HIP,
    VFIT_JOINT_LEFT_KNEE,     VFIT_JOINT_LEFT_CLAVICLE, VFIT_JOINT_RIGHT_CLAVICLE,  VFIT_JOINT_RIGHT_SHOULDER,
    VFIT_JOINT_RIGHT_ELBOW,   VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HIP,  VFIT_JOINT_RIGHT_KNEE};

/// Joints that an axis runs between.
constexpr int kAxes[][2] = {
    {VFIT_JOINT_NECK, VFIT_JOINT_HEAD},
    {VFIT_JOINT_PELVIS, VFIT_JOINT_NECK},
    {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
    {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
    {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE}};

bool is_arm(BodyPart part) {
    switch (part) {
        case BodyPart::kLeftUpperArm:
        case BodyPart::kLeftForearm:
        case BodyPart::kLeftHand:
        case BodyPart::kRightUpperArm:
        case BodyPart::kRightForearm:
        case BodyPart::kRightHand: return true;
        default: return false;
    }
}

}  // namespace

void check(const TapeBody& body) {
    if (body.positions.empty() || body.indices.empty())
        fail(VFIT_ERROR_DATA, "the body has no mesh to measure");
    if (body.indices.size() % 3 != 0) fail(VFIT_ERROR_DATA, "the body's indices are not three a triangle");
    if (body.parts.size() < body.positions.size())
        fail(VFIT_ERROR_DATA, "the body has parts for ", body.parts.size(), " of ", body.positions.size(),
             " vertices");
    for (const Vec3& p : body.positions)
        if (!finite(p)) fail(VFIT_ERROR_DATA, "the body has a vertex that is not finite");
    for (const uint32_t i : body.indices)
        if (i >= body.positions.size())
            fail(VFIT_ERROR_DATA, "a triangle names vertex ", i, " of ", body.positions.size());
    for (const int joint : kNeededJoints)
        if (!body.joints.has(joint) || !finite(body.joints.at(joint)))
            fail(VFIT_ERROR_DATA, "the body to measure has no joint ", joint_name(joint));
    for (const auto& [from, to] : kAxes)
        if (!(glm::distance(body.joints.at(from), body.joints.at(to)) > 0.0f))
            fail(VFIT_ERROR_DATA, "the body's joints ", joint_name(from), " and ", joint_name(to), " are one place");
}

HeightRange height_range(std::span<const Vec3> positions) {
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
    return {low->y, high->y};
}

TapeMesh::TapeMesh(const TapeBody& body) : body_(body) {
    check(body);
    whole_ = sorted_layers();
    trunk_ = without_arms(whole_);
    range_ = height_range(body.positions);
}

TapeMesh::Layers TapeMesh::sorted_layers() const {
    struct Triangle {
        float lowest;
        uint32_t first;
    };
    Layers result;
    std::vector<Triangle> order;
    order.reserve(body_.indices.size() / 3);
    for (uint32_t t = 0; t < body_.indices.size(); t += 3) {
        const uint32_t* v = &body_.indices[t];
        const auto [low, high] =
            std::minmax({body_.positions[v[0]].y, body_.positions[v[1]].y, body_.positions[v[2]].y});
        order.push_back({low, t});
        result.tallest = std::max(result.tallest, high - low);
    }
    std::sort(order.begin(), order.end(), [](const Triangle& a, const Triangle& b) {
        return a.lowest != b.lowest ? a.lowest < b.lowest : a.first < b.first;
    });
    for (const Triangle& triangle : order) {
        result.lowest.push_back(triangle.lowest);
        for (uint32_t k = 0; k < 3; ++k) result.indices.push_back(body_.indices[triangle.first + k]);
    }
    return result;
}

TapeMesh::Layers TapeMesh::without_arms(const Layers& whole) const {
    Layers result;
    result.tallest = whole.tallest;
    for (size_t t = 0; t < whole.lowest.size(); ++t) {
        const uint32_t* v = &whole.indices[3 * t];
        if (is_arm(body_.parts[v[0]]) + is_arm(body_.parts[v[1]]) + is_arm(body_.parts[v[2]]) >= 2) continue;
        result.lowest.push_back(whole.lowest[t]);
        result.indices.insert(result.indices.end(), v, v + 3);
    }
    return result;
}

std::span<const uint32_t> TapeMesh::Layers::between(float low, float high) const {
    const auto first = std::lower_bound(lowest.begin(), lowest.end(), low - tallest);
    const auto last = std::upper_bound(first, lowest.end(), high);
    return std::span(indices).subspan(3 * size_t(first - lowest.begin()), 3 * size_t(last - first));
}

Axis TapeMesh::upper_arm(Side side) const {
    return side == Side::kLeft ? Axis{joint(VFIT_JOINT_LEFT_SHOULDER), joint(VFIT_JOINT_LEFT_ELBOW)}
                               : Axis{joint(VFIT_JOINT_RIGHT_SHOULDER), joint(VFIT_JOINT_RIGHT_ELBOW)};
}

Axis TapeMesh::thigh(Side side) const {
    return side == Side::kLeft ? Axis{joint(VFIT_JOINT_LEFT_HIP), joint(VFIT_JOINT_LEFT_KNEE)}
                               : Axis{joint(VFIT_JOINT_RIGHT_HIP), joint(VFIT_JOINT_RIGHT_KNEE)};
}

Axis TapeMesh::spine() const { return {joint(VFIT_JOINT_PELVIS), joint(VFIT_JOINT_NECK)}; }

Section TapeMesh::level(float y) const { return cut(body_.positions, whole_.between(y, y), {0, y, 0}, kUp); }
Section TapeMesh::trunk(float y) const { return cut(body_.positions, trunk_.between(y, y), {0, y, 0}, kUp); }

Section TapeMesh::across(const Vec3& place, const Vec3& axis) const {
    // A thigh 0.3 m thick that leans by 30 degrees spans 0.15 m of height.
    constexpr float kReach_m = 0.1f;
    return cut(body_.positions, whole_.between(place.y - kReach_m, place.y + kReach_m), place, axis);
}

Section TapeMesh::profile(float x) const {
    return cut(body_.positions, body_.indices, {x, 0, 0}, Vec3(1, 0, 0));
}

const std::vector<Vec2>* loop_about(const Section& section, const Vec3& place) {
    const Vec3 p = place - section.origin;
    const Vec2 in_plane(glm::dot(p, section.u), glm::dot(p, section.v));
    const std::vector<Vec2>* best = nullptr;
    for (const auto& loop : section.loops)
        if (encloses(loop, in_plane) && (!best || std::abs(area(loop)) < std::abs(area(*best)))) best = &loop;
    return best;
}

}  // namespace vfit
