// vfit-bench measure: measures of virtual people through the C ABI, against the truth, by each method.
// Synthetic: people drawn from a survey before the virtual camera; bodies inside and outside the fit's space
// are kept apart.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

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
    uint32_t count = 300, seed = 1, first = 0, repeats = 10;
    std::string only;
    bool json = false, told_sex = false;
};

/// 95 % confidence of a share k of n (Wilson 1927).
std::pair<double, double> confidence(double k, double n) {
    if (n <= 0.0) return {0.0, 1.0};
    constexpr double z = 1.96;
    const double p = k / n, middle = (p + z * z / (2 * n)) / (1 + z * z / n),
                 half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    return {middle - half, middle + half};
}

std::string between(std::pair<double, double> range) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2) << " (95 %: " << range.first << " to " << range.second << ")";
    return out.str();
}

/// Errors of one measure over people.
class Tally {
public:
    void add(double error, double sigma) {
        sum_ += error, absolute_ += std::abs(error), squares_ += error * error, ++count_;
        inside_ += std::abs(error) <= 1.645 * sigma;
    }
    double mean() const { return absolute_ / n(); }
    /// Half of the 95 % confidence interval of mean().
    double mean_confidence() const {
        return 1.96 * std::sqrt(std::max(0.0, squares_ / n() - mean() * mean()) / n());
    }
    double bias() const { return sum_ / n(); }
    double covered() const { return inside_ / n(); }
    std::pair<double, double> covered_confidence() const { return confidence(inside_, count_); }
    Json json() const {
        return {{"mean_absolute", mean()}, {"bias", bias()}, {"covered", covered()}, {"n", count_}};
    }

private:
    double n() const { return std::max(1u, count_); }
    double sum_ = 0.0, absolute_ = 0.0, squares_ = 0.0;
    uint32_t count_ = 0, inside_ = 0;
};

using Tallies = std::map<std::string, Tally>;

/// Letters told against the truth.
struct Letters {
    uint32_t people = 0, exact = 0, within_one = 0, sure = 0, sure_right = 0;
    double log_loss = 0.0;
    std::map<int, uint32_t> chart_off;  // what a chart by true height and weight says: letters off the truth

    /// Of the chart, were each of its answers given with the frequency of that miss: the best that it can be.
    double chart_log_loss() const {
        double sum = 0.0;
        for (const auto& [off, n] : chart_off) sum -= n * std::log(double(n) / people);
        return sum / std::max(1u, people);
    }
    double chart_exact() const { return chart_off.count(0) ? double(chart_off.at(0)) / people : 0.0; }
};

struct Set {
    std::string name;
    BodySpace space;
    Dress dress;
    // As a person whose clothes nobody tells of, and where the scan is told that they are tight.
    Tallies front{}, both{}, front_told{}, both_told{}, paper{};
    Letters letters{}, letters_told{};
    Samples last_ms{};  // what is left to do when the capture ends
    uint32_t scans = 0, failed = 0;
    bool tight() const { return dress == Dress::kTight; }
};

void add(const std::vector<vfit_measurement>& measured, const BodyMeasures& truth, Tallies& out) {
    for (const vfit_measurement& m : measured)
        if (const auto t = truth.find(m.key); t != truth.end())
            out[m.key].add(double(m.value) - t->second, double(m.sigma));
}

vfit_measurement exactly(const char* key, const BodyMeasures& truth) {
    vfit_measurement m = vfit_measurement_init();
    std::snprintf(m.key, sizeof m.key, "%s", key);
    m.value = float(truth.at(key));
    return m;
}

