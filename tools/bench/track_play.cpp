#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr double kSamePerson_m = 0.5;  // half of what two people who stand side by side are apart
constexpr uint32_t kFirst = 1;         // id of the virtual person whom the options describe

}  // namespace

Tracker open_own_tracker(vfit_context context, vfit_track_fit fit) {
    TrackOptions options;
    options.joints = options.user_map = VFIT_TRACK_BUILT_IN;
    options.fit = fit;
    return open_tracker(context, options);
}

void play_tracked(const std::string& uri, vfit_track_fit fit,
                  const std::function<void(vfit_frame frame, vfit_frame tracked)>& show) {
    const Context context = open_context();
    Source source(context.get(), uri);
    const Tracker tracker = open_own_tracker(context.get(), fit);
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        show(frame->get(), tracked.get());
    }
}

std::vector<vfit_body> bodies_of(vfit_frame frame) {
    return list<vfit_body>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_bodies(frame, items, stride, n);
    });
}

uint32_t body_near(vfit_frame tracked, const Joints& reference) {
    uint32_t best = 0;
    double nearest = kSamePerson_m;
    for (const vfit_body& body : bodies_of(tracked)) {
        const Joints joints = joints_in_camera(tracked, body.body_id, camera_of(tracked));
        const double d = distance(joints, reference, VFIT_JOINT_TORSO);
        if (d < nearest) nearest = d, best = body.body_id;
    }
    return best;
}

Joints truth_of(vfit_frame frame) {
    for (const vfit_body& body : bodies_of(frame))
        if (body.body_id == kFirst) return joints_in_camera(frame, kFirst, camera_of(frame));
    return {};
}

}  // namespace vfit::tools
