// Which ways a person has faced in a turn on the spot.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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
    /// Nearly all ways have been seen, and of each way it or the opposite one: the outline from behind is
    /// that from the front, and one frame that was not good is no reason to turn again.
    bool complete() const {
        constexpr int kEnough = kWays * 5 / 6;
        const uint32_t bits = seen(), opposite = (bits >> (kWays / 2) | bits << (kWays / 2)) & kAll;
        return std::popcount(bits) >= kEnough && (bits | opposite) == kAll;
    }
    /// Half a turn at least was seen: its views close round the person, as both sides are seen from before
    /// and behind.
    bool closed() const { return std::popcount(seen()) >= kWays / 2 && widest_gap() <= kWays / 2; }
    /// How many times wider the errors of a closed surface are than after a whole turn; by generated people.
    float doubt() const {
        constexpr float kUnseenSide = 1.4f;
        constexpr int kQuarter = kWays / 4 + 1;
        return widest_gap() > kQuarter ? kUnseenSide : 1.0f;
    }
    /// The same of cameras that stand still around a person: front, back and one side at least are faced by
    /// one within 60 degrees.
    bool surrounded() const {
        constexpr int kReach = kWays / 6, kHalf = kWays / 8, kEnough = kWays * 7 / 8;
        uint32_t faced = 0;
        for (int way = 0; way < kWays; ++way)
            for (int off = -kReach; off <= kReach; ++off)
                if (frames((way + off + kWays) % kWays)) faced |= uint32_t{1} << way;
        uint32_t front_and_back = 0;
        for (int off = -kHalf; off <= kHalf; ++off)
            front_and_back |= uint32_t{1} << (kWays + off) % kWays | uint32_t{1} << (kWays / 2 + off);
        return std::popcount(faced) >= kEnough && (faced & front_and_back) == front_and_back;
    }
    /// How many times wider the errors are than those by four cameras, a quarter apart; by generated people.
    float doubt_between_cameras() const {
        constexpr float kUnseenSide = 1.5f, kThree = 1.2f;
        constexpr int kQuarter = kWays / 4 + 1, kThird = kWays / 3 + 1;
        return widest_gap() > kThird ? kUnseenSide : widest_gap() > kQuarter ? kThree : 1.0f;
    }
    void reset() { frames_ = {}; }

private:
    /// Ways from one that was seen to the next one.
    int widest_gap() const {
        int widest = kWays, first = -1, last = -1;
        for (int way = 0; way < kWays; ++way) {
            if (!frames(way)) continue;
            widest = first < 0 ? 0 : std::max(widest, way - last);
            if (first < 0) first = way;
            last = way;
        }
        return first < 0 ? kWays : std::max(widest, first + kWays - last);
    }

    std::array<uint32_t, kWays> frames_{};
};

}  // namespace vfit