/// The letter of the chest's girth, told and true, and what a chart by height and weight says.
void judge_size(vfit_context context, const PersonOfPopulation& person,
                const std::vector<vfit_measurement>& measured, Letters& out) {
    const bool man = person.sex == VFIT_SEX_MALE;
    const SizeChart chart = open_chart(context, man ? "en13402_men" : "en13402_women"),
                    by_weight = open_chart(context, man ? "height_weight_men" : "height_weight_women");
    const Json truth = sizes_json(chart.get(), "short_sleeves", {exactly("chest_girth_m", person.measures)}),
               told = sizes_json(chart.get(), "short_sleeves", measured),
               guess = sizes_json(
                   by_weight.get(), "short_sleeves",
                   {exactly("stature_m", person.measures), exactly("body_mass_kg", person.measures)});
    const std::string letter = truth[0]["label"];
    std::vector<std::string> order;
    for (const auto& row : list<vfit_size_row>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_size_chart_rows(chart.get(), items, stride, n);
         }))
        if (std::string(row.garment_kind) == "short_sleeves") order.push_back(row.label);
    const auto place = [&](const std::string& label) {
        return int(std::find(order.begin(), order.end(), label) - order.begin());
    };
    const std::string best = told[0]["label"];
    const double probability = told[0]["probability"];
    ++out.people;
    out.exact += best == letter;
    out.within_one += std::abs(place(best) - place(letter)) <= 1;
    if (probability >= 0.7 && probability <= 0.9) ++out.sure, out.sure_right += best == letter;
    ++out.chart_off[place(guess[0]["label"]) - place(letter)];
    for (const Json& size : told)
        if (size["label"] == letter)
            out.log_loss -= std::log(std::max(1e-6, size["probability"].get<double>()));
}

/// One person before the camera, scanned in several ways at once.
class ScanOfPerson {
public:
    ScanOfPerson(const ScanScene& scene, vfit_sex sex)
        : scene_(scene), context_(open_context()), tracker_(open_own_tracker(context_.get())) {
        vfit_scan_desc desc = vfit_scan_desc_init();
        desc.frame_count = scene.front_frames, desc.side_frame_count = scene.side_frames;
        desc.sex = sex;
        desc.method = VFIT_SCAN_PROPORTIONS;
        check(vfit_scan_create(context_.get(), &desc, paper_.out()));
        desc.method = VFIT_SCAN_FIT, desc.flags = VFIT_SCAN_BARE;
        check(vfit_scan_create(context_.get(), &desc, fit_.out()));
        desc.flags |= VFIT_SCAN_TIGHT;
        check(vfit_scan_create(context_.get(), &desc, told_.out()));
    }
    /// False where fewer than half of the frames counted; why is told.
    bool front(const PersonOfPopulation& person) {
        play(scene_.front_uri(person), true);
        if (state_.frames_taken >= scene_.front_frames / 2) return true;
        std::cerr << "no scan: " << guidance_text(state_.guidance) << ": " << scene_.front_uri(person)
                  << "\n";
        return false;
    }
    bool side(const PersonOfPopulation& person) {
        play(scene_.side_uri(person), false);
        if (state_.side_frames_taken >= scene_.side_frames / 2) return true;
        std::cerr << "no side view: " << guidance_text(state_.guidance) << ": " << scene_.side_uri(person)
                  << "\n";
        return false;
    }
    vfit_context context() const { return context_.get(); }
    vfit_scan fit() const { return fit_.get(); }
    vfit_scan told_tight() const { return told_.get(); }
    vfit_scan paper() const { return paper_.get(); }
    double last_frame_ms() const { return double(state_.compute_ms); }

private:
    void play(const std::string& uri, bool front) {
        Source source(context_.get(), uri);
        while (const auto frame = source.next()) {
            Frame tracked;
            check(vfit_tracker_update(tracker_.get(), frame->get(), tracked.out()));
            const auto bodies = bodies_of(tracked.get());
            if (bodies.empty()) continue;
            const uint32_t body = bodies.front().body_id;
            check(vfit_scan_add(fit_.get(), tracked.get(), body, &state_));
            check(vfit_scan_add(told_.get(), tracked.get(), body, nullptr));
            if (front) check(vfit_scan_add(paper_.get(), tracked.get(), body, nullptr));
        }
    }

    const ScanScene& scene_;
    Context context_;
    Tracker tracker_;
    Scan fit_, told_, paper_;
    vfit_scan_state state_ = vfit_scan_state_init();
};

