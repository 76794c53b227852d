#include "geometry/borders.h"

#include <map>
#include <set>
#include <utility>

#include "core/error.h"

namespace vfit {

std::vector<std::vector<uint32_t>> borders(std::span<const uint32_t> indices) {
    using Side = std::pair<uint32_t, uint32_t>;
    const auto after = [](size_t at) { return at - at % 3 + (at + 1) % 3; };
    std::map<Side, size_t> sides;  // where in the indices each begins
    for (size_t at = 0; at < indices.size(); ++at) sides[{indices[at], indices[after(at)]}] = at;
    std::set<Side> open;
    for (const auto& [side, at] : sides)
        if (!sides.count({side.second, side.first})) open.insert(side);
    std::vector<std::vector<uint32_t>> out;
    while (!open.empty()) {
        out.emplace_back();
        Side side = *open.begin();
        // Around its far end, over the triangles there, to the next side of the border.
        while (open.erase(side) > 0) {
            out.back().push_back(side.first);
            Side next = side;
            for (size_t turns = 0;; ++turns) {
                if (turns > indices.size())
                    fail(VFIT_ERROR_DATA, "the surface has sides of more than two triangles");
                const size_t at = after(sides.at(next));
                next = {indices[at], indices[after(at)]};
                if (!sides.count({next.second, next.first})) break;
                next = {next.second, next.first};
            }
            side = next;
        }
    }
    return out;
}

float length_around(std::span<const Vec3> places, std::span<const uint32_t> loop) {
    float sum = 0.0f;
    for (size_t i = 0; i < loop.size(); ++i)
        sum += glm::length(places[loop[(i + 1) % loop.size()]] - places[loop[i]]);
    return sum;
}

}  // namespace vfit
