#include "motion/foot_planter.h"

#include <algorithm>
#include <cmath>

#include "math/two_bone_ik.h"

namespace vfit {

namespace {

// Over the last hundredth of its length a leg eases into full extension against a knee that snaps; the root takes
// that, a centimetre at most. (At a contact's switch 0.2 % turns knees harder, 3 % lowers whoever stands straight:
// vfit-bench motion --only feet.)
constexpr float kSoftness = 0.01f;
constexpr float kHeldM = 1e-3f;           // closer is close enough for a foot that limits have moved
constexpr float kWeightS = 0.35f;        // time constant with which a foot gains and loses its say in the root's height
constexpr float kRootFadeS = 0.1f;       // after which a shift that no leg needs has gone
constexpr float kMostRoll = 0.1f;         // rad, of the pelvis
constexpr float kLeastHipsM = 0.02f;      // apart, seen from above
constexpr int kRootPasses = 12;          // two legs at the end of their reach pull the root in turns
constexpr float kReachedM = 5e-5f;       // 0.05 mm: closer is not seen

size_t at(int id) { return static_cast<size_t>(id); }

struct Leg {
    const LimbParts* parts = nullptr;
    const RestLimb* rest = nullptr;
    Vec3 hip{0.0f}, target{0.0f}, knee_axis{1, 0, 0};

    Leg() = default;
    Leg(int side, const RestPose& pose, const PosedSkeleton& posed)
        : parts(&kLimbParts[kLeftLeg + side]),
          rest(&pose.limbs[at(kLeftLeg + side)]),
          hip(posed.position[at(parts->upper)]),
          knee_axis(posed.rotation[at(parts->upper)] * rest->hinge) {}

