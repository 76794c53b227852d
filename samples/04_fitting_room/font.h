// A font of strokes: each letter a few lines, drawn once into a picture of all letters.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace room {

/// All printable letters of ASCII side by side, as how much of each pixel they cover.
struct Letters {
    int width = 0, height = 0;  // of one letter's cell
    int columns = 16, rows = 6;
    std::vector<uint8_t> coverage;  // columns * width by rows * height

    /// unit: pixels of a sixth of a capital's width.
    explicit Letters(float unit);
};

}  // namespace room
