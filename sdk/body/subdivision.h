// Catmull-Clark subdivision of a closed quad mesh, and plain midpoint subdivision of its UV map.
// Catmull & Clark 1978: "Recursively generated B-spline surfaces on arbitrary topological meshes".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vfit {

using Quad = std::array<uint32_t, 4>;

/// One step of subdivision. The fine vertices are the coarse ones, then one an edge, then one a face.
struct Refinement {
    struct Edge {
        uint32_t a, b;        // ends
        int32_t left, right;  // faces; right is -1 on a border
    };
    uint32_t vertex_count = 0;  // coarse
    std::vector<Quad> quads;    // coarse
    std::vector<Edge> edges;
    std::vector<uint32_t> valence;  // edges at each coarse vertex

    uint32_t fine_vertex_count() const {
        return vertex_count + static_cast<uint32_t>(edges.size() + quads.size());
    }
};

/// VFIT_ERROR_DATA where more than two quads share an edge.
Refinement make_refinement(uint32_t vertex_count, std::vector<Quad> quads);
std::vector<Quad> fine_quads(const Refinement& refinement);

/// Values at the fine vertices of a closed mesh (positions, or any field that should be as smooth).
template <typename T>
void refine_smooth(const Refinement& mesh, const T* coarse, T* fine) {
    T* edge_points = fine + mesh.vertex_count;
    T* face_points = edge_points + mesh.edges.size();
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) fine[v] = T(0.0f);
    // A coarse vertex of valence n goes to (F / n + 2 M / n + (n - 3) P) / n, where F and M are the sums of
    // the face points and edge midpoints around it: both are gathered in fine[v] first.
    for (size_t f = 0; f < mesh.quads.size(); ++f) {
        const Quad& q = mesh.quads[f];
        face_points[f] = 0.25f * (coarse[q[0]] + coarse[q[1]] + coarse[q[2]] + coarse[q[3]]);
        for (uint32_t v : q) fine[v] += face_points[f];
    }
    for (size_t e = 0; e < mesh.edges.size(); ++e) {
        const Refinement::Edge& edge = mesh.edges[e];
        const T ends = coarse[edge.a] + coarse[edge.b];
        edge_points[e] = 0.25f * (ends + face_points[edge.left] + face_points[edge.right]);
        fine[edge.a] += ends;  // twice the midpoint
        fine[edge.b] += ends;
    }
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
        const float n = static_cast<float>(mesh.valence[v]);
        fine[v] = (1.0f / (n * n)) * fine[v] + ((n - 3.0f) / n) * coarse[v];
    }
}

/// Values at the fine vertices where coarse vertices stay, edges are halved and faces get their centre.
template <typename T>
void refine_linear(const Refinement& mesh, const T* coarse, T* fine) {
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) fine[v] = coarse[v];
    fine += mesh.vertex_count;
    for (const Refinement::Edge& edge : mesh.edges) *fine++ = 0.5f * (coarse[edge.a] + coarse[edge.b]);
    for (const Quad& q : mesh.quads)
        *fine++ = 0.25f * (coarse[q[0]] + coarse[q[1]] + coarse[q[2]] + coarse[q[3]]);
}

}  // namespace vfit
