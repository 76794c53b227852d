// What the body model's own default gets wrong about real people.
#pragma once

#include <string_view>

namespace vfit {

/// The usual value of a parameter measure-*. The default body's arms are short: shoulder to elbow .147 of
/// stature, where ANSUR II has acromion to radiale .191, of which some .027 lie above the one joint's centre
/// and below the other's.
inline float usual_measure(std::string_view key) {
    if (key.ends_with("measure-upperarm-length")) return 0.3f;   // +.012 of stature
    if (key.ends_with("measure-lowerarm-length")) return 0.15f;  // +.005
    return 0.0f;
}

}  // namespace vfit
