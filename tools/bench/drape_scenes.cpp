#include "bench/drape_scenes.h"

#include <algorithm>
#include <cmath>

#include "cloth/triangle_fans.h"

namespace vfit::bench {

namespace {

struct Box {
    Vec3 low{INFINITY}, high{-INFINITY};
    void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    bool meets(const Box& o) const { return glm::all(glm::lessThanEqual(low, o.high)) && glm::all(glm::lessThanEqual(o.low, high)); }
};

/// Does the line from p to q cross the triangle? (Moeller and Trumbore 1997)
bool crosses(const Vec3& p, const Vec3& q, const Vec3* t) {
    const glm::dvec3 d(q - p), e1(t[1] - t[0]), e2(t[2] - t[0]), h = glm::cross(d, e2);
    const double det = glm::dot(e1, h);
    if (std::abs(det) < 1e-16) return false;
    const glm::dvec3 s(p - t[0]), k = glm::cross(s, e1);
    const double u = glm::dot(s, h) / det, v = glm::dot(d, k) / det, at = glm::dot(e2, k) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1;
}

}  // namespace

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
            if ((r + c) % 2) indices.insert(indices.end(), {a, d, e, a, e, b});
            else indices.insert(indices.end(), {a, d, b, b, d, e});
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

size_t crossed_pairs(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    struct Triangle {
        Vec3 corner[3];
        Box box;
        uint32_t first;
    };
    std::vector<Triangle> list;
    for (uint32_t i = 0; i + 2 < indices.size(); i += 3) {
        Triangle t{{positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]}, {}, i};
        for (const Vec3& p : t.corner) t.box.add(p);
        list.push_back(t);
    }
    std::sort(list.begin(), list.end(), [](const Triangle& a, const Triangle& b) { return a.box.low.x < b.box.low.x; });
    const auto share = [&](uint32_t a, uint32_t b) {
        for (uint32_t i = 0; i < 3; ++i)
            for (uint32_t k = 0; k < 3; ++k)
                if (indices[a + i] == indices[b + k]) return true;
        return false;
    };
    size_t pairs = 0;
    for (size_t i = 0; i < list.size(); ++i)
        for (size_t k = i + 1; k < list.size() && list[k].box.low.x <= list[i].box.high.x; ++k) {
            const Triangle &a = list[i], &b = list[k];
            if (!a.box.meets(b.box) || share(a.first, b.first)) continue;
            bool crossed = false;
            for (int e = 0; e < 3 && !crossed; ++e)
                crossed = crosses(a.corner[e], a.corner[(e + 1) % 3], b.corner) || crosses(b.corner[e], b.corner[(e + 1) % 3], a.corner);
            pairs += crossed;
        }
    return pairs;
}

float least_spacing(std::span<const Vec3> positions, std::span<const uint32_t> indices, std::span<const Vec3> flat, float along_m) {
    constexpr float kReach_m = 0.05f;
    const TriangleFans fans(positions.size(), indices);
    float least2 = kReach_m * kReach_m;
    for (size_t v = 0; v < positions.size(); ++v)
        for (uint32_t other = 0; other < positions.size(); ++other) {
            const Vec3 way = positions[other] - positions[v];
            if (glm::dot(way, way) > kReach_m * kReach_m || glm::length(flat[other] - flat[v]) < along_m) continue;
            for (const TriangleFans::Corners& corners : fans.of(other)) {
                const Vec3 &a = positions[other], &b = positions[corners.second], &c = positions[corners.third];
                const Vec3 w = nearest_on_triangle(positions[v], a, b, c), off = positions[v] - (w.x * a + w.y * b + w.z * c);
                least2 = std::min(least2, glm::dot(off, off));
            }
        }
    return std::sqrt(least2);
}

}  // namespace vfit::bench
