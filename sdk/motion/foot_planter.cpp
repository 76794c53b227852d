#include "motion/foot_planter.h"

#include <algorithm>
#include <cmath>

#include "math/quaternion.h"
#include "motion/joint_limits.h"

namespace vfit {

namespace {

// What a leg keeps of its length, so that its knee does not snap where it comes to full stretch: 1 % (16
// degrees) while it moves, 0.1 % (5 degrees) while it rests and should look straight. The root takes what
// this costs, a centimetre at most. (At a contact's switch 0.2 % turns knees harder: vfit-bench motion --only
// feet.)
constexpr float kReserve = 0.01f, kRestingReserve = 0.001f;
constexpr float kRestingSpeed = 0.05f, kMovingSpeed = 0.25f;  // m/s, of the hip over the ankle
constexpr float kVelocityS = 0.1f, kReserveS = 0.15f;         // low-pass of that, and of the reserve
constexpr float kHeldM = 1e-3f;  // closer is close enough for a foot that limits have moved
constexpr float kPullS = 0.1f;   // in a few of these a pull that no leg needs has gone
constexpr float kHeelStaysM = 0.05f, kHeelRisesM = 0.2f;  // the hip ahead of the ankle
constexpr float kLeastLevel =
    0.1f;  // of the toes' direction: a foot that points up or down points nowhere ahead
constexpr float kMostRoll = 0.1f;     // rad, of the pelvis
constexpr float kLeastHipsM = 0.02f;  // apart, seen from above
constexpr int kRootPasses = 12;       // two legs at the end of their reach pull the root in turns
constexpr float kReachedM = 2e-6f;    // at 0.05 mm, a straight knee still trembles

size_t at(int id) { return static_cast<size_t>(id); }

/// The pelvis' turn about its way ahead by which the left hip rises by `rise_m` against the right one.
/// Trackers see one foot a centimetre higher than the other one on a level floor: 17 degrees of a straight
/// knee, but 4 of the pelvis.
Quat pelvis_roll(const Leg legs[2], float rise_m) {
    const Vec3 across = legs[0].hip - legs[1].hip;
    const Vec3 ahead(-across.z, 0.0f, across.x);
    const float length = glm::length(ahead);
    if (length < kLeastHipsM) return Quat(1, 0, 0, 0);
    return glm::angleAxis(std::clamp(rise_m / length, -kMostRoll, kMostRoll), ahead / length);
}

/// The foot of a planted leg that the body has passed, its ankle held within its range: it turns heel up
/// before it comes free, and not at once then. Who squats keeps the whole foot down.
Quat with_heel_off(const Leg& leg, int side, const RestPose& rest, const RangeOfMotion& rom) {
    const Vec3 toes = leg.foot * rest.toes[at(side)];
    const Vec2 ahead(toes.x, toes.z), past(leg.hip.x - leg.ankle.x, leg.hip.z - leg.ankle.z);
    const float length = glm::length(ahead);
    if (length < kLeastLevel) return leg.foot;
    const float share = glm::smoothstep(kHeelStaysM, kHeelRisesM, glm::dot(past, ahead) / length);
    if (share == 0.0f) return leg.foot;
    Quat ankle = glm::conjugate(leg.lower) * leg.foot;
    limit_ankle(rom, side, ankle);
    return glm::slerp(leg.foot, same_hemisphere(leg.lower * ankle, leg.foot), share);
}

}  // namespace

void FootPlanter::keep_reserve(Foot& foot, const Leg& tracked, bool planted, float dt_s) {
    const Vec3 way = tracked.hip - (planted ? Vec3(0.0f) : tracked.ankle);
    const bool first = foot.way == Vec3(0.0f);
    if (dt_s > 0.0f && !first && planted == foot.pin.planted()) {
        const Vec3 velocity = (way - foot.way) / dt_s;
        foot.velocity += (velocity - foot.velocity) * (1.0f - std::exp(-dt_s / kVelocityS));
    }
    foot.way = way;
    const float share = glm::smoothstep(kRestingSpeed, kMovingSpeed, glm::length(foot.velocity));
    const float reserve = glm::mix(kRestingReserve, kReserve, share);
    foot.reserve += (reserve - foot.reserve) * (first ? 1.0f : 1.0f - std::exp(-dt_s / kReserveS));
}

/// Rolls the hips about the root as the feet say; `lift_m`: how far up the root goes after that.
Quat FootPlanter::level_hips(Leg legs[2], const Vec3& root, float& lift_m) const {
    const Quat roll = pelvis_roll(legs, height_.slope_m());
    lift_m = height_.lift_m();
    for (int side = 0; side < 2; ++side) {
        const Vec3& hip = legs[side].hip;
        const float was = hip.y;
        legs[side].move_hip(root + roll * (hip - root) - hip);
        lift_m -= 0.5f * (hip.y - was);
    }
    return roll;
}

/// The root's whole shift: its lift, and what legs at the end of their reach pull.
Vec3 FootPlanter::pull_root(const Leg legs[2], const Seen seen[2], float lift_m, float dt_s) {
    const Vec3 lift(0.0f, lift_m, 0.0f);
    pull_.fade(kPullS, dt_s);
    Vec3 shift = lift + pull_.value();
    bool pulled = false;
    for (int pass = 0; pass < kRootPasses; ++pass) {
        bool reached = true;
        for (int side = 0; side < 2; ++side) {
            if (!seen[side].planted) continue;
            const Foot& foot = feet_[at(side)];
            const Vec3 residual =
                foot.shown -
                legs[side].solve(legs[side].hip + shift, foot.shown, foot.reserve).end;  // Alg. 6, 10
            if (glm::length(residual) < kReachedM) continue;
            shift += residual;
            pulled = true;
            reached = false;
        }
        if (reached) break;
    }
    if (pulled) pull_ = Glide(shift - lift);
    return shift;
}

/// One leg under its shifted hip: as it is planted, as it comes free, as it swings.
void FootPlanter::move_leg(Foot& foot, Leg& leg, const Leg& tracked, bool planted, bool released,
                           float dt_s) {
    if (planted) {
        Leg stood = leg;
        stood.reach(leg.hip, foot.shown, 0.0f);
        foot.back.stand(stood, dt_s);
        return;
    }
    if (released) {
        leg.reach(leg.hip, foot.pin.place(), 0.0f);
        foot.back.release(tracked, leg);
    }
    foot.back.swing(leg, dt_s);
    foot.shown = leg.ankle;
    foot.pin.showed(foot.shown);
}

void FootPlanter::apply(const Skeleton& skeleton, const RestPose& rest, const RangeOfMotion& rom,
                        const Seen seen[2], float dt_s, Pose& pose) {
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    const Leg tracked[2] = {Leg(0, rest, posed), Leg(1, rest, posed)};
    Leg legs[2] = {tracked[0], tracked[1]};
    bool released[2], stands[2];
    HeightVote votes[2];
    pose.contacts = 0;
    pose.foot_correction_m = 0;
    for (int side = 0; side < 2; ++side) {
        Foot& foot = feet_[at(side)];
        const bool planted = seen[side].planted;
        released[side] = foot.pin.planted() && !planted;
        foot.pin.move(seen[side].drag);
        keep_reserve(foot, tracked[side], planted, dt_s);
        const float floor_m = skeleton.ankle_height;
        const float stand_y = seen[side].known ? standing_height(seen[side].ankle_m, floor_m) : floor_m;
        const Vec3 place = foot.pin.update(tracked[side].ankle, planted, stand_y, dt_s);
        foot.back.turn(legs[side], dt_s);
        if (planted) {
            foot.shown = place;
            votes[side] = standing_vote(tracked[side], foot.shown);
            pose.contacts |= side == 0 ? VFIT_CONTACT_LEFT : VFIT_CONTACT_RIGHT;
            pose.foot_correction_m = std::max(pose.foot_correction_m, glm::length(foot.pin.offset()));
        } else if (seen[side].known) {
            votes[side] = free_vote(seen[side].ankle_m - tracked[side].ankle.y);
        }
        stands[side] = planted;
    }
    height_.update(votes, stands, dt_s);

    float lift_m = 0.0f;
    const Quat roll = level_hips(legs, pose.hips_position, lift_m);
    const Vec3 shift = pull_root(legs, seen, lift_m, dt_s);
    // What stands on the pelvis does not turn with it.
    const Quat hips = glm::normalize(roll * posed.rotation[VFIT_BONE_HIPS]);
    pose.rotation[VFIT_BONE_HIPS] = hips;
    pose.rotation[VFIT_BONE_SPINE] = glm::normalize(glm::conjugate(hips) * posed.rotation[VFIT_BONE_SPINE]);
    pose.root_correction = shift;
    pose.hips_position += shift;

    for (int side = 0; side < 2; ++side) {
        Foot& foot = feet_[at(side)];
        Leg& leg = legs[side];
        leg.move_hip(shift);
        move_leg(foot, leg, tracked[side], seen[side].planted, released[side], dt_s);
        leg.reach(leg.hip, foot.shown, foot.reserve);
        if (seen[side].planted) leg.foot = with_heel_off(leg, side, rest, rom);
        foot.back.turn_foot(leg, dt_s);
        leg.put(hips, pose);
    }
}

void FootPlanter::hold(const Skeleton& skeleton, const RestPose& rest, const bool planted[2],
                       Pose& pose) const {
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    Vec3 shift(0.0f);
    float farthest = 0.0f, feet = 0.0f;
    for (int side = 0; side < 2; ++side) {
        if (!planted[side]) continue;
        const Vec3 residual = feet_[at(side)].shown - posed.position[at(kLimbParts[kLeftLeg + side].last)];
        farthest = std::max(farthest, glm::length(residual));
        shift += residual;
        feet += 1.0f;
    }
    if (farthest < kHeldM) return;
    shift /= feet;
    for (int side = 0; side < 2; ++side) {
        if (!planted[side]) continue;
        Leg leg(side, rest, posed);
        leg.reach(leg.hip + shift, feet_[at(side)].shown, feet_[at(side)].reserve);
        leg.put(posed.rotation[VFIT_BONE_HIPS], pose);
    }
    pose.hips_position += shift;
    pose.root_correction += shift;
}

}  // namespace vfit
