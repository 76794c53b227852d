#include "picture/foot_curve.h"

#include "client/progress.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kFeetFrames = 300;

}  // namespace

Curve foot_correction(vfit_context context, const std::string& uri, uint32_t frames) {
    Source source(context, uri);
    Tracker tracker;
    check(vfit_tracker_create(context, nullptr, tracker.out()));
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    Curve curve{"Displacement of the planted foot (Fig. 11)", "s", "corrected displacement, mm", {}};
    int64_t first_ns = -1;
    uint32_t body = 0;
    const uint32_t wanted = frames ? frames : kFeetFrames;
    Progress progress("frames");
    while (source.taken() < wanted) {
        progress.at(source.taken(), wanted);
        const auto frame = source.next();
        if (!frame) break;
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (body == 0) body = active_body(tracked.get());
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion.get(), tracked.get(), body, now_ns)) != VFIT_OK) continue;
        if (first_ns < 0) first_ns = now_ns;
        vfit_pose pose = vfit_pose_init();
        uint32_t count = 0;
        check(vfit_motion_pose(motion.get(), &pose, nullptr, 0, &count));
        curve.points.emplace_back(float(double(now_ns - first_ns) * 1e-9), 1000.0f * pose.foot_correction_m);
    }
    return curve;
}

}  // namespace vfit::tools
