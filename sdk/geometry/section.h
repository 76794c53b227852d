// The outline of a mesh cut by a plane, and what a tape or a ruler reads off it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Outlines in the plane's own axes: a point (a, b) lies at origin + a u + b v. u is +X made square to the
/// normal (+Z where the normal runs along X), and u x v is the normal: in a horizontal cut u is the body's
/// left and v its back. Outer outlines run counter-clockwise, holes clockwise.
struct Section {
    std::vector<std::vector<Vec2>> loops;   // closed; the first point is not repeated
    std::vector<std::vector<Vec2>> chains;  // end at a border of the mesh
    Vec3 origin{0.0f}, u{1, 0, 0}, v{0, 0, -1};

    Vec3 lift(const Vec2& p) const { return origin + u * p.x + v * p.y; }
    /// The points of all loops and chains.
    std::vector<Vec2> points() const;
};

/// Cuts the mesh with the plane through `point` square to `normal` (any length). A vertex exactly in the
/// plane counts as above it, so that a closed mesh always gives closed loops. VFIT_ERROR_ARGUMENT where the
/// plane is none, VFIT_ERROR_DATA where an index is out of range.
Section cut(std::span<const Vec3> positions, std::span<const uint32_t> indices, const Vec3& point,
            const Vec3& normal);

/// Length of the closed line.
float perimeter(std::span<const Vec2> loop);
/// Signed area, positive counter-clockwise.
float area(std::span<const Vec2> loop);
/// Is the point inside the closed line?
bool encloses(std::span<const Vec2> loop, const Vec2& point);

/// Convex hull, counter-clockwise, without points on its edges.
std::vector<Vec2> convex_hull(std::span<const Vec2> points);
/// Length of the hull's outline: where a taut tape lies.
float hull_perimeter(std::span<const Vec2> points);

struct Extent {
    Vec2 minimum, maximum;
    float breadth() const { return maximum.x - minimum.x; }
    float depth() const { return maximum.y - minimum.y; }
};
/// Smallest box about the points; all zero where there are none.
Extent extent(std::span<const Vec2> points);

}  // namespace vfit
