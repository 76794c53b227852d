// vfit-bench people: the paper's Table 3 on virtual people. Synthetic: bodies of the parametric model seen by
// the virtual Kinect v1.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>

#include "bench/bench.h"
#include "client/output.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 20, seed = 1;
    std::string sensor = "kinect_v1", method = "paper";
    double distance_m = 2.8;
    bool json = false;
};

struct Row {
    std::string sex;
    double height_true, height, height_sigma, shoulder_true, shoulder, shoulder_sigma, compute_ms, last_ms;
};

/// Bodies spread over the model's range of height and build.
std::string uri_of(const Options& options, uint32_t i, std::mt19937& random) {
    const auto between = [&](double low, double high) {
        // Not std::uniform_real_distribution: its numbers differ between standard libraries.
        return low + (high - low) * double(random()) / double(std::mt19937::max());
    };
    std::ostringstream uri;
    uri << "virtual:sensor=" << options.sensor << "&motion=scan&seed=" << options.seed + i
        << "&sex=" << (i % 2 ? "m" : "f") << "&height=" << between(0.2, 0.8)
        << "&weight=" << between(0.3, 0.9) << "&muscle=" << between(0.3, 0.8)
        << "&proportions=" << between(0.3, 0.8) << "&distance=" << options.distance_m;
    return uri.str();
}

double value_of(const std::vector<vfit_measurement>& list, const char* key, double* sigma) {
    for (const auto& m : list)
        if (std::string(m.key) == key) {
            *sigma = m.sigma;
            return m.value;
        }
    throw Failure(std::string(key) + " was not measured");
}

Json truth_of(const std::string& uri) {
    const Context context = open_context();
    Source source(context.get(), uri);
    const auto frame = source.next();
    if (!frame) throw Failure("the virtual person sends no frame");
    uint32_t length = 0;
    if (check(vfit_frame_meta(frame->get(), "measures", nullptr, 0, &length)) != VFIT_OK)
        throw Failure("the frame carries no true measures");
    std::string text(length + 1, '\0');
    check(vfit_frame_meta(frame->get(), "measures", text.data(), length + 1, &length));
    text.resize(length);
    return Json::parse(text);
}

Row measure(const std::string& uri, bool male, vfit_scan_method method) {
    const Json truth = truth_of(uri);
    const Context context = open_context();
    Source source(context.get(), uri);
    ScanOptions scan;
    scan.method = method;
    const ScanRun run = run_scan(context.get(), source, scan);
    const auto measured = measurements_of(run.scan.get());
    Row row;
    row.sex = male ? "m" : "f";
    row.height_true = truth["stature_m"];
    row.shoulder_true = truth["shoulder_breadth_m"];
    row.height = value_of(measured, "stature_m", &row.height_sigma);
    row.shoulder = value_of(measured, "shoulder_breadth_m", &row.shoulder_sigma);
    row.compute_ms = run.compute_ms;
    row.last_ms = run.last_ms;
    return row;
}

double error(double real, double estimated) { return 100.0 * std::abs(estimated - real) / real; }

}  // namespace

void add_people(Command& app) {
    Command command = app.add_subcommand("people", "Table 3 of the paper on virtual people (synthetic)");
    auto o = std::make_shared<Options>();
    command.add_option("--count", o->count, "How many people").within(2, 1000);
    command.add_option("--seed", o->seed, "Of bodies and noise");
    command.add_option("--sensor", o->sensor, "Noise model of the virtual sensor");
    command.add_option("--distance", o->distance_m, "From camera to person, m");
    command.add_option("--method", o->method, "paper, or paper-as-printed: canon ratios and plain means")
        .one_of({"paper", "paper-as-printed"});
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        pin_to_cores(1);
        std::mt19937 random(o->seed);
        Json rows = Json::array();
        double height = 0.0, shoulder = 0.0, height_bias = 0.0, shoulder_bias = 0.0, last_ms = 0.0,
               mean_ms = 0.0;
        if (!o->json)
            std::cout
                << " #    height real   est.  error    sd | shoulder real   est.  error    sd |   ms  (cm)\n";
        for (uint32_t i = 0; i < o->count; ++i) {
            const Row r = measure(uri_of(*o, i, random), i % 2 == 1, scan_method_from(o->method));
            const double he = error(r.height_true, r.height), se = error(r.shoulder_true, r.shoulder);
            height += he / o->count;
            shoulder += se / o->count;
            height_bias += 100.0 * (r.height - r.height_true) / o->count;
            shoulder_bias += 100.0 * (r.shoulder - r.shoulder_true) / o->count;
            last_ms += r.last_ms / o->count;
            mean_ms += r.compute_ms / o->count;
            rows.push_back({{"sex", r.sex},
                            {"height_m", {r.height_true, r.height, r.height_sigma}},
                            {"shoulder_m", {r.shoulder_true, r.shoulder, r.shoulder_sigma}},
                            {"compute_ms", r.compute_ms}});
            if (!o->json)
                std::cout << std::fixed << std::setw(2) << i + 1 << r.sex << std::setprecision(1)
                          << std::setw(13) << 100 * r.height_true << std::setw(7) << 100 * r.height
                          << std::setprecision(2) << std::setw(6) << he << "%" << std::setw(6)
                          << 100 * r.height_sigma << " |" << std::setprecision(1) << std::setw(14)
                          << 100 * r.shoulder_true << std::setw(7) << 100 * r.shoulder << std::setprecision(2)
                          << std::setw(6) << se << "%" << std::setw(6) << 100 * r.shoulder_sigma << " |"
                          << std::setprecision(1) << std::setw(6) << r.compute_ms << "\n";
        }
        if (o->json) {
            print_document({{"people", rows},
                            {"height_error_percent", height},
                            {"shoulder_error_percent", shoulder},
                            {"height_bias_cm", height_bias},
                            {"shoulder_bias_cm", shoulder_bias},
                            {"paper", {{"height_error_percent", 1.5}, {"shoulder_error_percent", 4.2}}},
                            {"compute_ms", {{"all_frames", mean_ms}, {"after_the_last_frame", last_ms}}}});
            return;
        }
        std::cout << std::setprecision(2) << "mean absolute error: height " << height
                  << " % (paper 1.5 %), shoulder " << shoulder << " % (paper 4.2 %); bias " << height_bias
                  << " and " << shoulder_bias << " cm; work " << mean_ms << " ms while the frames come, "
                  << last_ms << " ms beyond capture (paper 5 ms)\n";
    });
}

}  // namespace vfit::tools
