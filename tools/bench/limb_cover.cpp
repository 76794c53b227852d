#include "bench/limb_cover.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vfit::tools {

namespace {

constexpr float kAround = 0.5f;  // turns: fewer are none

/// The line in which a mesh meets a plane, piece by piece: from one edge of the mesh to another.
struct Piece {
    std::pair<uint32_t, uint32_t> from, to;  // edges, by their vertices
    float angle;                             // that it goes about the centre
};

std::vector<Piece> pieces_about(const Welded& mesh, const Vec3& centre, const Vec3& normal) {
    std::vector<Piece> out;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vec3 at[3];
        float above[3];
        for (size_t k = 0; k < 3; ++k) {
            at[k] = mesh.positions[mesh.indices[i + k]] - centre;
            above[k] = glm::dot(at[k], normal);
        }
        // The line enters where an edge goes up and leaves where one goes down, as triangles are oriented.
        Piece piece{};
        Vec3 in(0.0f), out_of(0.0f);
        int ends = 0;
        for (size_t k = 0; k < 3; ++k) {
            const size_t next = (k + 1) % 3;
            if ((above[k] < 0.0f) == (above[next] < 0.0f)) continue;
            const Vec3 p = glm::mix(at[k], at[next], above[k] / (above[k] - above[next]));
            (above[k] < 0.0f ? in : out_of) = p;
            (above[k] < 0.0f ? piece.from : piece.to) =
                std::minmax(mesh.indices[i + k], mesh.indices[i + next]);
            ++ends;
        }
        if (ends != 2) continue;
        piece.angle = std::atan2(glm::dot(glm::cross(in, out_of), normal), glm::dot(in, out_of));
        out.push_back(piece);
    }
    return out;
}

/// Winding number about `centre` of the line in which the mesh meets the plane through it.
LimbCover cover_about(const Welded& mesh, const Vec3& centre, const Vec3& normal, bool is_arm) {
    const std::vector<Piece> pieces = pieces_about(mesh, centre, normal);
    LimbCover out;
    float angle = 0.0f;
    std::map<std::pair<uint32_t, uint32_t>, size_t> begins_at;
    for (size_t i = 0; i < pieces.size(); ++i) begins_at[pieces[i].from] = i, angle += pieces[i].angle;
    out.turns = std::abs(angle) / (2.0f * kPi);
    bool closes = false;
    std::vector<uint8_t> is_known(pieces.size(), 0);
    for (size_t first = 0; first < pieces.size(); ++first) {
        float around = 0.0f;
        size_t i = first;
        while (!is_known[i]) {
            is_known[i] = 1, around += pieces[i].angle;
            const auto next = begins_at.find(pieces[i].to);
            if (next == begins_at.end()) break;
            i = next->second;
            if (i == first) closes |= std::abs(around) > kAround * 2.0f * kPi;
        }
    }
    out.stays = out.turns > kAround && (is_arm || closes);
    return out;
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

std::vector<LimbCover> cover_of_limbs(vfit_avatar avatar, const Welded& garment) {
    const auto joints = list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_avatar_joints(avatar, items, stride, n);
    });
    const auto at = [&](vfit_joint_id type) {
        for (const vfit_joint& joint : joints)
            if (joint.joint == type) return Vec3(joint.position[0], joint.position[1], joint.position[2]);
        throw Failure("the avatar has no joint " + std::to_string(int(type)));
    };
    std::vector<LimbCover> out;
    for (const LimbPlace& place : limb_places()) {
        const Vec3 from = at(place.from), to = at(place.to);
        out.push_back(cover_about(garment, glm::mix(from, to, place.share), glm::normalize(to - from),
                                  place.from <= VFIT_JOINT_RIGHT_ELBOW));
    }
    return out;
}

bool is_off_limb(const LimbCover& before, const LimbCover& now) {
    return before.stays && now.turns < kAround;
}

}  // namespace vfit::tools
