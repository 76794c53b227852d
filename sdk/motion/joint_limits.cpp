#include "motion/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "body/range_of_motion.h"
#include "math/quaternion.h"

namespace vfit {

namespace {

using Interval = RangeOfMotion::Interval;

constexpr float kRad = kPi / 180.0f;
constexpr float kMostSlack = 1.1f;

size_t at(int id) { return static_cast<size_t>(id); }

float clamp_to(float angle_rad, Interval range) {
    return std::clamp(angle_rad, range.least_deg * kRad, range.most_deg * kRad);
}

float twist_angle(const Quat& twist, const Vec3& axis) {
    const float along = twist.x * axis.x + twist.y * axis.y + twist.z * axis.z;
    const float angle = 2.0f * std::atan2(along, twist.w);
    return angle > kPi ? angle - 2.0f * kPi : angle <= -kPi ? angle + 2.0f * kPi : angle;
}

/// The intervals of a left joint mirrored where `side` is -1.
Interval sided(float least, float most, float side) {
    return side > 0 ? Interval{least, most} : Interval{-most, -least};
}

/// Splits q about the bone, moves the bone's direction by `clamp_direction` and its twist into `twist`.
template <typename ClampDirection>
Quat limit_bone(const Quat& q, const Vec3& bone, Interval twist, ClampDirection&& clamp_direction) {
    const SwingTwist parts = split_swing_twist(q, bone);
    const float angle = twist_angle(parts.twist, bone);
    const float limited = clamp_to(angle, twist);
    const Vec3 direction = parts.swing * bone;
    const Vec3 allowed = clamp_direction(direction);
    if (limited == angle && allowed == direction) return q;
    const Quat swing = allowed == direction ? parts.swing : shortest_arc(bone, allowed);
    return glm::normalize(swing * glm::angleAxis(limited, bone));
}

/// A unit vector with one component raised to `least`, the others scaled to keep the length.
Vec3 raise_component(Vec3 v, int axis, float least) {
    if (v[axis] >= least) return v;
    const float rest = std::sqrt(std::max(1e-12f, 1.0f - v[axis] * v[axis]));
    v *= std::sqrt(1.0f - least * least) / rest;
    v[axis] = least;
    return v;
}

Vec3 clamp_shoulder(const RangeOfMotion& rom, Vec3 d, float side) {
    d.x *= side;
    // The two half-spaces meet; a third pass undoes what the second one moved back out.
    d = raise_component(d, 2, -std::sin(rom.shoulder_extension * kRad));
    d = raise_component(d, 0, -std::sin(rom.shoulder_adduction * kRad));
    d = raise_component(d, 2, -std::sin(rom.shoulder_extension * kRad));
    d.x *= side;
    return d;
}

/// A direction as an angle in a plane (from `forward` towards `turn`) and one out of it (towards `out`).
Vec3 clamp_planar(const Vec3& d, const Vec3& forward, const Vec3& turn, const Vec3& out, Interval planar,
                  Interval off_plane) {
    const float angle = std::atan2(glm::dot(d, turn), glm::dot(d, forward));
    const float off = std::asin(std::clamp(glm::dot(d, out), -1.0f, 1.0f));
    const float angle_allowed = clamp_to(angle, planar), off_allowed = clamp_to(off, off_plane);
    if (angle == angle_allowed && off == off_allowed) return d;
    return std::sin(off_allowed) * out +
           std::cos(off_allowed) * (std::cos(angle_allowed) * forward + std::sin(angle_allowed) * turn);
}

/// A joint about the upright axis: twist in an interval, swing (bend about x, lean about z) in an ellipse.
Quat limit_upright(const Quat& q, Interval bend, Interval lean, Interval twist) {
    const Vec3 up(0, 1, 0);
    const SwingTwist parts = split_swing_twist(q, up);
    const float angle = twist_angle(parts.twist, up);
    const float limited = clamp_to(angle, twist);
    const Quat swing = parts.swing.w < 0 ? -parts.swing : parts.swing;
    const float swing_angle = angle_of(swing);
    const Vec3 axis(swing.x, 0.0f, swing.z);
    const float sine = glm::length(axis);
    float scale = 1.0f;
    if (sine > 1e-6f) {
        const Vec3 vector = axis * (swing_angle / sine);
        const float x = vector.x / (kRad * (vector.x < 0 ? bend.least_deg : bend.most_deg));
        const float z = vector.z / (kRad * (vector.z < 0 ? lean.least_deg : lean.most_deg));
        const float radius = std::sqrt(x * x + z * z);
        if (radius > 1.0f) scale = 1.0f / radius;
    }
    if (limited == angle && scale == 1.0f) return q;
    return glm::normalize(fraction(swing, scale) * glm::angleAxis(limited, up));
}

void limit_limb(const RangeOfMotion& rom, int index, const RestLimb& rest, BoneRotations& local) {
    const LimbParts& parts = kLimbParts[index];
    const float side = parts.side;
    Quat& upper = local[at(parts.upper)];
    if (parts.leg) {
        const Interval turn = sided(-rom.hip_external, rom.hip_internal, side);
        upper = limit_bone(upper, rest.upper, turn, [&](Vec3 d) {
            return clamp_planar(d, {0, -1, 0}, {0, 0, 1}, {side, 0, 0}, rom.hip_flexion, rom.hip_abduction);
        });
    } else {
        upper = limit_bone(upper, rest.upper, sided(-rom.shoulder_external, rom.shoulder_internal, side),
                           [&](Vec3 d) { return clamp_shoulder(rom, d, side); });
    }

    const Interval flexion = parts.leg ? rom.knee_flexion : rom.elbow_flexion;
    const float bend_deg = rest.bend_rad / kRad;
    const float out_deg = std::asin(std::clamp(glm::dot(rest.lower, rest.hinge), -1.0f, 1.0f)) / kRad;
    // Angles count from the straight limb; the T-pose may be bent a little.
    const Interval off_plane{out_deg - rom.hinge_play, out_deg + rom.hinge_play};
    const Interval bend{std::min(flexion.least_deg, bend_deg), flexion.most_deg};
    const Interval pronation = sided(-rom.forearm_supination, rom.forearm_pronation, side);
    const Interval twist = parts.leg ? Interval{-rom.hinge_play, rom.hinge_play} : pronation;
    Quat& lower = local[at(parts.lower)];
    lower = limit_bone(lower, rest.lower, twist, [&](Vec3 d) {
        return clamp_planar(d, rest.upper, glm::cross(rest.hinge, rest.upper), rest.hinge, bend, off_plane);
    });
    if (parts.leg) return;

    Quat& hand = local[at(parts.last)];
    hand = limit_bone(hand, rest.lower, pronation, [&](Vec3 d) {
        return clamp_planar(d, {side, 0, 0}, {0, -1, 0}, {0, 0, 1}, rom.wrist_flexion, rom.wrist_radial);
    });
}

/// The limits hold for the turn of the whole chain; what is too much is taken off all its bones alike.
void limit_spine(const RangeOfMotion& rom, BoneRotations& local) {
    Quat& spine = local[VFIT_BONE_SPINE];
    Quat& chest = local[VFIT_BONE_CHEST];
    Quat& upper = local[VFIT_BONE_UPPER_CHEST];
    const Quat total = spine * chest * upper;
    const Quat limited = limit_upright(total, rom.spine_flexion, {-rom.spine_lateral, rom.spine_lateral},
                                       {-rom.spine_rotation, rom.spine_rotation});
    if (limited == total) return;
    spine = chest = upper = fraction(limited, 1.0f / 3.0f);
}

void limit_neck(const RangeOfMotion& rom, BoneRotations& local) {
    const Interval lean{-rom.neck_lateral, rom.neck_lateral};
    const Interval turn{-rom.neck_rotation, rom.neck_rotation};
    Quat& neck = local[VFIT_BONE_NECK];
    Quat& head = local[VFIT_BONE_HEAD];
    neck = limit_upright(neck, rom.neck_flexion, lean, turn);
    const Quat total = neck * head;
    const Quat limited = limit_upright(total, rom.neck_flexion, lean, turn);
    if (limited != total) head = glm::normalize(glm::conjugate(neck) * limited);
}

}  // namespace

void limit_ankle(const RangeOfMotion& rom, int side, Quat& foot) {
    // Positions of a straight leg do not show its axial turn, so that a toe turned out by the hip appears at
    // the ankle: the hip's range holds.
    const float sign = side == 0 ? 1.0f : -1.0f;
    const Interval lean = sided(-rom.ankle_inversion, rom.ankle_eversion, sign);
    const Interval turn = sided(-rom.hip_internal, rom.hip_external, sign);
    foot = limit_upright(foot, rom.ankle_plantarflexion, lean, turn);
}

void apply_joint_limits(const RestPose& rest, const bool planted[2], BoneRotations& local,
                        const RangeOfMotion& rom) {
    limit_spine(rom, local);
    limit_neck(rom, local);
    for (int i = 0; i < kLimbCount; ++i) limit_limb(rom, i, rest.limbs[at(i)], local);
    if (!planted[0]) limit_ankle(rom, 0, local[VFIT_BONE_LEFT_FOOT]);
    if (!planted[1]) limit_ankle(rom, 1, local[VFIT_BONE_RIGHT_FOOT]);
}

bool apply_joint_limits(const RestPose& rest, const bool planted[2], float slack_rad, BoneRotations& local,
                        const RangeOfMotion& rom) {
    BoneRotations limited = local;
    apply_joint_limits(rest, planted, limited, rom);
    bool changed = false;
    for (size_t b = 0; b < local.size(); ++b) {
        if (limited[b] == local[b]) continue;
        const Quat outside = glm::conjugate(limited[b]) * local[b];
        const float angle = angle_of(outside);
        if (angle <= slack_rad) continue;
        local[b] = glm::normalize(limited[b] * fraction(outside, slack_rad / angle));
        changed = true;
    }
    if (!changed) return false;
    // Where a range curves, the nearest rotation inside of it may now be another one, farther off.
    limited = local;
    apply_joint_limits(rest, planted, limited, rom);
    for (size_t b = 0; b < local.size(); ++b)
        if (limited[b] != local[b] &&
            angle_of(glm::conjugate(limited[b]) * local[b]) > kMostSlack * slack_rad)
            local[b] = limited[b];
    return true;
}

}  // namespace vfit
