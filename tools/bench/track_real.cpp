// The tracker's own joints against those of another middleware on real recordings.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/track_parts.h"
#include "bench/track_score.h"

namespace vfit::tools {

namespace {

// The reference's joints and the depth were stored by clocks of their own: how many frames later the depth
// shows what a reference frame says.
constexpr int kMostLead = 2;
using ByLead = std::array<std::vector<Pair>, 2 * kMostLead + 1>;

struct Run {
    std::string name, person;
    ByLead by_lead;
    uint32_t frames = 0, missed = 0, longest_swap = 0, jumps = 0;

    std::vector<Pair>& at(int lead) { return by_lead[size_t(lead + kMostLead)]; }
    const std::vector<Pair>& at(int lead) const { return by_lead[size_t(lead + kMostLead)]; }
};

constexpr const char* kFirstPerson = "s1";
constexpr double kBoneTolerance =
    0.15;  // of the recording's median, beyond which a reference frame is left out
constexpr int kSilhouettePixels = 3;
constexpr double kSurface_m = 0.12;  // of an arm's joint to its skin, and the sensor's error

/// The bones by which the reference's frames are judged.
constexpr std::array<std::pair<int, int>, 9> kBones = {{{VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
                                                        {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
                                                        {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND},
                                                        {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_HAND},
                                                        {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
                                                        {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE},
                                                        {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT},
                                                        {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT},
                                                        {VFIT_JOINT_NECK, VFIT_JOINT_TORSO}}};

double bone_length(const Joints& joints, size_t bone) {
    double sum = 0.0;
    for (size_t k = 0; k < 3; ++k) {
        const double d = joints.at[size_t(kBones[bone].first)][k] - joints.at[size_t(kBones[bone].second)][k];
        sum += d * d;
    }
    return std::sqrt(sum);
}

void mark_usable(std::vector<Pair>& pairs) {
    for (size_t bone = 0; bone < kBones.size(); ++bone) {
        std::vector<double> lengths;
        for (const Pair& p : pairs)
            if (const double l = bone_length(p.reference, bone); std::isfinite(l)) lengths.push_back(l);
        if (lengths.empty()) continue;
        std::nth_element(lengths.begin(), lengths.begin() + long(lengths.size() / 2), lengths.end());
        const double usual = lengths[lengths.size() / 2];
        for (Pair& p : pairs)
            if (std::abs(bone_length(p.reference, bone) / usual - 1.0) > kBoneTolerance) p.usable = false;
    }
}

/// Whether the reference joint lies on the person's pixels, or a few beside them.
bool on_silhouette(vfit_frame frame, const vfit_intrinsics& k, const std::array<double, 3>& p) {
    const vfit_view map = view_of(frame, VFIT_STREAM_USER_MAP);
    const int u = int(std::lround(p[0] / p[2] * k.fx + k.cx)),
              v = int(std::lround(p[1] / p[2] * k.fy + k.cy));
    for (int y = v - kSilhouettePixels; y <= v + kSilhouettePixels; ++y)
        for (int x = u - kSilhouettePixels; x <= u + kSilhouettePixels; ++x)
            if (x >= 0 && y >= 0 && x < int(map.width) && y < int(map.height) &&
                row_of<uint8_t>(map, uint32_t(y))[x])
                return true;
    return false;
}

bool is_of_lower_arm(int joint) {
    return joint == VFIT_JOINT_LEFT_HAND || joint == VFIT_JOINT_RIGHT_HAND ||
           joint == VFIT_JOINT_LEFT_ELBOW || joint == VFIT_JOINT_RIGHT_ELBOW;
}

/// Whether the reference joint lies at the depth that is measured there, give or take an arm's thickness.
bool on_surface(vfit_frame frame, const vfit_intrinsics& k, double unit_m, const std::array<double, 3>& p) {
    const vfit_view map = view_of(frame, VFIT_STREAM_USER_MAP), depth = view_of(frame, VFIT_STREAM_DEPTH);
    const int u = int(std::lround(p[0] / p[2] * k.fx + k.cx)),
              v = int(std::lround(p[1] / p[2] * k.fy + k.cy));
    uint16_t nearest = 65535;
    for (int y = std::max(0, v - kSilhouettePixels);
         y <= std::min(int(map.height) - 1, v + kSilhouettePixels); ++y)
        for (int x = std::max(0, u - kSilhouettePixels);
             x <= std::min(int(map.width) - 1, u + kSilhouettePixels); ++x) {
            const uint16_t z = row_of<uint16_t>(depth, uint32_t(y))[x];
            if (z && row_of<uint8_t>(map, uint32_t(y))[x]) nearest = std::min(nearest, z);
        }
    return nearest != 65535 && std::abs(p[2] - double(nearest) * unit_m) <= kSurface_m;
}

/// The reference's joints of each frame, in camera space; without any where it saw nobody.
std::vector<Joints> references_of(const std::string& path) {
    std::vector<Joints> out;
    const Context context = open_context();
    Source source(context.get(), path);
    while (const auto frame = source.next()) {
        const uint32_t id = first_body(frame->get());
        out.push_back(id ? joints_in_camera(frame->get(), id, camera_of(frame->get())) : Joints{});
    }
    return out;
}

Run track(const std::string& path, vfit_track_fit fit, Samples& times) {
    Run run;
    run.name = std::filesystem::path(path).filename().string();
    const std::vector<Joints> references = references_of(path);
    const Context context = open_context();
    Source source(context.get(), path);
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = VFIT_TRACK_BUILT_IN;
    desc.fit = fit;
    Tracker tracker;
    check(vfit_tracker_create(context.get(), &desc, tracker.out()));
    while (const auto frame = source.next()) {
        const Timer timer;
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        times.add(timer.ms());
        const int index = int(run.frames++);
        const uint32_t id = first_body(tracked.get());
        if (!id) {
            run.missed += references[size_t(index)].has(VFIT_JOINT_TORSO);
            continue;
        }
        Pair pair;
        pair.tracked = joints_in_camera(tracked.get(), id, camera_of(tracked.get()));
        vfit_intrinsics k = vfit_intrinsics_init();
        check(vfit_frame_intrinsics(frame->get(), &k));
        for (int lead = -kMostLead; lead <= kMostLead; ++lead) {
            const int i = index - lead;
            if (i < 0 || i >= int(references.size()) || !references[size_t(i)].has(VFIT_JOINT_TORSO))
                continue;
            pair.reference = references[size_t(i)];
            for (int j = 0; j < kScored; ++j) {
                if (!pair.reference.has(j)) continue;
                pair.on_body[size_t(j)] = on_silhouette(tracked.get(), k, pair.reference.at[size_t(j)]);
                // Joints of trunk and head may lie deep in the body.
                pair.on_surface[size_t(j)] =
                    !is_of_lower_arm(j) || on_surface(tracked.get(), k, camera_of(tracked.get()).depth_unit_m,
                                                      pair.reference.at[size_t(j)]);
            }
            run.at(lead).push_back(pair);
        }
    }
    for (auto& pairs : run.by_lead) mark_usable(pairs);
    return run;
}

void count_swaps_and_jumps(Run& run) {
    uint32_t swapped = 0;
    const std::vector<Pair>& pairs = run.at(0);
    for (size_t i = 0; i < pairs.size(); ++i) {
        const Pair& p = pairs[i];
        swapped = sides_are_exchanged(p.tracked, p.reference) ? swapped + 1 : 0;
        run.longest_swap = std::max(run.longest_swap, swapped);
        if (i == 0) continue;
        for (int j = 0; j < kScored; ++j)
            if (distance(p.tracked, pairs[i - 1].tracked, j) > 0.20 &&
                distance(p.reference, pairs[i - 1].reference, j) < 0.05)
                ++run.jumps;
    }
}

/// Which of the reference's joints count.
enum class Which { kAll, kOnSilhouette, kOnSurface };

bool counts(const Pair& p, size_t joint, Which which) {
    return which == Which::kAll ||
           (p.on_body[joint] && (which == Which::kOnSilhouette || p.on_surface[joint]));
}

/// Whose runs.
enum class Whose { kEverybody, kFirst, kOthers };

bool counts(const Run& run, Whose whose) {
    return whose == Whose::kEverybody || (run.person == kFirstPerson) == (whose == Whose::kFirst);
}

/// Errors of the runs where the depth shows the reference that many frames later.
Errors errors_of(const std::vector<Run>& runs, Whose whose, const Offsets& offsets, int lead, Which which) {
    Errors errors;
    for (const Run& run : runs) {
        if (!counts(run, whose)) continue;
        for (const Pair& p : run.at(lead)) {
            if (!p.usable) continue;
            const Joints found = offsets.apply(p.tracked);
            for (int j = 0; j < kScored; ++j)
                if (const double d = distance(found, p.reference, j);
                    std::isfinite(d) && counts(p, size_t(j), which))
                    errors.add(j, d);
        }
    }
    return errors;
}

/// The constant differences between the two middlewares, fitted on the first person.
struct Definition {
    int lead = 0;
    Offsets offsets;
};

Offsets offsets_of(const std::vector<Run>& runs, int lead) {
    std::vector<Pair> pairs;
    for (const Run& run : runs)
        if (counts(run, Whose::kFirst)) pairs.insert(pairs.end(), run.at(lead).begin(), run.at(lead).end());
    return Offsets::fit(pairs);
}

Definition definition_of(const std::vector<Run>& runs) {
    Definition best;
    double most = -1.0;
    for (int lead = -kMostLead; lead <= kMostLead; ++lead) {
        const Offsets offsets = offsets_of(runs, lead);
        const double within = errors_of(runs, Whose::kFirst, offsets, lead, Which::kOnSilhouette).within(0.1);
        if (within > most) most = within, best = {lead, offsets};
    }
    return best;
}

/// Of the reference's hands and elbows: how many lie on the depth that was measured that many frames later.
/// It owes nothing to our joints.
double on_surface_share(const std::vector<Run>& runs, int lead) {
    size_t all = 0, on = 0;
    for (const Run& run : runs)
        for (const Pair& p : run.at(lead))
            for (int j = 0; j < kScored; ++j)
                if (is_of_lower_arm(j) && p.reference.has(j)) ++all, on += p.on_surface[size_t(j)];
    return all ? double(on) / double(all) : 0.0;
}

void print_errors(const char* title, const Errors& e) {
    std::cout << std::left << std::setw(62) << title << std::right << " median " << std::setw(4)
              << std::lround(1000 * e.median()) << " mm  within 10 cm " << std::fixed << std::setprecision(3)
              << e.within(0.1) << "  (" << e.count() << " joints)\n";
}

void print_table(const std::array<const Errors*, 4>& columns, const Offsets& offsets) {
    std::cout << "                   raw            offset         offset, lead   same, on the silhouette   "
                 "(median mm, within 10 cm);   the offset to the left, up, ahead (mm)\n";
    for (int j = 0; j < kScored; ++j) {
        std::cout << "  " << std::left << std::setw(16) << joint_name(j) << std::right;
        for (const Errors* e : columns)
            std::cout << std::setw(5) << std::lround(1000 * e->median(j)) << "  " << std::setprecision(2)
                      << e->within(0.1, j) << "    ";
        for (const double x : offsets.of(j)) std::cout << std::setw(6) << std::lround(1000 * x);
        std::cout << "\n";
    }
}

void print(const std::vector<Run>& runs, const Errors& raw, const Errors& off, const Errors& lead,
           const Errors& best, const Errors& surface, const Definition& definition, const Samples& times) {
    std::cout << "REAL recordings, own joints against those of the recordings' middleware, which err by 5 to "
                 "10 cm themselves\n";
    for (const Run& run : runs) {
        const Errors e = errors_of({run}, Whose::kEverybody, Offsets{}, 0, Which::kAll);
        std::cout << "  " << std::left << std::setw(28) << run.name << std::right << std::setw(4)
                  << run.frames << " frames, " << run.missed << " missed, raw median " << std::setw(4)
                  << std::lround(1000 * e.median()) << " mm, within 10 cm " << std::fixed
                  << std::setprecision(2) << e.within(0.1) << ", longest swap " << run.longest_swap
                  << ", jumps " << run.jumps << "\n";
    }
    std::cout << "the reference's hands and elbows on the depth of the frame";
    for (int lead = -kMostLead; lead <= kMostLead; ++lead)
        std::cout << (lead == -kMostLead ? " " : ", ") << std::showpos << lead << std::noshowpos << ": "
                  << std::setprecision(3) << on_surface_share(runs, lead);
    std::cout << "\n";
    print_errors("raw, everybody", raw);
    print_errors("offset per joint fitted on s1, the others", off);
    print_errors(("same, depth " + std::to_string(definition.lead) + " frames later (by s1)").c_str(), lead);
    print_errors("same, reference on the silhouette", best);
    print_errors("same, not judged: without arms that hang in the air", surface);
    print_table({&raw, &off, &lead, &best}, definition.offsets);
    std::cout << "  update: median " << times.quantile(0.5) << " ms, p95 " << times.quantile(0.95)
              << " ms while the reader of the files shares the core\n";
}

void judge_errors(const std::vector<Run>& runs, const Errors& raw, const Errors& off, const Errors& lead,
                  const Errors& best, Targets& targets) {
    uint32_t swap = 0, jumps = 0;
    for (const Run& run : runs) swap = std::max(swap, run.longest_swap), jumps += run.jumps;
    double hands = 0.0, others = 0.0;
    for (int j = 0; j < kScored; ++j) {
        double& worst = j == VFIT_JOINT_LEFT_HAND || j == VFIT_JOINT_RIGHT_HAND ? hands : others;
        worst = std::max(worst, 1000 * best.median(j));
    }
    const auto both = [&](const std::string& what, const Errors& e, double median_mm, double within) {
        targets.judge(what + ": median", 1000 * e.median(), Aim::at_most, median_mm, 1, " mm");
        targets.judge(what + ": joints within 10 cm", e.within(0.1), Aim::at_least, within, 3);
    };
    both("raw", raw, 50, 0.90);
    both("offset fitted on s1", off, 28, 0.95);
    const auto worse = [&](const std::string& what, vfit_joint_id left, vfit_joint_id right, double within) {
        targets.judge("offset, lead: " + what + " within 10 cm, the worse side",
                      std::min(lead.within(0.1, left), lead.within(0.1, right)), Aim::at_least, within, 3);
    };
    targets.judge("offset, lead: joints within 10 cm", lead.within(0.1), Aim::at_least, 0.96, 3);
    worse("hands", VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND, 0.85);
    worse("elbows", VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_RIGHT_ELBOW, 0.95);
    both("offset, lead, on the silhouette", best, 25, 0.98);
    targets.judge("same: worse hand, median", hands, Aim::at_most, 45, 1, " mm");
    targets.judge("same: worst other joint, median", others, Aim::at_most, 35, 1, " mm");
    targets.judge("left and right exchanged, frames at a time", swap, Aim::at_most, 3);
    targets.judge("jumps over 20 cm where the reference moves under 5", jumps, Aim::exactly, 0);
}

}  // namespace

Json judge_real(const std::string& folder, const JudgeOptions& options, Targets& targets) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_directory()) paths.push_back(entry.path());
    if (paths.empty()) throw Failure(folder + ": holds no recordings");
    std::sort(paths.begin(), paths.end());
    std::vector<Run> runs;
    Samples times;
    for (const auto& path : paths) {
        Run run = track(path.string(), options.fit, times);
        const size_t a = run.name.find("_s"), b = run.name.find('_', a + 1);
        run.person = a == std::string::npos ? run.name : run.name.substr(a + 1, b - a - 1);
        count_swaps_and_jumps(run);
        runs.push_back(std::move(run));
    }
    const Offsets none{};
    const Definition definition = definition_of(runs);
    const Errors raw = errors_of(runs, Whose::kEverybody, none, 0, Which::kAll),
                 off = errors_of(runs, Whose::kOthers, offsets_of(runs, 0), 0, Which::kAll),
                 lead = errors_of(runs, Whose::kOthers, definition.offsets, definition.lead, Which::kAll),
                 best = errors_of(runs, Whose::kOthers, definition.offsets, definition.lead,
                                  Which::kOnSilhouette),
                 // Says how much of what is missed is the reference's own: some of its hands hang in the air.
        surface = errors_of(runs, Whose::kOthers, definition.offsets, definition.lead, Which::kOnSurface);

    Json rows = Json::array();
    for (const Run& run : runs)
        rows.push_back({{"recording", run.name},
                        {"frames", run.frames},
                        {"missed", run.missed},
                        {"longest_swap", run.longest_swap},
                        {"jumps", run.jumps},
                        {"raw", errors_of({run}, Whose::kEverybody, none, 0, Which::kAll).json()}});
    const Json report = {{"update_ms", times.json()},    {"raw", raw.json()},
                         {"offset", off.json()},         {"lead_frames", definition.lead},
                         {"offset_lead", lead.json()},   {"offset_lead_on_body", best.json()},
                         {"on_surface", surface.json()}, {"recordings", rows}};
    if (!options.quiet) print(runs, raw, off, lead, best, surface, definition, times);
    judge_errors(runs, raw, off, lead, best, targets);
    return report;
}

}  // namespace vfit::tools
