// vfit-bench measure: measures of virtual people through the C ABI, against the truth, by each method. Synthetic: people
// drawn from a survey before the virtual camera; bodies inside and outside the fit's space are kept apart.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/bench.h"
#include "bench/targets.h"
#include "bench/track_play.h"
#include "client/assets.h"
#include "client/output.h"
#include "client/people.h"
#include "population/scan_scene.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 300, seed = 1, first = 0;
    std::string only;
    bool json = false, told_sex = false;
};

/// Errors of one measure over people.
class Tally {
public:
    void add(double error_m, double sigma_m) {
        sum_ += error_m, absolute_ += std::abs(error_m), ++count_;
        inside_ += std::abs(error_m) <= 1.645 * sigma_m;
    }
    double mean_mm() const { return 1000 * absolute_ / std::max(1u, count_); }
    double bias_mm() const { return 1000 * sum_ / std::max(1u, count_); }
    double covered() const { return double(inside_) / std::max(1u, count_); }
    Json json() const { return {{"mean_absolute_mm", mean_mm()}, {"bias_mm", bias_mm()}, {"covered", covered()}, {"n", count_}}; }

private:
    double sum_ = 0.0, absolute_ = 0.0;
    uint32_t count_ = 0, inside_ = 0;
};

using Tallies = std::map<std::string, Tally>;

struct Set {
    std::string name;
    BodySpace space;
    Dress dress;
    Tallies front{}, both{}, paper{};
    Samples last_ms{};  // what is left to do when the capture ends
    uint32_t scans = 0, failed = 0, exact = 0, within_one = 0, sure = 0, sure_right = 0;
    double log_loss = 0.0;
};

void add(const std::vector<vfit_measurement>& measured, const BodyMeasures& truth, Tallies& out) {
    for (const vfit_measurement& m : measured)
        if (const auto t = truth.find(m.key); t != truth.end())
            out[m.key].add(double(m.value) - t->second, double(m.sigma));
}

/// The letter of the chest's girth, told and true.
void judge_size(vfit_context context, const PersonOfPopulation& person, const std::vector<vfit_measurement>& measured, Set& set) {
    const SizeChart chart = open_chart(context, person.sex == VFIT_SEX_MALE ? "en13402_men" : "en13402_women");
    vfit_measurement chest = vfit_measurement_init();
    std::snprintf(chest.key, sizeof chest.key, "chest_girth_m");
    chest.value = float(person.measures.at("chest_girth_m"));
    const Json truth = sizes_json(chart.get(), "short_sleeves", {chest}), told = sizes_json(chart.get(), "short_sleeves", measured);
    const std::string letter = truth[0]["label"];
    std::vector<std::string> order;
    for (const auto& row : list<vfit_size_row>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_size_chart_rows(chart.get(), items, stride, n);
         }))
        if (std::string(row.garment_kind) == "short_sleeves") order.push_back(row.label);
    const auto place = [&](const std::string& label) { return std::find(order.begin(), order.end(), label) - order.begin(); };
    const std::string best = told[0]["label"];
    const double probability = told[0]["probability"];
    set.exact += best == letter;
    set.within_one += std::abs(place(best) - place(letter)) <= 1;
    if (probability >= 0.7 && probability <= 0.9) ++set.sure, set.sure_right += best == letter;
    for (const Json& size : told)
        if (size["label"] == letter) set.log_loss -= std::log(std::max(1e-6, size["probability"].get<double>()));
}

