// Heads among the points of one component: peaks of its upper edge, with shoulders beside and a body below
// them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "math/types.h"

namespace vfit {

/// World space.
struct Head {
    float x_m = 0.0f, z_m = 0.0f;  // axis
    float top_m = 0.0f;            // crown
};

class HeadFinder {
public:
    static constexpr size_t kMost = 8;

    /// Each point carries the square metres that it stands for in w. Highest heads come first; valid until
    /// the next run. half_seen: of the bodies no more than head and trunk need be seen.
    std::span<const Head> run(std::span<const Vec4> points, bool half_seen = false);

private:
    static constexpr int kColumns = 128, kSlices = 26;

    void project(std::span<const Vec4> points);
    int column(float x) const;
    int highest_untried() const;
    int middle_of_crown(int peak) const;
    float look(std::span<const Vec4> points, int axis, Head& head) const;
    bool may_be_separate(int axis, float top) const;
    float valley(int from, int to) const;
    bool separate(int axis, const Head& head, float area_m2) const;
    bool has_shoulders(int axis, float top) const;
    bool has_body(int axis, float top, bool half_seen) const;
    float filled(int column, int slice) const { return filled_[size_t(column * kSlices + slice)]; }

    std::array<float, kColumns> top_{}, top_z_{};     // highest point
    std::array<float, kColumns * kSlices> filled_{};  // m2
    std::array<bool, kColumns> tried_{};
    std::array<Head, kMost> heads_{};
    std::array<int, kMost> axes_{};  // columns
    size_t count_ = 0;
    float left_m_ = 0.0f, lowest_m_ = 0.0f;
};

}  // namespace vfit
