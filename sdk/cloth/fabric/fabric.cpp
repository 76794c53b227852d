#include "cloth/fabric/fabric.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kNoTether_m = 1e9f;

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
    for (size_t i = 0; i < d.hinges.size(); ++i) {
        const Hinge& h = d.hinges[i];
        for (size_t k = 0; k < 4; ++k)
            if (h.vertices[k] >= n || !std::isfinite(h.weights[k]) ||
                std::count(h.vertices.begin(), h.vertices.end(), h.vertices[k]) != 1)
                fail(VFIT_ERROR_DATA, "hinge ", i, " joins vertices ", h.vertices[0], ", ", h.vertices[1],
                     ", ", h.vertices[2], " and ", h.vertices[3], " of ", n);
        if (!(h.compliance_m_n >= 0.0f) || !std::isfinite(h.compliance_m_n))
            fail(VFIT_ERROR_DATA, "hinge ", i, " has compliance ", h.compliance_m_n, " m/N");
    }
    for (const Tether& t : d.tethers)
        if (t.vertex >= n || t.anchor >= n || !(t.length_m > 0.0f) || !std::isfinite(t.length_m))
            fail(VFIT_ERROR_DATA, "tether of vertex ", t.vertex, " to ", t.anchor, " of length ", t.length_m,
                 " m");
        else if (d.inverse_mass[t.anchor] > 0.0f)
            fail(VFIT_ERROR_DATA, "tether of vertex ", t.vertex, " to vertex ", t.anchor,
                 ", which is not fixed");
    for (const Backstop& b : d.backstops)
        if (b.vertex >= n || d.inverse_mass[b.vertex] == 0.0f || !(b.radius_m > 0.0f) ||
            !std::isfinite(b.radius_m))
            fail(VFIT_ERROR_DATA, "backstop of vertex ", b.vertex, " with radius ", b.radius_m, " m");
    for (const DistanceLimit& l : d.limits)
        if (l.vertex >= n || l.target >= n || d.inverse_mass[l.vertex] == 0.0f || !(l.distance_m > 0.0f) ||
            !std::isfinite(l.distance_m))
            fail(VFIT_ERROR_DATA, "greatest distance of vertex ", l.vertex, " from target ", l.target, ": ",
                 l.distance_m, " m");
}

}  // namespace

Fabric::Fabric(FabricData data, Jobs* jobs) : data_(std::move(data)) {
    check(data_);
    const std::vector<float>& inverse_mass = data_.inverse_mass;
    for (auto* list : {&data_.edges, &data_.bends})
        std::erase_if(*list, [&](const DistanceConstraint& c) {
            return inverse_mass[c.a] == 0.0f && inverse_mass[c.b] == 0.0f;
        });
    std::erase_if(data_.hinges, [&](const Hinge& h) {
        return std::all_of(h.vertices.begin(), h.vertices.end(),
                           [&](uint32_t v) { return inverse_mass[v] == 0.0f; });
    });
    std::erase_if(data_.tethers, [&](const Tether& t) { return inverse_mass[t.vertex] == 0.0f; });
    for (uint32_t i = 0; i < vertex_count(); ++i)
        if (inverse_mass[i] == 0.0f) kinematic_.push_back(i);

    layout_ = lay_out(data_);
    parallel_for(jobs, 3, [&](uint32_t kind) {
        if (kind == 0)
            hinges_ = make_hinge_batches(data_.hinges, inverse_mass, layout_);
        else if (kind == 1)
            edges_ = make_batches(data_.edges, inverse_mass, layout_);
        else
            bends_ = make_batches(data_.bends, inverse_mass, layout_);
    });
    tether_anchors_.resize(layout_.count());
    tether_lengths_.assign(layout_.count(), kNoTether_m);
    for (const ParticleLayout::Part& part : layout_.parts)
        std::fill(tether_anchors_.begin() + part.begin, tether_anchors_.begin() + part.end, part.spare());
    for (const Tether& t : data_.tethers) {
        const uint32_t particle = layout_.particle_of[t.vertex];
        const size_t at = particle / kLanes * kLanes + lane_of(particle % kLanes);
        tether_anchors_[at] = layout_.particle_in(layout_.part_of(particle), t.anchor);
        tether_lengths_[at] = t.length_m;
    }
    std::vector<DistanceLimit> backstops;  // the targets of their centres follow those of the vertices
    for (const Backstop& b : data_.backstops)
        backstops.push_back({b.vertex, b.radius_m, vertex_count() + uint32_t(backstops.size())});
    backstop_runs_ = place_balls(backstops);
    limit_runs_ = place_balls(data_.limits);
    fans_ = make_fans();
}

std::vector<std::vector<BallRun>> Fabric::place_balls(std::span<const DistanceLimit> balls) const {
    std::vector<std::vector<BallRun>> parts(layout_.parts.size());
    for (const DistanceLimit& ball : balls) {
        const uint32_t particle = layout_.particle_of[ball.vertex], run = particle / uint32_t(kLanes);
        std::vector<BallRun>& runs = parts[layout_.part_of(particle)];
        const size_t lane = lane_of(particle % kLanes);
        const auto place = std::find_if(runs.begin(), runs.end(), [&](const BallRun& r) {
            return r.run == run && r.radius_m[lane] == 0.0f;
        });
        BallRun& of = place != runs.end() ? *place : runs.emplace_back(BallRun{run, {}, {}});
        of.target[lane] = ball.target;
        of.radius_m[lane] = ball.distance_m;
    }
    for (auto& runs : parts)
        std::stable_sort(runs.begin(), runs.end(),
                         [](const BallRun& x, const BallRun& y) { return x.run < y.run; });
    return parts;
}

TriangleFans Fabric::make_fans() const {
    std::vector<uint32_t> corners;
    for (uint32_t v : data_.indices) corners.push_back(layout_.particle_of[v]);
    return TriangleFans(layout_.count(), corners);
}

}  // namespace vfit
