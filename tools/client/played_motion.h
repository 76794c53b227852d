// A motion stage that follows the person in a file: a recording or a sensor, a table of joints, a BVH file.
#pragma once

#include <functional>
#include <string>

#include "client/client.h"

namespace vfit::tools {

/// Steps the stage with each frame of `source`, as far as max_frames (0: all), and calls on_pose(now_ns)
/// after each in which the person was there. on_frame(taken): after every frame.
void play_motion(vfit_context context, vfit_motion motion, const std::string& source, uint32_t max_frames,
                 const std::function<void(int64_t now_ns)>& on_pose,
                 const std::function<void(uint32_t taken)>& on_frame = {});

}  // namespace vfit::tools
