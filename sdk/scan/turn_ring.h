// Which ways a person has faced in a turn on the spot.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "math/types.h"
#include "vfit.h"

namespace vfit {

class TurnRing {
public:
    static constexpr int kWays = VFIT_TURN_WAYS;
    static constexpr uint32_t kAll = (uint32_t{1} << kWays) - 1;

    /// Radians to the person's left of facing the camera.
    static int way_of(float turned_rad) {
        const int way = int(std::lround(turned_rad / (2.0f * kPi) * float(kWays))) % kWays;
        return way < 0 ? way + kWays : way;
    }
    void add(int way) { ++frames_[size_t(way)]; }
    uint32_t frames(int way) const { return frames_[size_t(way)]; }
    /// Bit i: turned by i / kWays of a full turn to their left.
    uint32_t seen() const {
        uint32_t bits = 0;
        for (int way = 0; way < kWays; ++way)
            if (frames(way)) bits |= uint32_t{1} << way;
        return bits;
    }
    void reset() { frames_ = {}; }

private:
    std::array<uint32_t, kWays> frames_{};
};

}  // namespace vfit
