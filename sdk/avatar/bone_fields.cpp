#include "avatar/bone_fields.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vfit {

namespace {

using glm::dot;

constexpr float kLevel_m = 0.025f;  // between two levels: two vertices of the body model
constexpr float kCap_m = 0.02f;     // by which the skin closes beyond the last vertex
constexpr float kMinBone_m = 1e-3f;
constexpr size_t kAngles = BoneField::kAngles;

struct BoneOfPart {
    BodyPart part;
    int bone, end;  // VFIT_BONE_*; end -1: at the rig bone's tail
    bool starts_part, ends_part;
};
constexpr BoneOfPart kBones[] = {
    {BodyPart::kTorso, VFIT_BONE_HIPS, VFIT_BONE_SPINE, true, false},
    {BodyPart::kTorso, VFIT_BONE_SPINE, VFIT_BONE_CHEST, false, false},
    {BodyPart::kTorso, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST, false, false},
    {BodyPart::kTorso, VFIT_BONE_UPPER_CHEST, VFIT_BONE_NECK, false, true},
    {BodyPart::kLeftUpperArm, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, true, true},
    {BodyPart::kLeftForearm, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND, true, true},
    {BodyPart::kLeftHand, VFIT_BONE_LEFT_HAND, -1, true, true},
    {BodyPart::kRightUpperArm, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, true, true},
    {BodyPart::kRightForearm, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND, true, true},
    {BodyPart::kRightHand, VFIT_BONE_RIGHT_HAND, -1, true, true},
    {BodyPart::kLeftThigh, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, true, true},
    {BodyPart::kLeftShank, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT, true, true},
    {BodyPart::kLeftFoot, VFIT_BONE_LEFT_FOOT, -1, true, true},
    {BodyPart::kRightThigh, VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, true, true},
    {BodyPart::kRightShank, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT, true, true},
    {BodyPart::kRightFoot, VFIT_BONE_RIGHT_FOOT, -1, true, true},
};
static_assert(std::size(kBones) <= kMaxFieldBones);

/// 0 to 4 around the axis, without trigonometry: the angle by which the table of radii runs.
float turn_of(float x, float z) {
    const float sum = std::abs(x) + std::abs(z);
    if (sum < 1e-9f) return 0.0f;
    const float t = z / sum;
    return x >= 0.0f ? (z >= 0.0f ? t : 4.0f + t) : 2.0f - t;
}

struct Cell {
    size_t level, angle, next_angle;
    float on_level, on_angle;
};
Cell cell_of(const BoneField& f, float height, float x, float z) {
    const float level = std::clamp(height * f.levels_per_m, 0.0f, float(f.levels - 1));
    const float turn = turn_of(x, z) * (float(kAngles) / 4.0f);
    Cell c{};
    c.level = std::min(size_t(level), f.levels - 2);
    c.on_level = level - float(c.level);
    const auto angle = size_t(turn);
    c.on_angle = turn - float(angle);
    c.angle = angle % kAngles;
    c.next_angle = c.angle + 1 == kAngles ? 0 : c.angle + 1;
    return c;
}

float radius_at(const BoneField& f, const PosedField::Radii& radius, float height, float x, float z) {
    const Cell c = cell_of(f, height, x, z);
    const float* row = radius.data() + c.level * kAngles;
    const float low = row[c.angle] + c.on_angle * (row[c.next_angle] - row[c.angle]);
    row += kAngles;
    const float high = row[c.angle] + c.on_angle * (row[c.next_angle] - row[c.angle]);
    return low + c.on_level * (high - low);
}

/// Radii of a bone as the weighted mean of the vertices around each cell. Cells without vertices take the
/// mean of their neighbours', over and over until all are known.
void learn_radii(BoneField& f, std::span<const Vec3> points) {
    std::array<float, BoneField::kMaxLevels * kAngles> weight{};
    f.radius.fill(0.0f);
    for (const Vec3& p : points) {
        const Vec3 d = p - f.start;
        const float height = dot(d, f.axis), x = dot(d, f.x), z = dot(d, f.z);
        if (height < -kLevel_m || height > f.length_m + kLevel_m) continue;
        const Cell c = cell_of(f, height, x, z);
        const float out = std::hypot(x, z);
        for (size_t l = 0; l < 2; ++l)
            for (size_t a = 0; a < 2; ++a) {
                const float w = (l ? c.on_level : 1.0f - c.on_level) * (a ? c.on_angle : 1.0f - c.on_angle);
                const size_t cell = (c.level + l) * kAngles + (a ? c.next_angle : c.angle);
                f.radius[cell] += w * out;
                weight[cell] += w;
            }
    }
    const size_t cells = f.levels * kAngles;
    constexpr float kKnown = 0.05f;  // of a vertex
    size_t known = 0;
    for (size_t i = 0; i < cells; ++i) {
        if (weight[i] < kKnown)
            f.radius[i] = 0.0f;
        else
            f.radius[i] /= weight[i], ++known;
    }
    if (known == 0) return;
    while (known < cells) {
        const auto before = f.radius;
        for (size_t l = 0; l < f.levels; ++l)
            for (size_t a = 0; a < kAngles; ++a) {
                if (before[l * kAngles + a] > 0.0f) continue;
                float sum = 0.0f;
                size_t count = 0;
                const auto add = [&](size_t level, size_t angle) {
                    if (before[level * kAngles + angle] > 0.0f)
                        sum += before[level * kAngles + angle], ++count;
                };
                add(l, (a + 1) % kAngles), add(l, (a + kAngles - 1) % kAngles);
                if (l > 0) add(l - 1, a);
                if (l + 1 < f.levels) add(l + 1, a);
                if (count == 0) continue;
                f.radius[l * kAngles + a] = sum / float(count);
                ++known;
            }
    }
}

}  // namespace

