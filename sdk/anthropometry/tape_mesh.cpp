// Checks a body mesh and cuts it.
#include "anthropometry/tape_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

const Vec3 kUp(0, 1, 0);

constexpr int kNeededJoints[] = {
    VFIT_JOINT_HEAD,          VFIT_JOINT_NECK,          VFIT_JOINT_TORSO,          VFIT_JOINT_PELVIS,
    VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW,    VFIT_JOINT_LEFT_WRIST,     VFIT_JOINT_LEFT_HIP,
    VFIT_JOINT_LEFT_KNEE,     VFIT_JOINT_LEFT_CLAVICLE, VFIT_JOINT_RIGHT_CLAVICLE, VFIT_JOINT_RIGHT_SHOULDER,
    VFIT_JOINT_RIGHT_ELBOW,   VFIT_JOINT_RIGHT_WRIST,   VFIT_JOINT_RIGHT_HIP,      VFIT_JOINT_RIGHT_KNEE};

/// Joints that an axis runs between.
constexpr int kAxes[][2] = {{VFIT_JOINT_NECK, VFIT_JOINT_HEAD},
                            {VFIT_JOINT_PELVIS, VFIT_JOINT_NECK},
                            {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
                            {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
                            {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
                            {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE}};

std::vector<uint32_t> without_arms(const TapeBody& body) {
    std::vector<uint32_t> out;
    for (size_t t = 0; t < body.indices.size(); t += 3) {
        const uint32_t* v = &body.indices[t];
        if (is_arm(body.parts[v[0]]) + is_arm(body.parts[v[1]]) + is_arm(body.parts[v[2]]) < 2)
            out.insert(out.end(), v, v + 3);
    }
    return out;
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
            fail(VFIT_ERROR_DATA, "the body's joints ", joint_name(from), " and ", joint_name(to),
                 " are one place");
}

HeightRange height_range(std::span<const Vec3> positions) {
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
    return {low->y, high->y};
}

TapeMesh::TapeMesh(const TapeBody& body)
    : body_((check(body), body)),
      range_(height_range(body.positions)),
      whole_(body.positions, body.indices, Vec3(0.0f), kUp, range_.floor, range_.crown),
      trunk_(body.positions, without_arms(body), Vec3(0.0f), kUp, range_.floor, range_.crown) {}

Axis upper_arm(const TapeBody& body, Side side) {
    const Body& j = body.joints;
    return side == Side::kLeft ? Axis{j.at(VFIT_JOINT_LEFT_SHOULDER), j.at(VFIT_JOINT_LEFT_ELBOW)}
                               : Axis{j.at(VFIT_JOINT_RIGHT_SHOULDER), j.at(VFIT_JOINT_RIGHT_ELBOW)};
}

Axis TapeMesh::thigh(Side side) const {
    return side == Side::kLeft ? Axis{joint(VFIT_JOINT_LEFT_HIP), joint(VFIT_JOINT_LEFT_KNEE)}
                               : Axis{joint(VFIT_JOINT_RIGHT_HIP), joint(VFIT_JOINT_RIGHT_KNEE)};
}

Axis TapeMesh::spine() const { return {joint(VFIT_JOINT_PELVIS), joint(VFIT_JOINT_NECK)}; }

Section TapeMesh::level(float y) const { return cut(body_.positions, whole_.at(y), {0, y, 0}, kUp); }
Section TapeMesh::trunk(float y) const { return cut(body_.positions, trunk_.at(y), {0, y, 0}, kUp); }

Section TapeMesh::profile(float x) const {
    return cut(body_.positions, body_.indices, {x, 0, 0}, Vec3(1, 0, 0));
}

TapeLimb::TapeLimb(const TapeBody& body, const Axis& axis, float from_m, float to_m)
    : positions_(body.positions),
      axis_(axis),
      direction_(axis.direction()),
      layers_(body.positions, body.indices, axis.start, direction_, from_m, to_m) {}

Section TapeLimb::across(float along_m) const {
    return cut(positions_, layers_.at(along_m), place(along_m), direction_);
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
