// vfit motion: the clean pose of each frame, as JSON lines, and to other programs. Joints and root are in the
// recording's camera space; of joints without pictures in world space.
#include <chrono>
#include <iostream>

#include "client/bvh_file.h"
#include "client/bvh_joints.h"
#include "client/files.h"
#include "client/joint_file.h"
#include "client/live_joints.h"
#include "client/missing_bones.h"
#include "client/output.h"
#include "client/pose_outputs.h"
#include "client/progress.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source, bone_map;
    float scale = 0.0f;  // 0: not given
    bool raw = false, json = false, nodes = false;
    uint32_t frames = 0;  // 0: all
    TrackOptions track;
    PoseOutputOptions outputs;
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

/// The motion stage, and where its poses go.
class Player {
public:
    Player(vfit_context context, const Options& options)
        : options_(options), outputs_(context, options.outputs), progress_("frames", true) {
        vfit_motion_desc desc = vfit_motion_desc_init();
        if (options.raw)
            desc.flags = VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_LIMITS | VFIT_MOTION_NO_SMOOTHING |
                         VFIT_MOTION_NO_FEET;
        check(vfit_motion_create(context, &desc, motion_.out()));
    }

    /// One frame: step(motion) steps the stage and tells whether the person was there.
    template <typename StepMotion>
    void play(StepMotion&& step_motion, const vfit_camera& camera) {
        const auto start = std::chrono::steady_clock::now();
        const vfit_result result = check(step_motion(motion_.get()));
        const double ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        const uint32_t index = taken_++;
        progress_.at(taken_, 0);
        if (result == VFIT_NOT_READY) {
            if (!options_.json) std::cout << "frame " << index << ": no person\n";
            return;
        }
        const Step step = read_step(motion_.get());
        outputs_.take(step.pose, step.bones);
        if (options_.json)
            print_line(step_json(step, camera, index, ms));
        else
            std::cout << "frame " << index << ": contacts "
                      << (step.pose.contact_flags & VFIT_CONTACT_LEFT ? "L" : "-")
                      << (step.pose.contact_flags & VFIT_CONTACT_RIGHT ? "R" : "-") << "\n";
        ++seen_;
    }

    bool wants_more() const { return options_.frames == 0 || taken_ < options_.frames; }
    uint32_t seen() const { return seen_; }
    void finish() { outputs_.finish(); }

private:
    const Options& options_;
    PoseOutputs outputs_;
    Progress progress_;
    Motion motion_;
    uint32_t taken_ = 0, seen_ = 0;
};

void play_source(vfit_context context, const Options& options) {
    Source source(context, options.source);
    const Tracker tracker = open_tracker(context, options.track);
    Player player(context, options);
    while (player.wants_more()) {
        const auto frame = source.next();
        if (!frame) break;
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const vfit_view depth = view_of(tracked.get(), VFIT_STREAM_DEPTH);
        const uint32_t body = active_body(tracked.get());
        player.play(
            [&](vfit_motion motion) { return vfit_motion_step(motion, tracked.get(), body, depth.time_ns); },
            camera_of(tracked.get()));
    }
    player.finish();
}

/// The axes of the world itself, in place of a camera's.
vfit_camera world_axes() {
    vfit_camera camera = vfit_camera_init();
    for (int i = 0; i < 4; ++i) camera.world_from_camera[5 * i] = 1.0f;
    return camera;
}

/// next(row) gives row after row; false: there is none.
template <typename Next>
void play_joints(vfit_context context, const Options& options, Next&& next) {
    const vfit_camera world = world_axes();
    Player player(context, options);
    for (JointRow row; player.wants_more() && next(row);)
        player.play([&](vfit_motion motion) { return step_row(motion, row); }, world);
    if (player.seen() == 0)
        throw Failure(options.source +
                      ": in no row can the trunk be placed: wanted are both shoulders, or NECK with PELVIS, "
                      "TORSO or both hips");
    player.finish();
}

/// Empty where the file's nodes are printed instead.
std::vector<JointRow> read_bvh_rows(vfit_context context, const Options& options) {
    const std::string map = options.bone_map.empty() ? std::string() : read_text(options.bone_map);
    try {
        return read_bvh_joints(context, options.source, {map, options.scale});
    } catch (const Failure& failure) {
        report_missing_bones(failure, options.nodes);
        return {};
    }
}

void play_joint_file(vfit_context context, const Options& options) {
    const bool is_bvh = is_bvh_file(options.source);
    const std::vector<JointRow> rows =
        is_bvh ? read_bvh_rows(context, options) : read_joint_file(options.source);
    if (rows.empty()) return;
    auto at = rows.begin();
    play_joints(context, options, [&](JointRow& row) {
        if (at == rows.end()) return false;
        row = *at++;
        return true;
    });
}

void check_track_options(const Options& options) {
    const TrackOptions& track = options.track;
    if (track.asked || track.joints != VFIT_TRACK_AUTO || track.user_map != VFIT_TRACK_AUTO)
        throw WrongUsage(options.source +
                         " holds the joints of one person: --joints, --user-map and --active have no choice");
}

void motion(const Options& options) {
    const Context context = open_context();
    const bool live = options.source == "-";
    const bool for_bvh = options.scale > 0.0f || !options.bone_map.empty() || options.nodes;
    if (for_bvh && (live || !is_bvh_file(options.source)))
        throw WrongUsage(options.source + " is no BVH file: --scale, --bone-map and --nodes are for these");
    if (!live && !is_joint_file(options.source)) return play_source(context.get(), options);
    check_track_options(options);
    if (!live) return play_joint_file(context.get(), options);
    LiveJoints joints(std::cin);
    play_joints(context.get(), options, [&](JointRow& row) { return joints.next(row); });
}

void add_outputs(Command& command, PoseOutputOptions& o) {
    command.add_option("--bvh", o.bvh, "Write the motion as a BVH file, in centimetres");
    command.add_option("--bvh-rate", o.bvh_rate_hz, "Frames per second of that file (30)").within(1, 1000);
    command
        .add_option("--vmc", o.vmc, "HOST:PORT: send each pose by the VMC protocol (receivers' port: 39539)")
        .check(address_fault);
    command.add_option("--vrchat", o.vrchat, "HOST:PORT: send VRChat's OSC trackers (its port: 9000)")
        .check(address_fault);
}

}  // namespace

void add_motion(Command& app) {
    Command command = app.add_subcommand("motion", "Print the clean pose of each frame, or send it");
    auto o = std::make_shared<Options>();
    command
        .add_option(
            "source", o->source,
            "Recording folder, sensor URI, file of joints, BVH file, or - for joints from standard input")
        .required();
    command.add_flag("--raw", o->raw, "Without filter, limits, smoothing and foot planting");
    command.add_flag("--json", o->json, "Print JSON lines");
    command.add_option("--frames", o->frames, "Stop after so many frames").positive();
    command.add_option("--scale", o->scale, "Of a BVH file: metres in a unit of it (default: by the stature)")
        .positive();
    command.add_option("--bone-map", o->bone_map,
                       "Of a BVH file: JSON file {\"hips\": \"name of a joint\", ...}");
    command.add_flag("--nodes", o->nodes,
                     "Where bones of a BVH file are not found: print a bone map to fill in, and the nodes");
    add_outputs(command, o->outputs);
    add_track_options(command, o->track);
    command.callback([o] { motion(*o); });
}

}  // namespace vfit::tools
