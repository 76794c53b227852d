#include "cook/sew/sewn.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kLeastShare = 0.35f;  // of a side: shorter edges become a point

/// Which items are one.
class Sets {
public:
    explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t a, uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parent_;
};

uint32_t steps_of(float edge_m, float length_m) {
    return edge_m < kLeastShare * length_m ? 0u : std::max(1u, uint32_t(std::lround(edge_m / length_m)));
}

/// Sides along each edge of each panel: as many on both edges of a stitch.
std::vector<std::vector<uint32_t>> choose_steps(const Pattern& pattern, float length_m) {
    std::vector<std::vector<uint32_t>> steps;
    for (const Panel& panel : pattern.panels) {
        steps.emplace_back();
        for (const PatternEdge& edge : panel.edges)
            steps.back().push_back(steps_of(edge_length(panel, edge), length_m));
    }
    for (const Stitch& stitch : pattern.stitches) {
        float sum = 0.0f;
        for (const EdgeName& n : {stitch.a, stitch.b})
            sum += edge_length(pattern.panels[n.panel], pattern.panels[n.panel].edges[n.edge]);
        for (const EdgeName& n : {stitch.a, stitch.b})
            steps[n.panel][n.edge] = steps_of(0.5f * sum, length_m);
    }
    return steps;
}

/// Of each panel, whether its triangles have to be turned over so that seams join what shows to the same
/// side.
std::vector<uint8_t> turned_panels(const Pattern& pattern) {
    std::vector<int> side(pattern.panels.size(), -1);
    for (uint32_t first = 0; first < side.size(); ++first) {
        if (side[first] >= 0) continue;
        side[first] = 0;
        std::vector<uint32_t> open{first};
        while (!open.empty()) {
            const uint32_t panel = open.back();
            open.pop_back();
            for (size_t s = 0; s < pattern.stitches.size(); ++s) {
                const Stitch& stitch = pattern.stitches[s];
                if (stitch.a.panel != panel && stitch.b.panel != panel) continue;
                const uint32_t other = stitch.a.panel == panel ? stitch.b.panel : stitch.a.panel;
                const int wanted = side[panel] ^ int(stitch.turned);
                if (side[other] < 0) {
                    side[other] = wanted;
                    open.push_back(other);
                } else if (side[other] != wanted) {
                    fail(VFIT_ERROR_DATA, "stitch ", s, " (", pattern.text(stitch.a), " to ",
                         pattern.text(stitch.b),
                         ") joins the outside of the cloth to its inside: seen over the other stitches, one "
                         "of the two runs the wrong way round");
                }
            }
        }
    }
    return {side.begin(), side.end()};
}

using DirectedEdge = std::pair<uint32_t, uint32_t>;

class Sewer {
public:
    Sewer(const Pattern& pattern, float length_m) : pattern_(pattern), turned_(turned_panels(pattern)) {
        const auto steps = choose_steps(pattern, length_m);
        for (size_t p = 0; p < pattern.panels.size(); ++p) {
            mesh_.panels.push_back(mesh_panel(pattern.panels[p], steps[p], length_m));
            if (turned_[p])
                for (auto& t : mesh_.panels.back().triangles) std::swap(t[1], t[2]);
        }
    }

    SewnMesh sew() {
        constexpr int kRounds = 4;
        for (int round = 0; round < kRounds; ++round) {
            number();
            join();
            if (!split_doubled()) return std::move(mesh_);
        }
        fail(VFIT_ERROR_DATA, "the seams of the pattern fold its panels onto themselves");
    }

private:
    void number() {
        mesh_.first_vertex.clear(), mesh_.first_triangle.clear(), mesh_.panel_indices.clear();
        uint32_t vertices = 0;
        for (const PanelMesh& panel : mesh_.panels) {
            mesh_.first_vertex.push_back(vertices);
            mesh_.first_triangle.push_back(uint32_t(mesh_.panel_indices.size() / 3));
            for (const auto& t : panel.triangles)
                for (const uint32_t v : t) mesh_.panel_indices.push_back(vertices + v);
            vertices += uint32_t(panel.flat.size());
        }
        mesh_.first_triangle.push_back(uint32_t(mesh_.panel_indices.size() / 3));
        mesh_.sewn_of.assign(vertices, 0);
    }

    uint32_t vertex_on(const EdgeName& edge, size_t i) const {
        return mesh_.first_vertex[edge.panel] + mesh_.panels[edge.panel].edge_vertices[edge.edge][i];
    }

