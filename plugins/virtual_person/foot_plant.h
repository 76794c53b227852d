// Finds when the feet of a captured motion stand, and plants them: in each contact the ankle gets one place
// and the foot lies flat; before and after the correction fades.
#pragma once

#include <cstddef>
#include <vector>

#include "types.h"

namespace vfit::virtual_person {

/// One foot over all frames.
struct FootTrack {
    std::vector<Vec3> ankle, ball;  // world, metres
    std::vector<Quat> rotation;     // world
    std::vector<char> planted;      // output: the whole sole stands
    std::vector<char> rolls;        // output: only ball or heel does
};

/// Contacts of one foot: ankle and ball slow and low, or one of them. Floor heights are those of its own
/// lowest frames.
void find_contacts(FootTrack& foot, double frame_time_s);

/// Replaces ankle and rotation as said above.
void plant(FootTrack& foot, double frame_time_s, float ankle_height_m);

}  // namespace vfit::virtual_person
