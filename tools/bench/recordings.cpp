// vfit-bench recordings: stature of real people over several recordings each. True heights are not known:
// what can be judged is how well recordings of one person agree, and whether people differ as their masks do.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/bench.h"
#include "bench/targets.h"
#include "client/output.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string folder, method = "fit";
    bool json = false;
};

struct Person {
    std::vector<double> stature_m, mask_m;
};

/// Height of the user map in metres at the person's median depth: the crude figure to hold the method
/// against.
double mask_height(vfit_frame frame) {
    const vfit_view depth = view_of(frame, VFIT_STREAM_DEPTH), map = view_of(frame, VFIT_STREAM_USER_MAP);
    vfit_intrinsics k = vfit_intrinsics_init();
    check(vfit_frame_intrinsics(frame, &k));
    std::vector<uint16_t> z;
    uint32_t top = depth.height, bottom = 0;
    for (uint32_t y = 0; y < depth.height; ++y)
        for (uint32_t x = 0; x < depth.width; ++x) {
            const uint16_t d = row_of<uint16_t>(depth, y)[x];
            if (!row_of<uint8_t>(map, y)[x] || !d) continue;
            z.push_back(d);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
    if (z.empty()) return 0.0;
    std::nth_element(z.begin(), z.begin() + long(z.size() / 2), z.end());
    return double(bottom - top + 1) * z[z.size() / 2] * camera_of(frame).depth_unit_m / k.fy;
}

/// Tallest mask of a recording: people bend, jump and squat, but nobody grows.
double tallest_mask(const std::string& recording) {
    const Context context = open_context();
    Source source(context.get(), recording);
    std::vector<double> heights;
    while (const auto frame = source.next()) heights.push_back(mask_height(frame->get()));
    if (heights.empty()) throw Failure(recording + ": no frames");
    std::sort(heights.begin(), heights.end());
    return heights[heights.size() * 9 / 10];
}

/// "kinect1_s5_squat_1" is person s5.
std::string person_of(const std::string& name) {
    const size_t a = name.find("_s"), b = name.find('_', a + 1);
    return a == std::string::npos ? name : name.substr(a + 1, b - a - 1);
}

double mean(const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += x;
    return sum / double(v.size());
}

double deviation(const std::vector<double>& v) {
    const double m = mean(v);
    double sum = 0.0;
    for (const double x : v) sum += (x - m) * (x - m);
    return v.size() > 1 ? std::sqrt(sum / double(v.size() - 1)) : 0.0;
}

/// By the paper's method on the recording's own joints; by the fitted body on the tracker's, from the front
/// alone.
ScanOptions scan_options(const std::string& method) {
    ScanOptions options;
    options.method = scan_method_from(method);
    if (options.method == VFIT_SCAN_FIT) options.track.joints = options.track.user_map = VFIT_TRACK_BUILT_IN;
    return options;
}

/// How far the difference of two people's statures is from that of their masks, at most, over all pairs.
double worst_difference(const std::map<std::string, Person>& people) {
    double worst = 0.0;
    for (const auto& [name, a] : people)
        for (const auto& [other, b] : people)
            worst = std::max(
                worst, std::abs((mean(a.stature_m) - mean(b.stature_m)) - (mean(a.mask_m) - mean(b.mask_m))));
    return worst;
}

}  // namespace

void add_recordings(Command& app) {
    Command command = app.add_subcommand("recordings", "Stature of real people over their recordings");
    auto o = std::make_shared<Options>();
    command.add_option("folder", o->folder, "Folder of recordings named ..._s<person>_...").required();
    command.add_option("--method", o->method, "How to measure").one_of({"fit", "paper", "paper-as-printed"});
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::directory_iterator(o->folder))
            if (entry.is_directory()) paths.push_back(entry.path());
        if (paths.empty()) throw Failure(o->folder + ": holds no recordings");
        std::sort(paths.begin(), paths.end());
        std::map<std::string, Person> people;
        Json rows = Json::array();
        for (const auto& path : paths) {
            const Context context = open_context();
            Source source(context.get(), path.string());
            const std::string name = path.filename().string();
            ScanRun run;
            try {
                run = run_scan(context.get(), source, scan_options(o->method));
            } catch (const Failure& failure) {  // nobody stands as a scan needs it
                rows.push_back({{"recording", name}, {"frames", 0}, {"why", failure.what()}});
                if (!o->json)
                    std::cout << std::left << std::setw(32) << name << std::right
                              << "  no scan: " << failure.what() << "\n";
                continue;
            }
            double stature = 0.0;
            for (const auto& m : measurements_of(run.scan.get()))
                if (std::string(m.key) == "stature_m") stature = m.value;
            const double mask = tallest_mask(path.string());
            people[person_of(name)].stature_m.push_back(stature);
            people[person_of(name)].mask_m.push_back(mask);
            rows.push_back({{"recording", name},
                            {"frames", run.frames_taken},
                            {"stature_m", stature},
                            {"mask_m", mask}});
            if (!o->json)
                std::cout << std::left << std::setw(32) << name << std::right << std::setw(3)
                          << run.frames_taken << " frames  stature " << std::fixed << std::setprecision(3)
                          << stature << " m  mask " << mask << " m\n";
        }
        Json summary = Json::object();
        for (const auto& [name, p] : people) {
            summary[name] = {{"recordings", p.stature_m.size()},
                             {"stature_m", mean(p.stature_m)},
                             {"stature_sd_m", deviation(p.stature_m)},
                             {"mask_m", mean(p.mask_m)},
                             {"mask_sd_m", deviation(p.mask_m)}};
            if (!o->json)
                std::cout << name << ": stature " << mean(p.stature_m) << " m, SD " << deviation(p.stature_m)
                          << " m over " << p.stature_m.size() << " recordings; mask " << mean(p.mask_m)
                          << " m, SD " << deviation(p.mask_m) << " m\n";
        }
        Targets targets(o->json);
        for (const auto& [name, p] : people)
            if (p.stature_m.size() > 1)  // one has no deviation
                targets.judge(
                    name + ": stature, sd over " + std::to_string(p.stature_m.size()) + " recordings",
                    1000 * deviation(p.stature_m), Aim::at_most, 4.0, 1, " mm");
        targets.judge("people's statures differ as their masks do, to", 1000 * worst_difference(people),
                      Aim::at_most, 15.0, 1, " mm");
        if (o->json) print_document({{"recordings", rows}, {"people", summary}, {"targets", targets.json()}});
    });
}

}  // namespace vfit::tools
