#include "cloth/crossings.h"

#include <algorithm>

#include "cloth/contact/contact.h"

namespace vfit {

namespace {

struct BoxedTriangle {
    Vec3 corner[3];
    Bounds box;
    uint32_t triangle;
    bool of_b;
};

/// Does the way from p to q go through the triangle?
bool goes_through(const Vec3& p, const Vec3& q, const Vec3 (&t)[3]) {
    const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return glm::dot(b - a, glm::cross(c - a, d - a)); };
    const float from = volume(t[0], t[1], t[2], p), to = volume(t[0], t[1], t[2], q);
    if (from * to >= 0.0f) return false;
    const float x = volume(p, q, t[0], t[1]), y = volume(p, q, t[1], t[2]), z = volume(p, q, t[2], t[0]);
    return (x > 0.0f && y > 0.0f && z > 0.0f) || (x < 0.0f && y < 0.0f && z < 0.0f);
}

void add_triangles(const MeshView& mesh, bool of_b, std::vector<BoxedTriangle>& out) {
    for (uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        BoxedTriangle t{{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]}, {}, i / 3, of_b};
        for (const Vec3& p : t.corner) t.box.add(p);
        out.push_back(t);
    }
}

/// Sweeps along the body's height, which spreads garments most.
template <typename Wanted>
std::vector<std::pair<uint32_t, uint32_t>> sweep_for_pairs(std::vector<BoxedTriangle>& list, Wanted&& wanted) {
    std::sort(list.begin(), list.end(), [](const BoxedTriangle& a, const BoxedTriangle& b) { return a.box.low.y < b.box.low.y; });
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t i = 0; i < list.size(); ++i)
        for (size_t k = i + 1; k < list.size() && list[k].box.low.y <= list[i].box.high.y; ++k) {
            const BoxedTriangle &a = list[i], &b = list[k];
            if (!a.box.overlaps(b.box) || !wanted(a, b)) continue;
            bool crossed = false;
            for (int e = 0; e < 3 && !crossed; ++e)
                crossed = goes_through(a.corner[e], a.corner[(e + 1) % 3], b.corner) || goes_through(b.corner[e], b.corner[(e + 1) % 3], a.corner);
            if (crossed) pairs.emplace_back(a.of_b ? b.triangle : a.triangle, a.of_b ? a.triangle : b.triangle);
        }
    return pairs;
}

}  // namespace

std::vector<std::pair<uint32_t, uint32_t>> crossed_triangles(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    std::vector<BoxedTriangle> list;
    add_triangles({positions, indices}, false, list);
    return sweep_for_pairs(list, [&](const BoxedTriangle& a, const BoxedTriangle& b) {
        const uint32_t *u = &indices[3 * a.triangle], *v = &indices[3 * b.triangle];
        return std::none_of(u, u + 3, [&](uint32_t i) { return i == v[0] || i == v[1] || i == v[2]; });
    });
}

std::vector<std::pair<uint32_t, uint32_t>> crossed_triangles(const MeshView& a, const MeshView& b) {
    std::vector<BoxedTriangle> list;
    add_triangles(a, false, list);
    add_triangles(b, true, list);
    return sweep_for_pairs(list, [](const BoxedTriangle& x, const BoxedTriangle& y) { return x.of_b != y.of_b; });
}

}  // namespace vfit
