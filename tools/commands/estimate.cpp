// vfit estimate: from the measures that a person knows to all the others, and which of them may be wrong.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <span>
#include <sstream>

#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::vector<std::string> measures;
    std::string sex = "unknown", population = "adults", known, profile;
    float age = 0.0f;
    bool json = false;
};

struct Unit {
    const char* name;
    double in_si;  // metres or kilograms
};
constexpr Unit kLengths[] = {{"cm", 0.01}, {"mm", 0.001}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}},
               kMasses[] = {{"kg", 1.0}, {"lb", 0.45359237}, {"st", 6.35029318}};

bool is_mass(const std::string& key) { return key.size() > 3 && key.substr(key.size() - 3) == "_kg"; }

std::vector<std::string> measure_keys() {
    std::vector<std::string> keys;
    char key[48];
    for (uint32_t i = 0; vfit_measure_key(i, key, sizeof key) > 0; ++i) keys.emplace_back(key);
    return keys;
}

/// "stature_m" of "stature_m", "stature" or "height".
std::string key_of(const std::string& name) {
    if (name == "height") return "stature_m";
    if (name == "weight") return "body_mass_kg";
    for (const std::string& key : measure_keys())
        if (key == name || key.substr(0, key.rfind('_')) == name ||
            key.substr(0, key.rfind("_girth")) == name)
            return key;
    // A measure of the host's own is told by its whole key.
    if (name.rfind("x_", 0) == 0) return name;
    throw WrongUsage("\"" + name +
                     "\" is no measure; they are: height, weight, chest, waist, hip and the keys of "
                     "docs/measuring.md");
}

/// "172cm", "5ft8in", "11st4lb", "1.72" (in the key's unit).
double amount_of(const std::string& text, bool mass) {
    double sum = 0.0;
    const std::span<const Unit> units =
        mass ? std::span<const Unit>(kMasses) : std::span<const Unit>(kLengths);
    size_t at = 0;
    while (at < text.size()) {
        const size_t end = text.find_first_not_of("0123456789.", at);
        const std::string digits = text.substr(at, end - at);
        std::istringstream in(digits);
        in.imbue(std::locale::classic());
        double number = 0.0;
        if (!(in >> number) || !in.eof())
            throw WrongUsage("\"" + text + "\" is not an amount such as 172cm or 5ft8in");
        if (end == std::string::npos) {
            if (at != 0) throw WrongUsage("\"" + text + "\" ends without a unit");
            return number;
        }
        at = std::min(text.find_first_of("0123456789.", end), text.size());
        const std::string name = text.substr(end, at - end);
        const auto unit =
            std::find_if(units.begin(), units.end(), [&](const Unit& u) { return name == u.name; });
        if (unit == units.end()) {
            std::string known;
            for (const Unit& u : units) known += std::string(known.empty() ? "" : ", ") + u.name;
            throw WrongUsage("\"" + text + "\": the unit is none of " + known);
        }
        sum += number * unit->in_si;
    }
    if (!(sum > 0.0)) throw WrongUsage("\"" + text + "\" is no amount above 0");
    return sum;
}

/// "waist=81cm", "waist=32in+-4cm".
vfit_measurement measurement_of(const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw WrongUsage("\"" + text + "\" is not MEASURE=AMOUNT, such as height=172cm");
    vfit_measurement m = vfit_measurement_init();
    const std::string key = key_of(text.substr(0, equals)), amount = text.substr(equals + 1);
    const size_t error = amount.find("+-");
    const std::string value = amount.substr(0, error);
    if (value.empty()) throw WrongUsage("\"" + text + "\" has no amount, such as height=172cm");
    m.value = float(amount_of(value, is_mass(key)));
    if (error != std::string::npos) {
        std::string sigma = amount.substr(error + 2);
        // "81cm+-2": in the value's unit.
        if (!sigma.empty() && sigma.find_first_not_of("0123456789.") == std::string::npos)
            sigma += value.substr(value.find_last_of("0123456789.") + 1);
        m.sigma = float(amount_of(sigma, is_mass(key)));
    }
    m.observed = 1;
    key.copy(m.key, sizeof m.key - 1);
    return m;
}

