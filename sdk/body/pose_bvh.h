// A motion as the text of a BVH file (Biovision hierarchy;
// research.cs.wisc.edu/graphics/Courses/cs-838-1999/Jeff/BVH.html): right-handed, Y up, the character's left
// at +X, in centimetres, as the motion capture programs write it.
#pragma once

#include <functional>
#include <string>

#include "body/skeleton.h"

namespace vfit {

/// A pose, and the person's lengths as they were known then.
struct BvhPose {
    Pose pose;
    Skeleton skeleton;
};

/// Frame k shows the motion at the first pose's time plus k frame times, between two poses interpolated.
/// pose(i) gives the poses in order of time. The file has one skeleton, that of the last pose; the hips of
/// the others are moved so that the feet stay where those lengths had them. Fails with VFIT_ERROR_ARGUMENT
/// for no pose, or a frame time that is not in 1 ms..10 s or gives more than a million frames, with
/// VFIT_ERROR_DATA where times do not increase.
std::string bvh_text(size_t pose_count, const std::function<BvhPose(size_t)>& pose, double frame_time_s);

}  // namespace vfit
