#include "collision_body.h"

#include <cmath>

namespace vfit::tools {

namespace {

constexpr Color kSphere{0.86f, 0.56f, 0.25f}, kCapsule{0.45f, 0.60f, 0.72f};
constexpr int kAround = 32, kArc = 16;  // vertices of a circle, and of an arc from pole to equator
constexpr float kQuarter = 1.57079633f;

/// The hull of two spheres, turned about the line between them; of one sphere where they are the same.
void add_hull(RenderMesh& mesh, const glm::vec3& a, float radius_a, const glm::vec3& b, float radius_b) {
    const glm::vec3 way = b - a;
    const float length = glm::length(way);
    // One that lies in the other shows the larger alone.
    if (length <= std::abs(radius_a - radius_b)) {
        if (length == 0.0f && radius_a == radius_b && radius_a == 0.0f) return;
        const bool first = radius_a >= radius_b;
        const glm::vec3 centre = first ? a : b;
        const float radius = first ? radius_a : radius_b;
        add_hull(mesh, centre, radius, centre + glm::vec3(0, 1e-4f, 0), radius);
        return;
    }
    const glm::vec3 z = way / length, other = std::abs(z.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 x = glm::normalize(glm::cross(other, z)), y = glm::cross(z, x);
    // The cone touches both spheres where their normals have this slope.
    const float touch = std::asin((radius_a - radius_b) / length);
    const uint32_t first = uint32_t(mesh.positions.size());
    const auto ring = [&](const glm::vec3& centre, float radius, float slope) {
        for (int i = 0; i < kAround; ++i) {
            const float turn = 4.0f * kQuarter * float(i) / kAround;
            const glm::vec3 normal =
                std::sin(slope) * z + std::cos(slope) * (std::cos(turn) * x + std::sin(turn) * y);
            mesh.normals.push_back(normal);
            mesh.positions.push_back(centre + radius * normal);
        }
    };
    for (int i = 0; i <= kArc; ++i) ring(a, radius_a, glm::mix(-kQuarter, touch, float(i) / kArc));
    for (int i = 0; i <= kArc; ++i) ring(b, radius_b, glm::mix(touch, kQuarter, float(i) / kArc));
    for (uint32_t r = 0; r < 2 * kArc + 1; ++r)
        for (uint32_t i = 0; i < kAround; ++i) {
            const uint32_t p = first + r * kAround + i, q = first + r * kAround + (i + 1) % kAround;
            mesh.indices.insert(mesh.indices.end(), {p, q, p + kAround, p + kAround, q, q + kAround});
        }
}

}  // namespace

std::vector<vfit_collider> colliders_of(vfit_avatar avatar) {
    return list<vfit_collider>([&](auto* items, uint32_t stride, uint32_t* count) {
        return vfit_avatar_colliders(avatar, items, stride, count);
    });
}

std::vector<RenderMesh> collider_meshes(const std::vector<vfit_collider>& colliders) {
    std::vector<RenderMesh> meshes(2);
    meshes[0].color = kSphere;
    meshes[1].color = kCapsule;
    constexpr float kDrawnAside = 1.01f;  // a sphere is seen beside the capsules that end in it
    for (const vfit_collider& c : colliders) {
        if (c.radius <= 0.0f) continue;
        const glm::vec3 a(c.center[0], c.center[1], c.center[2]),
            b(c.center_b[0], c.center_b[1], c.center_b[2]);
        if (c.joint_b < 0)
            add_hull(meshes[0], a, kDrawnAside * c.radius, a, kDrawnAside * c.radius);
        else
            add_hull(meshes[1], a, c.radius, b, c.radius_b);
    }
    return meshes;
}

}  // namespace vfit::tools