void scan(const PersonOfPopulation& person, const ScanScene& scene, bool told_sex, Set& set) {
    ScanOfPerson one(scene, told_sex ? person.sex : VFIT_SEX_UNKNOWN);
    ++set.scans;
    if (!one.front(person)) {
        ++set.failed;
        return;
    }
    const Timer timer;
    const auto measured = measurements_of(one.fit());
    set.last_ms.add(timer.ms() + one.last_frame_ms());
    add(measured, person.measures, set.front);
    add(measurements_of(one.told_tight()), person.measures, set.front_told);
    add(measurements_of(one.paper()), person.measures, set.paper);
    if (!one.side(person)) {
        ++set.failed;
        return;
    }
    const auto both = measurements_of(one.fit()), told = measurements_of(one.told_tight());
    add(both, person.measures, set.both);
    add(told, person.measures, set.both_told);
    judge_size(one.context(), person, both, set.letters);
    judge_size(one.context(), person, told, set.letters_told);
}

void print(const Set& set) {
    std::vector<std::pair<const char*, const Tallies*>> columns = {{"front", &set.front},
                                                                   {"front and side", &set.both}};
    if (set.tight())
        columns.insert(columns.end(), {{"front, told tight", &set.front_told}, {"and side", &set.both_told}});
    columns.push_back({"the paper's method", &set.paper});
    std::cout << "\nSYNTHETIC, " << set.name << ": " << set.scans << " scans, " << set.failed
              << " of them failed. Absolute error with 95 % confidence, bias, share within the 90 % "
                 "interval; mm, kg\n"
              << std::left << std::setw(24) << "";
    for (const auto& [title, tallies] : columns) std::cout << std::setw(25) << (std::string("  ") + title);
    std::cout << std::right << "\n";
    for (const auto& [key, front] : set.front) {
        const double unit = key == "body_mass_kg" ? 1.0 : 1000.0;
        std::cout << "  " << std::left << std::setw(22) << key << std::right << std::fixed;
        for (const auto& [title, tallies] : columns) {
            const auto found = tallies->find(key);
            if (found == tallies->end()) continue;
            const Tally& t = found->second;
            std::cout << std::setprecision(1) << std::setw(6) << unit * t.mean() << " +-" << std::setw(4)
                      << unit * t.mean_confidence() << std::setw(6) << unit * t.bias() << std::setw(4)
                      << std::setprecision(0) << 100 * t.covered() << " %";
        }
        std::cout << "\n";
    }
    const Letters& l = set.tight() ? set.letters_told : set.letters;
    const double n = std::max(1u, l.people);
    std::cout << std::setprecision(3) << "  size letter, front and side: exact " << l.exact / n
              << between(confidence(l.exact, n)) << ", within one " << l.within_one / n
              << between(confidence(l.within_one, n)) << ", log loss " << l.log_loss / n
              << "\n  a chart by true height and weight: exact " << l.chart_exact()
              << ", log loss (at its best) " << l.chart_log_loss() << "\n";
}

