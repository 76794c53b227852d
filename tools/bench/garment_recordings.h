// Garments on real people's motion.
#pragma once

#include <string>

namespace vfit::tools {

struct RecordingsOptions {
    std::string folder;        // of recordings
    std::string garment;       // one, or an outfit "A+B"; empty: every bundled garment
    std::string cooked;        // folder of garment files instead, each by itself; as they are simulated
    std::string recording;     // part of a name; empty: all
    std::string pictures;      // folder for a sheet of each recording; empty: none
    bool hands = true;         // push the garments, as with vfit fit --hands
    bool own_tracker = false;  // instead of the recording's joints
    bool props = false;        // a scabbard, a backpack and a ball that circles (vfit's own)
    float carry_speed_m_s = 0.0f, carry_way_m = 0.0f;  // of vfit_cloth_desc
    int substeps = 0;                                  // 0: the library's default
    bool json = false;
};
void judge_recordings(const RecordingsOptions& options);

}  // namespace vfit::tools
