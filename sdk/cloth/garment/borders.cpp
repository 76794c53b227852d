#include "cloth/garment/borders.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace vfit {

std::vector<std::vector<uint32_t>> border_lines(std::span<const uint32_t> indices) {
    struct Side {
        uint32_t high, corner;
    };
    const auto corners = uint32_t(indices.size() / 3 * 3);
    const auto low_of = [&](uint32_t corner) {
        return std::min(indices[corner], indices[next_corner(corner)]);
    };
    const uint32_t vertices =
        corners == 0 ? 0 : 1 + *std::max_element(indices.begin(), indices.begin() + corners);
    std::vector<uint32_t> first(vertices + 1, 0);  // side of those at a vertex and a higher one
    for (uint32_t i = 0; i < corners; ++i) ++first[low_of(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Side> sides(corners);
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    for (uint32_t i = 0; i < corners; ++i)
        sides[fill[low_of(i)]++] = {std::max(indices[i], indices[next_corner(i)]), i};
    std::map<uint32_t, uint32_t> from;  // vertex: the corner at which a border's side begins
    for (uint32_t v = 0; v < vertices; ++v) {
        const std::span<Side> at = std::span(sides).subspan(first[v], first[v + 1] - first[v]);
        std::sort(at.begin(), at.end(), [](const Side& x, const Side& y) { return x.high < y.high; });
        for (size_t i = 0, end; i < at.size(); i = end) {
            for (end = i + 1; end < at.size() && at[end].high == at[i].high;) ++end;
            if (end == i + 1) from[indices[at[i].corner]] = at[i].corner;
        }
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
