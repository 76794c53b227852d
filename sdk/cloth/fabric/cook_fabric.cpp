// From a shape and a material to masses and constraints in SI units.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <span>

#include "cloth/fabric/fabric.h"
#include "core/error.h"

namespace vfit {

namespace {

/// A triangle beside an edge, from whose first end the corner opposite to it stands so far along and off.
struct BesideEdge {
    uint32_t corner;
    float along;  // 0: at the first end, 1: at the second
    float height_m;
};

/// An edge of the mesh with what its one or two triangles say about it.
struct MeshEdge {
    float area_m2 = 0.0f;   // of its triangles
    float length_m = 0.0f;  // mean over them
    float warp2 = 0.0f;     // share (squared) of its direction that runs along the warp, mean over them
    uint32_t triangles = 0;
    BesideEdge beside[2];  // the first two
};
struct EdgeOfEnds {
    uint32_t a, b;  // the lower first
    MeshEdge edge;
};

/// The corners of one triangle as it was cut, and its edges' directions in the cloth (x weft, y warp).
struct CutTriangle {
    Vec3 at[3];
    Vec2 cloth[3];

    float area() const { return 0.5f * glm::length(glm::cross(at[1] - at[0], at[2] - at[0])); }
    float warp_cosine2(int k) const {
        const Vec2 d = cloth[(k + 1) % 3] - cloth[k];
        const float length2 = glm::dot(d, d);
        return length2 > 0.0f ? d.y * d.y / length2 : 0.5f;
    }
};

CutTriangle cut_triangle(const FabricShape& shape, size_t first) {
    const Vec3 scale(shape.horizontal_scale, 1.0f, shape.horizontal_scale);
    CutTriangle t;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = shape.indices[first + k];
        t.at[k] = shape.cut.empty() ? shape.positions[v] * scale : Vec3(shape.cut[first + k], 0.0f);
        t.cloth[k] = !shape.cut.empty()   ? shape.cut[first + k]
                     : !shape.uvs.empty() ? shape.uvs[v]
                                          : Vec2(0.0f);
    }
    return t;
}

/// By rising ends.
std::vector<EdgeOfEnds> edges_of(const FabricShape& shape) {
    std::vector<std::pair<uint64_t, uint32_t>>
        sides;  // ends, and the corner at which a triangle's side begins
    sides.reserve(shape.indices.size());
    for (uint32_t corner = 0; corner < shape.indices.size(); ++corner) {
        const auto [low, high] =
            std::minmax(shape.indices[corner], shape.indices[corner % 3 == 2 ? corner - 2 : corner + 1]);
        sides.emplace_back(uint64_t(low) << 32 | high, corner);
    }
    std::sort(sides.begin(), sides.end());
    std::vector<uint32_t> edge_of(sides.size());  // of each such corner
    std::vector<EdgeOfEnds> edges;
    edges.reserve(sides.size());
    for (size_t i = 0; i < sides.size(); ++i) {
        if (i == 0 || sides[i].first != sides[i - 1].first)
            edges.push_back({uint32_t(sides[i].first >> 32), uint32_t(sides[i].first), {}});
        edge_of[sides[i].second] = uint32_t(edges.size()) - 1;
    }
    for (size_t first = 0; first + 2 < shape.indices.size(); first += 3) {
        const CutTriangle t = cut_triangle(shape, first);
        const float area = t.area();
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = shape.indices[first + size_t(k)], b = shape.indices[first + size_t(k + 1) % 3];
            const int from = a < b ? k : (k + 1) % 3, to = a < b ? (k + 1) % 3 : k, off = (k + 2) % 3;
            const Vec3 edge_way = t.at[to] - t.at[from], corner_way = t.at[off] - t.at[from];
            const float length = glm::length(edge_way),
                        along = glm::dot(corner_way, edge_way) / (length * length);
            MeshEdge& edge = edges[edge_of[first + size_t(k)]].edge;
            edge.area_m2 += area;
            edge.length_m += length;
            if (shape.cut.empty() && shape.uvs.empty()) {
                const Vec3 d = shape.positions[a] - shape.positions[b];
                edge.warp2 += d.y * d.y / glm::dot(d, d);
            } else {
                edge.warp2 += t.warp_cosine2(k);
            }
            if (edge.triangles < 2)
                edge.beside[edge.triangles] = {shape.indices[first + size_t(off)], along,
                                               glm::length(corner_way - along * edge_way)};
            ++edge.triangles;
        }
    }
    for (auto& [a, b, edge] : edges) {
        const float count = float(edge.triangles);
        edge.length_m /= count;
        edge.warp2 /= count;
    }
    return edges;
}

