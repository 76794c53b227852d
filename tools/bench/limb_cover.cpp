#include "bench/limb_cover.h"

#include <cmath>

namespace vfit::tools {

namespace {

/// Winding number about `centre` of the line in which the mesh meets the plane through it.
float turns_about(const Welded& mesh, const Vec3& centre, const Vec3& normal) {
    float angle = 0.0f;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vec3 at[3];
        float above[3];
        for (size_t k = 0; k < 3; ++k) {
            at[k] = mesh.positions[mesh.indices[i + k]] - centre;
            above[k] = glm::dot(at[k], normal);
        }
        // The line enters where an edge goes up and leaves where one goes down, as triangles are oriented.
        Vec3 in(0.0f), out(0.0f);
        int ends = 0;
        for (size_t k = 0; k < 3; ++k) {
            const size_t next = (k + 1) % 3;
            if ((above[k] < 0.0f) == (above[next] < 0.0f)) continue;
            const Vec3 p = glm::mix(at[k], at[next], above[k] / (above[k] - above[next]));
            (above[k] < 0.0f ? in : out) = p;
            ++ends;
        }
        if (ends == 2) angle += std::atan2(glm::dot(glm::cross(in, out), normal), glm::dot(in, out));
    }
    return std::abs(angle) / (2.0f * kPi);
}

}  // namespace

const std::vector<LimbPlace>& limb_places() {
    static const std::vector<LimbPlace> places = {
        {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW, 0.5f},
        {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW, 0.5f},
        {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND, 0.35f},
        {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_HAND, 0.35f},
        {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, 0.5f},
        {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, 0.5f},
        {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, 0.35f},
        {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, 0.35f},
    };
    return places;
}

std::vector<float> turns_around_limbs(vfit_avatar avatar, const Welded& garment) {
    const auto joints = list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_avatar_joints(avatar, items, stride, n);
    });
    const auto at = [&](vfit_joint_id type) {
        for (const vfit_joint& joint : joints)
            if (joint.joint == type) return Vec3(joint.position[0], joint.position[1], joint.position[2]);
        throw Failure("the avatar has no joint " + std::to_string(int(type)));
    };
    std::vector<float> out;
    for (const LimbPlace& place : limb_places()) {
        const Vec3 from = at(place.from), to = at(place.to);
        out.push_back(turns_about(garment, glm::mix(from, to, place.share), glm::normalize(to - from)));
    }
    return out;
}

bool is_off_limb(float before, float now) {
    constexpr float kClosed = 1e-3f;  // a closed line goes around a whole number of times
    return before > 0.5f && std::abs(before - std::round(before)) < kClosed && now < 0.5f;
}

}  // namespace vfit::tools
