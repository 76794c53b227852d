#include "cloth/fabric.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

void check(const std::vector<DistanceConstraint>& list, const char* what, size_t vertices) {
    for (size_t i = 0; i < list.size(); ++i) {
        const DistanceConstraint& c = list[i];
        if (c.a >= vertices || c.b >= vertices || c.a == c.b)
            fail(VFIT_ERROR_DATA, what, " ", i, " joins vertices ", c.a, " and ", c.b, " of ", vertices);
        if (!(c.rest_m > 0.0f) || !std::isfinite(c.rest_m))
            fail(VFIT_ERROR_DATA, what, " ", i, " has rest length ", c.rest_m, " m");
        if (!(c.compliance_m_n >= 0.0f) || !std::isfinite(c.compliance_m_n))
            fail(VFIT_ERROR_DATA, what, " ", i, " has compliance ", c.compliance_m_n, " m/N");
    }
}

void check(const FabricData& d) {
    const size_t n = d.inverse_mass.size();
    if (n == 0) fail(VFIT_ERROR_DATA, "the fabric has no vertices");
    for (size_t i = 0; i < n; ++i)
        if (!(d.inverse_mass[i] >= 0.0f) || !std::isfinite(d.inverse_mass[i]))
            fail(VFIT_ERROR_DATA, "vertex ", i, " has inverse mass ", d.inverse_mass[i]);
    if (d.indices.size() % 3 != 0) fail(VFIT_ERROR_DATA, "the fabric's indices are not whole triangles");
    for (uint32_t i : d.indices)
        if (i >= n) fail(VFIT_ERROR_DATA, "a triangle names vertex ", i, " of ", n);
    check(d.edges, "edge", n);
    check(d.bends, "bend", n);
    for (const Tether& t : d.tethers)
        if (t.vertex >= n || t.anchor >= n || !(t.length_m > 0.0f) || !std::isfinite(t.length_m))
            fail(VFIT_ERROR_DATA, "tether of vertex ", t.vertex, " to ", t.anchor, " of length ", t.length_m, " m");
    for (const Backstop& b : d.backstops)
        if (b.vertex >= n || d.inverse_mass[b.vertex] == 0.0f || !(b.radius_m > 0.0f) || !std::isfinite(b.radius_m))
            fail(VFIT_ERROR_DATA, "backstop of vertex ", b.vertex, " with radius ", b.radius_m, " m");
}

/// Constraints between two fixed vertices do nothing; the others go into batches in which no vertex occurs
/// twice (greedy colouring), so that neighbours in the list do not wait for each other's results.
void sort_for_solver(std::vector<DistanceConstraint>& list, const std::vector<float>& inverse_mass) {
    std::erase_if(list, [&](const DistanceConstraint& c) {
        return inverse_mass[c.a] == 0.0f && inverse_mass[c.b] == 0.0f;
    });
    constexpr uint32_t kColours = 64;  // one bit each; what does not fit goes to the last
    std::vector<uint64_t> used(inverse_mass.size(), 0);
    std::vector<uint8_t> colour(list.size());
    for (size_t i = 0; i < list.size(); ++i) {
        uint64_t& a = used[list[i].a];
        uint64_t& b = used[list[i].b];
        const uint32_t free = std::min<uint32_t>(kColours - 1, uint32_t(std::countr_one(a | b)));
        colour[i] = uint8_t(free);
        a |= uint64_t(1) << free;
        b |= uint64_t(1) << free;
    }
    std::vector<uint32_t> order(list.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) { return colour[i] < colour[j]; });
    std::vector<DistanceConstraint> sorted(list.size());
    for (size_t i = 0; i < order.size(); ++i) sorted[i] = list[order[i]];
    list = std::move(sorted);
}

/// The vertices in an order in which runs of kContactBlock are neighbours on the cloth, so that a run has a small box.
std::vector<uint32_t> compact_patches(const std::vector<uint32_t>& vertices, const FabricData& data) {
    std::vector<std::vector<uint32_t>> neighbours(data.inverse_mass.size());
    for (const DistanceConstraint& e : data.edges) {
        neighbours[e.a].push_back(e.b);
        neighbours[e.b].push_back(e.a);
    }
    std::vector<uint8_t> taken(data.inverse_mass.size(), 1);
    for (uint32_t v : vertices) taken[v] = 0;
    std::vector<uint32_t> order;
    for (uint32_t seed : vertices) {
        if (taken[seed]) continue;
        const size_t begin = order.size();
        order.push_back(seed);
        taken[seed] = 1;
        for (size_t i = begin; i < order.size() && order.size() - begin < kContactBlock; ++i)
            for (uint32_t next : neighbours[order[i]])
                if (!taken[next] && order.size() - begin < kContactBlock) {
                    order.push_back(next);
                    taken[next] = 1;
                }
    }
    return order;
}

}  // namespace

Fabric::Fabric(FabricData data) : data_(std::move(data)) {
    check(data_);
    for (uint32_t i = 0; i < vertex_count(); ++i)
        (data_.inverse_mass[i] > 0.0f ? simulated_ : kinematic_).push_back(i);
    sort_for_solver(data_.edges, data_.inverse_mass);
    sort_for_solver(data_.bends, data_.inverse_mass);
    simulated_ = compact_patches(simulated_, data_);
    std::erase_if(data_.tethers, [&](const Tether& t) { return data_.inverse_mass[t.vertex] == 0.0f; });
}

}  // namespace vfit
