#include "bench/feet_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/joint_bones.h"
#include "client/client.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr size_t kWarmUp = 30;
constexpr size_t kNear = 1;         // frames: a contact may be seen one frame earlier or later
constexpr size_t kSettle = 2;       // frames after a touchdown that may move
constexpr double kSkating = 0.025;  // m/s
constexpr double kFrame_s = 1.0 / 30.0;

constexpr int kFeet[2] = {VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT};
// Bones whose turning would show a pop, and the joints that have the truth of it.
constexpr int kTurning[] = {VFIT_BONE_HIPS,      VFIT_BONE_LEFT_UPPER_LEG,  VFIT_BONE_LEFT_LOWER_LEG,
                            VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG,
                            VFIT_BONE_RIGHT_FOOT};

int joint_of_bone(int bone) {
    for (int j = 0; j < kJointCount; ++j)
        if (kJointPlaces[size_t(j)].bone == bone) return j;
    throw Failure("a bone without a joint");
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(double(glm::length(glm::cross(a, b))), double(glm::dot(a, b)));
}

/// Flexion.
double knee_of(const Body& body, int side) {
    const Vec3& knee = body.at(VFIT_JOINT_LEFT_KNEE + side);
    return angle_between(knee - body.at(VFIT_JOINT_LEFT_HIP + side),
                         body.at(VFIT_JOINT_LEFT_FOOT + side) - knee);
}

bool found_near(const std::vector<char>& flags, size_t i) {
    for (size_t k = i > kNear ? i - kNear : 0; k <= std::min(flags.size() - 1, i + kNear); ++k)
        if (flags[k]) return true;
    return false;
}

/// Of the turn from a to b to c, rad/s^2.
double angular_acceleration(const Quat& a, const Quat& b, const Quat& c) {
    const auto turn = [](const Quat& from, const Quat& to) {
        Quat q = to * glm::conjugate(from);
        if (q.w < 0) q = -q;
        const float angle = 2.0f * std::acos(std::min(1.0f, q.w));
        const Vec3 axis(q.x, q.y, q.z);
        const float length = glm::length(axis);
        return length > 1e-7f ? axis * (angle / length) : Vec3(0.0f);
    };
    return double(glm::length(turn(b, c) - turn(a, b))) / (kFrame_s * kFrame_s);
}

void score_contacts(const PersonStream& stream, const std::vector<Shown>& shown, size_t side,
                    FeetScore& score) {
    const size_t n = stream.frames.size();
    std::vector<char> truth, said;
    for (size_t i = kWarmUp; i < n; ++i) {
        truth.push_back(!stream.frames[i].planted[side]);
        said.push_back(shown[i].valid && !shown[i].planted[side]);
    }
    score.lifted.add(truth, said);
    for (auto* v : {&truth, &said})
        for (char& c : *v) c = !c;
    score.planted.add(truth, said);

    size_t since = 0;  // frames since the touchdown
    Vec3 place(0.0f);
    double slide = 0, drift = 0;
    for (size_t i = kWarmUp; i <= n; ++i) {
        const bool planted = i < n && stream.frames[i].planted[side];
        if (!planted) {
            if (since > kSettle) {
                score.slides_m.push_back(slide);
                score.drifts_m.push_back(drift);
            }
            since = 0;
            continue;
        }
        ++since;
        if (!shown[i].valid || !shown[i - 1].valid || since <= kSettle) continue;
        if (since == kSettle + 1) place = shown[i].ankle[side], slide = drift = 0;
        const Vec3 moved = shown[i].ankle[side] - shown[i - 1].ankle[side];
        const Vec3 away = shown[i].ankle[side] - place;
        slide = std::max(slide, double(glm::length(Vec2(away.x, away.z))));
        drift = std::max(drift, double(glm::length(away)));
        if (since == kSettle + 1) continue;
        ++score.contact_frames;
        score.skating += double(glm::length(Vec2(moved.x, moved.z))) / kFrame_s > kSkating;
        score.moving += double(glm::length(moved)) / kFrame_s > kSkating;
        score.knee_errors_rad.push_back(
            std::abs(shown[i].knee_rad[side] - knee_of(stream.frames[i].truth, int(side))));
    }
}

void score_pops(const PersonStream& stream, const std::vector<Shown>& shown, FeetScore& score) {
    for (size_t i = kWarmUp; i + 1 < stream.frames.size(); ++i) {
        const bool valid = shown[i - 1].valid && shown[i].valid && shown[i + 1].valid;
        bool switches = false;
        for (size_t k = i - 1; k <= i + 1; ++k)
            switches = switches || shown[k].planted != shown[k - 1].planted;
        for (const int bone : kTurning) {
            if (!stream.frames[i].truth.joints[size_t(joint_of_bone(bone))].has_rotation) continue;
            const auto b = size_t(bone);
            const auto truly = [&](size_t k) {
                return stream.frames[k].truth.joints[size_t(joint_of_bone(bone))].rotation;
            };
            score.true_turning.push_back(angular_acceleration(truly(i - 1), truly(i), truly(i + 1)));
            if (valid && switches)
                score.pops.push_back(
                    angular_acceleration(shown[i - 1].world[b], shown[i].world[b], shown[i + 1].world[b]));
        }
    }
}

