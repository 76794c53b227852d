#include "motion/motion.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/error.h"
#include "math/finite.h"
#include "math/quaternion.h"
#include "motion/body_filter.h"
#include "motion/bone_solver.h"
#include "motion/foot_contact.h"
#include "motion/foot_planter.h"
#include "motion/hidden_feet.h"
#include "motion/joint_feet.h"
#include "motion/joint_limits.h"
#include "motion/proportions.h"
#include "motion/rotation_smoothing.h"

namespace vfit {

namespace {

// For so long after a foot was planted the larger divisor smooths (paper 3.3.4, step 4): half the double
// support of a slow gait.
constexpr double kSwitchTimeS = 0.25;

constexpr float kLimitSlackRad = 0.025f;  // 1.4 degrees

// Over a longer time a trend foretells nothing.
constexpr float kMostPredictionS = 0.2f;

// A person who was out of sight for longer may have gone anywhere: they start where they are found.
constexpr double kLongestGap_s = 2.0;

// A joint further from the origin, or a rotation with larger numbers, is a broken reading: its square would
// soon be infinite, and one such body would stay in the filters for good.
constexpr float kFarthestM = 1e4f, kLongestQuaternion = 1e3f;

size_t at(int id) { return static_cast<size_t>(id); }

bool is_place(const Vec3& p) {
    return std::abs(p.x) <= kFarthestM && std::abs(p.y) <= kFarthestM && std::abs(p.z) <= kFarthestM;
}

bool is_rotation(const Quat& q) {
    const float length = glm::length(q);
    return length >= 1e-3f && length <= kLongestQuaternion;
}

void check_share(float value, const char* name) {
    if (!(value >= 0.0f && value <= 1.0f))
        fail(VFIT_ERROR_ARGUMENT, "motion ", name, " is ", value, ", not in 0..1");
}

void check_radius(float value, const char* name) {
    if (!(value >= 0.0f) || !std::isfinite(value))
        fail(VFIT_ERROR_ARGUMENT, "motion ", name, " is ", value, " m, not a length");
}

void check_cutoff(float value, const char* name) {
    if (!(value > 0.0f) || !std::isfinite(value))
        fail(VFIT_ERROR_ARGUMENT, "motion ", name, " is ", value, " Hz, not above 0");
}

void check_divisor(float value, const char* name) {
    if (!(value >= 1.0f) || !std::isfinite(value))
        fail(VFIT_ERROR_ARGUMENT, "motion ", name, " is ", value, ", less than 1");
}

void validate(const MotionSettings& s) {
    const HoltSettings& holt = s.filter.holt;
    check_share(holt.smoothing, "smoothing");
    check_share(holt.correction, "correction");
    check_share(holt.prediction, "prediction");
    check_radius(holt.jitter_radius_m, "jitter_radius_m");
    check_radius(holt.max_deviation_radius_m, "max_deviation_radius_m");
    const OneEuroSettings& euro = s.filter.one_euro;
    check_cutoff(euro.min_cutoff_hz, "min_cutoff_hz");
    check_cutoff(euro.derivative_cutoff_hz, "derivative_cutoff_hz");
    if (!(euro.beta >= 0.0f) || !std::isfinite(euro.beta))
        fail(VFIT_ERROR_ARGUMENT, "motion beta is ", euro.beta, ", not at least 0");
    if (s.filter.kind < VFIT_POSITION_ADAPTIVE || s.filter.kind > VFIT_POSITION_ONE_EURO)
        fail(VFIT_ERROR_ARGUMENT, "motion filter ", s.filter.kind, " is not one of VFIT_POSITION_*");
    if (s.contact_rule < VFIT_CONTACT_LEARNT || s.contact_rule > VFIT_CONTACT_THRESHOLDS)
        fail(VFIT_ERROR_ARGUMENT, "motion contact_rule ", s.contact_rule,
             " is not one of VFIT_CONTACT_LEARNT, _THRESHOLDS");
    if (!(s.prediction_s >= 0.0f && s.prediction_s <= kMostPredictionS))
        fail(VFIT_ERROR_ARGUMENT, "motion prediction_s is ", s.prediction_s, ", not in 0..",
             kMostPredictionS);
    check_divisor(s.rotation_divisor, "rotation_divisor");
    check_divisor(s.rotation_divisor_switched, "rotation_divisor_switched");
}

void validate(const Body& body) {
    for (int i = 0; i < kJointCount; ++i) {
        const Joint& joint = body.joints[at(i)];
        if (!joint.seen()) continue;
        if (!finite(joint.position) || !finite(joint.confidence))
            fail(VFIT_ERROR_DATA, "joint ", joint_name(i), " of body ", body.id, " is not finite");
        if (!is_place(joint.position))
            fail(VFIT_ERROR_DATA, "joint ", joint_name(i), " of body ", body.id, " is more than ", kFarthestM,
                 " m away");
        if (joint.has_rotation && !is_rotation(joint.rotation))
            fail(VFIT_ERROR_DATA, "joint ", joint_name(i), " of body ", body.id, " has no valid rotation");
    }
}

void validate(const Skeleton& skeleton) {
    for (int bone = 0; bone < kBoneCount; ++bone)
        if (!is_place(skeleton.offset[at(bone)]))
            fail(VFIT_ERROR_DATA, "bone ", bone_name(bone), " of the skeleton is not finite, or too long");
    if (!finite(skeleton.ankle_height)) fail(VFIT_ERROR_DATA, "the skeleton's ankle height is not finite");
    const RestPose rest(skeleton);
    for (int leg : {kLeftLeg, kRightLeg})
        if (rest.limbs[at(leg)].upper_m < 1e-3f || rest.limbs[at(leg)].lower_m < 1e-3f)
            fail(VFIT_ERROR_DATA, "the skeleton has a leg without length");
}

void to_local(const BoneRotations& world, BoneRotations& local) {
    for (int b = 0; b < kBoneCount; ++b) {
        const int parent = bone_parent(b);
        local[at(b)] =
            parent < 0 ? world[at(b)] : glm::normalize(glm::conjugate(world[at(parent)]) * world[at(b)]);
    }
}

void to_world(const BoneRotations& local, BoneRotations& world) {
    for (int b = 0; b < kBoneCount; ++b) {
        const int parent = bone_parent(b);
        world[at(b)] = parent < 0 ? local[at(b)] : glm::normalize(world[at(parent)] * local[at(b)]);
    }
}

}  // namespace

struct Motion::State {
    explicit State(const MotionSettings& s)
        : settings(s), ahead_ns(static_cast<int64_t>(1e9 * double{s.prediction_s})) {
        joints.joints.fill(Joint());
    }

