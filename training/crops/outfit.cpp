#include "outfit.h"

#include <algorithm>

#include "noise.h"
#include "solids.h"

namespace vfit::training {

namespace {

constexpr float kFold_m = 0.35f, kWrinkle_m = 0.10f;  // sizes of the smooth and the fine unevenness of cloth

/// Thickness of a layer, metres: mostly thin, now and then a thick coat.
float thickness(Random& random, float most) {
    switch (random.pick({0.2f, 0.55f, 0.25f})) {
        case 0: return random.between(0.0f, 0.004f);
        case 1: return random.between(0.003f, 0.4f * most);
        default: return random.between(0.4f * most, most);
    }
}

}  // namespace

Outfit::Outfit(const Avatar& avatar, Random& random) {
    const float top = thickness(random, 0.048f), trousers = thickness(random, 0.051f);
    const float sleeves = random.chance(0.3f) ? 0.0f : top * random.between(0.55f, 0.75f);
    const float shoes = random.between(0.005f, 0.02f), hair = random.between(0.0f, 0.035f);
    const bool short_trousers = random.chance(0.15f);
    const auto seed = static_cast<uint32_t>(random.bits());
    const auto& rest = avatar.rest().positions;
    const uint32_t count = avatar.topology().vertex_count;
    offset_m_.resize(count);
    float crown = 0.0f;
    for (const Vec3& p : rest) crown = std::max(crown, p.y);
    for (uint32_t v = 0; v < count; ++v) {
        float layer = 0.0f;
        switch (avatar.parts()[v]) {
            case BodyPart::kHead: layer = rest[v].y > crown - 0.14f || rest[v].z < -0.02f ? hair : 0.0f; break;
            case BodyPart::kTorso: layer = top; break;
            case BodyPart::kLeftUpperArm: case BodyPart::kRightUpperArm: layer = std::max(sleeves, 0.6f * top); break;
            case BodyPart::kLeftForearm: case BodyPart::kRightForearm: layer = sleeves; break;
            case BodyPart::kLeftHand: case BodyPart::kRightHand: layer = 0.0f; break;
            case BodyPart::kLeftThigh: case BodyPart::kRightThigh: layer = trousers; break;
            case BodyPart::kLeftShank: case BodyPart::kRightShank: layer = short_trousers ? 0.0f : trousers; break;
            default: layer = shoes;
        }
        const float folds = 1.0f + 0.5f * smooth_noise(seed, rest[v] / kFold_m);
        const float wrinkles = 1.0f + 0.4f * smooth_noise(seed + 1, rest[v] / kWrinkle_m);
        offset_m_[v] = layer * folds * wrinkles;
    }
    skirt_ = random.chance(0.14f);
    hem_ = random.between(0.3f, 0.95f);
    flare_ = random.between(1.0f, 1.5f);
    skirt_ease_m_ = random.between(0.01f, 0.06f);
    hair_ = random.chance(0.35f);
    hair_length_m_ = random.between(0.05f, 0.35f);
    hair_width_m_ = random.between(0.07f, 0.12f);
}

void Outfit::dress(const Avatar& avatar, Random& random, Mesh& out) const {
    const uint32_t count = avatar.topology().vertex_count;
    out.positions.resize(count);
    out.indices = avatar.topology().indices;
    for (uint32_t v = 0; v < count; ++v) out.positions[v] = avatar.positions()[v] + offset_m_[v] * avatar.normals()[v];
    if (skirt_) add_skirt(avatar, out);
    if (hair_) add_hair(avatar, out);
    if (random.chance(0.12f)) add_held_thing(avatar, random, out);
}

// Rings from the waist down; each is an ellipse about the two legs at its height.
void Outfit::add_skirt(const Avatar& avatar, Mesh& out) const {
    const auto& at = avatar.posed_skeleton().position;
    const Quat pelvis = avatar.posed_skeleton().rotation[VFIT_BONE_HIPS];
    const Vec3 right_way = pelvis * Vec3(1, 0, 0), ahead = pelvis * Vec3(0, 0, 1);
    std::vector<std::vector<Vec3>> rings;
    for (int r = 0; r <= 6; ++r) {
        const float t = hem_ * float(r) / 6.0f;  // 0 hips, 0.5 knees, 1 ankles
        Vec3 leg[2];
        for (int side = 0; side < 2; ++side) {
            const auto hip = size_t(side ? VFIT_BONE_RIGHT_UPPER_LEG : VFIT_BONE_LEFT_UPPER_LEG);
            leg[side] = t < 0.5f ? glm::mix(at[hip], at[hip + 1], 2 * t) : glm::mix(at[hip + 1], at[hip + 2], 2 * t - 1);
        }
        const Vec3 middle = 0.5f * (leg[0] + leg[1]) + Vec3(0, r == 0 ? 0.12f : 0.0f, 0);
        const float flare = 1.0f + (flare_ - 1.0f) * t;
        const float thick = (0.095f - 0.035f * t) * flare + skirt_ease_m_;
        const Vec3 between = leg[0] - leg[1];
        const float wide = 0.5f * std::abs(glm::dot(between, right_way)) + thick + 0.02f;
        const float deep = 0.5f * std::abs(glm::dot(between, ahead)) + thick + 0.02f;
        rings.emplace_back();
        for (int i = 0; i < 24; ++i) {
            const float turn = 2.0f * kPi * float(i) / 24.0f;
            rings.back().push_back(middle + right_way * (wide * std::cos(turn)) + ahead * (deep * std::sin(turn)));
        }
    }
    add_tube(rings, out);
}

void Outfit::add_hair(const Avatar& avatar, Mesh& out) const {
    const auto& posed = avatar.posed_skeleton();
    const Quat turn = posed.rotation[VFIT_BONE_HEAD];
    const Vec3 head = posed.position[VFIT_BONE_HEAD];
    const float down = 0.5f * hair_length_m_;
    add_ellipsoid(head + turn * Vec3(0, 0.10f - down, -0.03f),
                  glm::mat3_cast(turn) * Mat3(hair_width_m_, 0, 0, 0, 0.11f + down, 0, 0, 0, 0.09f), out);
}

void Outfit::add_held_thing(const Avatar& avatar, Random& random, Mesh& out) const {
    const Body joints = avatar.joints();
    const Vec3 hand = joints.at(random.chance(0.5f) ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND);
    const Vec3 half(random.between(0.02f, 0.18f), random.between(0.02f, 0.2f), random.between(0.02f, 0.1f));
    const Quat turn = glm::angleAxis(random.between(0, 2 * kPi), random.direction());
    const Vec3 hangs = random.chance(0.6f) ? Vec3(0, -half.y, 0) : Vec3(0);
    add_ellipsoid(hand + hangs, glm::mat3_cast(turn) * Mat3(half.x, 0, 0, 0, half.y, 0, 0, 0, half.z), out);
}

}  // namespace vfit::training
