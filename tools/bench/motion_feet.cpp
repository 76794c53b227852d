// Foot contacts, feet that stand still, straight knees, jumps and pops of the motion stage on virtual people:
// seen by the tracker, and by ideal joints under noise.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/feet_score.h"
#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "bench/puppets.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 3, kFrames = 330;
constexpr double kDegrees = 180.0 / 3.14159265358979;

using ScoresByMotion = std::map<std::string, FeetScore>;

/// The scores of each motion, and of all.
FeetScore score_all(const std::vector<PersonStream>& streams, ScoresByMotion* by_motion = nullptr) {
    FeetScore all;
    for (const PersonStream& stream : streams) {
        const FeetScore score = score_feet(stream, show_motion(stream));
        all.merge(score);
        if (by_motion) (*by_motion)[stream.motion].merge(score);
    }
    return all;
}

void print_head(const std::string& first) {
    std::cout
        << "  " << std::left << std::setw(16) << first << std::right
        << "lifted: P       R      F1  planted F1  slides, %  moves, %  drift, mm: p50     p95  jump: least"
           "  p50    pop  knees, deg: p50  p95\n";
}

void print(const std::string& name, const FeetScore& s) {
    std::cout << "  " << std::left << std::setw(16) << name << std::right << std::fixed
              << std::setprecision(3) << std::setw(9) << s.lifted.precision() << std::setw(8)
              << s.lifted.recall() << std::setw(8) << s.lifted.value() << std::setw(12) << s.planted.value()
              << std::setprecision(2) << std::setw(11) << s.skating_percent() << std::setw(10)
              << s.moving_percent() << std::setprecision(1) << std::setw(15)
              << 1e3 * quantile(s.drifts_m, 0.5) << std::setw(8) << 1e3 * quantile(s.drifts_m, 0.95)
              << std::setprecision(2) << std::setw(13) << quantile(s.jump_heights, 0.0) << std::setw(5)
              << quantile(s.jump_heights, 0.5) << std::setw(7) << s.worst_pop() << std::setprecision(1)
              << std::setw(17) << kDegrees * quantile(s.knee_errors_rad, 0.5) << std::setw(5)
              << kDegrees * quantile(s.knee_errors_rad, 0.95) << "\n";
}

/// Planted feet stand still in all three axes.
void judge_stillness(const std::string& name, const FeetScore& s, Targets& t) {
    t.judge("SYNTHETIC, " + name + ": frames of contact in which the foot moves", s.moving_percent(),
            Aim::at_most, 1.0, 2, " %");
    t.judge("SYNTHETIC, " + name + ": drift in a contact, 95 of 100", 1e3 * quantile(s.drifts_m, 0.95),
            Aim::at_most, 3.0, 1, " mm");
}

void judge_contacts(const std::string& name, const FeetScore& s, double lifted, double planted, Targets& t) {
    t.judge("SYNTHETIC, " + name + ": lifted feet, F1 within a frame", s.lifted.value(), Aim::at_least,
            lifted, 3);
    t.judge("SYNTHETIC, " + name + ": planted feet, F1 within a frame", s.planted.value(), Aim::at_least,
            planted, 3);
}

/// Knees of a person who stands straight, and how still the feet are.
Json judge_standing(Targets& t) {
    const std::vector<PersonStream> ideal{straight_puppet()};
    const FeetScore clean = score_all(ideal), noisy = score_all(with_noisy_joints(ideal));
    const double clean_deg = kDegrees * quantile(clean.knee_errors_rad, 0.5);
    const double noisy_deg = kDegrees * quantile(noisy.knee_errors_rad, 0.5);
    t.judge("SYNTHETIC, standing straight, ideal joints: knees bent by, median", clean_deg, Aim::at_most, 5.0,
            1, " deg");
    t.judge("SYNTHETIC, standing straight, noisy ideal joints: knees bent by, median", noisy_deg,
            Aim::at_most, 8.0, 1, " deg");
    judge_stillness("standing straight, noisy ideal joints", noisy, t);
    return {{"ideal_knees_deg", clean_deg}, {"noisy_knees_deg", noisy_deg}};
}

}  // namespace

