#include "cloth/garment/drawn_mesh.h"

#include "geometry/mesh_query.h"

namespace vfit {

DrawnFrame::DrawnFrame(const CarryingMesh& mesh, uint32_t triangle, const Vec2& weights) {
    const uint32_t* v = &mesh.indices[3 * size_t(triangle)];
    const Vec3 &a = mesh.positions[v[0]], &b = mesh.positions[v[1]], &c = mesh.positions[v[2]];
    const float first = 1.0f - weights.x - weights.y;
    origin = first * a + weights.x * b + weights.y * c;
    Vec3 z = first * mesh.normals[v[0]] + weights.x * mesh.normals[v[1]] + weights.y * mesh.normals[v[2]];
    // Where cloth is folded sharply normals may cancel, and where it is pressed flat a side may vanish.
    constexpr float kLeast = 1e-12f;
    z = glm::dot(z, z) > kLeast ? glm::normalize(z) : Vec3(0, 1, 0);
    Vec3 x = b - a - glm::dot(b - a, z) * z;
    if (!(glm::dot(x, x) > kLeast)) x = glm::cross(std::abs(z.x) < 0.8f ? Vec3(1, 0, 0) : Vec3(0, 1, 0), z);
    x = glm::normalize(x);
    axes = Mat3(x, glm::cross(z, x), z);
}

DrawnMesh bind_drawn(const CarryingMesh& mesh, const MeshQuery& query, std::span<const Vec3> positions,
                     std::span<const Vec3> normals) {
    DrawnMesh out;
    for (size_t i = 0; i < positions.size(); ++i) {
        const MeshQuery::Closest closest = query.closest(positions[i]);
        const DrawnFrame frame(mesh, closest.triangle, closest.uv);
        const Mat3 into = glm::transpose(frame.axes);
        out.triangles.push_back(closest.triangle);
        out.weights.push_back(closest.uv);
        out.offsets.push_back(into * (positions[i] - frame.origin));
        out.normals.push_back(into * normals[i]);
    }
    return out;
}

}  // namespace vfit
