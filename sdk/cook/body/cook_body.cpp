#include "cook/body/cook_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

const Quat kAtRest(1, 0, 0, 0);

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

const char* part_name(BodyPart part) {
    constexpr std::array<const char*, kBodyPartCount> kNames = {
        "head",          "trunk",      "left upper arm", "left forearm", "left hand", "right upper arm",
        "right forearm", "right hand", "left thigh",     "left shank",   "left foot", "right thigh",
        "right shank",   "right foot"};
    return kNames[size_t(part)];
}

bool Stance::is_rest() const {
    return thickness == 1.0f &&
           std::all_of(turned.begin(), turned.end(), [](const Quat& q) { return q == kAtRest; });
}

CookBody::CookBody(const BodyModel& model, vfit_sex sex, std::vector<ShapeSetting> settings)
    : model_(model),
      sex_(sex),
      settings_(std::move(settings)),
      evaluated_(evaluate(model, sex, settings_)),
      topology_(model.topology(0)),
      skin_(evaluated_.positions, topology_.indices),
      outline_(model, evaluated_),
      bones_(bones_below(evaluated_, topology_)) {
    const auto limb = [&](int from, int to) {
        return LimbSkin{joint(from), joint(to), shares(model, topology_, model.rig_bone(from))};
    };
    limbs_ = {limb(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT),
              limb(VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT),
              limb(VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND),
              limb(VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND),
              limb(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG),
              limb(VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG),
              limb(VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM),
              limb(VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM)};
}

Vec3 CookBody::joint(int humanoid_bone) const {
    return evaluated_.bone_heads[size_t(model_.rig_bone(humanoid_bone))];
}

std::vector<Vec3> CookBody::leaving(const Stance& stance, float share) const {
    const float thickness = glm::mix(stance.thickness, 1.0f, share);
    std::vector<Vec3> out(bones_.size());
    for (size_t v = 0; v < out.size(); ++v) out[v] = glm::mix(bones_[v], evaluated_.positions[v], thickness);
    for (size_t l = 0; l < kLimbs; ++l) {
        if (stance.turned[l] == kAtRest) continue;
        const LimbSkin& limb = limbs_[l];
        const Quat turn = glm::slerp(stance.turned[l], kAtRest, share);
        for (size_t v = 0; v < out.size(); ++v)
            if (limb.share[v] > 0.0f)
                out[v] = glm::mix(out[v], limb.root + turn * (out[v] - limb.root), limb.share[v]);
    }
    return out;
}

Vec3 CookBody::carried(const Stance& stance, Limb limb, const Vec3& place) const {
    const Vec3 out = root(limb) + stance.of(limb) * (place - root(limb));
    const auto on = parent(limb);
    return on ? carried(stance, *on, out) : out;
}

void CookBody::put_legs_together(Stance& stance) const {
    constexpr float kAnkles_m = 0.08f;  // from the middle
    for (const auto& [leg, shank] :
         {std::pair(Limb::left_leg, Limb::left_shank), std::pair(Limb::right_leg, Limb::right_shank)}) {
        const Vec3 &hip = root(leg), &ankle = end(shank);
        const float side = hip.x < 0.0f ? -1.0f : 1.0f,
                    turn = -std::atan((std::abs(ankle.x) - kAnkles_m) / (hip.y - ankle.y));
        stance.of(leg) = glm::angleAxis(side * turn, Vec3(0, 0, 1));
    }
}

void CookBody::hold_arms_level(Stance& stance) const {
    for (const auto& [arm, forearm] :
         {std::pair(Limb::left_arm, Limb::left_forearm), std::pair(Limb::right_arm, Limb::right_forearm)}) {
        const Vec3 along = end(forearm) - root(arm);
        const float side = root(arm).x < 0.0f ? -1.0f : 1.0f;
        stance.of(arm) = glm::angleAxis(side * std::atan2(-along.y, std::abs(along.x)), Vec3(0, 0, 1));
    }
}

}  // namespace vfit
