// vfit-bench measure: measures of virtual people through the C ABI, against the truth, by each method.
// Synthetic: people drawn from a survey before the virtual camera; bodies inside and outside the fit's space
// are kept apart.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

#include "bench/bench.h"
#include "bench/measure_sets.h"
#include "bench/track_play.h"
#include "client/assets.h"
#include "client/cameras.h"
#include "client/output.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 300, seed = 1, first = 0, repeats = 10;
    std::string only;
    bool json = false, told_sex = false;
};

void add(const std::vector<vfit_measurement>& measured, const BodyMeasures& truth, MeasureTallies& out) {
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

/// Height and weight as people type them: a centimetre and a kilogram off, in whole ones.
std::vector<vfit_measurement> typed_by(const PersonOfPopulation& person, uint32_t seed) {
    Random random(seed);
    std::vector<vfit_measurement> out;
    const auto type = [&](const char* key, double unit) {
        vfit_measurement m = exactly(key, person.measures);
        m.value = float(unit * std::round(double(m.value) / unit + double(random.normal())));
        out.push_back(m);
    };
    type("stature_m", 0.01);
    type("body_mass_kg", 1.0);
    return out;
}

/// What the measures make likely of all, of a person whose sex is told.
std::vector<vfit_measurement> estimated(vfit_context context, vfit_sex sex,
                                        const std::vector<vfit_measurement>& known) {
    const Population population = open_population(context, "adults");
    vfit_person person = vfit_person_init();
    person.sex = sex;
    return list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_population_estimate(population.get(), &person, known.data(), sizeof known[0],
                                        uint32_t(known.size()), items, stride, n);
    });
}

