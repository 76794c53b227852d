// Garments on a body that jumps, turns or moves a limb within one step.
#pragma once

#include <string>

namespace vfit::tools {

struct JumpsOptions {
    std::string garment;  // one, or an outfit "A+B"; empty: every bundled garment and two outfits
    float carry_speed_m_s = 0, carry_way_m = 0;  // 0: the library's default
    float inertia = 0;                           // the same
    bool spheres = false;                        // the avatar's spheres and capsules instead of its skin
    bool all = false;                            // a line for each case, not for the worst alone
    bool json = false;
};
void judge_jumps(const JumpsOptions& options);

}  // namespace vfit::tools
