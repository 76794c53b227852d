#include "motion/leg.h"

namespace vfit {

namespace {

size_t index_of(int id) { return static_cast<size_t>(id); }

}  // namespace

Leg::Leg(int side, const RestPose& pose, const PosedSkeleton& posed)
    : parts(&kLimbParts[kLeftLeg + side]),
      rest(&pose.limbs[index_of(kLeftLeg + side)]),
      hip(posed.position[index_of(parts->upper)]),
      ankle(posed.position[index_of(parts->last)]),
      upper(posed.rotation[index_of(parts->upper)]),
      lower(posed.rotation[index_of(parts->lower)]),
      foot(posed.rotation[index_of(parts->last)]) {}

TwoBoneSolution Leg::solve(const Vec3& root, const Vec3& goal, float softness) const {
    // The knee's front: square to its axis and to the leg. This keeps the tracked swivel even where the leg
    // is straight and the knee itself tells nothing.
    const Vec3 front = glm::cross(goal - root, knee_axis());
    return solve_two_bone(root, rest->upper_m, rest->lower_m, goal, front, softness);
}

void Leg::reach(const Vec3& root, const Vec3& goal, float softness) {
    const TwoBoneSolution ik = solve(root, goal, softness);
    const Vec3 axis = knee_axis();
    upper = align_pairs(upper * rest->upper, axis, ik.middle - root, axis) * upper;
    lower = align_pairs(lower * rest->lower, axis, ik.end - ik.middle, axis) * lower;
    hip = root;
    ankle = ik.end;
}

void Leg::turn_to(const Quat& new_upper, const Quat& new_lower) {
    upper = new_upper;
    lower = new_lower;
    ankle = hip + upper * (rest->upper * rest->upper_m) + lower * (rest->lower * rest->lower_m);
}

void Leg::put(const Quat& hips, Pose& pose) const {
    pose.rotation[index_of(parts->upper)] = glm::normalize(glm::conjugate(hips) * upper);
    pose.rotation[index_of(parts->lower)] = glm::normalize(glm::conjugate(upper) * lower);
    pose.rotation[index_of(parts->last)] = glm::normalize(glm::conjugate(lower) * foot);
}

}  // namespace vfit
