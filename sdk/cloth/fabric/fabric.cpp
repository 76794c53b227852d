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
        else if (!(l.pull_m_s2 >= 0.0f))  // may be infinite
            fail(VFIT_ERROR_DATA, "distance limit of vertex ", l.vertex, " pulls by ", l.pull_m_s2, " m/s2");
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
    pieces_.push_back({{0, vertex_count()},
                       {0, uint32_t(data_.indices.size())},
                       {0, uint32_t(data_.edges.size())},
                       {0, uint32_t(data_.backstops.size())},
                       {0, uint32_t(layout_.parts.size())},
                       simulated_count(),
                       uint32_t(data_.edges.size() + data_.bends.size() + data_.hinges.size()),
                       data_.density_kg_m2});
}

Fabric::Fabric(std::vector<std::shared_ptr<const Fabric>> pieces) {
    if (pieces.empty() || pieces.size() > kMaxPieces)
        fail(VFIT_ERROR_ARGUMENT, "a cloth of ", pieces.size(), " pieces; there may be 1 to ", kMaxPieces);
    for (const auto& piece : pieces) append(*piece);
    append_batches(pieces);
    fans_ = make_fans();
}

std::vector<uint8_t> Fabric::piece_of() const {
    std::vector<uint8_t> out;
    for (size_t i = 0; i < pieces_.size(); ++i) out.resize(pieces_[i].vertices.end, uint8_t(i));
    return out;
}

/// All but the batches, which are sorted by groups.
void Fabric::append(const Fabric& piece) {
    const FabricData& data = piece.data_;
    const uint32_t vertex = vertex_count(), index = uint32_t(data_.indices.size()),
                   edge = uint32_t(data_.edges.size()), backstop = uint32_t(data_.backstops.size()),
                   particle = layout_.count(), part = uint32_t(layout_.parts.size());
    pieces_.push_back({{vertex, vertex + piece.vertex_count()},
                       {index, index + uint32_t(data.indices.size())},
                       {edge, edge + uint32_t(data.edges.size())},
                       {backstop, backstop + uint32_t(data.backstops.size())},
                       {part, part + uint32_t(piece.layout_.parts.size())},
                       piece.pieces_[0].simulated_count,
                       piece.pieces_[0].constraint_count,
                       data.density_kg_m2});
    const auto add = [](auto& to, const auto& from, const auto& moved) {
        for (auto item : from) moved(item), to.push_back(item);
    };
    const auto keep = [](auto&) {};
    const auto number = [&](uint32_t& v) { v += vertex; };
    const auto joint = [&](DistanceConstraint& c) { c.a += vertex, c.b += vertex; };
    add(data_.inverse_mass, data.inverse_mass, keep);
    add(data_.indices, data.indices, number);
    add(data_.edges, data.edges, joint);
    add(data_.bends, data.bends, joint);
    add(data_.hinges, data.hinges, [&](Hinge& h) {
        for (uint32_t& v : h.vertices) v += vertex;
    });
    add(data_.tethers, data.tethers, [&](Tether& t) { t.vertex += vertex, t.anchor += vertex; });
    add(data_.backstops, data.backstops, [&](Backstop& b) { b.vertex += vertex; });
    add(data_.limits, data.limits, [&](DistanceLimit& l) { l.vertex += vertex, l.target += vertex; });
    add(kinematic_, piece.kinematic_, number);

    const ParticleLayout& layout = piece.layout_;
    add(layout_.vertex_of, layout.vertex_of, [&](uint32_t& v) {
        if (v != ParticleLayout::kNobody) v += vertex;
    });
    add(layout_.particle_of, layout.particle_of, [&](uint32_t& p) { p += particle; });
    add(layout_.parts, layout.parts,
        [&](ParticleLayout::Part& p) { p.begin += particle, p.moving_end += particle, p.end += particle; });
    add(tether_anchors_, piece.tether_anchors_, [&](uint32_t& p) { p += particle; });
    tether_anchors_.resize(layout_.count());  // none of the spares has one
    add(tether_lengths_, piece.tether_lengths_, keep);
    tether_lengths_.resize(layout_.count(), kNoTether_m);
}

void Fabric::append_batches(const std::vector<std::shared_ptr<const Fabric>>& pieces) {
    const auto add_groups = [&](bool cuts) {
        for (size_t i = 0; i < pieces.size(); ++i) {
            const Fabric& piece = *pieces[i];
            const size_t parts = piece.layout_.parts.size();
            const uint32_t bytes = uint32_t(layout_.parts[pieces_[i].parts.begin].begin * sizeof(Particle));
            if (cuts && i > 0)  // between two pieces there is nothing
                bends_.emplace_back(), edges_.emplace_back(), hinges_.emplace_back();
            for (size_t group = cuts ? parts : 0; group < (cuts ? 2 * parts - 1 : parts); ++group) {
                bends_.push_back(moved(piece.bends_[group], bytes));
                edges_.push_back(moved(piece.edges_[group], bytes));
                hinges_.push_back(moved(piece.hinges_[group], bytes));
            }
        }
    };
    add_groups(false), add_groups(true);
    for (size_t i = 0; i < pieces.size(); ++i) {
        const Piece& of = pieces_[i];
        const uint32_t run = layout_.parts[of.parts.begin].begin / uint32_t(kLanes),
                       own_vertices = of.vertices.count(), centre = vertex_count() + of.backstops.begin;
        const auto add_runs = [&](auto& to, const auto& from) {
            for (std::vector<BallRun> runs : from) {
                for (BallRun& ball : runs) {
                    ball.run += run;
                    for (uint32_t& target : ball.target)
                        target += target < own_vertices ? of.vertices.begin : centre - own_vertices;
                }
                to.push_back(std::move(runs));
            }
        };
        add_runs(backstop_runs_, pieces[i]->backstop_runs_);
        add_runs(limit_runs_, pieces[i]->limit_runs_);
    }
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
        BallRun& of = place != runs.end() ? *place : runs.emplace_back(BallRun{run, {}, {}, {}});
        of.target[lane] = ball.target;
        of.radius_m[lane] = ball.distance_m;
        of.pull_m_s2[lane] = ball.pull_m_s2;
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
