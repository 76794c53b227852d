// Takes people apart who touch each other, or something else: every cell goes to the seed that is nearest
// along the surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "track/depth_grid.h"
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
    /// Grows the seeds over the component, no farther than that along the surface: first over steps in depth
    /// that noise explains, then over the rest, so that an outline before somebody else is a border.
    void grow(float farthest_m);
    /// Cells of a seed; of 0: what no seed has reached.
    std::span<const uint32_t> piece(uint8_t number) const;

    /// Seeds below the heads of people who stand side by side or before something, as far as a body's width
    /// stands below them. Returns their number; 0: none looks like a head on a body.
    uint8_t seed_heads(const ShapeMeter& meter);

private:
    void spread(float farthest_m, float share);
    static constexpr uint8_t kOutside = 255, kFree = 0;
    const DepthGrid* grid_ = nullptr;
    std::span<const uint32_t> cells_;  // of members_
    std::vector<uint8_t> owner_;
    std::vector<uint32_t> members_, queue_, sorted_;
    std::vector<float> path_m_;
    std::array<uint32_t, kMostSeeds + 2> starts_{};
};

}  // namespace vfit
