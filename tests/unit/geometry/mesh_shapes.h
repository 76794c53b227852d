// Meshes whose measures are known in closed form, for the tests of this room.
#pragma once

#include <cmath>
#include <vector>

#include "body/mesh.h"

namespace vfit::test {

/// Points on a grid of `rows` by `columns` quads; columns wrap, rows wrap where `ring`. The caller orders the
/// axes so that triangles are counter-clockwise seen from outside.
template <typename Place>
Mesh grid(uint32_t rows, uint32_t columns, bool ring, const Place& place) {
    Mesh mesh;
    const uint32_t levels = ring ? rows : rows + 1;
    for (uint32_t r = 0; r < levels; ++r)
        for (uint32_t c = 0; c < columns; ++c)
            mesh.positions.push_back(place(float(r) / float(rows), float(c) / float(columns)));
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t above = (r + 1) % levels, next = (c + 1) % columns;
            const uint32_t a = r * columns + c, b = r * columns + next, d = above * columns + c,
                           e = above * columns + next;
            mesh.indices.insert(mesh.indices.end(), {a, d, b, b, d, e});
        }
    return mesh;
}

/// Closes the first and the last row of an open grid with fans about their means.
inline void close_ends(Mesh& mesh, uint32_t columns) {
    const uint32_t count = static_cast<uint32_t>(mesh.positions.size());
    for (const bool top : {false, true}) {
        const uint32_t first = top ? count - columns : 0,
                       center = static_cast<uint32_t>(mesh.positions.size());
        Vec3 mean(0.0f);
        for (uint32_t c = 0; c < columns; ++c) mean += mesh.positions[first + c] / float(columns);
        mesh.positions.push_back(mean);
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = first + c, b = first + (c + 1) % columns;
            if (top)
                mesh.indices.insert(mesh.indices.end(), {a, center, b});
            else
                mesh.indices.insert(mesh.indices.end(), {b, center, a});
        }
    }
}

/// About the Y axis, from y = 0 to the height; open at both ends.
inline Mesh tube(float radius, float height, uint32_t rows, uint32_t columns) {
    return grid(rows, columns, false, [=](float r, float c) {
        const float a = 2.0f * kPi * c;
        return Vec3(radius * std::cos(a), height * r, radius * std::sin(a));
    });
}

inline Mesh cylinder(float radius, float height, uint32_t rows, uint32_t columns) {
    Mesh mesh = tube(radius, height, rows, columns);
    close_ends(mesh, columns);
    return mesh;
}

/// About the origin.
inline Mesh ellipsoid(const Vec3& radii, uint32_t rows, uint32_t columns) {
    Mesh mesh = grid(rows, columns, false, [&](float r, float c) {
        const float rows_f = float(rows), polar = kPi * (r * rows_f + 0.5f) / (rows_f + 1.0f),
                    a = 2.0f * kPi * c;
        return radii * Vec3(std::sin(polar) * std::cos(a), -std::cos(polar), std::sin(polar) * std::sin(a));
    });
    close_ends(mesh, columns);
    for (const bool top : {false, true})  // the ends lie on the surface
        mesh.positions[mesh.positions.size() - (top ? 1 : 2)] = Vec3(0.0f, top ? radii.y : -radii.y, 0.0f);
    return mesh;
}

/// About the Y axis: `ring` from the axis to the middle of the tube of radius `pipe`.
inline Mesh torus(float ring, float pipe, uint32_t rows, uint32_t columns) {
    return grid(rows, columns, true, [=](float r, float c) {
        const float along = 2.0f * kPi * c, round = 2.0f * kPi * r;
        const float out = ring + pipe * std::cos(round);
        return Vec3(out * std::cos(along), pipe * std::sin(round), out * std::sin(along));
    });
}

/// Ramanujan's second formula; below 1e-9 relative for the axes used here.
inline float ellipse_perimeter(float a, float b) {
    const double h = std::pow((double(a) - b) / (double(a) + b), 2.0);
    return static_cast<float>(double(kPi) * (double(a) + b) *
                              (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h))));
}

}  // namespace vfit::test
