// Edges of a quad mesh and the quads of its next level.
#include "body/subdivision.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace vfit {

namespace {

/// One side of a face: the edge's ends in order, and where it was met.
struct Side {
    uint32_t low, high, corner;  // corner = 4 * face + index in the face
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// Sides sorted so that those of one edge are neighbours, in the order of their faces.
std::vector<Side> sorted_sides(const std::vector<Quad>& quads) {
    std::vector<Side> sides;
    sides.reserve(4 * quads.size());
    for (uint32_t f = 0; f < quads.size(); ++f) {
        for (uint32_t i = 0; i < 4; ++i) {
            const auto [low, high] = std::minmax(quads[f][i], quads[f][(i + 1) % 4]);
            sides.push_back({low, high, 4 * f + i});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.corner < y.corner;
    });
    return sides;
}

}  // namespace

Refinement make_refinement(uint32_t vertex_count, std::vector<Quad> quads) {
    Refinement result;
    result.vertex_count = vertex_count;
    result.quads = std::move(quads);
    result.valence.assign(vertex_count, 0);
    const std::vector<Side> sides = sorted_sides(result.quads);
    result.edges.reserve(sides.size() / 2);
    for (size_t i = 0; i < sides.size(); ++i) {
        const int32_t face = static_cast<int32_t>(sides[i].corner / 4);
        if (i == 0 || !sides[i].same_edge(sides[i - 1])) {
            result.edges.push_back({sides[i].low, sides[i].high, face, -1});
            ++result.valence[sides[i].low];
            ++result.valence[sides[i].high];
        } else if (result.edges.back().right < 0) {
            result.edges.back().right = face;
        } else {
            fail(VFIT_ERROR_DATA, "more than two faces share the edge between vertices ", sides[i].low,
                 " and ", sides[i].high);
        }
    }
    return result;
}

std::vector<Quad> fine_quads(const Refinement& refinement) {
    const std::vector<Side> sides = sorted_sides(refinement.quads);
    std::vector<Quad> edge_of_side(refinement.quads.size());  // the vertex on each side of each face
    uint32_t edge_vertex = refinement.vertex_count;
    for (size_t i = 0; i < sides.size(); ++i) {
        if (i > 0 && !sides[i].same_edge(sides[i - 1])) ++edge_vertex;
        edge_of_side[sides[i].corner / 4][sides[i].corner % 4] = edge_vertex;
    }
    std::vector<Quad> fine;
    fine.reserve(4 * refinement.quads.size());
    uint32_t centre = refinement.vertex_count + static_cast<uint32_t>(refinement.edges.size());
    for (size_t f = 0; f < refinement.quads.size(); ++f, ++centre) {
        const Quad& on_side = edge_of_side[f];
        for (uint32_t i = 0; i < 4; ++i)
            fine.push_back({refinement.quads[f][i], on_side[i], centre, on_side[(i + 3) % 4]});
    }
    return fine;
}

}  // namespace vfit
