#include "client/alteration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vfit::tools {

namespace {

float factor_at(const std::vector<Widening>& widenings, float height_m) {
    if (height_m <= widenings.front().height_m) return widenings.front().factor;
    for (size_t i = 1; i < widenings.size(); ++i) {
        const auto &low = widenings[i - 1], &high = widenings[i];
        if (height_m < high.height_m)
            return std::lerp(low.factor, high.factor,
                             (height_m - low.height_m) / (high.height_m - low.height_m));
    }
    return widenings.back().factor;
}

/// Of each place in the flat pattern, its panel: the first of the places that hang together with it.
std::vector<uint32_t> panels_of(const std::vector<uint32_t>& corners, size_t count) {
    std::vector<uint32_t> panel(count);
    std::iota(panel.begin(), panel.end(), 0u);
    const auto root = [&](uint32_t v) {
        while (panel[v] != v) v = panel[v] = panel[panel[v]];
        return v;
    };
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
        for (const size_t k : {i + 1, i + 2}) panel[root(corners[k])] = root(corners[i]);
    for (uint32_t v = 0; v < count; ++v) panel[v] = root(v);
    return panel;
}

}  // namespace

Json altered(const Json& garment, const std::string& label, const std::string& as,
             const std::vector<Widening>& widenings) {
    if (!garment.contains("flat"))
        throw Failure(
            "it has no flat panels (its lengths are those of a mesh): a tailor has no seams to move");
    const auto positions = garment.at("positions").get<std::vector<float>>();
    const auto copies = garment.value("copies", std::vector<uint32_t>());
    const auto corners = garment.contains("corners") ? garment["corners"].get<std::vector<uint32_t>>()
                                                     : garment.at("indices").get<std::vector<uint32_t>>();
    const auto on_arm = garment.value("on_arm", std::vector<int>());
    Json out = garment;
    for (const Json& size : garment.at("sizes")) {
        if (size.at("label") != label) continue;
        auto flat = size.at("flat").get<std::vector<float>>();
        const size_t vertices = positions.size() / 3, count = flat.size() / 2;
        const std::vector<uint32_t> panel = panels_of(corners, count);
        std::vector<float> low(count, INFINITY), high(count, -INFINITY);
        for (size_t v = 0; v < count; ++v) {
            low[panel[v]] = std::min(low[panel[v]], flat[2 * v]);
            high[panel[v]] = std::max(high[panel[v]], flat[2 * v]);
        }
        for (size_t v = 0; v < count; ++v) {
            const size_t of = v < vertices ? v : copies.at(v - vertices);
            if (of < on_arm.size() && on_arm[of] != 0) continue;
            const float middle = 0.5f * (low[panel[v]] + high[panel[v]]);
            flat[2 * v] = middle + (flat[2 * v] - middle) * factor_at(widenings, positions[3 * of + 1]);
        }
        Json more = size;
        more["label"] = as;
        more["flat"] = flat;
        auto& sizes = out["sizes"];
        sizes.erase(std::remove_if(sizes.begin(), sizes.end(),
                                   [&](const Json& known) { return known["label"] == as; }),
                    sizes.end());
        sizes.push_back(std::move(more));
        return out;
    }
    throw Failure("it has no size " + label);
}

}  // namespace vfit::tools
