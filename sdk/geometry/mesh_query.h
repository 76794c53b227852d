// Closest points, inside tests and rays on one triangle mesh (Embree).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "math/types.h"

namespace vfit {

/// All const members may run at the same time on several threads and do not allocate.
class MeshQuery {
public:
    /// Copies the mesh: three indices a triangle, counter-clockwise seen from outside. VFIT_ERROR_DATA where
    /// it is empty, an index is out of range or a position is not finite.
    MeshQuery(std::span<const Vec3> positions, std::span<const uint32_t> indices);
    ~MeshQuery();
    MeshQuery(MeshQuery&&) noexcept;
    MeshQuery& operator=(MeshQuery&&) noexcept;

    struct Closest {
        Vec3 point;
        Vec3 normal;  // of the triangle, unit length; zero where the triangle has no area
        float distance;
        uint32_t triangle;
        Vec2 uv;  // barycentric weights of the triangle's second and third corner
    };
    /// The exact closest point of the surface to the finite point p. Of triangles equally far (p lies over an
    /// edge) the first is named.
    Closest closest(const Vec3& p) const;

    /// For a closed mesh; where parts of it overlap, the inside of any part is inside. Small holes do no
    /// harm.
    bool inside(const Vec3& p) const;
    /// Distance to the surface, negative inside.
    float signed_distance(const Vec3& p) const;

    struct Hit {
        float distance;  // in metres, whatever the length of the direction
        uint32_t triangle;
        Vec3 normal;  // of the triangle, unit length
    };
    /// The first triangle (either side of it) that the ray meets within `far` metres.
    std::optional<Hit> cast(const Vec3& origin, const Vec3& direction, float far) const;

    /// The same triangles with moved vertices. The search tree is refitted: fast, and as good as a new one
    /// while the mesh only deforms. VFIT_ERROR_ARGUMENT where the count differs, VFIT_ERROR_DATA where a
    /// position is not finite (and nothing changes).
    void update(std::span<const Vec3> positions);

    std::span<const Vec3> positions() const;
    std::span<const uint32_t> indices() const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

/// Moves each point out of a closed mesh, to that clearance at least; in a few tries, as out of one limb may
/// be into another.
void push_out(const MeshQuery& mesh, float clearance_m, std::span<Vec3> points);

/// Radius of the largest sphere about the centre that stays inside the skin; 0 where the centre lies outside.
float largest_inner_sphere(const MeshQuery& skin, const Vec3& center);

}  // namespace vfit
