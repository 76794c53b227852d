// vfit-bench motion: filters, feet, limits and times of the stage that turns joints into poses, and skinning.
#include <filesystem>
#include <iostream>

#include "bench/bench.h"
#include "bench/motion_parts.h"
#include "bench/parts.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string shared = "../shared", only;
    bool json = false;
};

constexpr Part<MotionJudge> kParts[] = {
    {"filters", judge_filters},      {"feet", judge_feet}, {"real", judge_real},
    {"vicon", judge_vicon},          {"time", judge_time}, {"skinning", judge_skinning},
    {"characters", judge_characters}};

void motion(const Options& options) {
    RealStreams real;
    if (std::filesystem::is_directory(options.shared + "/data")) {
        real.kinect2 = kinect2_streams(options.shared);
        real.ui_prmd = ui_prmd_streams(options.shared);
        real.markers = ui_prmd_markers(options.shared);
    } else if (!options.json) {
        std::cout << "no real streams at " << options.shared << ": made ones only\n";
    }
    pin_to_cores(1);
    Targets targets(options.json);
    judge_parts(kParts, options.only, {targets, real, options.json, options.shared});
}

}  // namespace

void add_motion(Command& app) {
    Command command =
        app.add_subcommand("motion", "Judge filters, feet, limits and times of the motion stage");
    auto o = std::make_shared<Options>();
    command.add_option("--only", o->only, "One part").one_of(names_of(kParts));
    command.add_option("--shared", o->shared, "Folder with real streams (default ../shared)");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { motion(*o); });
}

}  // namespace vfit::tools
