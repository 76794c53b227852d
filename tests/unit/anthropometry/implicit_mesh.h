// A closed mesh of the surface field(p) = 0 (negative inside) by marching tetrahedra: bodies for the tests of
// this room are put together from solids in a line or two.
#pragma once

#include <array>
#include <cmath>
#include <unordered_map>

#include "body/mesh.h"

namespace vfit::test {

template <typename Field>
Mesh implicit_mesh(const Vec3& low, const Vec3& high, float step, const Field& field) {
    const glm::uvec3 n = glm::uvec3(glm::ceil((high - low) / step)) + 1u;
    const auto id = [&](uint32_t x, uint32_t y, uint32_t z) { return (z * n.y + y) * n.x + x; };
    std::vector<Vec3> corner(size_t(n.x) * n.y * n.z);
    std::vector<float> value(corner.size());
    for (uint32_t z = 0; z < n.z; ++z)
        for (uint32_t y = 0; y < n.y; ++y)
            for (uint32_t x = 0; x < n.x; ++x) {
                const uint32_t i = id(x, y, z);
                corner[i] = low + step * Vec3(float(x), float(y), float(z));
                value[i] = field(corner[i]);
            }

    Mesh mesh;
    std::unordered_map<uint64_t, uint32_t> vertex_of_edge;
    const auto vertex = [&](uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [found, is_new] =
            vertex_of_edge.try_emplace(uint64_t(a) << 32 | b, static_cast<uint32_t>(mesh.positions.size()));
        if (is_new) {
            // The field need not be linear: halving finds the surface.
            Vec3 in = corner[value[a] < 0.0f ? a : b], out = corner[value[a] < 0.0f ? b : a];
            for (int i = 0; i < 20; ++i) {
                const Vec3 middle = 0.5f * (in + out);
                (field(middle) < 0.0f ? in : out) = middle;
            }
            mesh.positions.push_back(0.5f * (in + out));
        }
        return found->second;
    };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c, const Vec3& outside) {
        const Vec3 pa = mesh.positions[a],
                   normal = glm::cross(mesh.positions[b] - pa, mesh.positions[c] - pa);
        if (glm::dot(normal, outside - pa) < 0.0f) std::swap(b, c);
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    // Six tetrahedra about the cell's diagonal.
    constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                       {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    for (uint32_t z = 0; z + 1 < n.z; ++z)
        for (uint32_t y = 0; y + 1 < n.y; ++y)
            for (uint32_t x = 0; x + 1 < n.x; ++x)
                for (const auto& tetrahedron : kTetrahedra) {
                    std::array<uint32_t, 4> in{}, out{};
                    int ins = 0, outs = 0;
                    for (const int k : tetrahedron) {
                        const uint32_t i = id(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
                        (value[i] < 0.0f ? in[size_t(ins++)] : out[size_t(outs++)]) = i;
                    }
                    if (ins == 1)
                        triangle(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]),
                                 corner[out[0]]);
                    if (ins == 3)
                        triangle(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]),
                                 corner[out[0]]);
                    if (ins == 2) {
                        const uint32_t a = vertex(in[0], out[0]), b = vertex(in[0], out[1]),
                                       c = vertex(in[1], out[1]), d = vertex(in[1], out[0]);
                        triangle(a, b, c, corner[out[1]]);
                        triangle(a, c, d, corner[out[0]]);
                    }
                }
    return mesh;
}

}  // namespace vfit::test
