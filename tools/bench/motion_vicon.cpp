// Angles of limbs against a marker system: the pose beside the raw joints, on exercises that both a Kinect v2
// and a Vicon system saw (UI-PRMD, REAL). The two were cut apart and run on clocks of their own: each episode
// is shifted in time to where it agrees best, and angles are compared without their mean, since markers lie
// on the skin.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/motion_parts.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr double kKinectStep_s = 1.0 / 30.0, kViconStep_s = 0.01;
constexpr double kMostLag_s = 1.5, kLagPlay_s = 0.15;
constexpr double kLeastOverlap_s = 1.0;
constexpr double kLeastRange_deg = 20.0;   // of an angle that the exercise is about
constexpr double kLeastCorrelation = 0.8;  // of the raw joints: else the sensor saw something else
constexpr size_t kLeastStill = 10;         // frames at rest of a curve that has a say
constexpr double kStill_deg = 1.0,
                 kStill_s = 0.5;  // before and after: at rest for a second, as in the table of filters

enum Angle {
    kLeftKnee,
    kRightKnee,
    kLeftElbow,
    kRightElbow,
    kLeftArm,
    kRightArm,
    kLeftThigh,
    kRightThigh,
    kAngles
};
using Angles = std::array<double, kAngles>;

double degrees_between(const Vec3& a, const Vec3& b) {
    return double(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0f, 1.0f))) *
           180.0 / double(kPi);
}

/// A limb bent by 0 degrees is straight; arms and thighs are counted from the trunk's way down.
struct Places {
    std::array<Vec3, 2> shoulder, elbow, wrist, hip, knee, ankle;
    Vec3 top, bottom;  // of the trunk
};
Angles angles_of(const Places& p) {
    Angles out{};
    const Vec3 down = p.bottom - p.top;
    for (size_t side = 0; side < 2; ++side) {
        out[kLeftKnee + side] = degrees_between(p.knee[side] - p.hip[side], p.ankle[side] - p.knee[side]);
        out[kLeftElbow + side] =
            degrees_between(p.elbow[side] - p.shoulder[side], p.wrist[side] - p.elbow[side]);
        out[kLeftArm + side] = degrees_between(down, p.elbow[side] - p.shoulder[side]);
        out[kLeftThigh + side] = degrees_between(down, p.knee[side] - p.hip[side]);
    }
    return out;
}

/// Of the Plug-in Gait marker set, in its usual order.
Places from_markers(const std::vector<Vec3>& m) {
    const auto mid = [&](size_t a, size_t b) { return 0.5f * (m[a] + m[b]); };
    Places p;
    p.shoulder = {m[9], m[16]};
    p.elbow = {m[11], m[18]};
    p.wrist = {mid(13, 14), mid(20, 21)};
    p.hip = {mid(23, 25), mid(24, 26)};
    p.knee = {m[28], m[34]};
    p.ankle = {m[30], m[36]};
    p.top = m[4];
    p.bottom = mid(25, 26);
    return p;
}

Places from_joints(const Body& b) {
    const auto both = [&](int left, int right) { return std::array<Vec3, 2>{b.at(left), b.at(right)}; };
    Places p;
    p.shoulder = both(VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER);
    p.elbow = both(VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_RIGHT_ELBOW);
    p.wrist = b.has(VFIT_JOINT_LEFT_WRIST) ? both(VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_RIGHT_WRIST)
                                           : both(VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND);
    p.hip = both(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP);
    p.knee = both(VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_RIGHT_KNEE);
    p.ankle = both(VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT);
    p.top = b.at(VFIT_JOINT_NECK);
    p.bottom = 0.5f * (p.hip[0] + p.hip[1]);
    return p;
}

Places from_pose(const vfit::Motion& motion) {
    const PosedSkeleton posed = forward_kinematics(motion.skeleton(), motion.pose());
    const auto both = [&](int left, int right) {
        return std::array<Vec3, 2>{posed.position[size_t(left)], posed.position[size_t(right)]};
    };
    Places p;
    p.shoulder = both(VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM);
    p.elbow = both(VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_LOWER_ARM);
    p.wrist = both(VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND);
    p.hip = both(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG);
    p.knee = both(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG);
    p.ankle = both(VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT);
    p.top = posed.position[VFIT_BONE_NECK];
    p.bottom = 0.5f * (p.hip[0] + p.hip[1]);
    return p;
}

