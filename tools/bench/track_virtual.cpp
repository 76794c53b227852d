// The tracker's joints against the truth of virtual people.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

#include "bench/bench.h"
#include "bench/track_cases.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kWarmUp =
    15;  // frames: half a second in which the tracker gets to know the room and the person
constexpr double kDegree = 3.14159265358979 / 180.0;
// Views by how far the person is turned away in that frame; between them nobody is judged apart.
constexpr double kFront_rad = 45 * kDegree, kSideFrom_rad = 60 * kDegree, kSideTo_rad = 120 * kDegree,
                 kBack_rad = 135 * kDegree;

/// What is counted over a set of frames.
struct Tally {
    Errors errors;
    uint32_t frames = 0, missed = 0, swapped = 0, longest_swap = 0, extra_bodies = 0, id_changes = 0;

    void add(const Joints* tracked, const Joints& truth) {
        errors.add_all(tracked, truth);
        ++frames;
        missed += !tracked;
    }
    void merge(const Tally& t) {
        errors.merge(t.errors);
        frames += t.frames, missed += t.missed, swapped += t.swapped, extra_bodies += t.extra_bodies;
        longest_swap = std::max(longest_swap, t.longest_swap), id_changes += t.id_changes;
    }
    Json json() const {
        Json out = errors.json();
        out["frames"] = frames, out["frames_without_body"] = missed, out["frames_swapped"] = swapped;
        out["longest_swap"] = longest_swap, out["extra_bodies"] = extra_bodies,
        out["id_changes"] = id_changes;
        return out;
    }
};

struct Views {
    Tally all, front, side, back;
    void merge(const Views& v) {
        all.merge(v.all), front.merge(v.front), side.merge(v.side), back.merge(v.back);
    }
};

Views play(const TrackCase& one, vfit_track_fit fit) {
    Views views;
    uint32_t index = 0, swapped = 0, last_id = 0;
    play_tracked(one.uri, fit, [&](vfit_frame frame, vfit_frame tracked) {
        if (index++ < kWarmUp) return;
        const Joints truth = truth_of(frame);
        if (!truth.has(VFIT_JOINT_TORSO)) return;
        const uint32_t id = body_near(tracked, truth);
        const Joints found = id ? joints_in_camera(tracked, id, camera_of(tracked)) : Joints{};
        const bool swap = id && sides_are_exchanged(found, truth);
        swapped = swap ? swapped + 1 : 0;
        const double turned = turned_away_rad(truth);
        for (Tally* t : {&views.all, turned <= kFront_rad                               ? &views.front
                                     : turned >= kSideFrom_rad && turned <= kSideTo_rad ? &views.side
                                     : turned >= kBack_rad                              ? &views.back
                                                                                        : nullptr}) {
            if (!t) continue;
            t->add(id ? &found : nullptr, truth);
            t->swapped += swap;
            t->longest_swap = std::max(t->longest_swap, swapped);
        }
        const auto bodies = uint32_t(bodies_of(tracked).size());
        views.all.extra_bodies += bodies - (id ? 1 : 0);
        views.all.id_changes += id && last_id && id != last_id;
        if (id) last_id = id;
    });
    return views;
}

void print_line(const std::string& name, const Tally& t) {
    std::cout << "  " << std::left << std::setw(34) << name << std::right << std::fixed
              << std::setprecision(3) << std::setw(8) << t.errors.within(0.1) << std::setprecision(1)
              << std::setw(9) << 100 * t.errors.mean() << std::setw(9) << 100 * t.errors.median()
              << std::setw(8) << t.frames << std::setw(9) << t.missed << std::setw(9) << t.swapped
              << std::setw(7) << t.longest_swap << "\n";
}

