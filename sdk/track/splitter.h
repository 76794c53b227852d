// Takes people apart who touch each other, or something else: every cell goes to the seed from which it is
// reached with the least effort, where a way along the surface costs its length and, several times over, what
// it climbs. So borders come to lie on the outlines of who stands in front, and in the crease between two who
// stand side by side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "track/depth_grid.h"
#include "track/heads.h"
#include "track/person_shape.h"

namespace vfit {

class Splitter {
public:
    static constexpr uint8_t kMostSeeds = 8;

    /// Makes room for a grid of that size.
    void fit(const DepthGrid& grid);
    /// Starts with the cells of one component, none of them a seed.
    void begin(const DepthGrid& grid, std::span<const uint32_t> cells);
    /// Seeds are numbered from 1.
    void seed(uint32_t cell, uint8_t number) { owner_[cell] = number; }
    /// Grows the seeds over the component, no farther than that along the surface.
    void grow(float farthest_m);
    /// Cells of a seed; of 0: what no seed has reached.
    std::span<const uint32_t> piece(uint8_t number) const;

    /// Seeds below the heads of people who stand side by side or before something. Returns their number; 0:
    /// none looks like a head on a body.
    uint8_t seed_heads(const ShapeMeter& meter, bool half_seen = false);

private:
    void queue(uint32_t cell, uint32_t effort);
    void leave_queue(uint32_t cell);
    void offer(uint32_t cell, uint32_t x, uint32_t y, float farthest_m);

    static constexpr uint8_t kOutside = 255, kFree = 0;
    static constexpr uint32_t kNone = ~0u;
    static constexpr uint32_t kBuckets = 8192;  // of a unit of effort each; more than one step costs
    const DepthGrid* grid_ = nullptr;
    std::span<const uint32_t> cells_;  // of members_
    std::vector<uint8_t> owner_;
    std::vector<uint32_t> members_, sorted_;
    std::vector<float> path_m_;                 // from the seed
    std::vector<uint32_t> effort_;              // the same with what is climbed
    std::vector<uint32_t> next_, previous_;     // cells of a bucket
    std::array<uint32_t, kBuckets> buckets_{};  // Dial's queue: first cell of each effort, modulo its size
    uint32_t waiting_ = 0;
    std::vector<Vec4> points_;  // of the cells: world, and their area
    HeadFinder finder_;
    std::array<uint32_t, kMostSeeds + 2> starts_{};
};

}  // namespace vfit
