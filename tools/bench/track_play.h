// A source through the whole tracker, as a host would run it: user map, network, filter, all built in.
#pragma once

#include <functional>
#include <string>

#include "bench/track_score.h"

namespace vfit::tools {

/// A tracker that takes nothing from the source but its depth.
Tracker open_own_tracker(vfit_context context, vfit_track_fit fit = VFIT_FIT_AUTO);

/// frame: as the source sends it, with the truth in it.
void play_tracked(const std::string& uri, vfit_track_fit fit,
                  const std::function<void(vfit_frame frame, vfit_frame tracked)>& show);

std::vector<vfit_body> bodies_of(vfit_frame frame);
/// The body whose trunk is nearest to the reference's, no farther than half a metre; 0: there is none.
uint32_t body_near(vfit_frame tracked, const Joints& reference);
/// The first virtual person's joints; without any where nobody is in view.
Joints truth_of(vfit_frame frame);

}  // namespace vfit::tools
