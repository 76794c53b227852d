#include "client/played_motion.h"

#include "client/bvh_file.h"
#include "client/bvh_joints.h"
#include "client/joint_file.h"
#include "client/people.h"

namespace vfit::tools {

namespace {

void play_rows(vfit_motion motion, const std::vector<JointRow>& rows, uint32_t max_frames,
               const std::function<void(int64_t)>& on_pose, const std::function<void(uint32_t)>& on_frame) {
    uint32_t taken = 0;
    for (const JointRow& row : rows) {
        if (max_frames != 0 && taken >= max_frames) break;
        if (check(step_row(motion, row)) != VFIT_NOT_READY) on_pose(row.time_ns);
        ++taken;
        if (on_frame) on_frame(taken);
    }
}

}  // namespace

void play_motion(vfit_context context, vfit_motion motion, const std::string& source, uint32_t max_frames,
                 const std::function<void(int64_t)>& on_pose, const std::function<void(uint32_t)>& on_frame) {
    if (is_bvh_file(source))
        return play_rows(motion, read_bvh_joints(context, source, BvhOptions()), max_frames, on_pose,
                         on_frame);
    if (is_joint_file(source))
        return play_rows(motion, read_joint_file(source), max_frames, on_pose, on_frame);
    Source frames(context, source);
    const Tracker tracker = open_tracker(context, TrackOptions{});
    while (max_frames == 0 || frames.taken() < max_frames) {
        const auto frame = frames.next();
        if (!frame) break;
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion, tracked.get(), active_body(tracked.get()), now_ns)) !=
            VFIT_NOT_READY)
            on_pose(now_ns);
        if (on_frame) on_frame(uint32_t(frames.taken()));
    }
}

}  // namespace vfit::tools
