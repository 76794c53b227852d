// vfit track: the bodies of each frame, as JSON lines in the recording's camera space, and as pictures.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "client/files.h"
#include "client/output.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "picture/tracked_picture.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source, map_folder, picture_folder;
    bool json = false;
    TrackOptions track;
};

constexpr uint32_t kPictureWidth = 900;  // at least, in pixels

std::string picture_path(const std::string& folder, uint32_t index) {
    char name[16];
    std::snprintf(name, sizeof name, "%06u.png", index);
    return folder + "/" + name;
}

void write_user_map(vfit_frame frame, const std::string& path) {
    const vfit_view map = view_of(frame, VFIT_STREAM_USER_MAP);
    write_grey_png(path, static_cast<const uint8_t*>(map.data), map.width, map.height, map.row_stride);
}

void write_picture(vfit_frame frame, const std::string& path, uint32_t index, size_t people) {
    const uint32_t width = view_of(frame, VFIT_STREAM_DEPTH).width;
    const std::string who = people == 0   ? "no person"
                            : people == 1 ? "1 person"
                                          : std::to_string(people) + " people";
    draw_tracked(frame, static_cast<int>((kPictureWidth + width - 1) / width),
                 "frame " + std::to_string(index) + "   " + who)
        .write_png(path);
}

void create_folders(const Options& options) {
    if (!options.map_folder.empty()) create_folder(options.map_folder);
    if (!options.picture_folder.empty()) create_folder(options.picture_folder);
    std::error_code error;
    if (!options.map_folder.empty() && !options.picture_folder.empty() &&
        std::filesystem::equivalent(options.map_folder, options.picture_folder, error))
        throw Failure(options.picture_folder +
                      ": --pictures and --user-map-out name their files alike and need two folders");
}

Json bodies_json(vfit_frame frame) {
    const vfit_camera camera = camera_of(frame);
    Json out = Json::array();
    for (const auto& body : list<vfit_body>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_frame_bodies(frame, items, stride, n);
         }))
        out.push_back(
            {{"id", body.body_id}, {"joints", joints_json(joints_of(frame, body.body_id), camera)}});
    return out;
}

constexpr const char* kFloorStates[] = {"unknown", "estimated", "given"};

Json floor_json(const vfit_camera& camera) {
    constexpr double kDegree = 3.14159265358979 / 180.0;
    return {{"state", kFloorStates[camera.floor_state]},
            {"height_m", camera.height_m},
            {"tilt_deg", double(camera.tilt_rad) / kDegree},
            {"roll_deg", double(camera.roll_rad) / kDegree}};
}

/// Why the tracker found no body; null where it has not looked.
Json why_absent(vfit_frame tracked) {
    char text[256];
    const bool said = vfit_frame_meta(tracked, "no_person", text, sizeof text, nullptr) == VFIT_OK;
    return said ? Json::parse(text) : Json();
}

std::string floor_text(const vfit_camera& camera) {
    const Json floor = floor_json(camera);
    std::ostringstream text;
    text << "floor " << floor["state"].get<std::string>();
    if (camera.floor_state != VFIT_FLOOR_DEFAULT)
        text << std::fixed << std::setprecision(2) << ", camera " << camera.height_m << " m above it, tilt "
             << std::lround(floor["tilt_deg"].get<double>()) << ", roll "
             << std::lround(floor["roll_deg"].get<double>()) << " degrees";
    return text.str();
}

void print(const Options& options, uint32_t index, vfit_frame tracked, const Json& bodies, double ms) {
    const vfit_camera camera = camera_of(tracked);
    const Json why = bodies.empty() ? why_absent(tracked) : Json();
    if (options.json) {
        Json line = {{"frame", index}, {"bodies", bodies}, {"floor", floor_json(camera)}};
        if (!why.is_null()) line["no_person"] = why;
        if (options.track.asked) line["active"] = active_body(tracked);
        line["ms"] = ms;
        print_line(line);
        return;
    }
    std::cout << "frame " << index << ": " << bodies.size() << (bodies.size() == 1 ? " body" : " bodies");
    if (options.track.asked) std::cout << ", active " << active_body(tracked);
    std::cout << "; " << floor_text(camera);
    if (!why.is_null()) std::cout << "; " << why.get<std::string>();
    std::cout << "\n";
}

void track(const Options& options) {
    const Context context = open_context();
    Source source(context.get(), options.source);
    const Tracker tracker = open_tracker(context.get(), options.track);
    create_folders(options);
    Progress progress("frames", true);
    while (const auto frame = source.next()) {
        const uint32_t index = source.taken() - 1;
        progress.at(source.taken(), 0);
        const auto start = std::chrono::steady_clock::now();
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const double ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        const Json bodies = bodies_json(tracked.get());
        if (!options.map_folder.empty())
            write_user_map(tracked.get(), picture_path(options.map_folder, index));
        if (!options.picture_folder.empty())
            write_picture(tracked.get(), picture_path(options.picture_folder, index), index, bodies.size());
        print(options, index, tracked.get(), bodies, ms);
    }
}

}  // namespace

void add_track(Command& app) {
    Command command = app.add_subcommand("track", "Print the bodies of each frame");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->source, "Recording folder or sensor URI").required();
    command.add_option("--user-map-out", o->map_folder, "Write each frame's user map there as PNG");
    command.add_option("--pictures", o->picture_folder,
                       "Draw each frame there as PNG: depth, people, skeletons");
    command.add_flag("--json", o->json, "Print JSON lines");
    add_track_options(command, o->track);
    command.callback([o] { track(*o); });
}

}  // namespace vfit::tools
