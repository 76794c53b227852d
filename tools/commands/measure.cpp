// vfit measure: scans the person of a recording and prints the measures.
#include <bit>
#include <iomanip>
#include <iostream>

#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kSideFrames = 15, kNotSaid = UINT32_MAX;

struct Options {
    std::string source, method, garment = "short_sleeves", sex = "unknown";
    uint32_t frames = 0, side_frames = kNotSaid;
    bool json = false, bare = false, tight = false, turn = false;
    std::string profile, merged, own, calibration, places;
    std::vector<std::string> cameras;
    TrackOptions track;
};

Json measure(const Options& options) {
    const vfit_scan_method method = scan_method_from(options.method);
    // A file that cannot be read is told of before the scan.
    std::vector<vfit_measurement> earlier;
    if (!options.merged.empty()) earlier = read_measures(options.merged).measurements;
    const std::string own = options.own.empty() ? std::string() : read_text(options.own);
    const std::string calibration =
        options.calibration.empty() ? std::string() : read_text(options.calibration);
    const Context context = open_context();
    const ScanRun run = scan_source(
        context.get(), options.source,
        {options.frames, sex_from(options.sex), method, options.track,
         options.side_frames != kNotSaid            ? options.side_frames
         : options.turn || !options.cameras.empty() ? 0u
                                                    : kSideFrames,
         (options.bare ? uint32_t{VFIT_SCAN_BARE} : 0u) | (options.tight ? uint32_t{VFIT_SCAN_TIGHT} : 0u) |
             (options.turn ? uint32_t{VFIT_SCAN_TURN} : 0u),
         options.cameras,
         options.places.empty() ? std::vector<CameraPlace>{}
                                : read_places(options.places, options.cameras.size() + 1)});
    Json out;
    out["method"] = scan_method_text(run.method);
    if (!run.note.empty()) out["note"] = run.note;
    if (options.turn && run.method == VFIT_SCAN_FIT && !run.complete)
        out["note"] = "no whole turn was seen: half of one counts, less than that does not";
    if (!options.cameras.empty() && run.method == VFIT_SCAN_FIT && !run.complete)
        out["note"] = "not every camera has shown what was wanted of it: measures are by those that have";
    out["frames"] = run.frames_taken;
    if (run.method == VFIT_SCAN_FIT) out["side_frames"] = run.side_frames_taken;
    if (options.turn || !options.cameras.empty())
        out["turned"] = double(std::popcount(run.turn_seen)) / double(VFIT_TURN_WAYS);
    std::vector<vfit_measurement> measured = measurements_of(run.scan.get());
    // Before the merge: what is kept of an earlier scan has been calibrated already.
    if (!options.calibration.empty()) measured = calibrated_measurements(calibration, measured);
    if (!options.merged.empty()) measured = merged_measurements(earlier, measured);
    if (!options.own.empty()) {
        Avatar avatar;
        check(vfit_avatar_create_from_scan(context.get(), nullptr, run.scan.get(), avatar.out()));
        for (const vfit_measurement& m :
             list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
                 return vfit_avatar_measure_own(avatar.get(), own.data(), own.size(), items, stride, n);
             }))
            measured.push_back(m);
    }
    out["measurements"] = measurements_json(measured);
    out["colliders"] = Json::array();
    for (const auto& c : list<vfit_collider>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_scan_colliders(run.scan.get(), items, stride, n);
         }))
        out["colliders"].push_back({{"joint", joint_name(c.joint)}, {"radius_m", c.radius}});
    vfit_scale scale = vfit_scale_init();
    check(vfit_scan_scale(run.scan.get(), options.garment.c_str(), &scale));
    out["scale"] = {{"x", scale.x}, {"y", scale.y}};
    out["compute_ms"] = {{"total", run.compute_ms}, {"per_frame", run.compute_ms / run.frames_taken}};
    return out;
}

void print(const Json& result) {
    if (result.contains("note")) std::cout << result["note"].get<std::string>() << "\n";
    std::cout << result["frames"] << " frames, " << std::fixed << std::setprecision(2)
              << result["compute_ms"]["total"].get<double>() << " ms\n";
    print_measurements(result["measurements"]);
}

}  // namespace

