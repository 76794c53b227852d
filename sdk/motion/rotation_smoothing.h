// Asymptotic smoothing of bone rotations (paper, Eq. 8-10): each frame a bone turns by the k-th part of the
// way from its last world rotation to the new one. Converted by elapsed time from frames of 1/30 s. No bone
// turns faster than people do: a joint that leaps comes to its new place at that speed.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vfit {

/// The share of the way that `dt_s` covers where 1/30 s covers 1/k.
float smoothing_share(float divisor, float dt_s);

class RotationSmoother {
public:
    void reset() { started_ = false; }

    /// World rotations in place; the first call passes them through.
    void apply(std::array<Quat, kBoneCount>& world, float divisor, float dt_s);

private:
    std::array<Quat, kBoneCount> last_;
    bool started_ = false;
};

}  // namespace vfit
