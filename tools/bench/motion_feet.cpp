// Foot contacts, skating, drift, jumps and pops of the motion stage on virtual people seen by the tracker.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "body/joint_bones.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 3, kFrames = 330;
constexpr size_t kWarmUp = 30;
constexpr int kNear = 1;            // frames: a contact may be seen so much earlier or later
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

/// What motion showed in one frame.
struct Shown {
    bool valid = false;
    std::array<bool, 2> planted{};
    std::array<Vec3, 2> ankle{};
    std::array<Quat, kBoneCount> world;
    float correction_m = 0;
};

std::vector<Shown> play(const PersonStream& stream) {
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
            shown.correction_m = pose.foot_correction_m;
            for (size_t side = 0; side < 2; ++side) {
                shown.planted[side] = pose.contacts & (side == 0 ? VFIT_CONTACT_LEFT : VFIT_CONTACT_RIGHT);
                shown.ankle[side] = posed.position[size_t(kFeet[side])];
            }
        }
        out.push_back(shown);
    }
    return out;
}

/// Frames of a class found within kNear frames, of the truth and of what was said.
struct F1 {
    size_t said = 0, said_right = 0, true_count = 0, found = 0;
    void add(const std::vector<char>& truth, const std::vector<char>& said_flags) {
        const auto near = [](const std::vector<char>& v, size_t i) {
            for (size_t k = i > kNear ? i - kNear : 0; k <= std::min(v.size() - 1, i + kNear); ++k)
                if (v[k]) return true;
            return false;
        };
        for (size_t i = 0; i < truth.size(); ++i) {
            said += size_t(said_flags[i]), said_right += said_flags[i] && near(truth, i);
            true_count += size_t(truth[i]), found += truth[i] && near(said_flags, i);
        }
    }
    double precision() const { return said ? double(said_right) / double(said) : 0.0; }
    double recall() const { return true_count ? double(found) / double(true_count) : 0.0; }
    double value() const {
        const double p = precision(), r = recall();
        return p + r > 0 ? 2 * p * r / (p + r) : 0.0;
    }
};

struct Score {
    F1 lifted, planted;
    size_t contact_frames = 0, skating = 0;
    std::vector<double> drifts_m;
    std::vector<double> pops, true_turning;  // rad/s^2
    std::vector<double> jump_heights;        // share of the truth's
    void merge(const Score& s) {
        for (auto [a, b] : {std::pair{&lifted, &s.lifted}, std::pair{&planted, &s.planted}})
            a->said += b->said, a->said_right += b->said_right, a->true_count += b->true_count,
                a->found += b->found;
        contact_frames += s.contact_frames, skating += s.skating;
        for (auto [a, b] : {std::pair{&drifts_m, &s.drifts_m}, std::pair{&jump_heights, &s.jump_heights},
                            std::pair{&pops, &s.pops}, std::pair{&true_turning, &s.true_turning}})
            a->insert(a->end(), b->begin(), b->end());
    }
};

