// vfit-bench track: how well and how fast the built-in tracker sees people. Real recordings and virtual
// people are judged and printed apart, each figure beside its target.
#include <filesystem>
#include <iostream>

#include "bench/bench.h"
#include "bench/track_parts.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string recordings, scenes, only;
    JudgeOptions people;
};

bool wants(const Options& o, const char* part) { return o.only.empty() || o.only == part; }

void run(const Options& o) {
    pin_to_cores(1);
    Targets targets(o.people.quiet);
    Json report = {{"seed", o.people.seed}, {"long", o.people.long_run}};
    // Time first: nothing of the other parts has warmed or filled anything then.
    if (wants(o, "time")) report["synthetic"]["time"] = judge_time(o.people, targets);
    if (wants(o, "joints")) report["synthetic"]["joints"] = judge_virtual(o.people, targets);
    if (wants(o, "facing")) report["synthetic"]["facing"] = judge_facing(o.people, targets);
    if (wants(o, "rooms")) report["synthetic"]["rooms"] = judge_rooms(o.people, targets);
    if (wants(o, "furniture")) report["synthetic"]["furniture"] = judge_furniture(o.people, targets);
    if (wants(o, "walls")) report["synthetic"]["walls"] = judge_walls(o.people, targets);
    if (wants(o, "half-seen")) report["synthetic"]["half_seen"] = judge_half_seen(o.people, targets);
    if (wants(o, "distance")) report["synthetic"]["distance"] = judge_distance(o.people, targets);
    if (wants(o, "events")) report["synthetic"]["events"] = judge_events(o.people, targets);
    if (!o.scenes.empty() && wants(o, "stills"))
        report["real"]["stills"] = judge_stills(o.scenes, o.people.quiet, targets);
    if (!o.recordings.empty() && wants(o, "recordings")) {
        if (!o.people.quiet) std::cout << "\n";
        report["real"]["recordings"] = judge_real(o.recordings, o.people, targets);
    }
    report["targets"] = targets.json();
    if (o.people.quiet) {
        print_document(report);
        return;
    }
    if (o.recordings.empty()) std::cout << "\nREAL recordings: none given, nothing judged\n";
    std::cout << "\n" << targets.count() - targets.missed() << " of " << targets.count() << " targets hit\n";
}

}  // namespace

void add_track(Command& app) {
    Command command =
        app.add_subcommand("track", "The tracker: joints, events and time, real and synthetic apart");
    auto o = std::make_shared<Options>();
    command
        .add_option("recordings", o->recordings,
                    "Folder of recordings named ..._s<person>_...: real people too")
        .existing_folder();
    command
        .add_option("--scenes", o->scenes,
                    "Folder of the real stills (default: scenes beside the recordings)")
        .existing_folder();
    command.add_option("--seed", o->people.seed, "Of bodies, rooms and noise").within(1, 1'000'000);
    command.add_flag("--long", o->people.long_run, "Each motion with both sensors and three people");
    command.add_option("--only", o->only, "One part")
        .one_of({"time", "joints", "facing", "rooms", "furniture", "walls", "half-seen", "distance", "events",
                 "stills", "recordings"});
    command
        .add_option_function(
            "--fit",
            [o](const std::string& value) {
                o->people.fit = value == "off"         ? VFIT_FIT_OFF
                                : value == "everybody" ? VFIT_FIT_EVERYBODY
                                                       : VFIT_FIT_AUTO;
            },
            "Whose joints the body fit moves, in joints and recordings (default: auto)")
        .one_of({"auto", "off", "everybody"});
    command.add_flag("--json", o->people.quiet, "Print JSON");
    command.callback([o] {
        if (o->scenes.empty() && !o->recordings.empty()) {
            const auto beside = std::filesystem::path(o->recordings) / ".." / "scenes";
            if (std::filesystem::is_directory(beside)) o->scenes = beside.string();
        }
        run(*o);
    });
}

}  // namespace vfit::tools
