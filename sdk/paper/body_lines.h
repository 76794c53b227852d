// The lines of Fig. 4 on one frame, in metres: crown, soles and contours from the filtered depth map, the
// rest from the joints (the "measurement source" column of Table 1).
#pragma once

#include "frame/body.h"
#include "frame/camera.h"
#include "paper/proportions.h"
#include "track/depth_filter.h"

namespace vfit {

/// Lines that cannot be seen in this frame are left unknown. Joints are in camera space. sigma_m is what the
/// rule itself may be wrong by; the spread over frames is the scan's.
Lines measure_lines(const FilteredDepth& depth, const Camera& camera, const Body& body);

/// Heights along the floor's normal: crown and floor as that frame shows them.
struct Upright {
    Estimate crown, floor;
};
Upright measure_upright(const FilteredDepth& depth, const Camera& camera, const Body& body);

// The lines one by one.
Estimate head_width(const FilteredDepth& depth, const Camera& camera, const Body& body,
                    const Upright& upright);
Estimate head_height(const FilteredDepth& depth, const Camera& camera, const Body& body,
                     const Upright& upright);
Estimate shoulder_width(const FilteredDepth& depth, const Camera& camera, const Body& body);
Estimate hip_width(const FilteredDepth& depth, const Camera& camera, const Body& body);
Estimate elbow_fingertip(const FilteredDepth& depth, const Camera& camera, const Body& body, bool from_wrist);

}  // namespace vfit
