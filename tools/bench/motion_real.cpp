// The motion stage on real streams of joints: feet that stand, bones that keep their length, joints within
// their limits.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "motion/joint_limits.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr int kFeet[2] = {VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT};
constexpr uint32_t kContacts[2] = {VFIT_CONTACT_LEFT, VFIT_CONTACT_RIGHT};
constexpr size_t kWarmUp = 15;

struct Tally {
    std::vector<double> steps_m;  // of a foot planted in two frames on end
    double longest_bone_change_m = 0;
    double most_excess_rad = 0;
    int worst_bone = 0;
    size_t planted = 0, feet = 0;
};

/// The character is bound, so that its bones are known.
Skeleton bound_skeleton() {
    vfit::Motion unbound{MotionSettings()};
    return unbound.skeleton();
}

/// How far the pose is outside of the joint limits, and by which bone.
void add_excess(const vfit::Motion& motion, Tally& tally) {
    const Pose& pose = motion.pose();
    const bool planted[2] = {(pose.contacts & VFIT_CONTACT_LEFT) != 0,
                             (pose.contacts & VFIT_CONTACT_RIGHT) != 0};
    BoneRotations limited = pose.rotation;
    apply_joint_limits(RestPose(motion.skeleton()), planted, limited);
    for (size_t b = 0; b < limited.size(); ++b) {
        const double cosine = std::abs(double(glm::dot(limited[b], pose.rotation[b])));
        const double excess = 2.0 * std::acos(std::min(1.0, cosine));
        if (excess > tally.most_excess_rad) tally.most_excess_rad = excess, tally.worst_bone = int(b);
    }
}

void play(const std::vector<Body>& bodies, Tally& tally) {
    vfit::Motion motion{MotionSettings()};
    const Skeleton skeleton = bound_skeleton();
    motion.bind(skeleton);
    PosedSkeleton before;
    uint32_t contacts_before = 0;
    for (size_t i = 0; i < bodies.size(); ++i) {
        if (!motion.step(&bodies[i], bodies[i].time_ns)) continue;
        const PosedSkeleton posed = forward_kinematics(motion.skeleton(), motion.pose());
        const uint32_t contacts = motion.pose().contacts;
        if (i >= kWarmUp) add_excess(motion, tally);
        for (size_t side = 0; i >= kWarmUp && side < 2; ++side) {
            ++tally.feet;
            tally.planted += (contacts & kContacts[side]) != 0;
            if (!(contacts & contacts_before & kContacts[side])) continue;
            const auto foot = size_t(kFeet[side]);
            tally.steps_m.push_back(double(glm::length(posed.position[foot] - before.position[foot])));
        }
        for (size_t b = 1; b < size_t(kBoneCount); ++b) {
            const auto parent = size_t(bone_parent(int(b)));
            const double length = double(glm::length(posed.position[b] - posed.position[parent]));
            tally.longest_bone_change_m = std::max(
                tally.longest_bone_change_m, std::abs(length - double(glm::length(skeleton.offset[b]))));
        }
        before = posed;
        contacts_before = contacts;
    }
}

double p95(std::vector<double> v) {
    if (v.empty()) return NAN;
    std::sort(v.begin(), v.end());
    return v[size_t(0.95 * double(v.size() - 1))];
}

constexpr double kDegrees = 180.0 / 3.14159265358979;

void print(const char* name, const Tally& t) {
    std::cout << "  " << std::left << std::setw(22) << name << std::right << std::fixed
              << std::setprecision(1) << std::setw(12)
              << 100.0 * double(t.planted) / double(std::max<size_t>(1, t.feet)) << std::setprecision(2)
              << std::setw(16) << 1e3 * p95(t.steps_m) << std::setprecision(4) << std::setw(18)
              << 1e3 * t.longest_bone_change_m << std::setprecision(1) << std::setw(14)
              << kDegrees * t.most_excess_rad << "  " << vfit::bone_name(t.worst_bone) << "\n";
}

}  // namespace

Json judge_real(const MotionJudge& judge) {
    if (!judge.quiet)
        std::cout << "\nA bound character on joint streams.\n"
                  << "  streams                 planted, %   moves p95, mm   bones change, mm  beyond "
                     "limits, degrees\n";
    Json rows = Json::object();
    double worst_excess = 0, worst_step = 0, worst_bone = 0;
    const auto add = [&](const char* name, bool real, const std::vector<std::vector<Body>>& streams) {
        if (streams.empty()) return;
        Tally tally;
        for (const auto& bodies : streams) play(bodies, tally);
        if (!judge.quiet) print(name, tally);
        rows[name] = {{"moves_p95_m", p95(tally.steps_m)},
                      {"beyond_limits_deg", kDegrees * tally.most_excess_rad}};
        worst_excess = std::max(worst_excess, kDegrees * tally.most_excess_rad);
        worst_bone = std::max(worst_bone, 1e3 * tally.longest_bone_change_m);
        if (real) worst_step = std::max(worst_step, 1e3 * p95(tally.steps_m));
    };
    const auto bodies_of = [](const std::vector<JointStream>& streams) {
        std::vector<std::vector<Body>> out;
        for (const JointStream& s : streams) out.push_back(s.bodies);
        return out;
    };
    add("REAL Kinect v2", true, bodies_of(judge.real.kinect2));
    add("REAL UI-PRMD", true, bodies_of(judge.real.ui_prmd));
    std::vector<std::vector<Body>> people;
    for (const PersonStream& stream : people_on_their_feet(1, 240)) {
        people.emplace_back();
        for (const PersonFrame& frame : stream.frames) {
            people.back().push_back(frame.tracked);
            people.back().back().id = 1;
        }
    }
    add("SYNTHETIC, tracked", false, people);
    Targets& t = judge.targets;
    if (!judge.real.ui_prmd.empty())
        t.judge("REAL, planted feet move in a frame, 95 of 100", worst_step, Aim::at_most, 3.0, 2, " mm");
    t.judge("bones change their length by", worst_bone, Aim::at_most, 0.01, 4, " mm");
    t.judge("joints beyond their limits, any stream", worst_excess, Aim::at_most, 2.0, 1, " deg");
    return rows;
}

}  // namespace vfit::tools