/// Targets by set: inside, outside, clothed. Where clothes are tight the scan is told so.
void judge(const Set& set, size_t column, Targets& targets) {
    const Tallies &front = set.tight() ? set.front_told : set.front,
                  &both = set.tight() ? set.both_told : set.both;
    if (front.count("stature_m") == 0 || both.count("stature_m") == 0) {
        targets.judge(set.name + ": scans that came about", 0.0, Aim::at_least, 1.0, 0);
        return;
    }
    const auto most = [&](const char* what, const Tallies& tallies, const char* key,
                          std::array<double, 3> mm) {
        targets.judge(set.name + ": " + key + ", " + what, 1000 * tallies.at(key).mean(), Aim::at_most,
                      mm[column], 1, " mm");
    };
    const auto bias = [&](const Tallies& tallies, const char* key, double mm) {
        targets.judge(set.name + ": " + key + ", bias", 1000 * std::abs(tallies.at(key).bias()), Aim::at_most,
                      mm, 1, " mm");
    };
    most("front", front, "stature_m", {5, 6, 8});
    bias(front, "stature_m", 4);
    most("front", front, "shoulder_breadth_m", {10, 12, 14});
    most("front", front, "chest_girth_m", {18, 24, 32});
    most("front", front, "waist_girth_m", {18, 22, 32});
    most("front", front, "hip_girth_m", {18, 18, 32});
    for (const char* key : {"chest_girth_m", "waist_girth_m", "hip_girth_m"}) {
        most("front and side", both, key, {10, 12, 22});
        bias(both, key, 9);
    }
    most("front and side", both, "inside_leg_m", {10, 12, 14});
    most("front and side", both, "arm_length_m", {10, 12, 14});
    const Tally *least = nullptr, *largest = nullptr;
    double sum = 0.0;
    for (const auto& [key, t] : both) {
        if (!least || t.covered() < least->covered()) least = &t;
        if (!largest || t.covered() > largest->covered()) largest = &t;
        sum += t.covered();
    }
    targets.judge(set.name + ": 90 % intervals cover, mean of measures", sum / double(both.size()),
                  Aim::at_least, 0.85, 3);
    targets.judge(set.name + ": the same, at most", sum / double(both.size()), Aim::at_most, 0.95, 3);
    targets.judge(
        set.name + ": 90 % intervals cover, least covered measure" + between(least->covered_confidence()),
        least->covered(), Aim::at_least, 0.85, 3);
    targets.judge(
        set.name + ": 90 % intervals cover, most covered measure" + between(largest->covered_confidence()),
        largest->covered(), Aim::at_most, 0.95, 3);
    const Letters& l = set.tight() ? set.letters_told : set.letters;
    const double n = std::max(1u, l.people);
    if (column < 2) {
        targets.judge(set.name + ": size letter exact" + between(confidence(l.exact, n)), l.exact / n,
                      Aim::at_least, column == 0 ? 0.85 : 0.82, 3);
        targets.judge(set.name + ": size letter within one", l.within_one / n, Aim::at_least, 0.995, 3);
    } else if (l.sure > 0) {
        const std::string what =
            set.name + ": letters said with 0.7 to 0.9 are right" + between(confidence(l.sure_right, l.sure));
        targets.judge(what + ", at least", double(l.sure_right) / l.sure, Aim::at_least, 0.7, 3);
        targets.judge(what + ", at most", double(l.sure_right) / l.sure, Aim::at_most, 0.9, 3);
        targets.judge(set.name + ": log loss beside the chart's", l.log_loss / n, Aim::at_most,
                      l.chart_log_loss(), 3);
    }
    targets.judge(set.name + ": beyond the capture of the front view, median", set.last_ms.quantile(0.5),
                  Aim::at_most, 60, 1, " ms");
}

/// The same people in the same clothes before the same camera, who come back and stand anew.
struct Repeated {
    std::string name;
    BodySpace space;
    Dress dress;
};

void repeat(const Options& o, const std::shared_ptr<const BodyModel>& body, const Repeated& set,
            Targets& targets, Json& out) {
    constexpr const char* kKeys[] = {"stature_m", "chest_girth_m", "waist_girth_m", "hip_girth_m"};
    std::map<std::string, double> squares;
    std::map<std::string, double> own;  // share of an error that repeats: squares of people's mean errors
    uint32_t people = 0, scans = 0;
    const bool tight = set.dress == Dress::kTight;
    Population population(body, set.space, o.seed);
    for (uint32_t i = o.first; i < o.first + std::max(3u, o.count / 10); ++i) {
        const PersonOfPopulation person = population.draw(i);
        const ScanScene first = ScanScene::draw(set.dress, o.seed * 104729u + i);
        std::map<std::string, std::vector<double>> errors;
        for (uint32_t s = 0; s < o.repeats; ++s) {
            const ScanScene scene = first.again(s);
            ScanOfPerson one(scene, o.told_sex ? person.sex : VFIT_SEX_UNKNOWN);
            if (!one.front(person) || !one.side(person)) continue;
            for (const vfit_measurement& m : measurements_of(tight ? one.told_tight() : one.fit()))
                if (std::find(std::begin(kKeys), std::end(kKeys), std::string(m.key)) != std::end(kKeys))
                    errors[m.key].push_back(double(m.value) - person.measures.at(m.key));
            ++scans;
        }
        if (errors.empty() || errors.begin()->second.size() < 3) continue;
        ++people;
        for (const auto& [key, list] : errors) {
            double mean = 0.0, spread = 0.0;
            for (const double e : list) mean += e / double(list.size());
            for (const double e : list) spread += (e - mean) * (e - mean) / double(list.size() - 1);
            squares[key] += spread, own[key] += mean * mean;
        }
    }
    if (!o.json)
        std::cout << "\nSYNTHETIC, " << set.name << ": " << people << " people, " << scans
                  << " scans in all, front and side" << (tight ? ", told tight" : ", told nothing") << "\n";
    Json one = {{"set", set.name}, {"people", people}, {"scans", scans}};
    for (const char* key : kKeys) {
        const double sd = 1000 * std::sqrt(squares[key] / std::max(1u, people)),
                     share = own[key] / std::max(1e-12, own[key] + squares[key]);
        if (!o.json)
            std::cout << "  " << std::left << std::setw(22) << key << std::right << std::fixed
                      << std::setprecision(1) << " sd from scan to scan " << sd
                      << " mm; share of the squared error that repeats " << std::setprecision(2) << share
                      << "\n";
        one[key] = {{"sd_mm", sd}, {"repeats", share}};
        targets.judge(set.name + ": " + key + ", sd over " + std::to_string(o.repeats) + " scans", sd,
                      Aim::at_most, std::string(key) == "stature_m" ? 4.0 : 8.0, 1, " mm");
    }
    out.push_back(one);
}

