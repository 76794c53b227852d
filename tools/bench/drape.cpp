// vfit-bench drape: what the cloth solver does beside the common scene: mechanics, contact, people, crowds,
// endurance.
#include "bench/bench.h"
#include "bench/drape_parts.h"
#include "bench/parts.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string only;
    double minutes = 10.0;
    bool json = false;
};

// The crowd first: it wants two cores, and who is pinned to one does not get them back.
constexpr Part<DrapeJudge> kParts[] = {
    {"crowd", judge_crowd}, {"strip", judge_strip}, {"fabrics", judge_fabrics}, {"scale", judge_scale},
    {"self", judge_self},   {"skin", judge_skin},   {"frame", judge_frame},     {"random", judge_random}};

void drape(const Options& options) {
    Targets targets(options.json);
    judge_parts(kParts, options.only, {targets, options.json, options.minutes});
}

}  // namespace

void add_drape(Command& app) {
    Command command = app.add_subcommand(
        "drape", "Judge the cloth solver: mechanics, contact, people, crowds, endurance (synthetic)");
    auto o = std::make_shared<Options>();
    command.add_option("--only", o->only, "One part").one_of(names_of(kParts));
    command.add_option("--minutes", o->minutes, "Minutes of random motion (default 10)");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { drape(*o); });
}

}  // namespace vfit::tools
