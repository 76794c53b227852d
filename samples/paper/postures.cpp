#include "postures.h"

namespace vfit::tools {

void take_postures(vfit_context context, vfit_avatar avatar, const std::string& source,
                   const TrackOptions& track,
                   const std::function<bool(vfit_frame tracked, float time_s)>& on_frame) {
    Source frames(context, source);
    const Tracker tracker = open_tracker(context, track);
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    check(vfit_motion_bind(motion.get(), avatar));
    int64_t first_ns = 0;
    bool seen = false;
    while (const auto frame = frames.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion.get(), tracked.get(), active_body(tracked.get()), now_ns)) !=
            VFIT_OK)
            continue;
        if (!seen) first_ns = now_ns;
        seen = true;
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(motion.get(), pose);
        set_pose(avatar, pose, bones);
        if (!on_frame(tracked.get(), 1e-9f * float(now_ns - first_ns))) return;
    }
    if (!seen) throw Failure(source + " shows no person");
}

Avatar avatar_of_shape(vfit_context context, vfit_sex sex, const std::vector<vfit_shape_value>& shape,
                       uint32_t detail) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = sex;
    desc.detail = detail;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                        uint32_t(shape.size()), avatar.out()));
    return avatar;
}

}  // namespace vfit::tools
