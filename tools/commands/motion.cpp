// vfit motion: the clean pose of each frame, as JSON lines; joints and root in the recording's camera space.
#include <chrono>
#include <iostream>

#include "client/output.h"
#include "client/progress.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source;
    bool raw = false, json = false;
    TrackOptions track;
};

struct Step {
    vfit_pose pose = vfit_pose_init();
    std::vector<vfit_bone> bones;
    std::vector<vfit_joint> joints;
};

Step read_step(vfit_motion motion) {
    Step step;
    step.bones = bones_of(motion, step.pose);
    step.joints = list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_motion_joints(motion, items, stride, n);
    });
    return step;
}

Json step_json(const Step& step, const vfit_camera& camera, uint32_t index, double ms) {
    Json bones = Json::object();
    Point root{};
    for (const vfit_bone& b : step.bones) {
        bones[bone_name(b.bone)] = {b.rotation[0], b.rotation[1], b.rotation[2], b.rotation[3]};
        if (b.bone == VFIT_BONE_HIPS) root = to_camera(camera, b.position);
    }
    return {{"frame", index},
            {"joints", joints_json(step.joints, camera)},
            {"bones", bones},
            {"root", {root.x, root.y, root.z}},
            {"contacts",
             {{"left", (step.pose.contact_flags & VFIT_CONTACT_LEFT) != 0},
              {"right", (step.pose.contact_flags & VFIT_CONTACT_RIGHT) != 0}}},
            {"ms", ms}};
}

void motion(const Options& options) {
    const Context context = open_context();
    Source source(context.get(), options.source);
    const Tracker tracker = open_tracker(context.get(), options.track);
    vfit_motion_desc desc = vfit_motion_desc_init();
    if (options.raw)
        desc.flags =
            VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_LIMITS | VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_FEET;
    Motion motion;
    check(vfit_motion_create(context.get(), &desc, motion.out()));
    Progress progress("frames", true);
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const vfit_view depth = view_of(tracked.get(), VFIT_STREAM_DEPTH);
        const auto start = std::chrono::steady_clock::now();
        const vfit_result result =
            check(vfit_motion_step(motion.get(), tracked.get(), active_body(tracked.get()), depth.time_ns));
        const double ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        const uint32_t index = source.taken() - 1;
        progress.at(source.taken(), 0);
        if (result == VFIT_NOT_READY) {
            if (!options.json) std::cout << "frame " << index << ": no person\n";
            continue;
        }
        const Step step = read_step(motion.get());
        if (options.json)
            print_line(step_json(step, camera_of(tracked.get()), index, ms));
        else
            std::cout << "frame " << index << ": contacts "
                      << (step.pose.contact_flags & VFIT_CONTACT_LEFT ? "L" : "-")
                      << (step.pose.contact_flags & VFIT_CONTACT_RIGHT ? "R" : "-") << "\n";
    }
}

}  // namespace

void add_motion(Command& app) {
    Command command = app.add_subcommand("motion", "Print the clean pose of each frame");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->source, "Recording folder or sensor URI").required();
    command.add_flag("--raw", o->raw, "Without filter, limits, smoothing and foot planting");
    command.add_flag("--json", o->json, "Print JSON lines");
    add_track_options(command, o->track);
    command.callback([o] { motion(*o); });
}

}  // namespace vfit::tools
