#include "cook/body/cook_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

EvaluatedBody evaluate(const BodyModel& model, vfit_sex sex, const std::vector<ShapeSetting>& settings) {
    EvaluatedBody body;
    model.evaluate(shape_of(model, sex, settings), body);
    return body;
}

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

/// Of the bone and all that hang on it, in each vertex.
std::vector<float> shares(const BodyModel& model, const BodyTopology& topology, int root) {
    std::vector<uint8_t> of_limb(model.bones().size(), 0);
    for (size_t b = 0; b < of_limb.size(); ++b) {
        const int parent = model.bones()[b].parent;
        of_limb[b] = int(b) == root || (parent >= 0 && of_limb[size_t(parent)]);
    }
    std::vector<float> out(topology.vertex_count, 0.0f);
    for (size_t v = 0; v < out.size(); ++v)
        for (size_t k = 0; k < size_t(kSkinBones); ++k)
            if (of_limb[topology.skin_bones[v][k]]) out[v] += topology.skin_weights[v][k];
    return out;
}

}  // namespace

CookBody::CookBody(const BodyModel& model, vfit_sex sex, std::vector<ShapeSetting> settings)
    : model_(model),
      sex_(sex),
      settings_(std::move(settings)),
      evaluated_(evaluate(model, sex, settings_)),
      topology_(model.topology(0)),
      skin_(evaluated_.positions, topology_.indices),
      outline_(model, evaluated_),
      bones_(bones_below(evaluated_, topology_)) {
    constexpr float kAnkles_m = 0.08f;  // from the middle
    const auto limb = [&](int from, int to, bool is_leg) {
        const Vec3 root = joint(from), end = joint(to);
        const float side = root.x < 0.0f ? -1.0f : 1.0f,
                    turn = is_leg ? -std::atan((std::abs(end.x) - kAnkles_m) / (root.y - end.y))
                                  : std::atan2(root.y - end.y, std::abs(end.x - root.x));
        return Limb{root, side * turn, is_leg, shares(model, topology_, model.rig_bone(from))};
    };
    limbs_ = {limb(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_FOOT, true),
              limb(VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_FOOT, true),
              limb(VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_HAND, false),
              limb(VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_HAND, false)};
}

Vec3 CookBody::joint(int humanoid_bone) const {
    return evaluated_.bone_heads[size_t(model_.rig_bone(humanoid_bone))];
}

std::vector<Vec3> CookBody::leaving(const Stance& stance, float share) const {
    const float thickness = glm::mix(stance.thickness, 1.0f, share);
    std::vector<Vec3> out(bones_.size());
    for (size_t v = 0; v < out.size(); ++v) out[v] = glm::mix(bones_[v], evaluated_.positions[v], thickness);
    for (const Limb& limb : limbs_) {
        if (!(limb.is_leg ? stance.legs_together : stance.arms_level)) continue;
        const Quat turn = glm::angleAxis((1.0f - share) * limb.turn_rad, Vec3(0, 0, 1));
        for (size_t v = 0; v < out.size(); ++v)
            if (limb.share[v] > 0.0f)
                out[v] = glm::mix(out[v], limb.root + turn * (out[v] - limb.root), limb.share[v]);
    }
    return out;
}

}  // namespace vfit
