// Natural ranges of human joints in degrees, as the neutral-zero method counts them: the spread of the AAOS,
// AMA, Boone & Azen (1979), 38 CFR 4.71 and Kapandji tables with a few degrees of slack.
#pragma once

namespace vfit::range_of_motion {

struct Interval {
    float least_deg, most_deg;
};

inline constexpr float kShoulderExtension = 60, kShoulderAdduction = 45;  // elevation is free up to 180
inline constexpr float kShoulderInternal = 90, kShoulderExternal = 105;
inline constexpr Interval kElbowFlexion{-5, 150};
inline constexpr float kForearmPronation = 85, kForearmSupination = 90;
inline constexpr Interval kWristFlexion{-75, 80};
inline constexpr Interval kWristRadial{-40, 22};  // least is ulnar
inline constexpr Interval kHipFlexion{-30, 130};
inline constexpr Interval kHipAbduction{-30, 45};
inline constexpr float kHipInternal = 40, kHipExternal = 50;
inline constexpr Interval kKneeFlexion{0, 145};
inline constexpr float kHingePlay = 10;  // of a knee out of its plane and about its axis
inline constexpr Interval kAnklePlantarflexion{-20, 55};  // least is dorsiflexion
inline constexpr float kAnkleInversion = 35, kAnkleEversion = 20;
inline constexpr Interval kNeckFlexion{-60, 50};
inline constexpr float kNeckLateral = 45, kNeckRotation = 80;
inline constexpr Interval kSpineFlexion{-30, 90};  // of the whole thoracolumbar spine
inline constexpr float kSpineLateral = 35, kSpineRotation = 40;

}  // namespace vfit::range_of_motion
