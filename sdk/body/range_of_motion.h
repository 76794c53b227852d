// Natural ranges of human joints in degrees, as the neutral-zero method counts them: data
// (assets/body/range_of_motion.json), which a host may replace joint by joint.
#pragma once

#include <string_view>

namespace vfit {

struct RangeOfMotion {
    struct Interval {
        float least_deg = 0, most_deg = 0;
    };
    float shoulder_extension = 0, shoulder_adduction = 0;  // elevation is free up to 180
    float shoulder_internal = 0, shoulder_external = 0;
    Interval elbow_flexion;
    float forearm_pronation = 0, forearm_supination = 0;
    Interval wrist_flexion;
    Interval wrist_radial;  // least is ulnar
    Interval hip_flexion;
    Interval hip_abduction;
    float hip_internal = 0, hip_external = 0;
    Interval knee_flexion;
    float hinge_play = 0;           // of a knee out of its plane and about its axis
    Interval ankle_plantarflexion;  // least is dorsiflexion
    float ankle_inversion = 0, ankle_eversion = 0;
    Interval neck_flexion;
    float neck_lateral = 0, neck_rotation = 0;
    Interval spine_flexion;  // of the whole thoracolumbar spine
    float spine_lateral = 0, spine_rotation = 0;

    /// What the data file says.
    static const RangeOfMotion& natural();
    /// `base` with what the JSON text gives in the data file's form: {"knee": {"flexion": 60}}.
    /// VFIT_ERROR_DATA naming the joint where it is no such text or an angle is not in 0..180.
    static RangeOfMotion read(std::string_view json, const RangeOfMotion& base);
};

}  // namespace vfit
