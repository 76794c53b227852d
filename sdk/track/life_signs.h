// Signs of life: a person who stands sways and breathes by millimetres, a thing that stands does not. Tells a
// mannequin from a person, and furniture from both, whatever they look like.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "track/depth_grid.h"
#include "track/identity.h"

namespace vfit {

class LifeSigns {
public:
    static constexpr uint32_t kSlots = Identity::kMost;

    /// Forgets everybody where the grid's size has changed.
    void fit(const DepthGrid& grid);
    void reset();

    /// slots: by cell, from 1; 0: none. ids: whose each slot is now, 0: free; a slot that changes hands
    /// starts afresh. dt_s: since the last image.
    void see(const DepthGrid& grid, const std::vector<uint8_t>& slots,
             const std::array<uint32_t, kSlots>& ids, float dt_s);

    /// It rests, shows no sign of life, and has shown none that outweighs this.
    bool lifeless(uint32_t slot) const { return people_[slot].lifeless; }
    /// For how long that has been so without a break.
    float lifeless_s(uint32_t slot) const { return people_[slot].lifeless ? people_[slot].still_s : 0.0f; }

private:
    static constexpr int kBins = 5;  // of time: the last ones
    struct Person {
        uint32_t id = 0;
        float alive_s = 0.0f;                    // of resting with signs of life
        float still_s = 0.0f;                    // without any, until now
        bool lifeless = false, stirred = false;  // stirred: at the last look
    };
    /// Of one block of cells, m2.
    struct Power {
        float slow = 0.0f, fast = 0.0f;  // movement and noise; noise alone
        std::array<float, 2> move{};     // slow movement along the view, metres
        float slope = 0.0f;              // of depth across the image, from cell to cell
        uint8_t slot = 0;
    };
    struct Cells {
        uint32_t all = 0, steady = 0;
    };
    void close_bin(const std::vector<uint8_t>& slots);
    void measure(const std::vector<uint8_t>& slots);
    void add_block(const std::vector<uint8_t>& slots, uint32_t left, uint32_t top);
    bool stirs(uint32_t slot, bool sure);
    float common_power(uint32_t slot) const;
    void judge(uint32_t slot);
    float median(uint32_t slot, float Power::* of);

    std::array<Person, kSlots> people_{};
    // By bin and cell: the slot that every image of the bin has given it, and the sum of its depths.
    std::array<std::vector<float>, kBins> sums_;
    std::array<std::vector<uint8_t>, kBins> owners_;
    std::array<uint32_t, kBins> images_{};
    std::vector<Power> blocks_;  // of the last look
    std::vector<float> values_;  // to take a median of
    std::array<Cells, kSlots> cells_{};
    uint32_t width_ = 0, height_ = 0;
    int bin_ = 0;         // that is being filled
    float bin_s_ = 0.0f;  // for how long
};

}  // namespace vfit