using Series = std::vector<Angles>;  // one a Kinect frame

/// The marker system's angle at a time of its own; frames between are blended.
double vicon_at(const Series& vicon, size_t angle, double time_s) {
    const double place = time_s / kViconStep_s;
    if (place < 0.0 || place > double(vicon.size() - 1)) return NAN;
    const auto i = std::min(size_t(place), vicon.size() - 2);
    const double t = place - double(i);
    return (1.0 - t) * vicon[i][angle] + t * vicon[i + 1][angle];
}

struct Pair {
    std::vector<double> own, vicon;
    double correlation() const {
        const double n = double(own.size());
        double a = 0, b = 0, ab = 0, aa = 0, bb = 0;
        for (size_t i = 0; i < own.size(); ++i) a += own[i] / n, b += vicon[i] / n;
        for (size_t i = 0; i < own.size(); ++i)
            ab += (own[i] - a) * (vicon[i] - b), aa += (own[i] - a) * (own[i] - a),
                bb += (vicon[i] - b) * (vicon[i] - b);
        return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
    }
    double rms() const {
        double mean = 0, sum = 0;
        for (size_t i = 0; i < own.size(); ++i) mean += (own[i] - vicon[i]) / double(own.size());
        for (size_t i = 0; i < own.size(); ++i)
            sum += std::pow(own[i] - vicon[i] - mean, 2) / double(own.size());
        return std::sqrt(sum);
    }
};

Pair pair_at(const Series& own, const Series& vicon, size_t angle, double lag_s) {
    Pair pair;
    for (size_t i = 0; i < own.size(); ++i) {
        const double v = vicon_at(vicon, angle, double(i) * kKinectStep_s + lag_s);
        if (std::isnan(v)) continue;
        pair.own.push_back(own[i][angle]);
        pair.vicon.push_back(v);
    }
    return pair;
}

/// Near the lag of the episode, the one at which this curve agrees best.
double nearest_lag(const Series& own, const Series& vicon, size_t angle, double lag_s) {
    double best = -1e9, found = lag_s;
    for (double at = lag_s - kLagPlay_s; at <= lag_s + kLagPlay_s; at += 0.01)
        if (const double c = pair_at(own, vicon, angle, at).correlation(); c > best) best = c, found = at;
    return found;
}

/// Where all moving angles agree best.
double best_lag(const Series& own, const Series& vicon, const std::vector<size_t>& moving) {
    double best = -1e9, lag = 0.0;
    for (double at = -kMostLag_s; at <= kMostLag_s; at += 0.01) {
        double sum = 0.0;
        bool enough = true;
        for (const size_t angle : moving) {
            const Pair pair = pair_at(own, vicon, angle, at);
            enough = enough && double(pair.own.size()) * kKinectStep_s >= kLeastOverlap_s;
            if (enough) sum += pair.correlation();
        }
        if (enough && sum > best) best = sum, lag = at;
    }
    return lag;
}

/// Second differences where the markers stand still: jitter alone.
void add_jitter(const Series& own, const Series& vicon, size_t angle, double lag_s, double& squares,
                size_t& count) {
    for (size_t i = 1; i + 1 < own.size(); ++i) {
        const double t = double(i) * kKinectStep_s + lag_s;
        const double before = vicon_at(vicon, angle, t - kStill_s),
                     after = vicon_at(vicon, angle, t + kStill_s), now = vicon_at(vicon, angle, t);
        if (std::isnan(before) || std::isnan(after) || std::abs(before - now) > kStill_deg ||
            std::abs(after - now) > kStill_deg)
            continue;
        const double bend = own[i - 1][angle] - 2.0 * own[i][angle] + own[i + 1][angle];
        squares += bend * bend;
        ++count;
    }
}

double median(std::vector<double> v) {
    if (v.empty()) return NAN;
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}

}  // namespace

