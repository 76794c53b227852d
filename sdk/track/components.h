// Connected components of the depth grid: cells that lie side by side and on one surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "track/depth_grid.h"

namespace vfit {

class Components {
public:
    /// Splits the cells with wanted[i] != 0. Cells are neighbours where no more than one cell without a
    /// reading lies between them in a row or column and their depths differ by less than same_surface_m, or
    /// go on evenly. Components of fewer cells than that are dropped.
    void run(const DepthGrid& grid, const uint8_t* wanted, uint32_t fewest_cells);

    size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
    /// Indices of a component's cells, row by row.
    std::span<const uint32_t> cells(size_t component) const {
        return {order_.data() + starts_[component], starts_[component + 1] - starts_[component]};
    }

private:
    uint32_t root(uint32_t i);
    void join(uint32_t a, uint32_t b);
    std::vector<uint32_t> parent_;  // of each cell
    std::vector<uint32_t> list_;    // wanted cells
    std::vector<uint32_t> count_, order_, starts_;
};

}  // namespace vfit
