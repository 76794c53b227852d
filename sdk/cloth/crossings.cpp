#include "cloth/crossings.h"

#include <algorithm>
#include <cmath>

#include "cloth/contact/contact.h"

namespace vfit {

namespace {

struct BoxedTriangle {
    Vec3 corner[3];
    Bounds box;
    uint32_t triangle;
    bool of_b;
};

/// Does the way from p to q go through the triangle? (Moeller and Trumbore 1997)
bool goes_through(const Vec3& p, const Vec3& q, const Vec3 (&t)[3]) {
    const glm::dvec3 d(q - p), e1(t[1] - t[0]), e2(t[2] - t[0]), h = glm::cross(d, e2);
    const double det = glm::dot(e1, h);
    if (std::abs(det) < 1e-16) return false;
    const glm::dvec3 s(p - t[0]), k = glm::cross(s, e1);
    const double u = glm::dot(s, h) / det, v = glm::dot(d, k) / det, at = glm::dot(e2, k) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1;
}

void add_triangles(const MeshView& mesh, bool of_b, std::vector<BoxedTriangle>& out) {
    for (uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        BoxedTriangle t{{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]}, {}, i / 3, of_b};
        for (const Vec3& p : t.corner) t.box.add(p);
        out.push_back(t);
    }
}

/// Sweeps along the axis on which they are spread most.
template <typename Wanted>
std::vector<std::pair<uint32_t, uint32_t>> sweep_for_pairs(std::vector<BoxedTriangle>& list, Wanted&& wanted) {
    Bounds all;
    for (const BoxedTriangle& t : list) all.add(t.box.low), all.add(t.box.high);
    const Vec3 size = all.high - all.low;
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    std::sort(list.begin(), list.end(), [&](const BoxedTriangle& a, const BoxedTriangle& b) { return a.box.low[axis] < b.box.low[axis]; });
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t i = 0; i < list.size(); ++i)
        for (size_t k = i + 1; k < list.size() && list[k].box.low[axis] <= list[i].box.high[axis]; ++k) {
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