void scan(const PersonOfPopulation& person, const ScanScene& scene, bool told_sex, Set& set) {
    const Context context = open_context();
    const Tracker tracker = open_own_tracker(context.get());
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.method = VFIT_SCAN_FIT, desc.flags = VFIT_SCAN_BARE;
    desc.frame_count = scene.front_frames, desc.side_frame_count = scene.side_frames;
    if (told_sex) desc.sex = person.sex;
    Scan fit, paper;
    check(vfit_scan_create(context.get(), &desc, fit.out()));
    desc.method = VFIT_SCAN_PROPORTIONS;
    check(vfit_scan_create(context.get(), &desc, paper.out()));
    vfit_scan_state state = vfit_scan_state_init();
    const auto play = [&](const std::string& uri, bool front) {
        Source source(context.get(), uri);
        while (const auto frame = source.next()) {
            Frame tracked;
            check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
            const auto bodies = bodies_of(tracked.get());
            if (bodies.empty()) continue;
            check(vfit_scan_add(fit.get(), tracked.get(), bodies.front().body_id, &state));
            if (front) check(vfit_scan_add(paper.get(), tracked.get(), bodies.front().body_id, nullptr));
        }
    };
    ++set.scans;
    play(scene.front_uri(person), true);
    if (state.frames_taken < scene.front_frames / 2) {
        ++set.failed;
        std::cerr << "no scan: " << guidance_text(state.guidance) << ": " << scene.front_uri(person) << "\n";
        return;
    }
    const Timer timer;
    const auto measured = measurements_of(fit.get());
    set.last_ms.add(timer.ms() + double(state.compute_ms));
    add(measured, person.measures, set.front);
    add(measurements_of(paper.get()), person.measures, set.paper);
    play(scene.side_uri(person), false);
    if (state.side_frames_taken < scene.side_frames / 2) {
        ++set.failed;
        std::cerr << "no side view: " << guidance_text(state.guidance) << ": " << scene.side_uri(person) << "\n";
        return;
    }
    const auto both = measurements_of(fit.get());
    add(both, person.measures, set.both);
    judge_size(context.get(), person, both, set);
}

void print(const Set& set) {
    std::cout << "\nSYNTHETIC, " << set.name << ": " << set.scans << " scans, " << set.failed << " of them failed\n"
              << "                            front                front and side       the paper's method\n"
              << "                            mean  bias  in 90 %  mean  bias  in 90 %  mean  bias  in 90 %   (absolute error, mm)\n";
    for (const auto& [key, front] : set.front) {
        std::cout << "  " << std::left << std::setw(24) << key << std::right << std::fixed;
        for (const Tallies* tallies : {&set.front, &set.both, &set.paper}) {
            const auto found = tallies->find(key);
            if (found == tallies->end()) continue;
            const Tally& t = found->second;
            std::cout << std::setprecision(1) << std::setw(7) << t.mean_mm() << std::setw(6) << t.bias_mm() << std::setw(6)
                      << std::setprecision(0) << 100 * t.covered() << " %";
        }
        std::cout << "\n";
    }
}

