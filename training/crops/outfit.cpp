#include "outfit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "noise.h"
#include "solids.h"

namespace vfit::training {

namespace {

constexpr float kFold_m = 0.35f, kWrinkle_m = 0.10f;  // sizes of the smooth and the fine unevenness of cloth
constexpr float kCrotch = 0.09f;  // below the hip joints, share of the leg's length (.53 - .48 of stature)
constexpr size_t kBands = 24;     // of the trunk's height, in which its outline is measured

/// Where the rest pose's bone begins.
Vec3 rest_head(const Avatar& avatar, int bone) {
    for (const AvatarBone& b : avatar.rig_bones())
        if (b.bone == bone) return b.rest_head;
    return Vec3(0.0f);
}

bool is_thigh(BodyPart part) { return part == BodyPart::kLeftThigh || part == BodyPart::kRightThigh; }
bool is_shank(BodyPart part) { return part == BodyPart::kLeftShank || part == BodyPart::kRightShank; }

/// Of a leg's two segments: distance of a point from the axis, and how far along, 0 hip, 1 knee, 2 ankle.
struct OnLeg {
    float radius_m, along;
};
OnLeg on_leg(const Vec3& p, const Vec3& hip, const Vec3& knee, const Vec3& ankle, bool shank) {
    const Vec3 from = shank ? knee : hip, axis = (shank ? ankle : knee) - from;
    const float t = std::clamp(glm::dot(p - from, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
    return {glm::length(p - from - t * axis), t + (shank ? 1.0f : 0.0f)};
}

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
            case BodyPart::kHead:
                layer = rest[v].y > crown - 0.14f || rest[v].z < -0.02f ? hair : 0.0f;
                break;
            case BodyPart::kTorso: layer = top; break;
            case BodyPart::kLeftUpperArm:
            case BodyPart::kRightUpperArm: layer = std::max(sleeves, 0.6f * top); break;
            case BodyPart::kLeftForearm:
            case BodyPart::kRightForearm: layer = sleeves; break;
            case BodyPart::kLeftHand:
            case BodyPart::kRightHand: layer = 0.0f; break;
            case BodyPart::kLeftThigh:
            case BodyPart::kRightThigh: layer = trousers; break;
            case BodyPart::kLeftShank:
            case BodyPart::kRightShank: layer = short_trousers ? 0.0f : trousers; break;
            default: layer = shoes;
        }
        const float folds = 1.0f + 0.5f * smooth_noise(seed, rest[v] / kFold_m);
        const float wrinkles = 1.0f + 0.4f * smooth_noise(seed + 1, rest[v] / kWrinkle_m);
        offset_m_[v] = layer * folds * wrinkles;
    }
    if (random.chance(0.65f)) fall_straight(avatar, random);
    if (!short_trousers && random.chance(0.65f)) straighten_legs(avatar, random);
    if (random.chance(0.75f))
        seat_ = kCrotch + random.between(0.0f, 0.26f);  // as low as the middle of the thigh
    if (random.chance(0.12f)) {                         // a skirt or a coat
        const float ease = random.between(0.01f, 0.06f);
        shells_.push_back(
            {random.between(0.3f, 0.95f), 0.10f + ease, 0.10f + ease, 0.3f, random.between(1.0f, 1.5f)});
    }
    hair_ = random.chance(0.35f);
    hair_length_m_ = random.between(0.05f, 0.35f);
    hair_width_m_ = random.between(0.07f, 0.12f);
}

/// A shirt hangs from chest and seat and bridges waist and small of the back; its hem lies about the crotch.
void Outfit::fall_straight(const Avatar& avatar, Random& random) {
    const float loose = random.between(0.3f, 1.1f);  // 1: straight lines from chest to seat
    const Vec3 hip = rest_head(avatar, VFIT_BONE_LEFT_UPPER_LEG);
    const float bottom = hip.y, top = rest_head(avatar, VFIT_BONE_UPPER_CHEST).y;
    struct Outline {
        float side = 0.0f, front = 0.0f, back = 0.0f;
    };
    std::array<Outline, kBands> body, cloth;
    const auto& rest = avatar.rest().positions;
    const auto band_of = [&](float y) {
        return int(std::floor((y - bottom) / (top - bottom) * float(kBands - 1) + 0.5f));
    };
    const auto covered = [&](size_t v) {
        const int band = band_of(rest[v].y);
        const BodyPart part = avatar.parts()[v];
        return (part == BodyPart::kTorso || is_thigh(part)) && band >= 0 && band < int(kBands);
    };
    for (size_t v = 0; v < offset_m_.size(); ++v) {
        if (!covered(v)) continue;
        Outline& o = body[size_t(band_of(rest[v].y))];
        o.side = std::max(o.side, std::abs(rest[v].x));
        o.front = std::max(o.front, rest[v].z - hip.z), o.back = std::max(o.back, hip.z - rest[v].z);
    }
    for (size_t i = 0; i < kBands; ++i) {
        const float t = float(i) / float(kBands - 1);
        const auto bridged = [&](float Outline::* side) {
            const float own = body[i].*side, line = glm::mix(body.front().*side, body.back().*side, t);
            return own + loose * std::max(0.0f, line - own);
        };
        cloth[i] = {bridged(&Outline::side), bridged(&Outline::front), bridged(&Outline::back)};
    }
    const auto& normals = avatar.rest().normals;
    for (size_t v = 0; v < offset_m_.size(); ++v) {
        if (!covered(v)) continue;
        const auto band = size_t(band_of(rest[v].y));
        const Outline &own = body[band], &out = cloth[band];
        const bool front = rest[v].z > hip.z;
        offset_m_[v] += std::abs(normals[v].x) * (out.side - own.side) +
                        std::abs(normals[v].z) * (front ? out.front - own.front : out.back - own.back);
    }
    const float ease = random.between(-0.015f, 0.015f);
    shells_.push_back({random.between(0.01f, 0.2f), body.front().side - std::abs(hip.x) + ease,
                       std::max(body.front().front, body.front().back) + ease, 0.0f,
                       random.between(0.8f, 1.05f)});
}

/// Trousers narrow evenly to their hem, past knee and calf.
void Outfit::straighten_legs(const Avatar& avatar, Random& random) {
    const float ease = random.between(0.0f, 0.015f), hem = random.between(0.05f, 0.10f);
    constexpr float kMiddle = 0.5f;  // of the thigh
    const auto& rest = avatar.rest().positions;
    for (const int first : {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG}) {
        const Vec3 hip = rest_head(avatar, first), knee = rest_head(avatar, first + 1);
        const Vec3 ankle = rest_head(avatar, first + 2);
        const bool left = first == VFIT_BONE_LEFT_UPPER_LEG;
        const auto leg_of = [&](size_t v) {
            const BodyPart part = avatar.parts()[v];
            return (is_thigh(part) || is_shank(part)) && (rest[v].x > 0.0f) == left;
        };
        float sum = 0.0f, count = 0.0f;
        for (size_t v = 0; v < offset_m_.size(); ++v) {
            if (!leg_of(v)) continue;
            const OnLeg at = on_leg(rest[v], hip, knee, ankle, is_shank(avatar.parts()[v]));
            if (std::abs(at.along - kMiddle) < 0.06f) sum += at.radius_m, ++count;
        }
        if (count == 0.0f) continue;
        const float thigh = sum / count + ease;
        for (size_t v = 0; v < offset_m_.size(); ++v) {
            if (!leg_of(v)) continue;
            const OnLeg at = on_leg(rest[v], hip, knee, ankle, is_shank(avatar.parts()[v]));
            if (at.along < kMiddle) continue;
            const float wanted = glm::mix(thigh, hem, (at.along - kMiddle) / (2.0f - kMiddle));
            offset_m_[v] = std::max(offset_m_[v], wanted - at.radius_m);
        }
    }
}

void Outfit::dress(const Avatar& avatar, Random& random, Mesh& out) const {
    const uint32_t count = avatar.topology().vertex_count;
    out.positions.resize(count);
    out.indices = avatar.topology().indices;
    for (uint32_t v = 0; v < count; ++v)
        out.positions[v] = avatar.positions()[v] + offset_m_[v] * avatar.normals()[v];
    for (const Shell& shell : shells_) add_shell(avatar, shell, out);
    if (seat_ > 0.0f) add_seat(avatar, out);
    if (hair_) add_hair(avatar, out);
    if (random.chance(0.12f)) add_held_thing(avatar, random, out);
}

namespace {

/// Both legs' axes at that share of their length: 0 hips, 0.5 knees, 1 ankles.
std::array<Vec3, 2> legs_at(const Avatar& avatar, float t) {
    const auto& at = avatar.posed_skeleton().position;
    std::array<Vec3, 2> leg;
    for (size_t side = 0; side < 2; ++side) {
        const auto hip = size_t(side ? VFIT_BONE_RIGHT_UPPER_LEG : VFIT_BONE_LEFT_UPPER_LEG);
        leg[side] =
            t < 0.5f ? glm::mix(at[hip], at[hip + 1], 2 * t) : glm::mix(at[hip + 1], at[hip + 2], 2 * t - 1);
    }
    return leg;
}

}  // namespace

// Rings from the waist down; each is an ellipse about the two legs at its height.
void Outfit::add_shell(const Avatar& avatar, const Shell& shell, Mesh& out) const {
    const Quat pelvis = avatar.posed_skeleton().rotation[VFIT_BONE_HIPS];
    const Vec3 right_way = pelvis * Vec3(1, 0, 0), ahead = pelvis * Vec3(0, 0, 1);
    std::vector<std::vector<Vec3>> rings;
    for (int r = 0; r <= 6; ++r) {
        const float t = shell.hem * float(r) / 6.0f;
        const auto leg = legs_at(avatar, t);
        const Vec3 middle = 0.5f * (leg[0] + leg[1]) + (r == 0 ? pelvis * Vec3(0, 0.12f, 0) : Vec3(0.0f));
        constexpr float kWaist = 0.88f;  // the first ring's share of the hips'
        const float grow =
            (r == 0 ? kWaist : 1.0f) * (1.0f - shell.taper * t) * (1.0f + (shell.flare - 1.0f) * t);
        const Vec3 between = leg[0] - leg[1];
        const float wide = 0.5f * std::abs(glm::dot(between, right_way)) + shell.side_m * grow;
        const float deep = 0.5f * std::abs(glm::dot(between, ahead)) + shell.deep_m * grow;
        rings.emplace_back();
        for (int i = 0; i < 24; ++i) {
            const float turn = 2.0f * kPi * float(i) / 24.0f;
            rings.back().push_back(middle + right_way * (wide * std::cos(turn)) +
                                   ahead * (deep * std::sin(turn)));
        }
    }
    add_tube(rings, out);
}

// The crotch of trousers lies lower than the body's, and their legs touch further down: a flat tube from one
// leg's axis to the other's, as far down as they stay close.
void Outfit::add_seat(const Avatar& avatar, Mesh& out) const {
    constexpr float kHalfThickness_m = 0.055f, kClose_m = 0.26f;
    const Vec3 ahead = avatar.posed_skeleton().rotation[VFIT_BONE_HIPS] * Vec3(0, 0, 1);
    std::vector<std::vector<Vec3>> rings;
    for (int r = 0; r <= 6; ++r) {
        const auto leg = legs_at(avatar, seat_ * float(r) / 6.0f);
        const Vec3 across = 0.5f * (leg[0] - leg[1]);
        if (r > 1 && 2.0f * glm::length(across) > kClose_m) break;
        rings.emplace_back();
        for (int i = 0; i < 12; ++i) {
            const float turn = 2.0f * kPi * float(i) / 12.0f;
            rings.back().push_back(0.5f * (leg[0] + leg[1]) + across * std::cos(turn) +
                                   ahead * (kHalfThickness_m * std::sin(turn)));
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