PosedField::Sample PosedField::sample(const Vec3& p) const {
    const BoneField& f = *field;
    const Vec3 d = p - start;
    const float height = dot(d, axis), along_x = dot(d, x), along_z = dot(d, z);
    const float radius = radius_at(f, *this->radius, height, along_x, along_z);
    const float beyond = height < 0.0f ? height : std::max(height - f.length_m, 0.0f);
    const float out2 = along_x * along_x + along_z * along_z;
    if (beyond == 0.0f) {
        const float out = std::sqrt(out2);
        const float inverse = 1.0f / std::max(out, 1e-6f);
        return {out - radius, radius, (along_x * inverse) * x + (along_z * inverse) * z};
    }
    // The end is half of an ellipsoid: (out / radius)^2 + (beyond / cap)^2 = 1 on the skin.
    const float cap = f.cap_m[beyond > 0.0f];
    const float on_side = out2 / (radius * radius), on_end = beyond * beyond / (cap * cap);
    const float level2 = on_side + on_end, level = std::sqrt(level2);
    const Vec3 gradient = (along_x * x + along_z * z) / (radius * radius) + (beyond / (cap * cap)) * axis;
    const float size = (on_side * radius + on_end * cap) / level2;  // of the ellipsoid in that direction
    return {(level - 1.0f) * size, radius, gradient / std::max(glm::length(gradient), 1e-6f)};
}

bool PosedField::is_within(const Vec3& p, float distance_m) const {
    const BoneField& f = *field;
    const Vec3 d = p - start;
    const float height = dot(d, axis), along_x = dot(d, x), along_z = dot(d, z);
    const float out2 = along_x * along_x + along_z * along_z;
    const float beyond = height < 0.0f ? height : std::max(height - f.length_m, 0.0f);
    const float most = f.reach_m + distance_m;
    if (out2 + beyond * beyond > most * most) return false;
    const float radius_m = radius_at(f, *radius, height, along_x, along_z);
    if (beyond == 0.0f) return out2 < (radius_m + distance_m) * (radius_m + distance_m);
    const float cap = f.cap_m[beyond > 0.0f];
    const float on_side = out2 / (radius_m * radius_m), on_end = beyond * beyond / (cap * cap);
    const float level2 = on_side + on_end;
    return (std::sqrt(level2) - 1.0f) * (on_side * radius_m + on_end * cap) < distance_m * level2;
}

