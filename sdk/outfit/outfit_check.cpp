#include "outfit/outfit_check.h"

#include <algorithm>

namespace vfit {

namespace {

MeshView mesh_of(const WornGarment& garment) {
    return {garment.finished().positions(), garment.dress().indices()};
}

/// Without triangles where it was not there yet in that step.
MeshView prop_of(const WornGarment& garment, size_t prop) {
    const PropsMet& props = garment.props();
    if (props.positions(prop).empty()) return {};
    return {props.positions(prop), props.indices(prop)};
}

/// Posed for each garment: cloths may have been stepped in different poses.
std::vector<std::vector<Vec3>> posed_skins(std::span<const WornGarment* const> outfit, Jobs& jobs) {
    std::vector<std::vector<Vec3>> skins;
    for (const WornGarment* garment : outfit)
        skins.push_back(garment->wearer().posed(garment->finished().pose(), jobs));
    return skins;
}

}  // namespace

std::vector<SurfaceCrossing> find_crossings(std::span<const WornGarment* const> outfit, Jobs& jobs) {
    using With = SurfaceCrossing::With;
    const std::vector<std::vector<Vec3>> skins = posed_skins(outfit, jobs);
    std::vector<SurfaceCrossing> surfaces;
    for (uint32_t i = 0; i < outfit.size(); ++i) {
        surfaces.push_back({With::itself, i, i, 0, {}});
        surfaces.push_back({With::skin, i, i, 0, {}});
        for (uint32_t k = i + 1; k < outfit.size(); ++k) surfaces.push_back({With::garment, i, k, 0, {}});
        for (uint32_t k = 0; k < outfit[i]->props().count(); ++k)
            surfaces.push_back({With::prop, i, k, 0, {}});
    }
    parallel_for(jobs, uint32_t(surfaces.size()), [&](uint32_t at) {
        SurfaceCrossing& s = surfaces[at];
        const MeshView mesh = mesh_of(*outfit[s.garment]);
        const auto pairs_of = [&]() -> std::vector<TrianglePair> {
            switch (s.with) {
                case With::itself: return crossed_triangles(mesh.positions, mesh.indices);
                case With::skin:
                    return crossed_triangles(mesh, {skins[s.garment], outfit[s.garment]->wearer().indices()});
                case With::garment: return crossed_triangles(mesh, mesh_of(*outfit[s.other]));
                case With::prop: return crossed_triangles(mesh, prop_of(*outfit[s.garment], s.other));
            }
            return {};
        };
        const std::vector<TrianglePair> pairs = pairs_of();
        s.pair_count = uint32_t(pairs.size());
        if (!pairs.empty()) s.first = *std::min_element(pairs.begin(), pairs.end());
    });
    std::erase_if(surfaces, [](const SurfaceCrossing& s) { return s.pair_count == 0; });
    return surfaces;
}

}  // namespace vfit
