#include "scan/body_zones.h"

#include <algorithm>
#include <cmath>

#include "fit/fit_pose.h"

namespace vfit {

namespace {

/// Which way a surface faces, T-pose: `p` is its place, `n` its normal.
int around_trunk(const Vec3&, const Vec3& n) {
    const float aside = std::abs(n.x);
    if (aside > 0.75f) return 0;
    if (aside > 0.35f) return n.z > 0.0f ? 1 : 2;
    return n.z > 0.0f ? 3 : 4;
}

int around_leg(const Vec3& p, const Vec3& n) {
    const float outwards = p.x > 0.0f ? n.x : -n.x;
    if (std::abs(outwards) > 0.5f) return outwards > 0.0f ? 0 : 1;
    return n.z > 0.0f ? 2 : 3;
}

int around_arm(const Vec3&, const Vec3& n) {
    if (std::abs(n.y) > 0.4f) return n.y > 0.0f ? 0 : 1;
    return n.z > 0.0f ? 2 : 3;
}

int around_head(const Vec3&, const Vec3& n) { return std::abs(n.x) > 0.6f ? 0 : n.z > 0.0f ? 1 : 2; }

int anywhere(const Vec3&, const Vec3&) { return 0; }

struct Part {
    std::vector<int> bones;
    int levels, ways;
    bool along_x;  // the arms, which the T-pose holds out
    int (*way)(const Vec3&, const Vec3&);
};

const Part kParts[] = {{{VFIT_BONE_HIPS, VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST,
                         VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_RIGHT_SHOULDER},
                        24,
                        5,
                        false,
                        around_trunk},
                       {{VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG}, 4, 4, false, around_leg},
                       {{VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG}, 2, 4, false, around_leg},
                       {{VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM}, 3, 4, true, around_arm},
                       {{VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_LOWER_ARM}, 2, 4, true, around_arm},
                       {{VFIT_BONE_NECK}, 1, 3, false, around_head},
                       {{VFIT_BONE_HEAD}, 1, 3, false, around_head},
                       {{VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT}, 1, 1, false, anywhere}};

}  // namespace

BodyZones::BodyZones(const FitModel& model) : of_vertex_(model.vertex_count(), -1) {
    FitBody body(model);
    body.place(FitState{});
    int first = 0;
    for (const Part& part : kParts) {
        const auto along = [&](uint32_t v) {
            return part.along_x ? std::abs(body.positions()[v].x) : body.positions()[v].y;
        };
        std::vector<uint32_t> members;
        for (uint32_t v = 0; v < model.vertex_count(); ++v)
            if (std::find(part.bones.begin(), part.bones.end(), model.vertices()[v].influences[0].bone) !=
                part.bones.end())
                members.push_back(v);
        const auto [low, high] = std::minmax_element(
            members.begin(), members.end(), [&](uint32_t a, uint32_t b) { return along(a) < along(b); });
        const float start = along(*low), length = along(*high) - start;
        for (const uint32_t v : members) {
            const int level =
                std::min(part.levels - 1, int(float(part.levels) * (along(v) - start) / length));
            of_vertex_[v] =
                int16_t(first + level * part.ways + part.way(body.positions()[v], body.normals()[v]));
        }
        first += part.levels * part.ways;
    }
}

}  // namespace vfit
