// Lengths, areas and hulls of the outlines of a section.
#include <algorithm>
#include <cmath>

#include "geometry/section.h"

namespace vfit {

namespace {

/// Twice the signed area of the triangle a b c. In double: products of floats are then exact, so that the
/// sign is right for points almost on a line.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
}

}  // namespace

std::vector<Vec2> Section::points() const {
    std::vector<Vec2> all;
    for (const auto* lines : {&loops, &chains})
        for (const auto& line : *lines) all.insert(all.end(), line.begin(), line.end());
    return all;
}

float perimeter(std::span<const Vec2> loop) {
    double sum = 0.0;
    for (size_t i = 0; i < loop.size(); ++i) sum += glm::distance(loop[i], loop[(i + 1) % loop.size()]);
    return static_cast<float>(sum);
}

float area(std::span<const Vec2> loop) {
    double twice = 0.0;
    for (size_t i = 1; i + 1 < loop.size(); ++i) twice += turn(loop[0], loop[i], loop[i + 1]);
    return static_cast<float>(0.5 * twice);
}

bool encloses(std::span<const Vec2> loop, const Vec2& point) {
    bool inside = false;
    for (size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        if ((a.y > point.y) != (b.y > point.y) && (turn(a, b, point) > 0.0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

std::vector<Vec2> convex_hull(std::span<const Vec2> points) {
    // Andrew's monotone chain: the lower side left to right, then the upper side back.
    std::vector<Vec2> sorted(points.begin(), points.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) return sorted;
    std::vector<Vec2> hull;
    hull.reserve(sorted.size() + 1);
    const auto side = [&](auto first, auto last) {
        const size_t start = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0.0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();  // the other side begins with it
    };
    side(sorted.begin(), sorted.end());
    side(sorted.rbegin(), sorted.rend());
    return hull;
}

float hull_perimeter(std::span<const Vec2> points) { return perimeter(convex_hull(points)); }

Extent extent(std::span<const Vec2> points) {
    if (points.empty()) return {Vec2(0.0f), Vec2(0.0f)};
    Extent e{points[0], points[0]};
    for (const Vec2& p : points) {
        e.minimum = glm::min(e.minimum, p);
        e.maximum = glm::max(e.maximum, p);
    }
    return e;
}

}  // namespace vfit
