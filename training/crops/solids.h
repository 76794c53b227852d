// Simple closed shapes, appended to a mesh.
#pragma once

#include <vector>

#include "body/mesh.h"

namespace vfit::training {

/// Axes of a shape, from its middle.
inline Mat3 size(float x, float y, float z) { return Mat3(x, 0, 0, 0, y, 0, 0, 0, z); }

/// Side walls between rings of equal count.
void add_tube(const std::vector<std::vector<Vec3>>& rings, Mesh& out);
/// The unit sphere carried by `axes`.
void add_ellipsoid(const Vec3& centre, const Mat3& axes, Mesh& out);
/// The cube from -1 to 1 carried by `axes`.
void add_box(const Vec3& centre, const Mat3& axes, Mesh& out);

}  // namespace vfit::training