/// Targets by set: inside, outside, clothed.
void judge(const Set& set, size_t column, Targets& targets) {
    const auto most = [&](const char* what, const Tallies& tallies, const char* key, std::array<double, 3> mm) {
        const auto found = tallies.find(key);
        targets.judge(set.name + ": " + key + ", " + what, found == tallies.end() ? NAN : found->second.mean_mm(), Aim::at_most,
                      mm[column], 1, " mm");
    };
    most("front", set.front, "stature_m", {5, 6, 8});
    targets.judge(set.name + ": stature_m, bias", std::abs(set.front.at("stature_m").bias_mm()), Aim::at_most, 4, 1, " mm");
    most("front", set.front, "shoulder_breadth_m", {10, 12, 14});
    most("front", set.front, "chest_girth_m", {18, 24, 32});
    most("front", set.front, "waist_girth_m", {18, 22, 32});
    most("front", set.front, "hip_girth_m", {18, 18, 32});
    for (const char* key : {"chest_girth_m", "waist_girth_m", "hip_girth_m"}) {
        most("front and side", set.both, key, {10, 12, 22});
        targets.judge(set.name + ": " + key + ", bias", std::abs(set.both.at(key).bias_mm()), Aim::at_most, 9, 1, " mm");
    }
    most("front and side", set.both, "inside_leg_m", {10, 12, 14});
    most("front and side", set.both, "arm_length_m", {10, 12, 14});
    double least = 1.0, largest = 0.0, sum = 0.0;
    for (const auto& [key, t] : set.both)
        least = std::min(least, t.covered()), largest = std::max(largest, t.covered()), sum += t.covered();
    targets.judge(set.name + ": 90 % intervals cover, mean of measures", sum / double(set.both.size()), Aim::at_least, 0.85, 3);
    targets.judge(set.name + ": the same, at most", sum / double(set.both.size()), Aim::at_most, 0.95, 3);
    targets.judge(set.name + ": 90 % intervals cover, least covered measure", least, Aim::at_least, 0.85, 3);
    targets.judge(set.name + ": 90 % intervals cover, most covered measure", largest, Aim::at_most, 0.95, 3);
    const double scans = std::max(1u, set.scans - set.failed);
    if (column < 2) {
        targets.judge(set.name + ": size letter exact", set.exact / scans, Aim::at_least, column == 0 ? 0.85 : 0.82, 3);
        targets.judge(set.name + ": size letter within one", set.within_one / scans, Aim::at_least, 0.995, 3);
    } else if (set.sure > 0) {
        targets.judge(set.name + ": letters said with 0.7 to 0.9 are right, at least", double(set.sure_right) / set.sure, Aim::at_least, 0.7, 3);
        targets.judge(set.name + ": letters said with 0.7 to 0.9 are right, at most", double(set.sure_right) / set.sure, Aim::at_most, 0.9, 3);
    }
    targets.judge(set.name + ": beyond the capture of the front view, median", set.last_ms.quantile(0.5), Aim::at_most, 60, 1, " ms");
}

void run(const Options& o) {
    const auto body = BodyModel::load(library_file("vfit_data/body.bin"));
    std::vector<Set> sets = {{"in space", BodySpace::kInside, Dress::kTight}, {"off space", BodySpace::kOutside, Dress::kTight},
                             {"clothed", BodySpace::kOutside, Dress::kClothed}};
    Targets targets(o.json);
    Json out = Json::array();
    std::unique_ptr<Population> population;
    BodySpace made = BodySpace::kInside;
    for (size_t column = 0; column < sets.size(); ++column) {
        Set& set = sets[column];
        if (set.name.find(o.only) == std::string::npos) continue;
        if (!population || made != set.space) population = std::make_unique<Population>(body, made = set.space, o.seed);
        for (uint32_t i = o.first; i < o.first + o.count; ++i)
            scan(population->draw(i), ScanScene::draw(set.dress, o.seed * 104729u + i), o.told_sex, set);
        if (!o.json) print(set);
        judge(set, column, targets);
        Json one = {{"set", set.name}, {"scans", set.scans}, {"failed", set.failed}, {"beyond_capture_ms", set.last_ms.json()},
                    {"log_loss", set.log_loss / std::max(1u, set.scans - set.failed)}};
        for (const auto& [name, tallies] : {std::pair("front", &set.front), {"both", &set.both}, {"paper", &set.paper}})
            for (const auto& [key, t] : *tallies) one[name][key] = t.json();
        out.push_back(one);
    }
    if (o.json)
        print_document({{"sets", out}, {"targets", targets.json()}});
    else
        std::cout << "\n" << targets.count() - targets.missed() << " of " << targets.count() << " targets hit\n";
}

}  // namespace

void add_measure(Command& app) {
    Command command = app.add_subcommand("measure", "Measures of virtual people by each method (synthetic)");
    auto o = std::make_shared<Options>();
    command.add_option("--count", o->count, "People of each set").within(1, 100000);
    command.add_option("--first", o->first, "Number of the first");
    command.add_option("--seed", o->seed, "Of the population; those of training are 1000 and above");
    command.add_option("--only", o->only, "Sets whose name contains this: in space, off space, clothed");
    command.add_flag("--told-sex", o->told_sex, "Tell the scan the person's sex");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
