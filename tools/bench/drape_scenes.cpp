#include "bench/drape_scenes.h"

#include <algorithm>
#include <cmath>

#include "cloth/base/triangle_fans.h"

namespace vfit::bench {

void Sheets::add(uint32_t rows, uint32_t columns, const Vec3& corner, const Vec3& across, const Vec3& down) {
    const auto first = uint32_t(positions.size());
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            positions.push_back(corner + across * float(c) + down * float(r));
            uvs.emplace_back(glm::length(across) * float(c), glm::length(down) * float(r));
        }
    for (uint32_t r = 0; r + 1 < rows; ++r)
        for (uint32_t c = 0; c + 1 < columns; ++c) {
            const uint32_t a = first + r * columns + c, b = a + 1, d = a + columns, e = d + 1;
            if ((r + c) % 2)
                indices.insert(indices.end(), {a, d, e, a, e, b});
            else
                indices.insert(indices.end(), {a, d, b, b, d, e});
        }
    simulated.resize(positions.size(), 1);
}

std::shared_ptr<const Fabric> Sheets::cook(const FabricMaterial& material) const {
    return std::make_shared<const Fabric>(cook_fabric({positions, indices, uvs, simulated}, material));
}

FabricMaterial plain_weave() { return {0.2f, 1000.0f, 1000.0f, 50.0f, 2e-5f, 0.3f}; }

Collider ball(const Vec3& center, float radius) {
    Collider c;
    c.center = center;
    c.radius = radius;
    return c;
}

Collider rod(const Vec3& a, const Vec3& b, float radius) {
    Collider c = ball(a, radius);
    c.joint_b = 1;
    c.center_b = b;
    c.radius_b = radius;
    return c;
}

float least_spacing(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                    std::span<const Vec3> flat, float along_m) {
    constexpr float kReach_m = 0.05f;
    const TriangleFans fans(positions.size(), indices);
    float least2 = kReach_m * kReach_m;
    for (size_t v = 0; v < positions.size(); ++v)
        for (uint32_t other = 0; other < positions.size(); ++other) {
            const Vec3 way = positions[other] - positions[v];
            if (glm::dot(way, way) > kReach_m * kReach_m || glm::length(flat[other] - flat[v]) < along_m)
                continue;
            for (const TriangleFans::Corners& corners : fans.of(other)) {
                const Vec3 &a = positions[other], &b = positions[corners.second],
                           &c = positions[corners.third];
                const Vec3 w = nearest_on_triangle(positions[v], a, b, c),
                           off = positions[v] - (w.x * a + w.y * b + w.z * c);
                least2 = std::min(least2, glm::dot(off, off));
            }
        }
    return std::sqrt(least2);
}

}  // namespace vfit::bench
