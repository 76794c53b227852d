// Streams of joints that motion is judged on: made ones with known truth, and real ones of the shared folder.
#pragma once

#include <string>
#include <vector>

#include "frame/body.h"

namespace vfit::tools {

/// Bodies in world space, in order of time.
struct JointStream {
    std::string name;
    std::vector<Body> bodies;
};

/// Kinect v2, 30 Hz: the four of data/kinect2_joints, then the Kinect's of data/ui_prmd. The floor lies under
/// the lowest ankle of each.
std::vector<JointStream> kinect2_streams(const std::string& shared);
std::vector<JointStream> ui_prmd_streams(const std::string& shared);

/// The markers of the Vicon system beside a stream of ui_prmd, metres, one row a frame.
struct MarkerStream {
    std::string name;  // as the JointStream's
    std::vector<std::vector<Vec3>> frames;
};
std::vector<MarkerStream> ui_prmd_markers(const std::string& shared);

}  // namespace vfit::tools