/// Moduli (N/m) of springs along warp, weft and between that together stretch and shear as the fabric does.
/// On a grid with diagonals these add D = G to the stiffness along both axes and couple the two: a strip that
/// is free to narrow pulls with A + D - D^2 / (B + D), which is to be its modulus. Springs at 45 degrees are
/// never softer than warp and weft make them: a network of springs shears with a third of its modulus or
/// more.
struct Springs {
    float warp, weft, between;

    explicit Springs(const FabricMaterial& m) : warp(m.stretch_warp_n_m), weft(m.stretch_weft_n_m) {
        constexpr int kRounds = 20;
        constexpr float kLeast = 0.25f, kStiffest = 1e6f;
        between = m.shear_n_m;
        for (int i = 0; i < kRounds; ++i) {
            between = 1.0f / std::max(1.0f / m.shear_n_m - 1.0f / warp - 1.0f / weft,
                                      1.0f / (kStiffest * m.shear_n_m));
            const float d = 1.0f / (1.0f / warp + 1.0f / weft + 1.0f / between);
            const float along = m.stretch_warp_n_m - d + d * d / (weft + d),
                        across = m.stretch_weft_n_m - d + d * d / (warp + d);
            warp = std::max(along, kLeast * m.stretch_warp_n_m);
            weft = std::max(across, kLeast * m.stretch_weft_n_m);
        }
    }
    /// At an angle to the warp: 1/E = c^4/A + s^4/B + c^2 s^2/G (Jones, Mechanics of Composite Materials,
    /// off-axis modulus, Poisson's ratio taken as zero).
    float modulus(float c2) const {
        const float s2 = 1.0f - c2;
        return 1.0f / (c2 * c2 / warp + s2 * s2 / weft + c2 * s2 / between);
    }
};

/// Bending stiffness B over a fold of angle t is an energy B l^2 / (2 (A1 + A2)) t^2: exact for cloth that is
/// bent to a cylinder, on triangles of equal sides and on squares cut across. (Factors of 3 that are in use
/// make it three times too stiff there.)
Hinge hinge_over(uint32_t a, uint32_t b, const MeshEdge& edge, float bend_n_m) {
    Hinge hinge{{a, b, edge.beside[0].corner, edge.beside[1].corner}, {}, 0.0f};
    float areas = 0.0f;
    for (const size_t k : {size_t(2), size_t(3)}) {
        const BesideEdge& corner = edge.beside[k - 2];
        const float weight = edge.length_m / corner.height_m;
        hinge.weights[k] = weight;
        hinge.weights[0] -= weight * (1.0f - corner.along);
        hinge.weights[1] -= weight * corner.along;
        areas += 0.5f * edge.length_m * corner.height_m;
    }
    hinge.compliance_m_n = areas / bend_n_m;
    return hinge;
}

/// A hinge as linear as ours gives way where a fold closes: its push goes with the sine of half the angle. A
/// distance over the fold does not; it is next to nothing over a flat one and stores what the hinge does at
/// 30 degrees.
DistanceConstraint fold_limit_over(const MeshEdge& edge, float distance_m, float bend_n_m) {
    constexpr float kFold_rad = kPi / 6.0f;
    const BesideEdge &c = edge.beside[0], &d = edge.beside[1];
    const float areas = 0.5f * edge.length_m * (c.height_m + d.height_m);
    const float stiffness_n_m = bend_n_m * edge.length_m * edge.length_m / areas;  // N m
    const float shorter_m = 0.5f * c.height_m * d.height_m / (c.height_m + d.height_m) *
                            kFold_rad;  // times the angle: what the distance loses by it
    return {c.corner, d.corner, distance_m, shorter_m * shorter_m / stiffness_n_m};
}

/// Between the two corners off the edge, where the fold is flat.
float flat_distance(const FabricShape& shape, const MeshEdge& edge) {
    const BesideEdge &c = edge.beside[0], &d = edge.beside[1];
    if (shape.cut.empty()) {
        const Vec3 scale(shape.horizontal_scale, 1.0f, shape.horizontal_scale);
        return glm::length((shape.positions[c.corner] - shape.positions[d.corner]) * scale);
    }
    return glm::length(Vec2((c.along - d.along) * edge.length_m, c.height_m + d.height_m));
}

}  // namespace

