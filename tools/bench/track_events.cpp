// What happens around a tracked person: they come, go and are hidden; nobody is there; real stills.
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>

#include "bench/bench.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"
#include "bench/user_map_scenes.h"

namespace vfit::tools {

namespace {

constexpr double kRecovered_m = 0.15;   // the trunk lies that near to the truth again
constexpr int kSeenJoints = 8;          // of 15: half of the person is to be seen
constexpr uint32_t kLastFrames = 5;     // within which the tracker must have noticed
constexpr uint32_t kNever = 1'000'000;  // frames; printed as such a number it cannot be overlooked

/// One frame of a sequence with one virtual person.
struct Moment {
    bool in_view = false, whole = false;  // truth: some of the person; all joints are within the image
    int seen = 0;                         // truth: joints of the 15 that the camera sees
    uint32_t id = 0;                      // tracked: body near the truth
    double trunk_m = 1e9;                 // and how far off its trunk is
    uint32_t bodies = 0;                  // tracked
};

std::vector<Moment> watch(const std::string& uri) {
    std::vector<Moment> moments;
    play_tracked(uri, VFIT_FIT_AUTO, [&](vfit_frame frame, vfit_frame tracked) {
        Moment m;
        const Joints truth = truth_of(frame);
        for (const vfit_body& body : bodies_of(frame)) {
            m.in_view = true;
            m.whole = !(body.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW);
            for (const vfit_joint& joint : joints_of(frame, body.body_id))
                m.seen += joint.joint < kScored && joint.state == VFIT_JOINT_MEASURED;
        }
        m.bodies = uint32_t(bodies_of(tracked).size());
        if (m.in_view) m.id = body_near(tracked, truth);
        if (m.id)
            m.trunk_m =
                distance(joints_in_camera(tracked, m.id, camera_of(tracked)), truth, VFIT_JOINT_TORSO);
        moments.push_back(m);
    });
    return moments;
}

/// Frames from `begin` until `is`; kNever: not before `end`.
template <typename Is>
uint32_t frames_until(const std::vector<Moment>& moments, size_t begin, size_t end, Is&& is) {
    for (size_t i = begin; i < end; ++i)
        if (is(moments[i])) return uint32_t(i - begin);
    return kNever;
}

template <typename Is>
size_t first_where(const std::vector<Moment>& moments, size_t begin, Is&& is) {
    while (begin < moments.size() && !is(moments[begin])) ++begin;
    return begin;
}

bool is_tracked(const Moment& m) { return m.id != 0 && m.trunk_m < kRecovered_m; }

/// A body of this part's own, dressed; and no word of the floor.
std::string person(uint32_t bodies, const JudgeOptions& options) {
    return "&clothing=0.02&floor=unknown&body=" + std::to_string(bodies + options.seed) +
           "&seed=" + std::to_string(options.seed);
}

Json visit(const std::string& sensor, const JudgeOptions& options, Targets& targets) {
    // The visit is over after 17 s; what remains is the turn outside.
    const auto moments =
        watch("virtual:sensor=" + sensor + "&motion=visit&distance=3&frames=480" + person(9000, options));
    const size_t whole = first_where(moments, 0, [](const Moment& m) { return m.whole; });
    const size_t part = first_where(moments, whole, [](const Moment& m) { return !m.whole; });
    const size_t gone = first_where(moments, part, [](const Moment& m) { return !m.in_view; });
    std::set<uint32_t> ids;
    for (size_t i = whole; i < part; ++i)
        if (moments[i].id) ids.insert(moments[i].id);
    uint32_t before = 0;
    for (size_t i = 0; i < whole; ++i) before += moments[i].bodies > 0 && !moments[i].in_view;
    const uint32_t found = frames_until(moments, whole, part, is_tracked);
    const uint32_t left =
        frames_until(moments, gone, moments.size(), [](const Moment& m) { return m.bodies == 0; });
    targets.judge(sensor + ": a person comes in: tracked, frames after all of them is seen", found,
                  Aim::at_most, kLastFrames);
    targets.judge(sensor + ": ids while they are in full view", double(ids.size()), Aim::exactly, 1);
    targets.judge(sensor + ": they leave: no body, frames after the last joint left", left, Aim::at_most,
                  kLastFrames);
    targets.judge(sensor + ": frames with a body before anybody was in view", before, Aim::exactly, 0);
    return {{"event", "visit"},
            {"sensor", sensor},
            {"found_after", found},
            {"ids", ids.size()},
            {"gone_after", left}};
}

Json occlusion(const std::string& sensor, const JudgeOptions& options, Targets& targets) {
    const auto moments = watch("virtual:sensor=" + sensor +
                               "&motion=sway&distance=2.9&occluder=3&frames=195" + person(9100, options));
    const auto hidden = [](const Moment& m) { return m.seen == 0; };
    const auto half_seen = [](const Moment& m) { return m.seen >= kSeenJoints; };
    const size_t begin = first_where(moments, 0, hidden), end = first_where(moments, begin, half_seen);
    std::set<uint32_t> before, after;
    for (size_t i = 0; i < begin; ++i)
        if (moments[i].id) before.insert(moments[i].id);
    for (size_t i = end; i < moments.size(); ++i)
        if (moments[i].id) after.insert(moments[i].id);
    uint32_t boxes = 0;  // bodies beside the person
    for (const Moment& m : moments) boxes += m.bodies > (m.id ? 1u : 0u);
    const uint32_t recovered = frames_until(moments, end, moments.size(), is_tracked);
    const bool same = before.size() == 1 && before == after;
    targets.judge(sensor + ": hidden by a box for " + std::to_string(end - begin) +
                      " frames: tracked, frames after half is seen",
                  recovered, Aim::at_most, kLastFrames);
    targets.judge(sensor + ": same id before and after the box (1: yes)", same, Aim::exactly, 1);
    targets.judge(sensor + ": frames in which the box is a body", boxes, Aim::exactly, 0);
    return {{"event", "occlusion"},         {"sensor", sensor}, {"hidden_frames", end - begin},
            {"recovered_after", recovered}, {"same_id", same},  {"frames_with_box_as_body", boxes}};
}

Json nobody(const std::string& sensor, const char* furniture, const char* name, const JudgeOptions& options,
            Targets& targets) {
    uint32_t with_body = 0;
    play_tracked("virtual:sensor=" + sensor + "&people=0&floor=unknown&frames=90&furniture=" + furniture +
                     "&seed=" + std::to_string(options.seed),
                 VFIT_FIT_AUTO,
                 [&](vfit_frame, vfit_frame tracked) { with_body += !bodies_of(tracked).empty(); });
    targets.judge(sensor + ": " + name + ": frames with a body", with_body, Aim::exactly, 0);
    return {{"event", name}, {"sensor", sensor}, {"frames_with_body", with_body}};
}

struct StillView {
    std::vector<vfit_body> bodies;
    vfit_camera camera;
};

/// A picture shown to the tracker for a second, as by a camera of the host's that looks at a still scene.
StillView look_at(const std::string& path) {
    const Shot still = load_still(path, 525.0f, 319.5f, 239.5f);
    const Context context = open_context();
    const Tracker tracker = open_own_tracker(context.get());
    vfit_intrinsics k = vfit_intrinsics_init();
    k.width = still.camera.width, k.height = still.camera.height;
    k.fx = still.camera.fx, k.fy = still.camera.fy, k.cx = still.camera.cx, k.cy = still.camera.cy;
    vfit_view pixels = vfit_view_init();
    pixels.format = VFIT_FORMAT_U16, pixels.data = still.depth.data();
    pixels.width = k.width, pixels.height = k.height;
    pixels.item_stride = 2, pixels.row_stride = 2 * k.width;
    const vfit_stream stream = VFIT_STREAM_DEPTH;
    vfit_frame_desc desc = vfit_frame_desc_init();
    desc.count = 1, desc.streams = &stream, desc.views = &pixels, desc.intrinsics = &k;
    StillView view;
    for (int i = 1; i <= 30; ++i) {
        desc.time_ns = int64_t(i) * 33'333'333;
        Frame frame, tracked;
        check(vfit_frame_create(context.get(), &desc, frame.out()));
        check(vfit_tracker_update(tracker.get(), frame.get(), tracked.out()));
        view.bodies = bodies_of(tracked.get());
        view.camera = camera_of(tracked.get());
    }
    return view;
}

}  // namespace

Json judge_stills(const std::string& folder, bool quiet, Targets& targets) {
    // The floor as it was published with the picture (camera space, y down; the distance in metres).
    constexpr std::array<double, 3> kNormal = {0.01036, -0.99701, -0.07656};
    constexpr double kDistance_m = 1.26614;
    if (!quiet) std::cout << "\nREAL stills\n";
    const StillView five = look_at(folder + "/five_people_depth_mm.png");
    const StillView one = look_at(folder + "/person_depth_mm.png");
    double cosine = 0.0;
    for (size_t k = 0; k < 3; ++k) cosine += kNormal[k] * double(five.camera.floor_normal[k]);
    const bool known = five.camera.floor_state != VFIT_FLOOR_DEFAULT;
    const double tilt_deg = known ? std::acos(std::min(1.0, cosine)) * 180.0 / 3.14159265358979 : NAN;
    const double off_cm = known ? 100 * std::abs(double(five.camera.floor_distance_m) - kDistance_m) : NAN;
    uint32_t cut = 0;
    for (const vfit_body& body : one.bodies) cut += (body.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW) != 0;
    targets.judge("five people: bodies", double(five.bodies.size()), Aim::exactly, 5);
    targets.judge("five people: floor, angle to the published one", tilt_deg, Aim::at_most, 1.0, 2, " deg");
    targets.judge("five people: floor, distance to the published one", off_cm, Aim::at_most, 3.0, 1, " cm");
    targets.judge("a person who is too close: bodies, partly out of view", cut, Aim::exactly, 1);
    targets.judge("a person who is too close: bodies", double(one.bodies.size()), Aim::exactly, 1);
    return {{"five_people", {{"bodies", five.bodies.size()}, {"floor_deg", tilt_deg}, {"floor_cm", off_cm}}},
            {"too_close", {{"bodies", one.bodies.size()}, {"partly_out_of_view", cut}}}};
}

Json judge_events(const JudgeOptions& options, Targets& targets) {
    if (!options.quiet) std::cout << "\nSYNTHETIC: people who come and go\n";
    Json rows = Json::array();
    for (const std::string sensor : {"kinect_v1", "tof"}) {
        if (options.long_run || sensor == "kinect_v1") rows.push_back(visit(sensor, options, targets));
        rows.push_back(occlusion(sensor, options, targets));
        rows.push_back(nobody(sensor, "", "an empty room", options, targets));
        rows.push_back(nobody(sensor, "chair,rack", "a chair and a coat rack", options, targets));
    }
    return rows;
}

}  // namespace vfit::tools
