// A garment as simple as can be: a tube.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "math/types.h"

namespace vfit::test {

/// A tube about the Y axis: `columns` around, rows from y = 0 up; in the flat, that much wider than it lies.
struct Tube {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<Vec2> cut;

    Tube(float radius, float height, uint32_t columns, uint32_t rows, float wider,
         uint32_t open_columns = 0) {
        const float step = 2.0f * kPi * radius / float(columns);
        for (uint32_t r = 0; r <= rows; ++r)
            for (uint32_t c = 0; c < columns; ++c) {
                const float angle = 2.0f * kPi * float(c) / float(columns);
                positions.emplace_back(radius * std::sin(angle), height * float(r) / float(rows),
                                       radius * std::cos(angle));
            }
        const auto flat = [&](uint32_t c, uint32_t r) {
            return Vec2(float(c) * step * wider, height * float(r) / float(rows));
        };
        for (uint32_t r = 0; r < rows; ++r)
            for (uint32_t c = 0; c + open_columns < columns; ++c) {
                const uint32_t a = r * columns + c, b = r * columns + (c + 1) % columns, d = a + columns,
                               e = b + columns;
                indices.insert(indices.end(), {a, b, e, a, e, d});
                const Vec2 fa = flat(c, r), fb = flat(c + 1, r), fe = flat(c + 1, r + 1), fd = flat(c, r + 1);
                cut.insert(cut.end(), {fa, fb, fe, fa, fe, fd});
            }
    }
};

}  // namespace vfit::test
