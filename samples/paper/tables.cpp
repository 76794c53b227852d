// vfit-paper tables: Tables 1 to 4. Of 3 and 4 the people are virtual (synthetic): the paper's seven by their
// dimensions, measured by its method as printed, by the same with real people's ratios, and by the fitted
// body.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <numeric>

#include "client/people.h"
#include "paper.h"
#include "paper/proportions.h"
#include "population/library_file.h"
#include "subjects.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kFrames = 30;  // one second, as in the paper
constexpr const char* kKeys[] = {"shoulder_breadth_m", "stature_m"};

struct Method {
    const char* name;
    vfit_scan_method method;
};
constexpr Method kMethods[] = {{"paper as printed", VFIT_SCAN_PROPORTIONS_AS_PRINTED},
                               {"paper, real people's ratios", VFIT_SCAN_PROPORTIONS},
                               {"fitted body", VFIT_SCAN_FIT}};

/// What a scan of all frames tells of a dimension, and how much scans of single frames differ.
struct Measured {
    double value_m = 0.0, deviation_m = 0.0;
};

std::array<Measured, 2> measure(const Subject& subject, vfit_scan_method method) {
    const Context context = open_context();
    TrackOptions track;
    track.joints = track.user_map = VFIT_TRACK_BUILT_IN;
    const Tracker tracker = open_tracker(context.get(), track);
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.method = method, desc.flags = VFIT_SCAN_BARE | VFIT_SCAN_TIGHT;
    desc.frame_count = kFrames;
    Scan all, single;
    check(vfit_scan_create(context.get(), &desc, all.out()));
    desc.frame_count = 1;
    check(vfit_scan_create(context.get(), &desc, single.out()));
    std::array<std::vector<double>, 2> frames;
    const auto told = [](vfit_scan scan, const char* key) {
        for (const vfit_measurement& m : measurements_of(scan))
            if (std::string(m.key) == key) return double(m.value);
        throw Failure(std::string(key) + " was not measured");
    };
    // A few more frames than are wanted: the first are the tracker's own start.
    Source source(context.get(), subject.uri + "&frames=" + std::to_string(kFrames + 30));
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const uint32_t body = active_body(tracked.get());
        const vfit_result result = check(vfit_scan_add(all.get(), tracked.get(), body, nullptr));
        check(vfit_scan_reset(single.get()));
        // Of a scan by fitted bodies a single frame says what it says by itself.
        if (check(vfit_scan_add(single.get(), tracked.get(), body, nullptr)) != VFIT_INCOMPLETE)
            for (size_t k = 0; k < frames.size(); ++k) frames[k].push_back(told(single.get(), kKeys[k]));
        if (result == VFIT_OK) break;
    }
    std::array<Measured, 2> out;
    for (size_t k = 0; k < out.size(); ++k) {
        const auto n = double(frames[k].size()),
                   mean = std::accumulate(frames[k].begin(), frames[k].end(), 0.0) / n;
        double squares = 0.0;
        for (const double v : frames[k]) squares += (v - mean) * (v - mean);
        out[k] = {told(all.get(), kKeys[k]), std::sqrt(squares / std::max(1.0, n - 1.0))};
    }
    return out;
}

void print_table_1() {
    constexpr const char* kNames[] = {"head width",     "head height",        "body height",
                                      "hip height",     "elbow to fingertip", "wrist to fingertip",
                                      "shoulder width", "hip width",          "torso height"};
    std::cout
        << "Table 1. Body proportions in heads (widths in head widths); numbers as in Fig. 4. The printed "
           "first column is\n"
           "lost in the text that this follows and was reconstructed (sdk/paper/proportions.h)\n"
        << "      line                  canon (the paper's)  women  men (ANSUR II, Drillis and Contini)\n";
    for (size_t i = 0; i < kLineCount; ++i) {
        const auto line = static_cast<Line>(i);
        const auto heads = [&](RatioTable table, vfit_sex sex) { return ratio(table, sex, line).heads; };
        std::cout << "  (" << i + 1 << ") " << std::left << std::setw(22) << kNames[i] << std::right
                  << std::fixed << std::setprecision(2);
        if (heads(RatioTable::kCanon, VFIT_SEX_UNKNOWN) == 0.0f) {
            std::cout << "  none\n";
            continue;
        }
        std::cout << std::setw(6) << heads(RatioTable::kCanon, VFIT_SEX_UNKNOWN) << std::setw(22)
                  << heads(RatioTable::kAnthropometric, VFIT_SEX_FEMALE) << std::setw(7)
                  << heads(RatioTable::kAnthropometric, VFIT_SEX_MALE) << "\n";
    }
}

