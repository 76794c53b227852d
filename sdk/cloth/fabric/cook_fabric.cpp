// From a shape and a material to masses and constraints in SI units.
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "cloth/fabric/fabric.h"
#include "core/error.h"

namespace vfit {

namespace {

/// An edge of the mesh with what its one or two triangles say about it.
struct MeshEdge {
    float area_m2 = 0.0f;           // of its triangles
    std::vector<uint32_t> opposite;  // their third vertices
};

using EdgeMap = std::map<std::pair<uint32_t, uint32_t>, MeshEdge>;

float triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5f * glm::length(glm::cross(b - a, c - a));
}

/// Share (squared) of the edge's direction that runs along the warp.
float warp_cosine2(const FabricShape& shape, uint32_t a, uint32_t b) {
    if (shape.uvs.empty()) {
        const Vec3 d = shape.positions[a] - shape.positions[b];
        return d.y * d.y / glm::dot(d, d);
    }
    const Vec2 d = shape.uvs[a] - shape.uvs[b];
    const float length2 = glm::dot(d, d);
    return length2 > 0.0f ? d.y * d.y / length2 : 0.5f;
}

/// Moduli (N/m) of springs along warp, weft and between that together stretch and shear as the fabric does. On a grid with
/// diagonals these add D = G to the stiffness along both axes and couple the two: a strip that is free to narrow pulls with
/// A + D - D^2 / (B + D), which is to be its modulus. Springs at 45 degrees are never softer than warp and weft make them:
/// a network of springs shears with a third of its modulus or more.
struct Springs {
    float warp, weft, between;

