// The closed surface of a prop: of a shape, or of the host's mesh. Contact finds a triangle by its nearest
// vertex, so triangles are split until no edge is long. A surface with small holes is closed by fans about
// their middles. What is open otherwise, such as a cape or a card of hair, becomes a shell: it gets a back,
// and a rim that joins both.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/mesh.h"
#include "math/types.h"

namespace vfit {

class PropMesh {
public:
    static constexpr size_t kMaxVertices = 1u << 16;

    /// Of a mesh given in its own frame, three indices a triangle. Vertices at the same place become one.
    /// VFIT_ERROR_DATA where indices name no vertex, where nothing is left, where what is closed is clockwise
    /// from outside, or where there are more than kMaxVertices.
    PropMesh(std::span<const Vec3> given, std::span<const uint32_t> indices);

    size_t given_count() const { return given_count_; }
    size_t vertex_count() const { return front_count() + backed_.size(); }
    const std::vector<uint32_t>& indices() const { return indices_; }
    /// All vertices, from where those lie that were given.
    void place(std::span<const Vec3> given, std::vector<Vec3>& out) const;

private:
    size_t front_count() const { return kept_.size() + rims_.size() + middles_.size(); }
    void fill_holes(std::vector<Vec3>& positions);
    void back_shells(size_t vertices);

    size_t given_count_;
    std::vector<uint32_t> kept_;                    // of those that were given
    std::vector<std::vector<uint32_t>> rims_;       // then one in the middle of each of these holes
    std::vector<std::array<uint32_t, 2>> middles_;  // then those between two others
    std::vector<uint32_t> backed_;                  // then those behind others, of a shell
    std::vector<uint32_t> fronts_;                  // triangles of shells
    std::vector<uint32_t> indices_;
};

/// About the origin. A capsule lies along y, its two centres that far from it.
Mesh sphere_mesh(float radius_m);
Mesh capsule_mesh(float radius_m, float half_m);
Mesh box_mesh(const Vec3& half_m);

}  // namespace vfit