    MotionSettings settings;
    int64_t ahead_ns;
    bool bound = false;
    Skeleton skeleton;
    RestPose rest;

    Proportions person;
    BodyFilter filter;
    FootContact contact;
    HiddenFeet hidden_feet;
    BoneSolver solver;
    RotationSmoother smoother;
    FootPlanter planter;
    JointFeet joint_feet;

    Pose pose;
    Body joints;
    bool has_body = false, seen = false;
    uint32_t body_id = 0;
    int64_t body_ns = 0, now_ns = 0, switched_ns = 0;
    bool switched = false;

    bool enabled(uint32_t no_flag) const { return (settings.flags & no_flag) == 0; }
    void take(const Body& body);
    void adopt_person();
    float on_character(float height_m) const;
    bool update_pose(float dt_s);
    void reset();
};

void Motion::State::reset() {
    person.reset();
    filter.reset();
    contact.reset();
    hidden_feet.reset();
    solver.reset();
    smoother.reset();
    planter.reset();
    joint_feet.reset();
    pose = Pose();
    joints = Body();
    has_body = seen = switched = false;
}

/// One new body through the stages that run once a body.
void Motion::State::take(const Body& given) {
    const bool stood[2] = {contact.planted(0), contact.planted(1)};
    const Body body = hidden_feet.put_back(given, stood);
    filter.update(body, enabled(VFIT_MOTION_NO_FILTER) ? &settings.filter : nullptr);
    body_id = body.id;
    body_ns = body.time_ns;
    has_body = true;

    filter.sample(body.time_ns, joints);
    person.update(joints);
    contact.update(body, settings.contact_rule);
    if (contact.switched()) {
        switched = true;
        switched_ns = body.time_ns;
    }
    if (enabled(VFIT_MOTION_NO_FEET)) {
        const bool planted[2] = {contact.planted(0), contact.planted(1)};
        solver.learn_flat_feet(joints, planted);
    }
    if (!bound) adopt_person();
}

/// The person's own skeleton stands at the height at which the sensor sees the person stand.
void Motion::State::adopt_person() {
    skeleton = person.skeleton();
    const float level = contact.ankle_level(skeleton.ankle_height);
    skeleton.offset[VFIT_BONE_HIPS].y += level - skeleton.ankle_height;
    skeleton.ankle_height = level;
    rest = RestPose(skeleton);
}

/// A height of the person's on the character: above the standing ankle scaled by leg length, so that other
/// legs stand on the same floor.
float Motion::State::on_character(float height_m) const {
    const RestPose person_rest(person.skeleton());
    const float ratio = bound ? rest.leg_m() / person_rest.leg_m() : 1.0f;
    const float ankle = contact.ankle_level(person.skeleton().ankle_height);
    return skeleton.ankle_height + ratio * (height_m - ankle);
}

bool Motion::State::update_pose(float dt_s) {
    filter.sample(later(now_ns, ahead_ns), joints);
    Trunk trunk;
    if (!find_trunk(joints, trunk)) return seen;

    const bool feet = enabled(VFIT_MOTION_NO_FEET);
    const bool planted[2] = {feet && contact.planted(0), feet && contact.planted(1)};
    BoneRotations world, local;
    solver.solve(skeleton, rest, joints, trunk, planted, dt_s, world);
    if (enabled(VFIT_MOTION_NO_LIMITS)) {
        to_local(world, local);
        apply_joint_limits(rest, planted, local, settings.range_of_motion);
        to_world(local, world);
    }
    if (enabled(VFIT_MOTION_NO_SMOOTHING)) {
        const bool recent = feet && switched && seconds_between(switched_ns, now_ns) < kSwitchTimeS;
        smoother.apply(world, recent ? settings.rotation_divisor_switched : settings.rotation_divisor, dt_s);
    }
    to_local(world, local);

    const BoneRotations before = pose.rotation;
    pose.time_ns = now_ns;
    pose.rotation = local;
    const Vec3 hip_middle(trunk.hip_middle.x, on_character(trunk.hip_middle.y), trunk.hip_middle.z);
    pose.hips_position = hip_middle - world[VFIT_BONE_HIPS] * rest.hip_middle;
    pose.contacts = 0;
    pose.root_correction = Vec3(0.0f);
    pose.foot_correction_m = 0.0f;
    if (feet) {
        FootPlanter::Seen seen_feet[2];
        for (int side = 0; side < 2; ++side) {
            const Joint& ankle = joints.joints[at(VFIT_JOINT_LEFT_FOOT + side)];
            seen_feet[side].planted = planted[side];
            seen_feet[side].known = ankle.state == VFIT_JOINT_MEASURED;
            seen_feet[side].ankle_m = on_character(ankle.position.y);
        }
        const Vec3 fronts[2] = {world[VFIT_BONE_LEFT_UPPER_LEG] * Vec3(0, 0, 1),
                                world[VFIT_BONE_RIGHT_UPPER_LEG] * Vec3(0, 0, 1)};
        joint_feet.apply(planted, fronts, contact.ankle_level(skeleton.ankle_height), dt_s, joints);
        for (int side = 0; side < 2; ++side) seen_feet[side].drag = joint_feet.drag(side);
        planter.apply(skeleton, rest, settings.range_of_motion, seen_feet, dt_s, pose);
    }
    // What smoothing and planting have bent too far; a foot that stands is held as long as it can be.
    if (enabled(VFIT_MOTION_NO_LIMITS) &&
        apply_joint_limits(rest, planted, kLimitSlackRad, pose.rotation, settings.range_of_motion) &&
        (planted[0] || planted[1])) {
        planter.hold(skeleton, rest, planted, pose);
        apply_joint_limits(rest, planted, kLimitSlackRad, pose.rotation, settings.range_of_motion);
    }
    for (size_t i = 0; i < before.size(); ++i)
        pose.rotation[i] = same_hemisphere(pose.rotation[i], before[i]);
    seen = true;
    return true;
}

Motion::Motion(const MotionSettings& settings) {
    validate(settings);
    state_ = std::make_unique<State>(settings);
    state_->adopt_person();
}

Motion::~Motion() = default;
Motion::Motion(Motion&&) noexcept = default;
Motion& Motion::operator=(Motion&&) noexcept = default;

void Motion::bind(const Skeleton& skeleton) {
    validate(skeleton);
    state_->skeleton = skeleton;
    state_->rest = RestPose(skeleton);
    state_->bound = true;
    state_->planter.reset();
}

bool Motion::step(const Body* body, int64_t now_ns) {
    State& s = *state_;
    if (body) {
        validate(*body);
        if (s.has_body && (body->id != s.body_id || body->time_ns < s.body_ns ||
                           seconds_between(s.body_ns, body->time_ns) > kLongestGap_s))
            s.reset();
        if (!s.has_body || body->time_ns != s.body_ns) s.take(*body);
    }
    if (!s.has_body) return false;
    const int64_t before = s.seen ? s.now_ns : s.body_ns;
    s.now_ns = std::max(now_ns, s.body_ns);
    const float dt_s = static_cast<float>(seconds_between(before, s.now_ns));
    return s.update_pose(std::max(0.0f, dt_s));
}

const Pose& Motion::pose() const { return state_->pose; }
const Body& Motion::joints() const { return state_->joints; }
const Skeleton& Motion::skeleton() const { return state_->skeleton; }
void Motion::reset() {
    state_->reset();
    if (!state_->bound) state_->adopt_person();
}

}  // namespace vfit
