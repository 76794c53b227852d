// vfit-bench population: the virtual people on whom measuring is judged and trained, and how near they come
// to the survey that they are drawn from.
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <vector>

#include <opencv2/core.hpp>

#include "bench/bench.h"
#include "client/output.h"
#include "core/platform.h"
#include "population/body_measures.h"
#include "population/population.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 20, seed = 1, first = 0;
    std::string space = "in";
    std::string meshes;
    bool json = false;
};

/// A girth, and the breadth and depth at its level: of the body and of the survey.
struct Level {
    const char *name, *girth, *breadth, *depth;
    const char *survey_girth, *survey_breadth, *survey_depth;
};
constexpr Level kLevels[] = {{"chest", "chest_girth_m", "chest_breadth_m", "chest_depth_m",
                              "chestcircumference", "chestbreadth", "chestdepth"},
                             {"waist at the navel", "navel_girth_m", "navel_breadth_m", "navel_depth_m",
                              "waistcircumference", "waistbreadth", "waistdepth"},
                             {"hip", "hip_girth_m", "hip_breadth_m", "hip_depth_m", "buttockcircumference",
                              "hipbreadth", "buttockdepth"}};
constexpr uint32_t kEnough = 40;   // people for a scatter
constexpr double kTape_mm = 10.0;  // of a survey's scatter, standard deviation, that tape and caliper make

/// Standard deviation of a girth about its regression on breadth and depth, millimetres.
double scatter_mm(const std::vector<PersonOfPopulation>& people, vfit_sex sex, const Level& level) {
    std::vector<cv::Vec4d> rows;
    for (const PersonOfPopulation& p : people)
        if (p.sex == sex)
            rows.push_back(
                {1.0, p.measures.at(level.breadth), p.measures.at(level.depth), p.measures.at(level.girth)});
    cv::Mat_<double> known(int(rows.size()), 3), girths(int(rows.size()), 1), line;
    for (int i = 0; i < int(rows.size()); ++i) {
        for (int k = 0; k < 3; ++k) known(i, k) = rows[size_t(i)][k];
        girths(i) = rows[size_t(i)][3];
    }
    cv::solve(known, girths, line, cv::DECOMP_SVD);
    return 1000.0 * cv::norm(known * line - girths) / std::sqrt(double(rows.size()) - 3.0);
}

void print_scatter(const std::vector<PersonOfPopulation>& people, const Anthropometry& survey) {
    std::cout << "\n  scatter of a girth about breadth and depth at its level, sd in mm\n"
              << "                            these   real people   without tape error\n";
    for (const Level& level : kLevels)
        for (const vfit_sex sex : {VFIT_SEX_MALE, VFIT_SEX_FEMALE}) {
            const double real =
                survey.scatter(sex, level.survey_girth, {level.survey_breadth, level.survey_depth});
            std::cout << "  " << std::left << std::setw(20) << level.name << std::setw(6)
                      << (sex == VFIT_SEX_MALE ? "men" : "women") << std::right << std::setw(7)
                      << scatter_mm(people, sex, level) << std::setw(14) << real << std::setw(21)
                      << std::sqrt(std::max(0.0, real * real - kTape_mm * kTape_mm)) << "\n";
        }
}

void run(const Options& o) {
    const Timer start;
    const std::shared_ptr<const BodyModel> model = BodyModel::load(library_file("vfit_data/body.bin"));
    VirtualPeople population(model, body_space(o.space), o.seed);
    if (!o.meshes.empty()) std::filesystem::create_directories(o.meshes);
    const double start_ms = start.ms();
    Json rows = Json::array();
    std::vector<PersonOfPopulation> people;
    const Timer timer;
    for (uint32_t i = o.first; i < o.first + o.count; ++i) {
        const PersonOfPopulation person = population.draw(i);
        if (!o.meshes.empty()) {
            std::vector<float> shape = model->default_shape(person.sex);
            for (const auto& [name, value] : person.shape) shape[size_t(model->parameter(name))] = value;
            write_mesh(o.meshes + "/" + std::to_string(i) + ".obj", model, person.sex, shape);
        }
        if (o.json) {
            rows.push_back({{"number", i},
                            {"sex", person.sex == VFIT_SEX_MALE ? "m" : "f"},
                            {"bmi", person.bmi},
                            {"options", person.options()},
                            {"measures", person.measures}});
            continue;
        }
        people.push_back(person);
        std::cout << std::setw(4) << i << (person.sex == VFIT_SEX_MALE ? " m" : " f") << std::fixed
                  << std::setprecision(1) << "  BMI " << person.bmi;
        for (const char* key : {"stature_m", "shoulder_breadth_m", "chest_girth_m", "waist_girth_m",
                                "hip_girth_m", "chest_depth_m", "inside_leg_m", "arm_length_m"})
            std::cout << "  " << key << " " << 100 * person.measures.at(key);
        std::cout << "\n";
    }
    if (!o.json && o.count >= kEnough) print_scatter(people, population.survey());
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
        .add_option(
            "--space", o->space,
            "varied: nearly as real people differ; in: of the fit's own body space; out: with depths and "
            "local changes beyond it")
        .one_of({"varied", "in", "out"});
    command.add_option("--meshes", o->meshes, "Folder for the meshes on which their girths are taken (OBJ)");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
