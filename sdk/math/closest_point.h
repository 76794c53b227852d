// The point of one triangle that is closest to a given point.
#pragma once

#include "math/types.h"

namespace vfit {

struct TriangleCorners {
    Vec3 a, b, c;
};

struct TrianglePoint {
    Vec3 position;
    Vec2 uv;  // barycentric weights of b and c
};

/// Square of the distance to the triangle's box, which is not larger than that to the triangle: cheap to
/// have.
inline float box_distance2(const TriangleCorners& t, const Vec3& p) {
    const Vec3 low = glm::min(t.a, glm::min(t.b, t.c)), high = glm::max(t.a, glm::max(t.b, t.c));
    const Vec3 outside = glm::max(glm::max(low - p, p - high), Vec3(0.0f));
    return glm::dot(outside, outside);
}

/// Weight of the end q of the segment p q at its point closest to the origin; 0 where p = q.
inline float closest_on_segment(const Vec3& p, const Vec3& q) {
    const Vec3 d = q - p;
    const float length2 = glm::dot(d, d);
    return length2 > 0.0f ? glm::clamp(-glm::dot(p, d) / length2, 0.0f, 1.0f) : 0.0f;
}

/// The foot of the perpendicular where it falls into the triangle, else the best point of its three edges.
/// Right for triangles without area as well.
inline TrianglePoint closest_point(const TriangleCorners& t, const Vec3& p) {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;  // p is the origin: no cancellation far from it
    const Vec3 n = glm::cross(b - a, c - a);
    const float n2 = glm::dot(n, n);
    // Twice the areas against each edge, in the plane of the triangle and times |n|.
    const float wa = glm::dot(n, glm::cross(b, c));
    const float wb = glm::dot(n, glm::cross(c, a));
    const float wc = glm::dot(n, glm::cross(a, b));
    if (n2 > 0.0f && wa >= 0.0f && wb >= 0.0f && wc >= 0.0f) {
        const float v = wb / n2, w = wc / n2;
        return {t.a + v * (t.b - t.a) + w * (t.c - t.a), Vec2(v, w)};
    }
    const float ab = closest_on_segment(a, b), bc = closest_on_segment(b, c), ca = closest_on_segment(c, a);
    const Vec3 on_ab = a + ab * (b - a), on_bc = b + bc * (c - b), on_ca = c + ca * (a - c);
    const float ab2 = glm::dot(on_ab, on_ab), bc2 = glm::dot(on_bc, on_bc), ca2 = glm::dot(on_ca, on_ca);
    if (ab2 <= bc2 && ab2 <= ca2) return {t.a + ab * (t.b - t.a), Vec2(ab, 0.0f)};
    if (bc2 <= ca2) return {t.b + bc * (t.c - t.b), Vec2(1.0f - bc, bc)};
    return {t.c + ca * (t.a - t.c), Vec2(0.0f, 1.0f - ca)};
}

}  // namespace vfit