void print_table_2() {
    std::cout << "\nTable 2. Primary dimensions by kind of garment\n";
    for (const char* kind : {"trousers", "long_sleeves", "short_sleeves"}) {
        const GarmentKind& g = garment_kind(kind);
        std::cout << "  " << std::left << std::setw(15) << kind << "height: " << std::setw(18)
                  << line_key(g.height) << " width: ";
        for (size_t w = 0; w < g.width_count; ++w) std::cout << (w ? ", " : "") << line_key(g.widths[w]);
        std::cout << std::right << "\n";
    }
}

/// Mean and deviation (of the people, as the paper has it) of errors in per cent.
std::pair<double, double> statistics(const std::vector<double>& errors) {
    const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
    double squares = 0.0;
    for (const double e : errors) squares += (e - mean) * (e - mean);
    return {mean, std::sqrt(squares / double(errors.size()))};
}

void print_dimension(double real_cm, double estimated_cm, double error, double deviation, const char* unit) {
    std::cout << std::fixed << std::setprecision(1) << std::setw(8) << real_cm << std::setw(8) << estimated_cm
              << std::setw(7) << error << " %" << std::setw(7) << deviation << " " << unit;
}

void tables() {
    print_table_1();
    print_table_2();
    const auto body = BodyModel::load(library_file("vfit_data/body.bin"));
    const std::vector<Subject> people = subjects(body);
    std::cout << "\nTable 3. Seven subjects. The paper's are real people; those below it are VIRTUAL ones of "
                 "the same shoulder width\n"
                 "and height (Kinect v1 noise, tracked by vfit, tight clothes, the sex not told), "
              << kFrames
              << " frames each. The deviation is\n"
                 "that of single frames; the paper gives its own without a unit.\n";
    const auto head = [](const char* name) {
        std::cout << "\n  " << std::left << std::setw(29) << name << std::right
                  << "shoulder width (cm)             height (cm)\n  subject    real   told   error    "
                     "deviation     real   told   error    deviation\n";
    };
    head("the paper");
    std::vector<double> paper_height, paper_shoulder;
    for (const Subject& s : people) {
        std::cout << "  " << std::setw(4) << s.number;
        print_dimension(s.shoulder.real, s.shoulder.estimated, s.shoulder.error, s.shoulder.deviation, "  ");
        print_dimension(s.height.real, s.height.estimated, s.height.error, s.height.deviation, "  ");
        std::cout << "\n";
        paper_shoulder.push_back(s.shoulder.error), paper_height.push_back(s.height.error);
    }
    std::vector<std::pair<std::string, std::array<std::vector<double>, 2>>> errors = {
        {"the paper, of its Table 3", {paper_shoulder, paper_height}}};
    for (const Method& method : kMethods) {
        head(method.name);
        errors.push_back({method.name, {}});
        for (const Subject& s : people) {
            const std::array<Measured, 2> told = measure(s, method.method);
            std::cout << "  " << std::setw(4) << s.number;
            for (size_t k = 0; k < told.size(); ++k) {
                const double real = s.measures.at(kKeys[k]),
                             error = 100.0 * std::abs(told[k].value_m - real) / real;
                print_dimension(100.0 * real, 100.0 * told[k].value_m, error, 1000.0 * told[k].deviation_m,
                                "mm");
                errors.back().second[k].push_back(error);
            }
            std::cout << "\n";
        }
    }
    std::cout
        << "\nTable 4. Error of height, mean and deviation over people, per cent (shoulder width beside it)\n"
           "  Giovanni et al. 2012, as the paper quotes it            4.00 +- 3.00\n"
           "  Samejima et al. 2012, as the paper quotes it            6.72 +- 4.68\n"
           "  the paper's own line (over shoulders AND heights)       2.67 +- 2.06\n";
    for (const auto& [name, by] : errors) {
        const auto shoulder = statistics(by[0]), height = statistics(by[1]);
        std::cout << "  " << std::left << std::setw(54)
                  << name + (name.find("Table 3") == std::string::npos ? ", virtual people" : "")
                  << std::right << std::fixed << std::setprecision(2) << std::setw(6) << height.first
                  << " +- " << height.second << "   (" << shoulder.first << " +- " << shoulder.second
                  << ")\n";
    }
}

}  // namespace

void add_tables(Command& app) {
    Command command = app.add_subcommand("tables", "Tables 1 to 4 (the people of 3 and 4 are virtual)");
    command.callback([] { tables(); });
}

}  // namespace vfit::tools
