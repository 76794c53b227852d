// Places of joints that somebody else saw in the image (a pose network in the colour stream): evidence for
// the heat maps of the tracker's own network.
#pragma once

#include <span>
#include <vector>

#include "track/crop.h"
#include "track/joint_network.h"

namespace vfit {

struct JointHint {
    int joint = 0;         // the person's own left and right
    float x = 0, y = 0;    // pixels of the depth image
    float confidence = 0;  // the chance that it is right, 0..1
    uint32_t person = 0;   // 0: of whom the pixel is
};

/// Multiplies the hinted joints' heat by the chance of the hint for a joint in each place: with its
/// confidence near the hinted pixel, else anywhere. So a hint decides between places that the network takes
/// for possible, and hardly moves a joint that the network is sure of. `away`: the person faces away, so that
/// their left is the maps' right. Hints outside the crop are left out.
void apply_hints(std::span<const JointHint> hints, const CropView& view, bool away, JointMaps& maps);

/// Adds to the maps' answer which side the person faces: hinted left and right joints fit the maps either as
/// they are or exchanged. Before apply_hints.
void answer_facing(std::span<const JointHint> hints, const CropView& view, JointMaps& maps);

/// Whose box a hint lies in, the box wider by a quarter of its size: a limb may be where the sensor sees
/// nothing.
bool near_box(const JointHint& hint, const PixelBox& box);

}  // namespace vfit