FabricData cook_fabric(const FabricShape& shape, const FabricMaterial& material) {
    const size_t n = shape.positions.size();
    if (shape.simulated.size() != n || (!shape.uvs.empty() && shape.uvs.size() != n))
        fail(VFIT_ERROR_ARGUMENT, "the shape's arrays differ in length");
    if (shape.indices.size() % 3 != 0) fail(VFIT_ERROR_DATA, "the shape's indices are not whole triangles");
    for (uint32_t index : shape.indices)
        if (index >= n) fail(VFIT_ERROR_DATA, "a triangle names vertex ", index, " of ", n);
    if (!(shape.horizontal_scale > 0.0f) || !std::isfinite(shape.horizontal_scale))
        fail(VFIT_ERROR_ARGUMENT, "the size's scale is ", shape.horizontal_scale);

    if (!shape.cut.empty() && shape.cut.size() != shape.indices.size())
        fail(VFIT_ERROR_ARGUMENT, shape.cut.size(), " cut corners for ", shape.indices.size());

    const Springs springs(material);
    FabricData data;
    std::vector<float> mass(n, 0.0f);
    for (size_t first = 0; first + 2 < shape.indices.size(); first += 3) {
        const float area = cut_triangle(shape, first).area();
        if (!shape.cut.empty() && !(area > 0.0f))
            fail(VFIT_ERROR_DATA, "triangle ", first / 3, " has no area");
        for (size_t k = 0; k < 3; ++k) mass[shape.indices[first + k]] += area * material.density_kg_m2 / 3.0f;
    }
    data.indices.assign(shape.indices.begin(), shape.indices.end());
    data.density_kg_m2 = material.density_kg_m2;
    data.inverse_mass.resize(n);
    for (size_t i = 0; i < n; ++i) {
        if (shape.simulated[i] && !(mass[i] > 0.0f))
            fail(VFIT_ERROR_DATA, "simulated vertex ", i, " has no triangle");
        data.inverse_mass[i] = shape.simulated[i] ? 1.0f / mass[i] : 0.0f;
    }
    for (const auto& [a, b, edge] : edges_of(shape)) {
        const float length = edge.length_m;
        if (!(length > 0.0f)) fail(VFIT_ERROR_DATA, "vertices ", a, " and ", b, " share an edge and a place");
        if (shape.simulated[a] || shape.simulated[b]) {
            // A spring of that length stands for a strip as wide as its triangles' area over its length.
            const float stiffness = springs.modulus(edge.warp2) * edge.area_m2 / (length * length);
            data.edges.push_back({a, b, length, 1.0f / stiffness});
        }
        if (edge.triangles != 2) continue;
        const uint32_t c = edge.beside[0].corner, d = edge.beside[1].corner;
        const bool moves =
            shape.simulated[a] || shape.simulated[b] || shape.simulated[c] || shape.simulated[d];
        if (c == d) continue;
        if (moves) data.hinges.push_back(hinge_over(a, b, edge, material.bend_n_m));
        const float apart = flat_distance(shape, edge);
        if ((shape.simulated[c] || shape.simulated[d]) && apart > 0.0f)
            data.bends.push_back(fold_limit_over(edge, apart, material.bend_n_m));
    }
    data.tethers = cook_tethers(data.inverse_mass, data.edges);
    return data;
}

std::vector<Tether> cook_tethers(std::span<const float> inverse_mass,
                                 std::span<const DistanceConstraint> edges) {
    struct Link {
        uint32_t to;
        float length;
    };
    const size_t n = inverse_mass.size();
    std::vector<uint32_t> first(n + 1, 0);  // of a vertex in links
    for (const DistanceConstraint& e : edges) ++first[e.a + 1], ++first[e.b + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Link> links(2 * edges.size());
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    for (const DistanceConstraint& e : edges)
        links[fill[e.a]++] = {e.b, e.rest_m}, links[fill[e.b]++] = {e.a, e.rest_m};
    // Dijkstra from all fixed vertices at once.
    std::vector<float> distance(n, INFINITY);
    std::vector<uint32_t> anchor(n, 0);
    using Entry = std::pair<float, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (uint32_t i = 0; i < n; ++i)
        if (inverse_mass[i] == 0.0f) {
            distance[i] = 0.0f;
            anchor[i] = i;
            open.push({0.0f, i});
        }
    while (!open.empty()) {
        const auto [d, i] = open.top();
        open.pop();
        if (d > distance[i]) continue;
        for (const Link& link : std::span(links).subspan(first[i], first[i + 1] - first[i]))
            if (d + link.length < distance[link.to]) {
                distance[link.to] = d + link.length;
                anchor[link.to] = anchor[i];
                open.push({distance[link.to], link.to});
            }
    }
    std::vector<Tether> tethers;
    for (uint32_t i = 0; i < n; ++i)
        if (inverse_mass[i] > 0.0f && distance[i] < INFINITY) tethers.push_back({i, anchor[i], distance[i]});
    return tethers;
}

}  // namespace vfit