    void join() {
        Sets sets(mesh_.sewn_of.size());
        mesh_.pairs.clear();
        for (uint32_t s = 0; s < pattern_.stitches.size(); ++s) {
            const Stitch& stitch = pattern_.stitches[s];
            const size_t count = mesh_.panels[stitch.a.panel].edge_vertices[stitch.a.edge].size();
            for (size_t i = 0; i < count; ++i) {
                const uint32_t a = vertex_on(stitch.a, i),
                               b = vertex_on(stitch.b, stitch.turned ? i : count - 1 - i);
                sets.join(a, b);
                if (a != b) mesh_.pairs.push_back({a, b, s});
            }
        }
        mesh_.sewn_count = 0;
        std::vector<uint32_t> number(mesh_.sewn_of.size(), UINT32_MAX);
        for (uint32_t v = 0; v < mesh_.sewn_of.size(); ++v) {
            uint32_t& n = number[sets.find(v)];
            if (n == UINT32_MAX) n = mesh_.sewn_count++;
            mesh_.sewn_of[v] = n;
        }
        mesh_.sewn_indices.clear();
        for (const uint32_t v : mesh_.panel_indices) mesh_.sewn_indices.push_back(mesh_.sewn_of[v]);
    }

    uint32_t panel_of(size_t triangle) const {
        return uint32_t(std::upper_bound(mesh_.first_triangle.begin(), mesh_.first_triangle.end(),
                                         uint32_t(triangle)) -
                        mesh_.first_triangle.begin()) -
               1;
    }

    /// Where two panels have a side from seam to seam each, between the same sewn vertices, four triangles
    /// would meet: both sides get a vertex in the middle. True where there were any.
    bool split_doubled() {
        std::map<DirectedEdge, std::vector<size_t>> at;  // first index of the triangle, plus the corner
        for (size_t i = 0; i < mesh_.sewn_indices.size(); i += 3)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = mesh_.sewn_indices[i + k], b = mesh_.sewn_indices[i + (k + 1) % 3];
                if (a == b)
                    fail(VFIT_ERROR_DATA, "the seams of panel ", pattern_.panels[panel_of(i / 3)].name,
                         " close one of its triangles: two of its edges that meet in a corner are sewn to "
                         "one and the same vertex; with smaller triangles they may part");
                at[{a, b}].push_back(i + k);
            }
        std::vector<std::set<DirectedEdge>> split(mesh_.panels.size());
        bool any = false;
        for (const auto& [ends, places] : at) {
            if (places.size() < 2) continue;
            for (const size_t place : places) {
                const size_t first = place / 3 * 3;
                const uint32_t panel = panel_of(first / 3), base = mesh_.first_vertex[panel];
                const uint32_t a = mesh_.panel_indices[place] - base,
                               b = mesh_.panel_indices[first + (place + 1) % 3] - base;
                if (is_outline(panel, a, b))
                    fail(VFIT_ERROR_DATA, "more than two edges of panels meet along a seam of panel ",
                         pattern_.panels[panel].name, ", or one lies on it the wrong way round");
                split[panel].insert(std::minmax(a, b));
                any = true;
            }
        }
        for (size_t p = 0; p < split.size(); ++p)
            for (const auto& [a, b] : split[p]) split_side(mesh_.panels[p], a, b);
        return any;
    }

    bool is_outline(uint32_t panel, uint32_t a, uint32_t b) const {
        int triangles = 0;
        for (const auto& t : mesh_.panels[panel].triangles)
            triangles += std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b);
        return triangles < 2;
    }

    static void split_side(PanelMesh& mesh, uint32_t a, uint32_t b) {
        const uint32_t middle = uint32_t(mesh.flat.size());
        mesh.flat.push_back(0.5f * (mesh.flat[a] + mesh.flat[b]));
        const size_t count = mesh.triangles.size();
        for (size_t i = 0; i < count; ++i) {
            auto& t = mesh.triangles[i];
            const auto at_a = std::find(t.begin(), t.end(), a), at_b = std::find(t.begin(), t.end(), b);
            if (at_a == t.end() || at_b == t.end()) continue;
            auto half = t;
            half[size_t(at_a - t.begin())] = middle;
            *at_b = middle;
            mesh.triangles.push_back(half);
        }
    }

    const Pattern& pattern_;
    std::vector<uint8_t> turned_;
    SewnMesh mesh_;
};

}  // namespace

std::vector<Vec2> SewnMesh::flat() const {
    std::vector<Vec2> out;
    for (const PanelMesh& panel : panels) out.insert(out.end(), panel.flat.begin(), panel.flat.end());
    return out;
}

std::vector<Vec2> SewnMesh::flat_of_size(const Pattern& base, const Pattern& size) const {
    if (size.panels.size() != base.panels.size())
        fail(VFIT_ERROR_DATA, "a size has ", size.panels.size(), " panels, the base size ",
             base.panels.size());
    std::vector<Vec2> out;
    for (size_t p = 0; p < panels.size(); ++p) {
        if (size.panels[p].edges.size() != base.panels[p].edges.size())
            fail(VFIT_ERROR_DATA, "panel ", size.panels[p].name, " of a size has ",
                 size.panels[p].edges.size(), " edges, that of the base size ", base.panels[p].edges.size());
        const std::vector<Vec2> flat = carry_to_size(panels[p], size.panels[p]);
        out.insert(out.end(), flat.begin(), flat.end());
    }
    return out;
}

SewnMesh sew(const Pattern& pattern, float length_m) { return Sewer(pattern, length_m).sew(); }

}  // namespace vfit