void run(const Options& o) {
    const auto body = BodyModel::load(library_file("vfit_data/body.bin"));
    std::vector<Set> sets = {{"in space", BodySpace::kInside, Dress::kTight},
                             {"off space", BodySpace::kOutside, Dress::kTight},
                             {"clothed", BodySpace::kOutside, Dress::kClothed}};
    Targets targets(o.json);
    Json out = Json::array();
    const auto asked_for = [&](const std::string& name) { return name.rfind(o.only, 0) == 0; };
    std::unique_ptr<Population> population;
    BodySpace made = BodySpace::kInside;
    for (size_t column = 0; column < sets.size(); ++column) {
        Set& set = sets[column];
        if (!asked_for(set.name)) continue;
        if (!population || made != set.space)
            population = std::make_unique<Population>(body, made = set.space, o.seed);
        for (uint32_t i = o.first; i < o.first + o.count; ++i)
            scan(population->draw(i), ScanScene::draw(set.dress, o.seed * 104729u + i), o.told_sex, set);
        if (!o.json) print(set);
        judge(set, column, targets);
        const double n = std::max(1u, set.letters.people);
        Json one = {{"set", set.name},
                    {"scans", set.scans},
                    {"failed", set.failed},
                    {"beyond_capture_ms", set.last_ms.json()},
                    {"log_loss", set.letters.log_loss / n},
                    {"log_loss_height_by_weight", set.letters.chart_log_loss()}};
        for (const auto& [name, tallies] : {std::pair("front", &set.front),
                                            {"both", &set.both},
                                            {"front_told_tight", &set.front_told},
                                            {"both_told_tight", &set.both_told},
                                            {"paper", &set.paper}})
            for (const auto& [key, t] : *tallies) one[name][key] = t.json();
        out.push_back(one);
    }
    for (const Repeated& set : {Repeated{"repeated in space", BodySpace::kInside, Dress::kTight},
                                {"repeated off space", BodySpace::kOutside, Dress::kTight},
                                {"repeated in clothes", BodySpace::kOutside, Dress::kClothed}})
        if (asked_for(set.name)) repeat(o, body, set, targets, out);
    if (o.json)
        print_document({{"sets", out}, {"targets", targets.json()}});
    else
        std::cout << "\n"
                  << targets.count() - targets.missed() << " of " << targets.count() << " targets hit\n";
}

}  // namespace

void add_measure(Command& app) {
    Command command = app.add_subcommand("measure", "Measures of virtual people by each method (synthetic)");
    auto o = std::make_shared<Options>();
    command.add_option("--count", o->count, "People of each set").within(1, 100000);
    command
        .add_option("--repeats", o->repeats,
                    "Scans of each person of the repeated sets, which have a tenth of the people")
        .within(3, 1000);
    command.add_option("--first", o->first, "Number of the first");
    command.add_option("--seed", o->seed, "Of the population; those of training are 1000 and above");
    command.add_option("--only", o->only,
                       "Sets whose name begins so: in space, off space, clothed, repeated (in space, off "
                       "space, in clothes)");
    command.add_flag("--told-sex", o->told_sex, "Tell the scan the person's sex");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
