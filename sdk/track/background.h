// What the scene looks like without people, learned cell by cell: a reading that stays the same for seconds
// and belongs to nobody, or an empty scene that the host shows.
#pragma once

#include <cstdint>
#include <vector>

#include "track/depth_grid.h"

namespace vfit {

class BackgroundModel {
public:
    /// Forgets everything where the grid's size has changed.
    void fit(const DepthGrid& grid);
    void reset();

    /// The scene is empty now: what is seen is background. Several such frames average.
    void learn_empty(const DepthGrid& grid);
    /// Cells with people[i] != 0 are left out. dt_s: since the last call.
    void learn(const DepthGrid& grid, const uint8_t* people, float dt_s);
    /// Cells of something that stands there and is no person.
    void add(const DepthGrid& grid, size_t cell);

    /// Depth of each cell's background; kNothing where none is known yet. A reading there, or a little
    /// beyond, is no news. Nobody sees through a thing: what is seen kGone_m behind was hidden by something
    /// that has gone, and may be a person.
    const std::vector<float>& known() const { return known_; }
    static constexpr float kNothing = 1e9f;
    static constexpr float kGone_m = 0.3f;  // deeper than what edges and slants jitter by

private:
    static constexpr float kSettled_s = 1.0f;
    static constexpr uint32_t kTurns = 4;
    void set(size_t cell, float depth, float settled_s);
    std::vector<float> depth_, settled_s_;     // background, and for how long it has been seen
    std::vector<float> known_;                 // the same where that was long enough
    std::vector<float> candidate_, steady_s_;  // what may become it
    uint32_t width_ = 0, height_ = 0, turn_ = 0;
    float waiting_s_ = 0.0f, passed_s_ = 0.0f;
};

}  // namespace vfit
