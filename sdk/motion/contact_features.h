// What tells whether a foot stands: how fast ankle, toes and knee moved over the last tenth of a second, and
// their medians over the last third; how high ankle and toes are over where they were lowest, how much this
// source's joints tremble. The same numbers for either foot, so that one network serves both, and by time, so
// that any frame rate will do.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "frame/body.h"

namespace vfit {

inline constexpr int kContactFeatureCount = 62;

class ContactFeatures {
public:
    void reset() { *this = ContactFeatures(); }

    /// Takes the readings of a body newer than the last, unfiltered. A joint that it lacks stays where it
    /// was.
    void update(const Body& body);

    /// Of the left (0) or right (1) foot at the last body. False while its ankle has not been seen for long
    /// enough.
    bool of(int side, std::span<float, kContactFeatureCount> out) const;

    /// Of the hips, up or down, the largest of the last three steps of 1/30 s; m/s.
    float hip_speed() const;

private:
    static constexpr int kPoints = 10;  // ankle, toes, knee, hip of both sides; pelvis; unused
    static constexpr size_t kHistory = 32;
    struct Sample {
        int64_t time_ns = 0;
        std::array<Vec3, kPoints> at{};
    };
    struct Low {
        bool known = false;
        float level = 0.0f;
    };
    Vec3 place(int point, float ago_s) const;
    Vec3 median_place(int point, int first) const;
    void follow(Low& low, float height, float dt_s);

    std::array<Sample, kHistory> history_{};  // newest at last_
    size_t last_ = 0, count_ = 0;
    std::array<bool, kPoints> known_{};
    std::array<Low, 4> lows_{};                 // ankles, toes
    std::array<float, 2> tremble_{0.1f, 0.1f};  // m/s, of ankles: exceeded in four of five frames
    std::array<float, 2> confidence_{};
};

}  // namespace vfit