void add_track_options(Command& command, TrackOptions& options) {
    const auto add = [&](const char* name, vfit_track_source& source) {
        const auto set = [&source](const std::string& value) {
            source = value == "tracked" ? VFIT_TRACK_BUILT_IN : VFIT_TRACK_GIVEN;
        };
        command
            .add_option_function(name, set,
                                 "recorded: the source's own; tracked: the tracker's (default: the source's "
                                 "where it has them)")
            .one_of({"recorded", "tracked"});
    };
    add("--joints", options.joints);
    add("--user-map", options.user_map);
    const auto is_rule = [](const std::string& value) {
        return value == "nearest" || value == "centred" || value == "first";
    };
    command
        .add_option_function(
            "--active",
            [&options, is_rule](const std::string& value) {
                if (is_rule(value))
                    options.follow = value == "nearest"   ? VFIT_FOLLOW_NEAREST
                                     : value == "centred" ? VFIT_FOLLOW_CENTRED
                                                          : VFIT_FOLLOW_FIRST;
                else
                    options.chosen = static_cast<uint32_t>(std::stoul(value));
                options.asked = true;
            },
            "Whom to follow: nearest (default), centred, first, or the id of a person")
        .check([is_rule](const std::string& value) {
            const bool digits = !value.empty() && value.size() <= 3 &&
                                value.find_first_not_of("0123456789") == std::string::npos;
            const bool id = digits && std::stoul(value) >= 1 && std::stoul(value) <= 255;
            return is_rule(value) || id ? std::string()
                                        : "\"" + value + "\" is none of nearest, centred, first, 1..255";
        });
}

void add_measure(Command& app) {
    Command command = app.add_subcommand("measure", "Measure the person of a recording or sensor");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->source, "Recording folder or sensor URI").required();
    command
        .add_option("--method", o->method,
                    "How to measure (default: fit; paper where no frame can be fitted)")
        .one_of({"fit", "paper", "paper-as-printed"});
    command.add_option("--garment", o->garment, "Garment kind that the scale is for");
    command.add_option("--frames", o->frames, "Frames to average (default 30)").within(1, 3000);
    command
        .add_option("--side-frames", o->side_frames,
                    "Of --method fit: frames to wait for from the side, after those from the front (default "
                    "15, with --turn or --camera 0)")
        .within(0, 3000);
    command.add_option("--sex", o->sex, "f or m, where known").one_of({"f", "m", "unknown"});
    command.add_flag("--bare", o->bare, "Of --method fit: no shoes, and no hair on the crown");
    command.add_flag("--tight", o->tight, "Of --method fit: the clothes lie on the skin");
    command.add_flag("--turn", o->turn,
                     "Of --method fit: after the other frames the person turns once round on the spot");
    command.add_option(
        "--camera", o->cameras,
        "Of --method fit: another camera that sees the person at the same time (once for each)");
    command.add_option("--places", o->places, "How all cameras stand to each other (vfit cameras)");
    command.add_option("--own", o->own,
                       "File of measures of your own (docs/measuring.md), taken on the avatar of the scan");
    command.add_option("--merge", o->merged,
                       "Profile of an earlier scan of the same person, to merge with this one");
    command.add_option("--calibration", o->calibration,
                       "What your own tape differs by (vfit calibrate): measures as it would tell them");
    command.add_option("--profile", o->profile, "File to write the measures to, for vfit size and --merge");
    command.add_flag("--json", o->json, "Print JSON");
    add_track_options(command, o->track);
    command.callback([o] {
        if (o->turn && !o->cameras.empty())
            throw WrongUsage("--turn is seen by one camera: leave --camera out");
        if (!o->places.empty() && o->cameras.empty()) throw WrongUsage("--places needs --camera");
        const Json result = measure(*o);
        if (o->json)
            print_document(result);
        else
            print(result);
        // Last: what cannot be written costs nothing that was measured.
        if (!o->profile.empty())
            write_text(o->profile,
                       profile_text(measurements_from(result.dump()).measurements, sex_from(o->sex)));
    });
}

}  // namespace vfit::tools
