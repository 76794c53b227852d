#include "cloth/garment/borders.h"

#include <algorithm>
#include <map>

namespace vfit {

std::vector<std::vector<uint32_t>> border_lines(std::span<const uint32_t> indices) {
    struct Side {
        uint32_t low, high, corner;
        bool operator<(const Side& o) const { return low != o.low ? low < o.low : high < o.high; }
    };
    std::vector<Side> sides;
    sides.reserve(indices.size());
    for (uint32_t i = 0; i < indices.size() / 3 * 3; ++i) {
        const uint32_t a = indices[i], b = indices[next_corner(i)];
        sides.push_back({std::min(a, b), std::max(a, b), i});
    }
    std::sort(sides.begin(), sides.end());
    std::map<uint32_t, uint32_t> from;  // vertex: the corner at which a border's side begins
    for (size_t i = 0, end; i < sides.size(); i = end) {
        for (end = i + 1; end < sides.size() && !(sides[i] < sides[end]);) ++end;
        if (end == i + 1) from[indices[sides[i].corner]] = sides[i].corner;
    }
    std::vector<std::vector<uint32_t>> lines;
    while (!from.empty()) {
        std::vector<uint32_t> line;
        for (auto it = from.begin(); it != from.end();) {
            line.push_back(it->second);
            const uint32_t to = indices[next_corner(it->second)];
            from.erase(it);
            it = from.find(to);
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace vfit
