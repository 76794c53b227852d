// Where in an image depth jumps, tile by tile: whoever looks a few pixels aside need not look where all is
// even.
#pragma once

#include <cstdint>
#include <vector>

#include "clean_image.h"

namespace vfit::virtual_person {

class EdgeTiles {
public:
    static constexpr uint32_t kWidth = 16, kHeight = 8;  // px
    static constexpr int kReach = 8;                     // px to either side, no more than a tile

    /// Marks the tiles with a pixel that is steeper than least_cosine, or that may be more than jump_m nearer
    /// or farther than one within kReach of it.
    void find(const CleanImage& image, float jump_m, float least_cosine);
    bool marked(uint32_t x, uint32_t y) const { return marked_[size_t{y / kHeight} * columns_ + x / kWidth]; }

private:
    struct Range {
        float low, high;  // depth, m
    };

    uint32_t columns_ = 0, rows_ = 0;
    std::vector<float> low_, high_, cosine_;  // over the rows of a tile, one a column of the image
    std::vector<Range> ranges_;
    std::vector<uint8_t> marked_;
};

}  // namespace vfit::virtual_person