/// Each flight: how high the lower foot gets, of how high it truly does.
void score_jumps(const PersonStream& stream, const std::vector<Shown>& shown, FeetScore& score) {
    const size_t n = stream.frames.size();
    const auto flies = [&](size_t k) {
        return k < n && !stream.frames[k].planted[0] && !stream.frames[k].planted[1];
    };
    const auto lower_foot = [&](size_t k, bool truth) {
        const auto y = [&](size_t side) {
            return truth ? stream.frames[k].truth.at(VFIT_JOINT_LEFT_FOOT + int(side)).y
                         : shown[k].ankle[side].y;
        };
        return double(std::min(y(0), y(1)));
    };
    for (size_t i = kWarmUp; i < n; ++i) {
        if (!flies(i) || flies(i - 1)) continue;
        double height = 0, true_height = 0;
        for (size_t k = i; flies(k); ++k) {
            height = std::max(height, lower_foot(k, false) - lower_foot(i - 1, false));
            true_height = std::max(true_height, lower_foot(k, true) - lower_foot(i - 1, true));
        }
        score.jump_heights.push_back(height / true_height);
    }
}

double percent(size_t part, size_t whole) {
    return 100.0 * double(part) / double(std::max<size_t>(1, whole));
}

}  // namespace

std::vector<Shown> show_motion(const PersonStream& stream) {
    vfit::Motion motion{MotionSettings()};
    std::vector<Shown> out;
    for (const PersonFrame& frame : stream.frames) {
        Shown shown;
        Body body = frame.tracked;
        body.id = 1;
        const bool there =
            std::any_of(body.joints.begin(), body.joints.end(), [](const Joint& j) { return j.seen(); });
        if (motion.step(there ? &body : nullptr, body.time_ns)) {
            const Pose& pose = motion.pose();
            const PosedSkeleton posed = forward_kinematics(motion.skeleton(), pose);
            shown.valid = true;
            shown.world = posed.rotation;
            for (size_t side = 0; side < 2; ++side) {
                const auto foot = size_t(kFeet[side]);
                shown.planted[side] = pose.contacts & (side == 0 ? VFIT_CONTACT_LEFT : VFIT_CONTACT_RIGHT);
                shown.ankle[side] = posed.position[foot];
                shown.knee_rad[side] = angle_between(posed.position[foot - 1] - posed.position[foot - 2],
                                                     posed.position[foot] - posed.position[foot - 1]);
            }
        }
        out.push_back(shown);
    }
    return out;
}

void F1::add(const std::vector<char>& truth, const std::vector<char>& said_flags) {
    for (size_t i = 0; i < truth.size(); ++i) {
        said += size_t(said_flags[i]), said_right += said_flags[i] && found_near(truth, i);
        true_count += size_t(truth[i]), found += truth[i] && found_near(said_flags, i);
    }
}

void F1::merge(const F1& other) {
    said += other.said, said_right += other.said_right;
    true_count += other.true_count, found += other.found;
}

double F1::value() const {
    const double p = precision(), r = recall();
    return p + r > 0 ? 2 * p * r / (p + r) : 0.0;
}

void FeetScore::merge(const FeetScore& s) {
    lifted.merge(s.lifted), planted.merge(s.planted);
    contact_frames += s.contact_frames, skating += s.skating, moving += s.moving;
    for (auto [a, b] :
         {std::pair{&slides_m, &s.slides_m}, std::pair{&drifts_m, &s.drifts_m},
          std::pair{&jump_heights, &s.jump_heights}, std::pair{&pops, &s.pops},
          std::pair{&true_turning, &s.true_turning}, std::pair{&knee_errors_rad, &s.knee_errors_rad}})
        a->insert(a->end(), b->begin(), b->end());
}

double FeetScore::skating_percent() const { return percent(skating, contact_frames); }
double FeetScore::moving_percent() const { return percent(moving, contact_frames); }
double FeetScore::worst_pop() const {
    const double truly = quantile(true_turning, 0.99);
    return truly > 0.0 ? quantile(pops, 1.0) / truly : NAN;
}

FeetScore score_feet(const PersonStream& stream, const std::vector<Shown>& shown) {
    FeetScore score;
    for (size_t side = 0; side < 2; ++side) score_contacts(stream, shown, side, score);
    score_pops(stream, shown, score);
    if (stream.motion == "jump") score_jumps(stream, shown, score);
    return score;
}

double quantile(std::vector<double> v, double q) {
    if (v.empty()) return NAN;
    std::sort(v.begin(), v.end());
    return v[std::min(v.size() - 1, size_t(q * double(v.size())))];
}

}  // namespace vfit::tools