double quantile(std::vector<double> v, double q) {
    if (v.empty()) return NAN;
    std::sort(v.begin(), v.end());
    return v[std::min(v.size() - 1, size_t(q * double(v.size())))];
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

Score judge_stream(const PersonStream& stream, const std::vector<Shown>& shown) {
    Score score;
    const size_t n = stream.frames.size();
    for (size_t side = 0; side < 2; ++side) {
        std::vector<char> truth, said;
        for (size_t i = kWarmUp; i < n; ++i) {
            truth.push_back(!stream.frames[i].planted[side]);
            said.push_back(shown[i].valid && !shown[i].planted[side]);
        }
        score.lifted.add(truth, said);
        for (auto* v : {&truth, &said})
            for (char& c : *v) c = !c;
        score.planted.add(truth, said);

        size_t since = 1000;  // frames since the touchdown
        Vec3 place(0.0f);
        double drift = 0;
        for (size_t i = kWarmUp; i <= n; ++i) {
            const bool planted = i < n && stream.frames[i].planted[side];
            if (!planted) {
                if (since > kSettle && since < 1000) score.drifts_m.push_back(drift);
                since = 0;
                continue;
            }
            ++since;
            if (!shown[i].valid || !shown[i - 1].valid || since <= kSettle) continue;
            if (since == kSettle + 1) place = shown[i].ankle[side], drift = 0;
            const Vec3 moved = shown[i].ankle[side] - shown[i - 1].ankle[side];
            drift = std::max(drift, double(glm::length(Vec2(shown[i].ankle[side].x - place.x,
                                                            shown[i].ankle[side].z - place.z))));
            if (since == kSettle + 1) continue;
            ++score.contact_frames;
            score.skating += double(glm::length(Vec2(moved.x, moved.z))) / kFrame_s > kSkating;
        }
    }
    for (size_t i = kWarmUp; i + 1 < n; ++i) {
        const bool valid = shown[i - 1].valid && shown[i].valid && shown[i + 1].valid;
        bool switches = false;
        for (size_t k = i - 1; k <= i + 1; ++k)
            switches = switches || shown[k].planted != shown[k - 1].planted;
        for (const int bone : kTurning) {
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
    // Each flight: how high the lower foot gets, of how high it truly does.
    for (size_t i = kWarmUp; stream.motion == "jump" && i < n; ++i) {
        const auto flies = [&](size_t k) {
            return k < n && !stream.frames[k].planted[0] && !stream.frames[k].planted[1];
        };
        if (!flies(i) || flies(i - 1)) continue;
        const auto lower_foot = [&](size_t k, bool truth) {
            const auto y = [&](size_t side) {
                return truth ? stream.frames[k].truth.at(VFIT_JOINT_LEFT_FOOT + int(side)).y
                             : shown[k].ankle[side].y;
            };
            return double(std::min(y(0), y(1)));
        };
        double height = 0, true_height = 0;
        for (size_t k = i; flies(k); ++k) {
            height = std::max(height, lower_foot(k, false) - lower_foot(i - 1, false));
            true_height = std::max(true_height, lower_foot(k, true) - lower_foot(i - 1, true));
        }
        score.jump_heights.push_back(height / true_height);
    }
    return score;
}

/// The largest angular acceleration at a switch over the 99th percentile of the true motion.
double worst_pop(const Score& s) { return quantile(s.pops, 1.0) / quantile(s.true_turning, 0.99); }

void print(const std::string& name, const Score& s) {
    std::cout << "  " << std::left << std::setw(10) << name << std::right << std::fixed
              << std::setprecision(3) << std::setw(9) << s.lifted.precision() << std::setw(9)
              << s.lifted.recall() << std::setw(9) << s.lifted.value() << std::setw(11) << s.planted.value()
              << std::setprecision(2) << std::setw(11)
              << 100.0 * double(s.skating) / double(std::max<size_t>(1, s.contact_frames))
              << std::setprecision(1) << std::setw(10) << 1e3 * quantile(s.drifts_m, 0.5) << std::setw(8)
              << 1e3 * quantile(s.drifts_m, 0.95) << std::setprecision(2) << std::setw(8) << worst_pop(s)
              << "\n";
}

}  // namespace

Json judge_feet(const MotionJudge& judge) {
    const std::vector<PersonStream> streams = people_on_their_feet(kPeople, kFrames);
    std::map<std::string, Score> by_motion;
    Score all;
    size_t lifted = 0, count = 0;
    for (const PersonStream& stream : streams) {
        const Score score = judge_stream(stream, play(stream));
        by_motion[stream.motion].merge(score);
        all.merge(score);
        for (const PersonFrame& f : stream.frames)
            for (const bool planted : f.planted) lifted += !planted, ++count;
    }
    const double share = double(lifted) / double(count);
    if (!judge.quiet) {
        std::cout << "\nFeet. SYNTHETIC: virtual people, " << streams.size()
                  << " streams, seen by the tracker in a Kinect v1's images; " << std::fixed
                  << std::setprecision(1) << 100 * share << " % of feet are lifted\n(always planted scores "
                  << std::setprecision(2) << 2 * (1 - share) / (2 - share)
                  << " on the planted class). Within one frame.\n"
                  << "  motion     lifted: P        R       F1  planted F1  skating, %  drift, mm: p50  p95  "
                     "   pop\n";
        for (const auto& [name, score] : by_motion) print(name, score);
        print("all", all);
    }
    Targets& t = judge.targets;
    t.judge("SYNTHETIC, lifted feet, F1 within a frame", all.lifted.value(), Aim::at_least, 0.90, 3);
    t.judge("SYNTHETIC, planted feet, F1 within a frame", all.planted.value(), Aim::at_least, 0.97, 3);
    t.judge("SYNTHETIC, frames of contact in which the foot skates",
            100.0 * double(all.skating) / double(std::max<size_t>(1, all.contact_frames)), Aim::at_most, 2.0,
            2, " %");
    t.judge("SYNTHETIC, drift in a contact, 95 of 100", 1e3 * quantile(all.drifts_m, 0.95), Aim::at_most, 5.0,
            1, " mm");
    t.judge("SYNTHETIC, a jump's height, least share of the truth", quantile(all.jump_heights, 0.0),
            Aim::at_least, 0.5, 2);
    Score captured;
    for (const PersonStream& stream : captured_walks(judge.shared, kFrames))
        captured.merge(judge_stream(stream, play(stream)));
    double pop = 0;
    for (const auto& [name, score] : by_motion) pop = std::max(pop, worst_pop(score));
    t.judge("SYNTHETIC, largest angular acceleration at a contact's switch over that motion's p99", pop,
            Aim::at_most, 2.0, 2);
    if (captured.contact_frames) {
        if (!judge.quiet) print("captured", captured);
        t.judge("SYNTHETIC people, captured walks: lifted feet, F1 within a frame", captured.lifted.value(),
                Aim::at_least, 0.90, 3);
        t.judge("SYNTHETIC people, captured walks: planted feet, F1 within a frame", captured.planted.value(),
                Aim::at_least, 0.97, 3);
    }
    return {{"lifted_f1", all.lifted.value()}, {"planted_f1", all.planted.value()}, {"lifted_share", share}};
}

}  // namespace vfit::tools
