#include "cook/mesh/panel_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kApart = 0.62f;  // of a side: so far from the outline inner vertices begin

float distance_to(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 d = b - a;
    const float along = std::clamp(glm::dot(p - a, d) / std::max(glm::dot(d, d), 1e-20f), 0.0f, 1.0f);
    return glm::length(p - a - d * along);
}

bool inside(const std::vector<Vec2>& line, const Vec2& p) {
    bool in = false;
    for (size_t i = 0, k = line.size() - 1; i < line.size(); k = i++)
        if ((line[i].y > p.y) != (line[k].y > p.y) &&
            p.x < (line[k].x - line[i].x) * (p.y - line[i].y) / (line[k].y - line[i].y) + line[i].x)
            in = !in;
    return in;
}

/// Places of a lattice of equal triangles, inside and not too near to the outline.
void add_lattice(const std::vector<Vec2>& line, float length_m, std::vector<Vec2>& out) {
    Vec2 low(1e30f), high(-1e30f);
    for (const Vec2& p : line) low = glm::min(low, p), high = glm::max(high, p);
    const float row_m = length_m * std::sqrt(0.75f);
    // Even about the panel's middle line, so that what is cut symmetric is meshed so.
    const float middle = 0.5f * (low.x + high.x);
    const int columns = int((high.x - low.x) / length_m) / 2 + 1;
    int row = 0;
    for (float y = low.y + 0.5f * row_m; y < high.y; y += row_m, ++row)
        for (int column = -columns - 1; column <= columns; ++column) {
            const Vec2 p(middle + (float(column) + (row % 2 ? 0.5f : 0.0f)) * length_m, y);
            if (!inside(line, p)) continue;
            float nearest = INFINITY;
            for (size_t i = 0, k = line.size() - 1; i < line.size(); k = i++)
                nearest = std::min(nearest, distance_to(p, line[k], line[i]));
            if (nearest >= kApart * length_m) out.push_back(p);
        }
}

std::vector<std::vector<uint32_t>> neighbours_of(const Triangles& triangles, size_t count) {
    std::vector<std::set<uint32_t>> sets(count);
    for (const auto& t : triangles)
        for (int k = 0; k < 3; ++k)
            sets[t[size_t(k)]].insert(t[size_t(k + 1) % 3]), sets[t[size_t(k)]].insert(t[size_t(k + 2) % 3]);
    std::vector<std::vector<uint32_t>> out;
    for (const auto& set : sets) out.emplace_back(set.begin(), set.end());
    return out;
}

/// Inner vertices to the middle of their neighbours.
void relax(std::vector<Vec2>& points, uint32_t outline, const Triangles& triangles) {
    constexpr int kRounds = 5;
    const auto neighbours = neighbours_of(triangles, points.size());
    for (int round = 0; round < kRounds; ++round)
        for (size_t i = outline; i < points.size(); ++i) {
            if (neighbours[i].empty()) continue;
            Vec2 sum(0.0f);
            for (const uint32_t n : neighbours[i]) sum += points[n];
            points[i] = sum / float(neighbours[i].size());
        }
}

/// The outline's vertices in their order; of an edge of no steps both ends are the same.
std::vector<Vec2> place_outline(const Panel& panel, const std::vector<uint32_t>& steps,
                                std::vector<std::vector<uint32_t>>& edge_vertices) {
    std::vector<Vec2> line;
    edge_vertices.assign(panel.edges.size(), {});
    for (size_t e = 0; e < panel.edges.size(); ++e) {
        if (steps[e] == 0) continue;
        const std::vector<Vec2> places = sample_edge(panel, panel.edges[e], steps[e]);
        for (uint32_t i = 0; i < steps[e]; ++i) {
            edge_vertices[e].push_back(uint32_t(line.size()));
            line.push_back(places[i]);
        }
    }
    // Ends: the first vertex of the next edge that has any.
    const auto first_after = [&](size_t e) {
        for (size_t k = 1; k <= panel.edges.size(); ++k)
            if (const size_t n = (e + k) % panel.edges.size(); steps[n] > 0) return edge_vertices[n].front();
        return 0u;
    };
    for (size_t e = 0; e < panel.edges.size(); ++e) edge_vertices[e].push_back(first_after(e));
    return line;
}

}  // namespace

PanelMesh mesh_panel(const Panel& panel, const std::vector<uint32_t>& steps, float length_m) {
    PanelMesh mesh;
    mesh.flat = place_outline(panel, steps, mesh.edge_vertices);
    mesh.outline = uint32_t(mesh.flat.size());
    if (mesh.outline < 3)
        fail(VFIT_ERROR_DATA, "panel ", panel.name, " is smaller than a triangle of ", length_m * 100.0f,
             " cm");
    const std::vector<Vec2> line = mesh.flat;
    add_lattice(line, length_m, mesh.flat);
    try {
        mesh.triangles = triangulate(mesh.flat, mesh.outline);
        relax(mesh.flat, mesh.outline, mesh.triangles);
        mesh.triangles = triangulate(mesh.flat, mesh.outline);
    } catch (const Error& error) {
        fail(VFIT_ERROR_DATA, "panel ", panel.name, ": ", error.what());
    }
    float area2 = 0.0f;
    for (size_t i = 0, k = line.size() - 1; i < line.size(); k = i++)
        area2 += line[k].x * line[i].y - line[k].y * line[i].x;
    if (area2 < 0.0f)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

std::vector<Vec2> carry_to_size(const PanelMesh& mesh, const Panel& size) {
    std::vector<uint32_t> steps;
    for (const auto& vertices : mesh.edge_vertices) steps.push_back(uint32_t(vertices.size()) - 1);
    std::vector<std::vector<uint32_t>> edge_vertices;
    const std::vector<Vec2> line = place_outline(size, steps, edge_vertices);
    // What the outline's places moved by, spread over the inside as a membrane spreads it (harmonic, with
    // weights of the mesh as it lies: Gauss-Seidel steps on the mean of neighbours).
    std::vector<Vec2> ways(mesh.flat.size(), Vec2(0.0f));
    for (uint32_t i = 0; i < mesh.outline; ++i) ways[i] = line[i] - mesh.flat[i];
    const auto neighbours = neighbours_of(mesh.triangles, mesh.flat.size());
    constexpr int kRounds = 600;  // a panel is some 50 vertices across
    for (int round = 0; round < kRounds; ++round)
        for (size_t i = mesh.outline; i < mesh.flat.size(); ++i) {
            if (neighbours[i].empty()) continue;
            Vec2 sum(0.0f);
            for (const uint32_t n : neighbours[i]) sum += ways[n];
            ways[i] = sum / float(neighbours[i].size());
        }
    std::vector<Vec2> out;
    for (size_t i = 0; i < mesh.flat.size(); ++i) out.push_back(mesh.flat[i] + ways[i]);
    return out;
}

}  // namespace vfit
