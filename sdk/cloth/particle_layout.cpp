#include "cloth/particle_layout.h"

#include <algorithm>

#include "cloth/fabric.h"

namespace vfit {

namespace {

/// The moving vertices in an order in which runs of kLanes are neighbours on the cloth, so that a run has a small box and
/// runs that follow each other are near.
std::vector<uint32_t> compact_runs(std::span<const float> inverse_mass, std::span<const DistanceConstraint> edges) {
    const size_t n = inverse_mass.size();
    std::vector<uint32_t> first(n + 1, 0), neighbours(2 * edges.size());
    for (const DistanceConstraint& e : edges) ++first[e.a + 1], ++first[e.b + 1];
    for (size_t i = 0; i < n; ++i) first[i + 1] += first[i];
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    for (const DistanceConstraint& e : edges) neighbours[fill[e.a]++] = e.b, neighbours[fill[e.b]++] = e.a;

    std::vector<uint8_t> taken(n);
    for (size_t i = 0; i < n; ++i) taken[i] = inverse_mass[i] == 0.0f;
    std::vector<uint32_t> order;
    for (uint32_t seed = 0; seed < n; ++seed) {
        if (taken[seed]) continue;
        const size_t begin = order.size();
        const auto take = [&](uint32_t v) {
            if (taken[v] || order.size() - begin == kLanes) return;
            taken[v] = 1;
            order.push_back(v);
        };
        take(seed);
        for (size_t i = begin; i < order.size() && order.size() - begin < kLanes; ++i)
            for (uint32_t k = first[order[i]]; k < first[order[i] + 1]; ++k) take(neighbours[k]);
    }
    return order;
}

}  // namespace

ParticleLayout lay_out(std::span<const float> inverse_mass, std::span<const DistanceConstraint> edges) {
    ParticleLayout out;
    out.vertex_of = compact_runs(inverse_mass, edges);
    out.moving = uint32_t((out.vertex_of.size() + kLanes - 1) / kLanes * kLanes);
    out.vertex_of.resize(out.moving, ParticleLayout::kNobody);
    for (uint32_t v = 0; v < inverse_mass.size(); ++v)
        if (inverse_mass[v] == 0.0f) out.vertex_of.push_back(v);
    out.spare = uint32_t(out.vertex_of.size());
    out.vertex_of.push_back(ParticleLayout::kNobody);
    out.particle_of.resize(inverse_mass.size());
    for (uint32_t p = 0; p < out.count(); ++p)
        if (out.vertex_of[p] != ParticleLayout::kNobody) out.particle_of[out.vertex_of[p]] = p;
    return out;
}

}  // namespace vfit