constexpr const char* kKinds[] = {"unlikely", "inches", "pounds", "digit", "swapped"};

struct Estimate {
    Json report;
    std::vector<vfit_measurement> measures;
    vfit_sex sex = VFIT_SEX_UNKNOWN;
};

Estimate estimate(const Options& o) {
    std::vector<vfit_measurement> known;
    vfit_sex sex = sex_from(o.sex);
    if (!o.known.empty()) {
        const StoredMeasures stored = read_measures(o.known);
        known = stored.measurements;
        if (sex == VFIT_SEX_UNKNOWN) sex = stored.sex;
    }
    for (const std::string& text : o.measures) known.push_back(measurement_of(text));
    if (known.empty()) throw WrongUsage("no measure is given: for example height=172cm weight=70kg");
    const Context context = open_context();
    const Population population = open_population(context.get(), o.population);
    vfit_person person = vfit_person_init();
    person.sex = sex;
    person.age_years = o.age;
    const auto measures = list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_population_estimate(population.get(), &person, known.data(), sizeof known[0],
                                        uint32_t(known.size()), items, stride, n);
    });
    Json out;
    out["population"] = o.population;
    out["sex"] = sex_text(sex);
    out["measurements"] = measurements_json(measures);
    out["doubts"] = Json::array();
    for (const vfit_doubt& d : list<vfit_doubt>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_population_check(population.get(), &person, known.data(), sizeof known[0],
                                          uint32_t(known.size()), items, stride, n);
         })) {
        Json doubt = {{"key", d.key},           {"kind", kKinds[d.kind]},
                      {"value", d.value},       {"suggested", d.suggested},
                      {"expected", d.expected}, {"sigma", d.sigma}};
        if (d.other_key[0]) doubt["other_key"] = d.other_key;
        out["doubts"].push_back(doubt);
    }
    return {out, measures, sex};
}

std::string in_words(const std::string& key, double value) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(1) << (is_mass(key) ? value : 100.0 * value)
        << (is_mass(key) ? " kg" : " cm");
    return out.str();
}

void print(const Json& result) {
    print_measurements(result["measurements"]);
    for (const Json& d : result["doubts"]) {
        const std::string key = d["key"], kind = d["kind"];
        std::cout << "doubtful: " << key << " " << in_words(key, d["value"]) << "; by the others "
                  << in_words(key, d["expected"]) << " +- " << in_words(key, d["sigma"]);
        if (kind == "swapped")
            std::cout << "; swapped with " << d["other_key"].get<std::string>() << "?";
        else if (kind == "inches" || kind == "pounds")
            std::cout << "; in " << kind << ", " << in_words(key, d["suggested"]) << "?";
        else if (kind == "digit")
            std::cout << "; mistyped for " << in_words(key, d["suggested"]) << "?";
        std::cout << "\n";
    }
}

}  // namespace

void add_estimate(Command& app) {
    Command command = app.add_subcommand("estimate", "All measures from those that a person knows");
    auto o = std::make_shared<Options>();
    command.add_option(
        "measures", o->measures,
        "height=172cm weight=70kg waist=32in+-4cm: units m, cm, mm, in, ft, kg, lb, st; none: of "
        "the key; after +- a standard deviation");
    command.add_option("--sex", o->sex, "f or m, where known").one_of({"f", "m", "unknown"});
    command.add_option("--age", o->age, "Years, 18 to 100, where known");
    command.add_option("--known", o->known,
                       "Known measures from a file: a profile or a report of vfit measure");
    command.add_option("--population", o->population, "Name of a population, or file (default: adults)");
    command.add_option("--profile", o->profile, "File to write the measures to, for vfit size");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        const Estimate result = estimate(*o);
        if (o->json)
            print_document(result.report);
        else
            print(result.report);
        if (!o->profile.empty()) write_text(o->profile, profile_text(result.measures, result.sex));
    });
}

}  // namespace vfit::tools
