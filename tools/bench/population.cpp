// vfit-bench population: the virtual people on whom measuring is judged and trained, and how near they come
// to the survey that they are drawn from.
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "client/output.h"
#include "core/platform.h"
#include "population/population.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 20, seed = 1, first = 0;
    std::string space = "in";
    bool json = false;
};

void run(const Options& o) {
    const Timer start;
    Population population(BodyModel::load(library_file("vfit_data/body.bin")),
                          o.space == "in" ? BodySpace::kInside : BodySpace::kOutside, o.seed);
    const double start_ms = start.ms();
    Json rows = Json::array();
    const Timer timer;
    for (uint32_t i = o.first; i < o.first + o.count; ++i) {
        const PersonOfPopulation person = population.draw(i);
        if (o.json) {
            rows.push_back({{"number", i},
                            {"sex", person.sex == VFIT_SEX_MALE ? "m" : "f"},
                            {"bmi", person.bmi},
                            {"options", person.options()},
                            {"measures", person.measures}});
            continue;
        }
        std::cout << std::setw(4) << i << (person.sex == VFIT_SEX_MALE ? " m" : " f") << std::fixed
                  << std::setprecision(1) << "  BMI " << person.bmi;
        for (const char* key : {"stature_m", "shoulder_breadth_m", "chest_girth_m", "waist_girth_m",
                                "hip_girth_m", "chest_depth_m", "inside_leg_m", "arm_length_m"})
            std::cout << "  " << key << " " << 100 * person.measures.at(key);
        std::cout << "\n";
    }
    if (o.json)
        print_document({{"people", rows}});
    else
        std::cout << std::setprecision(0) << "start " << start_ms << " ms, " << timer.ms() / o.count
                  << " ms a person\n";
}

}  // namespace

void add_population(Command& app) {
    Command command =
        app.add_subcommand("population", "Virtual people drawn from a survey of real ones (synthetic)");
    auto o = std::make_shared<Options>();
    command.add_option("--count", o->count, "How many people").within(1, 100000);
    command.add_option("--first", o->first, "Number of the first");
    command.add_option("--seed", o->seed, "Of the population");
    command
        .add_option("--space", o->space,
                    "in: of the fit's own body space; out: with depths and local changes beyond it")
        .one_of({"in", "out"});
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
