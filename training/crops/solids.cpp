#include "solids.h"

#include <cmath>

namespace vfit::training {

void add_tube(const std::vector<std::vector<Vec3>>& rings, Mesh& out) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    const auto n = static_cast<uint32_t>(rings.front().size());
    for (const auto& ring : rings) out.positions.insert(out.positions.end(), ring.begin(), ring.end());
    for (uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = first + r * n + i, b = first + r * n + (i + 1) % n, c = a + n, d = b + n;
            out.indices.insert(out.indices.end(), {a, b, c, b, d, c});
        }
}

void add_ellipsoid(const Vec3& centre, const Mat3& axes, Mesh& out) {
    std::vector<std::vector<Vec3>> rings;
    for (int r = 0; r <= 8; ++r) {
        const float polar = kPi * float(r) / 8.0f;
        rings.emplace_back();
        for (int i = 0; i < 12; ++i) {
            const float turn = 2.0f * kPi * float(i) / 12.0f;
            rings.back().push_back(centre + axes * Vec3(std::sin(polar) * std::cos(turn), std::cos(polar),
                                                        std::sin(polar) * std::sin(turn)));
        }
    }
    add_tube(rings, out);
}

void add_box(const Vec3& centre, const Mat3& axes, Mesh& out) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    for (int i = 0; i < 8; ++i)
        out.positions.push_back(centre + axes * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    constexpr uint32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                       {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& f : kFaces)
        for (const uint32_t corner : {f[0], f[1], f[2], f[0], f[2], f[3]})
            out.indices.push_back(first + corner);
}

}  // namespace vfit::training
