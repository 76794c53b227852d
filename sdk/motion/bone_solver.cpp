#include "motion/bone_solver.h"

#include <algorithm>
#include <cmath>

#include "math/quaternion.h"

namespace vfit {

namespace {

// A limb's roll. The plane through shoulder, elbow and wrist tells it to within the joints' deviation over
// the elbow's distance from the line between the limb's ends; below the least distance it tells nothing.
constexpr float kJointDeviationM = 0.025f;  // one standard deviation of a depth sensor's joint
constexpr float kMinOffLineM = 0.005f;
constexpr float kReadingS = 1.0f / 30.0f;  // the time that one reading of a sensor speaks for
constexpr float kRollDrift = 1.0f;         // rad^2 a second by which the roll may have changed
constexpr float kFastestRoll = 12.0f;      // rad/s; a quick throw's
constexpr float kRollOutlier = 2.0f;  // standard deviations beyond which a reading is followed no further
// Readings further from the natural axis bend the limb backwards.
constexpr float kMaxRollArm = 2.3f, kMaxRollLeg = 1.2f;
// An arm that was never seen hangs, this far below the T-pose.
constexpr float kHangingRad = 80.0f * kPi / 180.0f;
// Readings that the running mean of a flat foot's direction spans: two seconds at 30 Hz.
constexpr int kFlatFootCount = 60;
constexpr float kSteepestFootRad = 80.0f * kPi / 180.0f;

size_t at(int id) { return static_cast<size_t>(id); }

bool rotation_of(const Body& body, int joint, Quat& out) {
    const Joint& j = body.joints[at(joint)];
    if (!j.seen() || !j.has_rotation) return false;
    out = glm::normalize(j.rotation);
    return true;
}

bool direction_between(const Body& body, int from, int to, Vec3& direction, float& length) {
    if (!body.has(from) || !body.has(to)) return false;
    direction = body.at(to) - body.at(from);
    length = glm::length(direction);
    if (length < 1e-3f) return false;
    direction /= length;
    return true;
}

float elevation_of(const Vec3& unit) { return std::asin(std::clamp(unit.y, -1.0f, 1.0f)); }

}  // namespace

void BoneSolver::reset() { *this = BoneSolver(); }

void BoneSolver::learn_flat_feet(const Body& body, const bool planted[2]) {
    for (int side = 0; side < 2; ++side) {
        const LimbParts& parts = kLimbParts[kLeftLeg + side];
        Vec3 toes;
        float length = 0;
        if (!planted[side] || !direction_between(body, parts.end, parts.tip, toes, length)) continue;
        FlatFoot& flat = flat_feet_[at(side)];
        flat.count = std::min(flat.count + 1, kFlatFootCount);
        flat.elevation_rad += (elevation_of(toes) - flat.elevation_rad) / static_cast<float>(flat.count);
    }
}

void BoneSolver::solve(const Skeleton& skeleton, const RestPose& rest, const Body& body, const Trunk& trunk,
                       const bool planted[2], float dt_s, BoneRotations& world) {
    solve_spine(skeleton, rest, body, trunk, world);
    for (int i = 0; i < kLimbCount; ++i) solve_limb(i, rest, body, dt_s, world);
    for (int side = 0; side < 2; ++side) solve_foot(side, rest, body, planted[side], world);
}

void BoneSolver::solve_spine(const Skeleton& skeleton, const RestPose& rest, const Body& body,
                             const Trunk& trunk, BoneRotations& world) const {
    const Vec3 up = trunk.up();
    Quat hips = align_pairs(rest.hip_left, rest.neck, trunk.hip_left, up);
    Quat chest = align_pairs(rest.chest_left, rest.neck, trunk.chest_left, up);
    const bool given_hips = rotation_of(body, VFIT_JOINT_PELVIS, hips);
    const bool given_chest =
        rotation_of(body, VFIT_JOINT_CHEST, chest) || rotation_of(body, VFIT_JOINT_TORSO, chest);

    // The turn from hips to chest is spread evenly over the spine's three bones.
    Quat spine = glm::normalize(glm::slerp(hips, chest, 1.0f / 3.0f));
    Quat middle = glm::normalize(glm::slerp(hips, chest, 2.0f / 3.0f));
    if (!given_hips && !given_chest) {
        // The bent chain ends beside the line that it was built on: swing its two lower bones about the
        // spine's start, so that the neck lies where it was seen.
        const Vec3 start = hips * (skeleton.offset[VFIT_BONE_SPINE] - rest.hip_middle);
        const Vec3 end = start + spine * skeleton.offset[VFIT_BONE_CHEST] +
                         middle * skeleton.offset[VFIT_BONE_UPPER_CHEST];
        const Vec3 wanted = up * glm::length(rest.neck) - chest * skeleton.offset[VFIT_BONE_NECK];
        if (glm::length(end - start) > 1e-3f && glm::length(wanted - start) > 1e-3f) {
            const Quat swing = shortest_arc(end - start, wanted - start);
            spine = swing * spine;
            middle = swing * middle;
        }
    }
    world[VFIT_BONE_HIPS] = hips;
    world[VFIT_BONE_SPINE] = spine;
    world[VFIT_BONE_CHEST] = middle;
    world[VFIT_BONE_UPPER_CHEST] = chest;

    Quat neck = chest;
    Vec3 direction;
    float length = 0;
    if (direction_between(body, VFIT_JOINT_NECK, VFIT_JOINT_HEAD, direction, length))
        neck = shortest_arc(chest * rest.head, direction) * chest;
    Quat head = neck;
    if (rotation_of(body, VFIT_JOINT_HEAD, head)) neck = glm::normalize(glm::slerp(chest, head, 0.5f));
    rotation_of(body, VFIT_JOINT_NECK, neck);
    world[VFIT_BONE_NECK] = neck;
    world[VFIT_BONE_HEAD] = head;

    // Clavicles follow the chest: their joints are too short a lever to be read from positions.
    for (const auto& [joint, bone] : {std::pair{VFIT_JOINT_LEFT_CLAVICLE, VFIT_BONE_LEFT_SHOULDER},
                                      std::pair{VFIT_JOINT_RIGHT_CLAVICLE, VFIT_BONE_RIGHT_SHOULDER}}) {
        world[at(bone)] = chest;
        rotation_of(body, joint, world[at(bone)]);
    }
}

void BoneSolver::Roll::observe(float seen, float elbow_off_line_m, float dt_s) {
    const float deviation = kJointDeviationM / elbow_off_line_m;
    if (!known) {
        *this = {true, seen * glm::smoothstep(kMinOffLineM, kJointDeviationM, elbow_off_line_m),
                 deviation * deviation};
        return;
    }
    if (dt_s <= 0.0f) return;
    const float noise = deviation * deviation * std::max(1.0f, kReadingS / dt_s);
    variance += kRollDrift * dt_s;
    const float gain = variance / (variance + noise), most = kRollOutlier * std::sqrt(variance + noise);
    variance *= 1.0f - gain;
    // The angles are not wrapped: a limb never rolls through the side to which it does not bend.
    const float step = gain * std::clamp(seen - angle, -most, most);
    angle += std::clamp(step, -kFastestRoll * dt_s, kFastestRoll * dt_s);
}

/// The axis about which the lower bone bends.
Vec3 BoneSolver::hinge_of(int index, const RestLimb& rest, const Quat& parent, const Vec3& upper,
                          const Vec3& lower, float upper_m, float lower_m, float dt_s) {
    Roll& roll = rolls_[at(index)];
    const Quat to_parent = glm::conjugate(parent);
    const Vec3 upper_local = to_parent * upper;
    const Vec3 natural = shortest_arc(rest.upper, upper_local) * rest.hinge;
    const Vec3 normal = to_parent * glm::cross(upper, lower);
    const float span = glm::length(upper * upper_m + lower * lower_m);
    const float off_line = span > 1e-3f ? upper_m * lower_m * glm::length(normal) / span : 0.0f;
    if (off_line > kMinOffLineM) {
        const float seen =
            std::atan2(glm::dot(glm::cross(natural, normal), upper_local), glm::dot(natural, normal));
        if (std::abs(seen) < (kLimbParts[index].leg ? kMaxRollLeg : kMaxRollArm))
            roll.observe(seen, off_line, dt_s);
    }
    return parent * (glm::angleAxis(roll.angle, upper_local) * natural);
}

void BoneSolver::solve_limb(int index, const RestPose& rest, const Body& body, float dt_s,
                            BoneRotations& world) {
    const LimbParts& parts = kLimbParts[index];
    const RestLimb& limb = rest.limbs[at(index)];
    const Quat parent = world[at(parts.parent)];
    Quat& upper_rotation = world[at(parts.upper)];
    Quat& lower_rotation = world[at(parts.lower)];
    Quat& last_rotation = world[at(parts.last)];

    Vec3 upper, lower;
    float upper_m = 0, lower_m = 0;
    const bool has_end = body.has(parts.end);
    const bool has_upper = direction_between(body, parts.root, parts.middle, upper, upper_m);
    const bool has_lower =
        direction_between(body, parts.middle, has_end || parts.leg ? parts.end : parts.tip, lower, lower_m);
    if (has_upper) {
        const Vec3 hinge =
            hinge_of(index, limb, parent, upper, has_lower ? lower : upper, upper_m, lower_m, dt_s);
        upper_rotation = align_pairs(limb.upper, limb.hinge, upper, hinge);
        lower_rotation = has_lower ? align_pairs(limb.lower, limb.hinge, lower, hinge) : upper_rotation;
    } else {
        const float lowered = parts.leg ? 0.0f : -parts.side * kHangingRad;
        upper_rotation = parent * glm::angleAxis(lowered, Vec3(0, 0, 1));
        lower_rotation = upper_rotation;
    }
    rotation_of(body, parts.root, upper_rotation);
    rotation_of(body, parts.middle, lower_rotation);
    last_rotation = lower_rotation;
    if (parts.leg) return;

    Vec3 hand;
    float hand_m = 0;
    if (direction_between(body, parts.end, parts.tip, hand, hand_m))
        last_rotation = shortest_arc(lower_rotation * limb.lower, hand) * lower_rotation;
    if (!rotation_of(body, parts.end, last_rotation)) rotation_of(body, parts.tip, last_rotation);
}

void BoneSolver::solve_foot(int side, const RestPose& rest, const Body& body, bool planted,
                            BoneRotations& world) {
    const LimbParts& parts = kLimbParts[kLeftLeg + side];
    const Quat shank = world[at(parts.lower)];
    Quat& foot = world[at(parts.last)];
    const int toes_bone = side == 0 ? VFIT_BONE_LEFT_TOES : VFIT_BONE_RIGHT_TOES;
    const Vec3 floor_up(0, 1, 0);

    Vec3 toes;
    float length = 0;
    const bool given = rotation_of(body, parts.end, foot);
    if (!given && direction_between(body, parts.end, parts.tip, toes, length)) {
        const FlatFoot& flat = flat_feet_[at(side)];
        const Vec3 rest_toes = rest.toes[at(side)];
        const Vec3 level(toes.x, 0.0f, toes.z);
        if (flat.count > 0 && glm::length(level) > 1e-3f) {
            const float wanted = std::clamp(elevation_of(toes) + elevation_of(rest_toes) - flat.elevation_rad,
                                            -kSteepestFootRad, kSteepestFootRad);
            toes = glm::normalize(level) * std::cos(wanted) + floor_up * std::sin(wanted);
        }
        // The sole is level across: to the floor where it stands on it, else to the shank.
        const Vec3 up = planted ? floor_up : shank * floor_up;
        Vec3 across = glm::cross(up, toes);
        if (glm::length(across) < 0.1f) across = shank * Vec3(1, 0, 0);
        foot = align_pairs(rest_toes, glm::cross(floor_up, rest_toes), toes, across);
    } else if (!given) {
        // Toes that nobody sees: the foot is level and points where the knee bends.
        const Vec3 across = shank * Vec3(1, 0, 0);
        const Vec3 level(across.x, 0.0f, across.z);
        foot = glm::length(level) > 0.1f ? align_pairs(Vec3(1, 0, 0), floor_up, level, floor_up) : shank;
    }
    world[at(toes_bone)] = foot;
    rotation_of(body, parts.tip, world[at(toes_bone)]);
}

}  // namespace vfit
