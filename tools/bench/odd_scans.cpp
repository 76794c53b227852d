// vfit-bench odd-scans: people and scenes that a scan is not made for (synthetic). It must say what is wrong,
// or be unsure: never surely wrong.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/targets.h"
#include "client/output.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

struct Case {
    const char *name, *options;
};
// Each from the front, 60 frames, a Kinect v1 at 2.8 m unless said otherwise.
constexpr Case kCases[] = {
    {"as it should be", "sex=f"},
    {"too near", "sex=m&distance=1.4"},
    {"too far", "sex=m&distance=6"},
    {"feet out of the picture", "sex=m&tilt=-12"},
    {"head out of the picture", "sex=m&tilt=14"},
    {"turned away by half", "sex=f&facing=50"},
    {"from behind", "sex=f&facing=180"},
    {"arms hanging", "sex=m&arms=4"},
    {"sitting", "sex=m&motion=sit"},
    {"sitting on a chair", "sex=f&motion=sit&furniture=chair"},
    {"walking", "sex=m&motion=walk"},
    {"two people", "sex=f&people=2"},
    {"behind a passing box", "sex=m&occluder=0.1"},
    {"a child", "sex=f&age=0.2&height=0.2"},
    {"another child", "sex=m&age=0.3&height=0.3"},
    {"a small child", "sex=m&age=0.1876&height=0"},
    {"a coat of 6 cm", "sex=m&clothing=0.06"},
    {"a coat of 10 cm", "sex=f&clothing=0.1"},
    {"very heavy", "sex=m&weight=1.149&measure-waist-circ=1&measure-hips-circ=1"},
    {"very thin", "sex=f&weight=0.05"},
    {"a wide dress", "sex=f&trousers=0.08&top=0.01&sleeves=0"},
};
constexpr const char* kKeys[] = {"stature_m", "chest_girth_m", "waist_girth_m", "hip_girth_m",
                                 "inside_leg_m"};
constexpr double kWrong = 3.0;  // deviations: by chance one of four hundred

Json truth_of(vfit_context context, const std::string& uri) {
    Source source(context, uri);
    const auto frame = source.next();
    if (!frame) throw Failure(uri + ": no frame");
    std::string text(4096, 0);
    check(
        vfit_frame_meta(frame->get(), "measures", text.data(), static_cast<uint32_t>(text.size()), nullptr));
    return Json::parse(text.c_str());
}

/// The case's options, and the usual ones that it does not give itself.
std::string uri_of(const Case& one) {
    std::string uri = std::string("virtual:sensor=kinect_v1&seed=5&frames=60&") + one.options;
    const auto add_usual = [&](const std::string& key, const char* value) {
        if (uri.find("&" + key + "=") == std::string::npos) uri += "&" + key + "=" + value;
    };
    add_usual("motion", "scan");
    add_usual("distance", "2.8");
    return uri;
}

double number(const Json& value) {
    return value.is_object() ? value["value"].get<double>() : value.get<double>();
}

}  // namespace

void add_odd_scans(Command& app) {
    Command command = app.add_subcommand(
        "odd-scans", "What scans say of people and scenes that they are not made for (synthetic)");
    auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "Print JSON");
    command.callback([json] {
        Targets targets(*json);
        Json rows = Json::array();
        uint32_t surely_wrong = 0;
        for (const Case& one : kCases) {
            const std::string uri = uri_of(one);
            const Context context = open_context();
            ScanOptions options;
            options.method = VFIT_SCAN_FIT;
            options.track.joints = options.track.user_map = VFIT_TRACK_BUILT_IN;
            Json row = {{"case", one.name}};
            if (!*json) std::cout << std::left << std::setw(26) << one.name << std::right;
            try {
                const Json truth = truth_of(context.get(), uri);
                Source source(context.get(), uri);
                const ScanRun run = run_scan(context.get(), source, options);
                row["frames"] = run.frames_taken;
                if (!*json) std::cout << std::setw(3) << run.frames_taken << " frames ";
                double worst = 0.0;
                for (const vfit_measurement& m : measurements_of(run.scan.get())) {
                    if (std::find(std::begin(kKeys), std::end(kKeys), std::string(m.key)) ==
                            std::end(kKeys) ||
                        !truth.contains(m.key))
                        continue;
                    const double error = double(m.value) - number(truth[m.key]);
                    worst = std::max(worst, std::abs(error) / double(m.sigma));
                    row[m.key] = {{"error_m", error}, {"sigma_m", m.sigma}};
                    if (!*json)
                        std::cout << "  " << std::string(m.key).substr(0, 7) << std::fixed
                                  << std::setprecision(0) << std::setw(5) << 1000 * error << " +-"
                                  << std::setw(3) << 1000 * double(m.sigma);
                }
                row["worst_sigmas"] = worst;
                if (worst > kWrong) ++surely_wrong;
                if (!*json) std::cout << (worst > kWrong ? "   SURELY WRONG\n" : "\n");
            } catch (const Failure& failure) {
                row["why"] = failure.what();
                if (!*json) std::cout << "no scan: " << failure.what() << "\n";
            }
            rows.push_back(row);
        }
        targets.judge("scans that are surely wrong (an error beyond 3 sigma)", surely_wrong, Aim::at_most, 0,
                      0);
        if (*json) print_document({{"cases", rows}, {"targets", targets.json()}});
    });
}

}  // namespace vfit::tools