Json judge_vicon(const MotionJudge& judge) {
    if (judge.real.markers.empty()) return Json::object();
    std::map<std::string, const JointStream*> by_name;
    for (const JointStream& s : judge.real.ui_prmd) by_name[s.name] = &s;
    std::vector<double> raw_rms, pose_rms, delays_s, calmer;
    double raw_squares = 0, pose_squares = 0;
    size_t raw_count = 0, pose_count = 0, compared = 0, left_out = 0;
    for (const MarkerStream& markers : judge.real.markers) {
        const auto found = by_name.find(markers.name);
        if (found == by_name.end() || markers.frames.size() < 2) continue;
        Series vicon, raw, pose;
        for (const auto& frame : markers.frames) vicon.push_back(angles_of(from_markers(frame)));
        vfit::Motion motion{MotionSettings()};
        for (const Body& body : found->second->bodies) {
            raw.push_back(angles_of(from_joints(body)));
            motion.step(&body, body.time_ns);
            pose.push_back(angles_of(from_pose(motion)));
        }
        std::vector<size_t> moving;
        for (size_t a = 0; a < kAngles; ++a) {
            double least = 1e9, most = -1e9;
            for (const Angles& v : vicon) least = std::min(least, v[a]), most = std::max(most, v[a]);
            if (most - least >= kLeastRange_deg) moving.push_back(a);
        }
        if (moving.empty()) continue;
        const double raw_lag = best_lag(raw, vicon, moving), pose_lag = best_lag(pose, vicon, moving);
        delays_s.push_back(raw_lag - pose_lag);
        bool followed = true;
        for (const size_t a : moving) {
            // Each curve once more by itself: one that the sensor sees badly must not shift the others.
            const Pair r = pair_at(raw, vicon, a, nearest_lag(raw, vicon, a, raw_lag));
            const Pair p = pair_at(pose, vicon, a, nearest_lag(pose, vicon, a, pose_lag));
            if (r.correlation() < kLeastCorrelation) {
                ++left_out;
                followed = false;
                continue;
            }
            ++compared;
            raw_rms.push_back(r.rms());
            pose_rms.push_back(p.rms());
        }
        // Where the two systems are not told to be at one moment, nobody knows what stands still.
        for (size_t a = 0; followed && a < kAngles; ++a) {
            double raw_sum = 0, pose_sum = 0;
            size_t raw_frames = 0, pose_frames = 0;
            add_jitter(raw, vicon, a, raw_lag, raw_sum, raw_frames);
            add_jitter(pose, vicon, a, pose_lag, pose_sum, pose_frames);
            raw_squares += raw_sum, raw_count += raw_frames, pose_squares += pose_sum,
                pose_count += pose_frames;
            if (raw_frames >= kLeastStill && pose_frames >= kLeastStill)
                calmer.push_back(
                    std::sqrt((raw_sum / double(raw_frames)) / (pose_sum / double(pose_frames))));
        }
    }
    const double raw_jitter = std::sqrt(raw_squares / double(std::max<size_t>(1, raw_count)));
    const double pose_jitter = std::sqrt(pose_squares / double(std::max<size_t>(1, pose_count)));
    if (!judge.quiet)
        std::cout << "\nAngles of knees, elbows, arms and thighs against Vicon markers (UI-PRMD, REAL): "
                  << compared << " curves, " << left_out
                  << " left out where the raw joints do not follow the markers\n"
                  << std::fixed << std::setprecision(2) << "  RMS after alignment, median: raw joints "
                  << median(raw_rms) << ", pose " << median(pose_rms) << " degrees; the pose is "
                  << 1e3 * median(delays_s) << " ms later\n"
                  << "  second difference where the markers are still for a second, RMS of all: raw "
                  << raw_jitter << ", pose " << pose_jitter
                  << " degrees (an arm that the sensor lost has most of it); by curve the median is "
                  << median(calmer) << " times less, of " << calmer.size() << "\n";
    judge.targets.judge("REAL, angles against Vicon, RMS of pose over raw",
                        median(pose_rms) / median(raw_rms), Aim::at_most, 1.0, 3);
    judge.targets.judge("REAL, jitter of angles at rest, raw over pose, median", median(calmer),
                        Aim::at_least, 5.0, 1);
    return {{"raw_rms_deg", median(raw_rms)},
            {"pose_rms_deg", median(pose_rms)},
            {"delay_s", median(delays_s)},
            {"raw_jitter_deg", raw_jitter},
            {"pose_jitter_deg", pose_jitter},
            {"curves", compared},
            {"left_out", left_out}};
}

}  // namespace vfit::tools
