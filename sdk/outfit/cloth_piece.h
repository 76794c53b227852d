// The cloth of one garment: a whole one, or a piece of the one that it shares with garments worn over or
// below it. Numbers of vertices are the garment's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"

namespace vfit {

class ClothPiece {
public:
    ClothPiece(Cloth& cloth, size_t piece) : cloth_(cloth), piece_(piece) {}

    Cloth& whole() const { return cloth_; }
    std::span<const Vec3> positions() const { return of().vertices.of(cloth_.positions()); }
    std::span<const Vec3> normals() const { return of().vertices.of(cloth_.normals()); }
    std::span<const float> strain() const { return of().vertices.of(cloth_.strain()); }
    std::span<const float> edge_strain() const { return of().edges.of(cloth_.edge_strain()); }
    std::span<const float> pressure() const { return of().vertices.of(cloth_.pressure()); }
    ClothStats stats() const { return cloth_.stats(piece_); }
    uint64_t state_hash() const { return cloth_.state_hash(piece_); }
    uint32_t vertex_count() const { return of().vertices.count(); }
    /// Vertices at the ends of an edge.
    struct Edge {
        uint32_t a, b;
    };
    Edge edge(size_t i) const {
        const DistanceConstraint& edge = of().edges.of(cloth_.fabric().data().edges)[i];
        return {edge.a - of().vertices.begin, edge.b - of().vertices.begin};
    }
    /// Three a triangle.
    std::vector<uint32_t> indices() const;

    /// As those of Cloth. Such a mesh is met by this piece alone.
    uint32_t add_mesh(size_t vertices, std::span<const uint32_t> indices, MeshOf what,
                      const MeshFilter& filter = {});
    void replace_mesh(uint32_t mesh, size_t vertices, std::span<const uint32_t> indices, MeshOf what);
    void shape_mesh(uint32_t mesh, std::span<const Vec3> positions) { cloth_.shape_mesh(mesh, positions); }
    void move_mesh(uint32_t mesh, std::span<const Vec3> positions, std::span<const Vec3> start = {}) {
        cloth_.move_mesh(mesh, positions, start);
    }
    void hide_mesh(uint32_t mesh) { cloth_.hide_mesh(mesh); }
    bool crosses_mesh(uint32_t mesh) const { return cloth_.crosses_mesh(mesh); }
    void set_mesh_mask(uint32_t mesh, std::span<const uint8_t> mask) {
        cloth_.set_mesh_mask(mesh, mask, piece_);
    }
    void meet_edges() { cloth_.meet_edges(); }

private:
    const Fabric::Piece& of() const { return cloth_.fabric().pieces()[piece_]; }
    bool is_whole() const { return cloth_.fabric().pieces().size() == 1; }
    std::vector<uint8_t> whole_mask(std::span<const uint8_t> own) const;
    template <typename Add>
    auto with_filter(size_t vertices, const MeshFilter& filter, Add&& add) const;

    Cloth& cloth_;
    size_t piece_;
};

}  // namespace vfit