Json judge_feet(const MotionJudge& judge) {
    const std::vector<PersonStream> tracked = people_on_their_feet(kPeople, kFrames);
    const std::vector<PersonStream> captured = captured_walks(judge.shared, kFrames);
    size_t lifted = 0, count = 0;
    for (const PersonStream& stream : tracked)
        for (const PersonFrame& f : stream.frames)
            for (const bool planted : f.planted) lifted += !planted, ++count;
    const double share = double(lifted) / double(count);
    if (!judge.quiet)
        std::cout
            << "\nFeet. SYNTHETIC: virtual people, " << tracked.size()
            << " streams, seen by the tracker in a Kinect v1's images, and by their true joints under noise"
            << "\n(sd 1 cm an axis, 1 % of readings 8 cm off); " << std::fixed << std::setprecision(1)
            << 100 * share << " % of feet are lifted (always planted scores " << std::setprecision(2)
            << 2 * (1 - share) / (2 - share)
            << " on the planted class).\nContacts within one frame; slides along the floor, moves in any "
               "direction, faster than 2.5 cm/s.\n";
    FeetScore all[2];
    double pop = 0;
    for (const bool noisy : {false, true}) {
        ScoresByMotion by_motion;
        all[noisy] = score_all(noisy ? with_noisy_joints(tracked) : tracked, &by_motion);
        if (!judge.quiet) {
            print_head(noisy ? "noisy ideal" : "tracked");
            for (const auto& [name, score] : by_motion) print(name, score);
            print("all", all[noisy]);
        }
        if (noisy) continue;
        for (const auto& [name, score] : by_motion) pop = std::max(pop, score.worst_pop());
    }
    Targets& t = judge.targets;
    judge_contacts("tracked", all[0], 0.93, 0.98, t);
    judge_stillness("tracked", all[0], t);
    t.judge("SYNTHETIC, tracked: frames of contact in which the foot skates", all[0].skating_percent(),
            Aim::at_most, 2.0, 2, " %");
    t.judge("SYNTHETIC, tracked: a jump's height, least share of the truth",
            quantile(all[0].jump_heights, 0.0), Aim::at_least, 0.5, 2);
    t.judge("SYNTHETIC, tracked: a jump's height, median share of the truth",
            quantile(all[0].jump_heights, 0.5), Aim::at_least, 0.9, 2);
    t.judge("SYNTHETIC, largest angular acceleration at a contact's switch over that motion's p99", pop,
            Aim::at_most, 2.0, 2);
    judge_contacts("noisy ideal joints", all[1], 0.93, 0.98, t);
    judge_stillness("noisy ideal joints", all[1], t);
    t.judge("SYNTHETIC, noisy ideal joints: a jump's height, median share of the truth",
            quantile(all[1].jump_heights, 0.5), Aim::at_least, 0.9, 2);
    const Json standing = judge_standing(t);
    {
        ScoresByMotion by_motion;
        const std::vector<PersonStream> clean = puppets(kPeople);
        const FeetScore exact = score_all(clean), noisy = score_all(with_noisy_joints(clean), &by_motion);
        if (!judge.quiet) {
            print_head("puppets, noisy");
            for (const auto& [name, score] : by_motion) print(name, score);
            print("all", noisy);
            print("without noise", exact);
        }
        judge_contacts("puppets, noisy ideal joints", noisy, 0.93, 0.98, t);
        judge_stillness("puppets, noisy ideal joints", noisy, t);
        judge_contacts("puppets, ideal joints", exact, 0.93, 0.98, t);
        judge_stillness("puppets, ideal joints", exact, t);
    }
    if (!captured.empty()) {
        const FeetScore seen = score_all(captured), noisy = score_all(with_noisy_joints(captured));
        if (!judge.quiet) {
            print_head("captured walks");
            print("tracked", seen);
            print("noisy ideal", noisy);
        }
        judge_contacts("people of captured walks, tracked", seen, 0.90, 0.90, t);
        judge_contacts("people of captured walks, noisy ideal joints", noisy, 0.90, 0.90, t);
        judge_stillness("people of captured walks, tracked", seen, t);
        judge_stillness("people of captured walks, noisy ideal joints", noisy, t);
    }
    return {{"lifted_f1", all[0].lifted.value()},
            {"planted_f1", all[0].planted.value()},
            {"lifted_share", share},
            {"standing", standing}};
}

}  // namespace vfit::tools