    TwoBoneSolution solve(const Vec3& shift) const {
        const Vec3 root = hip + shift;
        // The knee's front: square to its axis and to the leg. This keeps the tracked swivel even where the
        // leg is straight and the knee itself tells nothing.
        const Vec3 front = glm::cross(target - root, knee_axis);
        return solve_two_bone(root, rest->upper_m, rest->lower_m, target, front, kSoftness);
    }
};

/// How far up its hip must go for the leg to reach its target `length_m` long, with the knee as it was tracked. Near full stretch a
/// centimetre of height is 17 degrees of the knee: the root's height, which nobody sees, follows the knee.
float keeping_the_knee(const Leg& leg, float length_m) {
    const Vec3 to_target = leg.target - leg.hip;
    const float aside2 = to_target.x * to_target.x + to_target.z * to_target.z;
    return to_target.y + std::sqrt(std::max(length_m * length_m - aside2, 0.0f));
}

/// The pelvis' turn about its way ahead by which the left hip rises by `rise_m` against the right one. Trackers see one
/// foot a centimetre higher than the other one on a level floor: 17 degrees of a straight knee, but 4 of the pelvis.
Quat pelvis_roll(const Leg legs[2], float rise_m) {
    const Vec3 across = legs[0].hip - legs[1].hip;
    const Vec3 ahead(-across.z, 0.0f, across.x);
    const float length = glm::length(ahead);
    if (length < kLeastHipsM) return Quat(1, 0, 0, 0);
    return glm::angleAxis(std::clamp(rise_m / length, -kMostRoll, kMostRoll), ahead / length);
}

void turn_leg(const Leg& leg, const Vec3& shift, const Quat& hips, const PosedSkeleton& posed, Pose& pose) {
    const TwoBoneSolution ik = leg.solve(shift);
    const Quat upper_was = posed.rotation[at(leg.parts->upper)];
    const Quat lower_was = posed.rotation[at(leg.parts->lower)];
    const Quat upper = align_pairs(upper_was * leg.rest->upper, leg.knee_axis, ik.middle - leg.hip - shift,
                                   leg.knee_axis) * upper_was;
    const Quat lower = align_pairs(lower_was * leg.rest->lower, leg.knee_axis, ik.end - ik.middle,
                                   leg.knee_axis) * lower_was;
    const Quat foot = posed.rotation[at(leg.parts->last)];  // stays as it is in the world
    pose.rotation[at(leg.parts->upper)] = glm::normalize(glm::conjugate(hips) * upper);
    pose.rotation[at(leg.parts->lower)] = glm::normalize(glm::conjugate(upper) * lower);
    pose.rotation[at(leg.parts->last)] = glm::normalize(glm::conjugate(lower) * foot);
}

}  // namespace

void FootPlanter::apply(const Skeleton& skeleton, const RestPose& rest, const bool planted[2],
                        const Vec3 drags[2], float dt_s, Pose& pose) {
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    Leg legs[2];
    bool moved = false;
    float lengths[2] = {}, rise = 0.0f, both = 1.0f;
    pose.contacts = 0;
    pose.foot_correction_m = 0;
    for (int side = 0; side < 2; ++side) {
        Leg& leg = legs[side];
        leg = Leg(side, rest, posed);
        FootPin& pin = pins_[at(side)];
        pin.move(drags[side]);
        leg.target = pin.update(posed.position[at(leg.parts->last)], planted[side], skeleton.ankle_height, dt_s);
        shown_[at(side)] = leg.target;
        moved = moved || pin.planted() || pin.offset() != Vec3(0.0f);
        float& weight = weight_[at(side)];
        weight += ((pin.planted() ? 1.0f : 0.0f) - weight) * (known_ ? 1.0f - std::exp(-dt_s / kWeightS) : 1.0f);
        lengths[side] = glm::distance(posed.position[at(leg.parts->last)], leg.hip);
        rise += (side == 0 ? 1.0f : -1.0f) * keeping_the_knee(leg, lengths[side]);
        both *= weight;
        if (!pin.planted()) continue;
        pose.contacts |= side == 0 ? VFIT_CONTACT_LEFT : VFIT_CONTACT_RIGHT;
        pose.foot_correction_m = std::max(pose.foot_correction_m, glm::length(pin.offset()));
    }
    known_ = true;

    const Quat roll = pelvis_roll(legs, both * rise);
    float height = 0.0f, weights = 0.0f;
    for (int side = 0; side < 2; ++side) {
        Leg& leg = legs[side];
        leg.hip = pose.hips_position + roll * (leg.hip - pose.hips_position);
        height += weight_[at(side)] * keeping_the_knee(leg, lengths[side]);
        weights += weight_[at(side)];
    }

    root_shift_ *= std::exp(-dt_s / kRootFadeS);
    const Vec3 lift(0.0f, height / std::max(weights, 1.0f), 0.0f);
    for (int pass = 0; pass < kRootPasses; ++pass) {
        bool reached = true;
        for (int side = 0; side < 2; ++side) {
            if (!planted[side]) continue;
            const Vec3 residual = legs[side].target - legs[side].solve(lift + root_shift_).end;  // Alg. 6, line 10
            if (glm::length(residual) < kReachedM) continue;
            root_shift_ += residual;
            reached = false;
        }
        if (reached) break;
    }
    if (glm::length(root_shift_) < kReachedM) root_shift_ = Vec3(0.0f);
    const Vec3 shift = lift + root_shift_;
    pose.root_correction = shift;
    if (!moved && shift == Vec3(0.0f)) return;
    // What stands on the pelvis does not turn with it.
    const Quat rolled = glm::normalize(roll * posed.rotation[VFIT_BONE_HIPS]);
    pose.rotation[VFIT_BONE_HIPS] = rolled;
    pose.rotation[VFIT_BONE_SPINE] = glm::normalize(glm::conjugate(rolled) * posed.rotation[VFIT_BONE_SPINE]);
    for (const Leg& leg : legs) turn_leg(leg, shift, rolled, posed, pose);
    pose.hips_position += shift;
}

void FootPlanter::hold(const Skeleton& skeleton, const RestPose& rest, const bool planted[2], Pose& pose) const {
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    Vec3 shift(0.0f);
    float farthest = 0.0f, feet = 0.0f;
    for (int side = 0; side < 2; ++side) {
        if (!planted[side]) continue;
        const Vec3 residual = shown_[at(side)] - posed.position[at(kLimbParts[kLeftLeg + side].last)];
        farthest = std::max(farthest, glm::length(residual));
        shift += residual;
        feet += 1.0f;
    }
    if (farthest < kHeldM) return;
    shift /= feet;
    for (int side = 0; side < 2; ++side) {
        if (!planted[side]) continue;
        Leg leg(side, rest, posed);
        leg.target = shown_[at(side)];
        turn_leg(leg, shift, posed.rotation[VFIT_BONE_HIPS], posed, pose);
    }
    pose.hips_position += shift;
    pose.root_correction += shift;
}

}  // namespace vfit
