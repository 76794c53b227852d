#include "cloth/contact/contact_pair.h"

#include <algorithm>
#include <cmath>

#include "cloth/base/triangle_fans.h"

namespace vfit {

namespace {

constexpr float kParallel = 1e-7f;  // of the squares of both lengths

/// Shares of the way along each of two edges at which they are closest (Ericson 2004, 5.1.9).
std::array<float, 2> closest_on_edges(const std::array<Vec3, 4>& at) {
    const Vec3 d1 = at[1] - at[0], d2 = at[3] - at[2], r = at[0] - at[2];
    const float a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r), c = glm::dot(d1, r),
                b = glm::dot(d1, d2);
    if (!(a > 0.0f) || !(e > 0.0f)) return {0.0f, 0.0f};
    const float denominator = a * e - b * b;
    float s = denominator > kParallel * a * e ? std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f) : 0.5f;
    float t = (b * s + f) / e;
    if (t < 0.0f)
        t = 0.0f, s = std::clamp(-c / a, 0.0f, 1.0f);
    else if (t > 1.0f)
        t = 1.0f, s = std::clamp((b - c) / a, 0.0f, 1.0f);
    return {s, t};
}

/// The volume that the four span, as a polynomial of time.
struct Cubic {
    std::array<double, 4> c{};

    double at(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
};

Cubic volume(PairKind kind, const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to) {
    // A vertex-face pair has the vertex first: 1 -> 2, 1 -> 3, 1 -> 0. Of two edges 0 -> 1, 2 -> 3, 0 -> 2.
    static constexpr size_t kEnds[2][3][2] = {{{1, 2}, {1, 3}, {1, 0}}, {{0, 1}, {2, 3}, {0, 2}}};
    glm::dvec3 place[3], way[3];
    for (size_t k = 0; k < 3; ++k) {
        const auto [a, b] = kEnds[kind == PairKind::edge_edge][k];
        place[k] = glm::dvec3(from[b]) - glm::dvec3(from[a]);
        way[k] = (glm::dvec3(to[b]) - glm::dvec3(to[a])) - place[k];
    }
    const glm::dvec3 n0 = glm::cross(place[0], place[1]),
                     n1 = glm::cross(place[0], way[1]) + glm::cross(way[0], place[1]),
                     n2 = glm::cross(way[0], way[1]);
    return {{glm::dot(n0, place[2]), glm::dot(n1, place[2]) + glm::dot(n0, way[2]),
             glm::dot(n2, place[2]) + glm::dot(n1, way[2]), glm::dot(n2, way[2])}};
}

/// 0, the extrema in (0, 1), and 1: between two of these the polynomial has one root at most.
struct Monotone {
    std::array<double, 4> ends{};
    size_t count = 1;

    explicit Monotone(const Cubic& f) {
        const double a = 3.0 * f.c[3], b = 2.0 * f.c[2], c = f.c[1];
        std::array<double, 2> roots{-1.0, -1.0};
        if (const double discriminant = b * b - 4.0 * a * c; discriminant >= 0.0) {
            const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
            if (a != 0.0) roots[0] = q / a;
            if (q != 0.0) roots[1] = c / q;
        }
        if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
        for (const double root : roots)
            if (root > 0.0 && root < 1.0) ends[count++] = root;
        ends[count++] = 1.0;
    }
};

double root_between(const Cubic& f, double low, double high) {
    constexpr int kHalvings = 40;
    const bool rises = f.at(low) < 0.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        ((f.at(middle) < 0.0) == rises ? low : high) = middle;
    }
    return high;
}

}  // namespace

bool ClosestPoints::is_inside(PairKind kind) const {
    const auto& w = weights;
    if (kind == PairKind::vertex_face) return std::max({w[1], w[2], w[3]}) < 0.0f;
    return w[0] > 0.0f && w[1] > 0.0f && w[2] < 0.0f && w[3] < 0.0f;
}

ClosestPoints closest_points(PairKind kind, const std::array<Vec3, 4>& at) {
    ClosestPoints out;
    if (kind == PairKind::vertex_face) {
        const Vec3 on = nearest_on_triangle(at[0], at[1], at[2], at[3]);
        out.weights = {1.0f, -on.x, -on.y, -on.z};
    } else {
        const auto [s, t] = closest_on_edges(at);
        out.weights = {1.0f - s, s, t - 1.0f, -t};
    }
    out.way = Vec3(0.0f);
    for (size_t k = 0; k < 4; ++k) out.way += out.weights[k] * at[k];
    return out;
}

std::optional<float> first_touch(PairKind kind, const std::array<Vec3, 4>& from,
                                 const std::array<Vec3, 4>& to, float tolerance_m,
                                 std::array<float, 4>& weights) {
    const auto touch_at = [&](double t) {
        std::array<Vec3, 4> at;
        for (size_t k = 0; k < 4; ++k) at[k] = from[k] + (to[k] - from[k]) * float(t);
        const ClosestPoints closest = closest_points(kind, at);
        weights = closest.weights;
        return glm::dot(closest.way, closest.way) < tolerance_m * tolerance_m;
    };
    const Cubic f = volume(kind, from, to);
    const Monotone pieces(f);
    for (size_t i = 0; i + 1 < pieces.count; ++i) {
        const double low = pieces.ends[i], high = pieces.ends[i + 1], before = f.at(low);
        const bool changes = before != 0.0 && (before > 0.0) != (f.at(high) > 0.0);
        const double t = changes ? root_between(f, low, high) : high;
        if ((changes || high < 1.0) && touch_at(t)) return float(t);
    }
    if (touch_at(1.0)) return 1.0f;
    return {};
}

}  // namespace vfit