void print_joints(const Views& v) {
    std::cout << "\n  joint              front: mAP   mean  median    side: mAP   mean    back: mAP   mean   "
                 "(cm)\n";
    for (int j = 0; j < kScored; ++j) {
        const auto cell = [&](const Errors& e, bool median) {
            std::cout << std::setprecision(3) << std::setw(12) << e.within(0.1, j) << std::setprecision(1)
                      << std::setw(7) << 100 * e.mean(j);
            if (median) std::cout << std::setw(8) << 100 * e.median(j);
        };
        std::cout << "  " << std::left << std::setw(16) << joint_name(j) << std::right;
        cell(v.front.errors, true), cell(v.side.errors, false), cell(v.back.errors, false);
        std::cout << "\n";
    }
}

/// mAP of both of a pair of joints: {left, right}.
double pair_within(const Errors& e, int left) {
    const auto n = [&](int j) { return double(e.missing(j)) + double(e.count_of(j)); };
    return (e.within(0.1, left) * n(left) + e.within(0.1, left + 1) * n(left + 1)) / (n(left) + n(left + 1));
}

}  // namespace

Json judge_virtual(const JudgeOptions& options, Targets& targets) {
    const std::vector<TrackCase> cases = track_cases(options.seed, options.long_run);
    Views everything;
    std::map<std::string, Views> by_sensor;
    std::vector<std::pair<std::string, Views>> by_what;
    Json rows = Json::array();
    if (!options.quiet)
        std::cout << "\nSYNTHETIC: " << cases.size()
                  << " virtual people whom no training has seen, clothes of 1 to 3 cm, "
                  << "seed " << options.seed << "\n"
                  << "  what                                   mAP     mean   median  frames  no body  "
                     "swapped longest\n";
    for (const TrackCase& one : cases) {
        const Views views = play(one, options.fit);
        rows.push_back(
            {{"what", one.what}, {"sensor", one.sensor}, {"uri", one.uri}, {"all", views.all.json()}});
        everything.merge(views);
        by_sensor[one.sensor].merge(views);
        const auto row =
            std::find_if(by_what.begin(), by_what.end(), [&](const auto& r) { return r.first == one.what; });
        if (row == by_what.end())
            by_what.emplace_back(one.what, views);
        else
            row->second.merge(views);
        if (!options.quiet) print_line(one.sensor + ", " + one.what, views.all);
    }
    Json report = {{"cases", rows}, {"warm_up_frames", kWarmUp}};
    const auto keep = [&](const char* key, const std::string& title, const Tally& t) {
        report[key] = t.json();
        if (!options.quiet) print_line(title, t);
    };
    if (!options.quiet) std::cout << "\n";
    for (const auto& [sensor, views] : by_sensor) keep(sensor.c_str(), sensor + ", all views", views.all);
    for (const auto& [what, views] : by_what)
        if (what == "arms crossed" || what == "sitting down") keep(what.c_str(), what, views.all);
    keep("front", "front, turned by 0 to 45 degrees", everything.front);
    keep("side", "side, turned by 60 to 120", everything.side);
    keep("back", "back, turned by 135 to 180", everything.back);
    keep("all", "everything", everything.all);
    if (!options.quiet) {
        print_joints(everything);
        std::cout << "  bodies reported where no person is: " << everything.all.extra_bodies
                  << ", changes of the id: " << everything.all.id_changes << "\n\n";
    }
    const Errors &front = everything.front.errors, &side = everything.side.errors,
                 &back = everything.back.errors;
    targets.judge("front: joints within 10 cm", front.within(0.1), Aim::at_least, 0.96, 3);
    targets.judge("front: mean joint error", 100 * front.mean(), Aim::at_most, 3.5, 1, " cm");
    targets.judge("front: elbows within 10 cm", pair_within(front, VFIT_JOINT_LEFT_ELBOW), Aim::at_least,
                  0.90, 3);
    targets.judge("front: hands within 10 cm", pair_within(front, VFIT_JOINT_LEFT_HAND), Aim::at_least, 0.90,
                  3);
    targets.judge("side view: joints within 10 cm", side.within(0.1), Aim::at_least, 0.88, 3);
    targets.judge("back view: joints within 10 cm", back.within(0.1), Aim::at_least, 0.88, 3);
    return report;
}

}  // namespace vfit::tools