    explicit Springs(const FabricMaterial& m) : warp(m.stretch_warp_n_m), weft(m.stretch_weft_n_m) {
        constexpr int kRounds = 20;
        constexpr float kLeast = 0.25f, kStiffest = 1e6f;
        between = m.shear_n_m;
        for (int i = 0; i < kRounds; ++i) {
            between = 1.0f / std::max(1.0f / m.shear_n_m - 1.0f / warp - 1.0f / weft, 1.0f / (kStiffest * m.shear_n_m));
            const float d = 1.0f / (1.0f / warp + 1.0f / weft + 1.0f / between);
            const float along = m.stretch_warp_n_m - d + d * d / (weft + d), across = m.stretch_weft_n_m - d + d * d / (warp + d);
            warp = std::max(along, kLeast * m.stretch_warp_n_m);
            weft = std::max(across, kLeast * m.stretch_weft_n_m);
        }
    }
    /// At an angle to the warp: 1/E = c^4/A + s^4/B + c^2 s^2/G (Jones, Mechanics of Composite Materials, off-axis modulus,
    /// Poisson's ratio taken as zero).
    float modulus(float c2) const {
        const float s2 = 1.0f - c2;
        return 1.0f / (c2 * c2 / warp + s2 * s2 / weft + c2 * s2 / between);
    }
};

/// Bending stiffness B over a fold of angle t is an energy B l^2 / (2 (A1 + A2)) t^2: exact for cloth that is bent to a
/// cylinder, on triangles of equal sides and on squares cut across. (Factors of 3 that are in use make it three times too
/// stiff there.)
Hinge hinge_over(std::span<const Vec3> cut, uint32_t a, uint32_t b, uint32_t c, uint32_t d, float bend_n_m) {
    const Vec3 edge = cut[b] - cut[a];
    const float length2 = glm::dot(edge, edge), length = std::sqrt(length2);
    Hinge hinge{{a, b, c, d}, {}, 0.0f};
    float areas = 0.0f;
    for (const size_t k : {size_t(2), size_t(3)}) {
        const Vec3 off = cut[hinge.vertices[k]] - cut[a];
        const float along = glm::dot(off, edge) / length2;  // of the foot of the corner's height
        const float height = glm::length(off - along * edge), weight = length / height;
        hinge.weights[k] = weight;
        hinge.weights[0] -= weight * (1.0f - along);
        hinge.weights[1] -= weight * along;
        areas += 0.5f * length * height;
    }
    hinge.compliance_m_n = areas / bend_n_m;
    return hinge;
}

/// A hinge as linear as ours gives way where a fold closes: its push goes with the sine of half the angle. A distance over the
/// fold does not; it is next to nothing over a flat one and stores what the hinge does at 30 degrees.
DistanceConstraint fold_limit_over(std::span<const Vec3> cut, uint32_t a, uint32_t b, uint32_t c, uint32_t d, float bend_n_m) {
    constexpr float kFold_rad = kPi / 6.0f;
    const float length = glm::length(cut[b] - cut[a]), area1 = triangle_area(cut[a], cut[b], cut[c]), area2 = triangle_area(cut[a], cut[b], cut[d]);
    const float stiffness_n_m = bend_n_m * length * length / (area1 + area2);  // N m
    const float height1 = 2.0f * area1 / length, height2 = 2.0f * area2 / length;
    const float shorter_m = 0.5f * height1 * height2 / (height1 + height2) * kFold_rad;  // times the angle: what the distance loses by it
    return {c, d, glm::length(cut[c] - cut[d]), shorter_m * shorter_m / stiffness_n_m};
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

    std::vector<Vec3> cut(shape.positions.begin(), shape.positions.end());
    for (Vec3& p : cut) p *= Vec3(shape.horizontal_scale, 1.0f, shape.horizontal_scale);

    const Springs springs(material);
    FabricData data;
    std::vector<float> mass(n, 0.0f);
    EdgeMap edges;
    for (size_t t = 0; t + 2 < shape.indices.size(); t += 3) {
        const uint32_t v[3] = {shape.indices[t], shape.indices[t + 1], shape.indices[t + 2]};
        const float area = triangle_area(cut[v[0]], cut[v[1]], cut[v[2]]);
        for (int k = 0; k < 3; ++k) {
            mass[v[k]] += area * material.density_kg_m2 / 3.0f;
            const uint32_t a = v[k], b = v[(k + 1) % 3];
            MeshEdge& edge = edges[{std::min(a, b), std::max(a, b)}];
            edge.area_m2 += area;
            edge.opposite.push_back(v[(k + 2) % 3]);
        }
    }
    data.indices.assign(shape.indices.begin(), shape.indices.end());
    data.density_kg_m2 = material.density_kg_m2;
    data.inverse_mass.resize(n);
    for (size_t i = 0; i < n; ++i) {
        if (shape.simulated[i] && !(mass[i] > 0.0f)) fail(VFIT_ERROR_DATA, "simulated vertex ", i, " has no triangle");
        data.inverse_mass[i] = shape.simulated[i] ? 1.0f / mass[i] : 0.0f;
    }
    for (const auto& [ends, edge] : edges) {
        const auto [a, b] = ends;
        const float length = glm::length(cut[a] - cut[b]);
        if (!(length > 0.0f)) fail(VFIT_ERROR_DATA, "vertices ", a, " and ", b, " share an edge and a place");
        if (shape.simulated[a] || shape.simulated[b]) {
            // A spring of that length stands for a strip as wide as its triangles' area over its length.
            const float stiffness = springs.modulus(warp_cosine2(shape, a, b)) * edge.area_m2 / (length * length);
            data.edges.push_back({a, b, length, 1.0f / stiffness});
        }
        if (edge.opposite.size() != 2) continue;
        const uint32_t c = edge.opposite[0], d = edge.opposite[1];
        const bool moves = shape.simulated[a] || shape.simulated[b] || shape.simulated[c] || shape.simulated[d];
        if (moves && c != d) data.hinges.push_back(hinge_over(cut, a, b, c, d, material.bend_n_m));
        if ((shape.simulated[c] || shape.simulated[d]) && cut[c] != cut[d]) data.bends.push_back(fold_limit_over(cut, a, b, c, d, material.bend_n_m));
    }
    data.tethers = cook_tethers(data.inverse_mass, data.edges);
    return data;
}

std::vector<Tether> cook_tethers(std::span<const float> inverse_mass, std::span<const DistanceConstraint> edges) {
    struct Link {
        uint32_t to;
        float length;
    };
    const size_t n = inverse_mass.size();
    std::vector<std::vector<Link>> links(n);
    for (const DistanceConstraint& e : edges) {
        links[e.a].push_back({e.b, e.rest_m});
        links[e.b].push_back({e.a, e.rest_m});
    }
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
        for (const Link& link : links[i])
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