/// The letter of the chest's girth, told and true, and what a chart by height and weight says.
void judge_size(vfit_context context, const PersonOfPopulation& person,
                const std::vector<vfit_measurement>& measured, SizeLetters& out) {
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
    ScanOfPerson(const ScanScene& scene, vfit_sex sex, const std::string& view = "side")
        : scene_(scene), view_(view), context_(open_context()), tracker_(open_own_tracker(context_.get())) {
        vfit_scan_desc desc = vfit_scan_desc_init();
        desc.frame_count = scene.front_frames, desc.side_frame_count = scene.side_frames;
        desc.sex = sex;
        desc.method = VFIT_SCAN_PROPORTIONS;
        check(vfit_scan_create(context_.get(), &desc, paper_.out()));
        desc.method = VFIT_SCAN_FIT, desc.flags = VFIT_SCAN_BARE;
        if (view != "side") desc.side_frame_count = 0;
        if (view == "turn") desc.flags |= VFIT_SCAN_TURN;
        if (view == "cameras") desc.camera_count = kCameras;
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
    /// The other view; likewise.
    bool all_round(const PersonOfPopulation& person) {
        if (view_ == "side") return side(person);
        if (view_ == "turn")
            play(scene_.turn_uri(person), false);
        else
            look_around(person);
        if (result_ == VFIT_OK) return true;
        std::cerr << "no whole " << view_ << ": " << guidance_text(state_.guidance) << ": "
                  << scene_.turn_uri(person) << "\n";
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
    double last_frame_ms() const { return last_frame_ms_; }

private:
    static constexpr uint32_t kCameras = 4;

    /// By all cameras at once, with their true places.
    void look_around(const PersonOfPopulation& person) {
        std::vector<std::string> uris;
        std::vector<CameraPlace> places;
        const float far_m = scene_.distance_to(person);
        for (const SceneCamera& camera : scene_.around(person)) {
            const float turned_rad = camera.turned_deg * kRadPerDegree;
            uris.push_back(camera.uri);
            places.push_back(
                {turned_rad, {far_m * std::sin(turned_rad), 0.0f, far_m * (std::cos(turned_rad) - 1.0f)}});
        }
        TrackOptions own;
        own.joints = own.user_map = VFIT_TRACK_BUILT_IN;
        Cameras cameras(context_.get(), uris, own, places);
        while (cameras.next())
            for (uint32_t camera = 0; camera < kCameras; ++camera)
                add(cameras.tracked(camera), false, camera);
    }

    void play(const std::string& uri, bool front) {
        Source source(context_.get(), uri);
        while (const auto frame = source.next()) {
            Frame tracked;
            check(vfit_tracker_update(tracker_.get(), frame->get(), tracked.out()));
            add(tracked.get(), front);
        }
    }
    void add(vfit_frame tracked, bool front, uint32_t camera = 0) {
        const auto bodies = bodies_of(tracked);
        if (bodies.empty()) return;
        const uint32_t body = bodies.front().body_id;
        result_ = check(vfit_scan_add_from(fit_.get(), camera, tracked, body, &state_));
        // A scan that is complete looks no further.
        if (state_.compute_ms > 0.0f) last_frame_ms_ = double(state_.compute_ms);
        check(vfit_scan_add_from(told_.get(), camera, tracked, body, nullptr));
        if (front) check(vfit_scan_add(paper_.get(), tracked, body, nullptr));
    }

    const ScanScene& scene_;
    std::string view_;
    Context context_;
    Tracker tracker_;
    Scan fit_, told_, paper_;
    vfit_scan_state state_ = vfit_scan_state_init();
    double last_frame_ms_ = 0.0;
    vfit_result result_ = VFIT_NOT_READY;  // of the last frame
};

/// By sex, BMI, stature and sensor.
std::vector<std::string> groups_of(const PersonOfPopulation& person, const ScanScene& scene) {
    const double stature_m = person.measures.at("stature_m");
    return {person.sex == VFIT_SEX_MALE ? "men" : "women",
            person.bmi < 22.0   ? "BMI to 22"
            : person.bmi < 30.0 ? "BMI 22 to 30"
                                : "BMI over 30",
            stature_m < 1.65   ? "stature to 1.65 m"
            : stature_m < 1.78 ? "stature 1.65 to 1.78 m"
                               : "stature over 1.78 m",
            "by " + scene.sensor};
}

void scan(const PersonOfPopulation& person, const ScanScene& scene, uint32_t seed, bool told_sex,
          MeasureSet& set) {
    ScanOfPerson one(scene, told_sex ? person.sex : VFIT_SEX_UNKNOWN, set.view);
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
    if (!one.all_round(person)) {
        ++set.failed;
        return;
    }
    const Timer all_round;
    const auto both = measurements_of(one.fit());
    set.all_round_ms.add(all_round.ms() + one.last_frame_ms());
    const auto told = measurements_of(one.told_tight());
    add(both, person.measures, set.both);
    add(told, person.measures, set.both_told);
    if (set.is_varied())
        for (const std::string& group : groups_of(person, scene))
            add(set.tight() ? told : both, person.measures, set.groups[group]);
    const auto typed = estimated(one.context(), person.sex, typed_by(person, seed));
    add(typed, person.measures, set.typed);
    // Where the crown is hidden the statures may be those of two people.
    if (!set.hair)
        add(merged_measurements(set.tight() ? told : both, typed), person.measures, set.both_and_typed);
    judge_size(one.context(), person, both, set.letters);
    judge_size(one.context(), person, told, set.letters_told);
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
    VirtualPeople population(body, set.space, o.seed);
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
    std::vector<MeasureSet> sets = {{"varied", BodySpace::kVaried, Dress::kTight},
                                    {"varied clothed", BodySpace::kVaried, Dress::kClothed},
                                    {"turn", BodySpace::kVaried, Dress::kTight, "turn"},
                                    {"turn clothed", BodySpace::kVaried, Dress::kClothed, "turn"},
                                    {"cameras", BodySpace::kVaried, Dress::kTight, "cameras"},
                                    {"cameras clothed", BodySpace::kVaried, Dress::kClothed, "cameras"},
                                    {"black hair", BodySpace::kVaried, Dress::kTight, "side", true},
                                    {"in space", BodySpace::kInside, Dress::kTight},
                                    {"off space", BodySpace::kOutside, Dress::kTight},
                                    {"clothed", BodySpace::kOutside, Dress::kClothed}};
    Targets targets(o.json);
    Json out = Json::array();
    const auto asked_for = [&](const std::string& name) { return name.rfind(o.only, 0) == 0; };
    std::unique_ptr<VirtualPeople> population;
    BodySpace made = BodySpace::kInside;
    for (MeasureSet& set : sets) {
        if (!asked_for(set.name)) continue;
        if (!population || made != set.space)
            population = std::make_unique<VirtualPeople>(body, made = set.space, o.seed);
        for (uint32_t p = o.first; p < o.first + o.count; ++p) {
            const uint32_t seed = o.seed * 104729u + p;
            const ScanScene scene = ScanScene::draw(set.dress, seed);
            scan(population->draw(p), set.hair ? scene.with_black_hair() : scene, seed, o.told_sex, set);
        }
        if (!o.json) print(set);
        judge(set, targets);
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
                                            {"typed", &set.typed},
                                            {"both_and_typed", &set.both_and_typed},
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
                       "Sets whose name begins so: varied, varied clothed, turn, turn clothed, black hair, "
                       "in space, off space, clothed, repeated "
                       "(in space, off space, in clothes)");
    command.add_flag("--told-sex", o->told_sex, "Tell the scan the person's sex");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