Vec3 place_of_cell(const BoneField& f, size_t cell) {
    const float height = f.length_m * float(cell / kAngles) / float(f.levels - 1);
    const float turn = 4.0f * float(cell % kAngles) / float(kAngles);
    const float quarter = std::floor(turn), t = turn - quarter;
    const Vec2 on[] = {{1.0f - t, t}, {-t, 1.0f - t}, {t - 1.0f, -t}, {t, t - 1.0f}};
    const Vec2 way = glm::normalize(on[int(quarter)]) * f.radius[cell];
    return f.start + height * f.axis + way.x * f.x + way.y * f.z;
}

float PosedField::radius_of(const Vec3& p) const {
    const Vec3 d = p - start;
    return std::hypot(dot(d, x), dot(d, z));
}

std::vector<BoneField> learn_bone_fields(const AvatarRig& rig, std::span<const Vec3> rest,
                                         std::span<const BodyPart> parts) {
    std::vector<BoneField> fields;
    for (const BoneOfPart& b : kBones) {
        if (rig.rig_bone(b.bone) < 0) continue;
        BoneField f;
        f.part = b.part;
        f.rig_bone = rig.rig_bone(b.bone);
        for (const LimbChain& limb : rig.limbs())
            if (limb.bone == b.bone) f.rig_bone = limb.rig_bones[limb.rig_bones.size() / 2];
        f.start = rig.rest_head(b.bone);
        const Vec3 way =
            (b.end < 0 ? rig.bones()[size_t(f.rig_bone)].rest_tail : rig.rest_head(b.end)) - f.start;
        f.length_m = glm::length(way);
        if (f.length_m < kMinBone_m) continue;
        f.axis = way / f.length_m;
        const Vec3 side = std::abs(f.axis.x) < 0.8f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
        f.x = glm::normalize(side - dot(side, f.axis) * f.axis);
        f.z = glm::cross(f.x, f.axis);
        std::vector<Vec3> points;
        float low = 0.0f, high = f.length_m, beyond[2] = {};
        for (size_t v = 0; v < rest.size(); ++v) {
            if (parts[v] != b.part) continue;
            points.push_back(rest[v]);
            const float height = dot(rest[v] - f.start, f.axis);
            (b.starts_part ? beyond[0] : beyond[0]) = std::max(beyond[0], -height);
            beyond[1] = std::max(beyond[1], height - f.length_m);
        }
        f.start += low * f.axis;
        f.length_m = high - low;
        f.levels =
            std::clamp<size_t>(size_t(std::round(f.length_m / kLevel_m)) + 1, 3, BoneField::kMaxLevels);
        f.levels_per_m = float(f.levels - 1) / f.length_m;
        learn_radii(f, points);
        const auto mean_radius = [&](size_t level) {
            const float* row = f.radius.data() + level * kAngles;
            return std::accumulate(row, row + kAngles, 0.0f) / float(kAngles);
        };
        f.cap_m[0] = b.starts_part && (b.part == BodyPart::kTorso || b.end < 0)
                         ? std::max(kCap_m, beyond[0])
                         : std::max(kCap_m, mean_radius(0));
        f.cap_m[1] = b.ends_part && (b.part == BodyPart::kTorso || b.end < 0)
                         ? std::max(kCap_m, beyond[1])
                         : std::max(kCap_m, mean_radius(f.levels - 1));
        f.reach_m = std::max({*std::max_element(f.radius.begin(), f.radius.end()), f.cap_m[0], f.cap_m[1]});
        if (f.reach_m > 0.0f) fields.push_back(f);
    }
    return fields;
}

}  // namespace vfit
