// Fabric: all of a cloth that does not change while it is simulated (masses, constraints, topology), cooked
// once and shared by every instance of that cloth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cloth/base/triangle_fans.h"
#include "cloth/fabric/distance_batches.h"
#include "cloth/fabric/fabric_library.h"
#include "cloth/fabric/hinge_batches.h"
#include "cloth/fabric/particle_layout.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

/// |xa - xb| = rest_m with that compliance (XPBD; Macklin, Mueller, Chentanez 2016).
struct DistanceConstraint {
    uint32_t a, b;
    float rest_m;
    float compliance_m_n;
};

/// A fold over the edge of two triangles: |sum of weights * places| of its ends and the two other corners is
/// the edge's length times the fold's angle, and 0 where it is flat: isometric bending (Bergou et al. 2006),
/// linear in the places.
struct Hinge {
    std::array<uint32_t, 4> vertices;
    std::array<float, 4> weights;  // their sum is 0
    float compliance_m_n;
};

/// |x - anchor| <= length_m of a fixed anchor: long range attachment (Kim, Chentanez, Mueller 2012).
struct Tether {
    uint32_t vertex, anchor;
    float length_m;
};

/// A ball below the skin that one vertex stays out of: where colliders are too coarse, the body's own shape.
struct Backstop {
    uint32_t vertex;
    float radius_m;
};

/// How far a vertex may be from a target: its own, or that of another vertex.
struct DistanceLimit {
    uint32_t vertex;
    float distance_m;
    uint32_t target = vertex;
    float pull_m_s2 = std::numeric_limits<float>::infinity();  // at most
};

/// Balls that particles of a run of kLanes stay out of, or in, by lanes.
struct BallRun {
    uint32_t run;
    uint32_t target[kLanes];  // index of its centre
    float radius_m[kLanes];   // 0: none
    float pull_m_s2[kLanes];  // into it, at most
};

/// What a fabric is made of as explicit data, in any order.
struct FabricData {
    std::vector<float> inverse_mass;  // 1/kg, one a vertex; 0: moved by its target
    float density_kg_m2 = 0.0f;       // 0: not known, and then no pressure is
    std::vector<uint32_t> indices;    // three a triangle, for the normals
    std::vector<DistanceConstraint> edges;
    std::vector<DistanceConstraint>
        bends;  // distances over folds: beside hinges they keep folds from closing, alone they bend
    std::vector<Hinge> hinges;
    std::vector<Tether> tethers;
    std::vector<Backstop> backstops;
    std::vector<DistanceLimit> limits;
};

/// Immutable and cooked: laid out for the solver. Made by cook_fabric or from explicit data.
class Fabric {
public:
    /// Fails with VFIT_ERROR_DATA, naming the constraint, where the data do not fit together. jobs: may share
    /// the work.
    explicit Fabric(FabricData data, Jobs* jobs = nullptr);
    /// Several that are simulated as one: garments that are worn together. Each is laid out as it is alone,
    /// so that it moves as it does alone while it meets none of the others. None of them is one of several
    /// itself.
    explicit Fabric(std::vector<std::shared_ptr<const Fabric>> pieces);

    /// What one of the pieces has of all. One made of data is a single piece.
    struct Range {
        uint32_t begin = 0, end = 0;
        uint32_t count() const { return end - begin; }
        template <typename T>
        std::span<const T> of(const std::vector<T>& all) const {
            return std::span(all).subspan(begin, count());
        }
    };
    struct Piece {
        Range vertices, indices, edges, backstops, parts;
        uint32_t simulated_count, constraint_count;  // edges, bends and hinges
        float density_kg_m2;
    };
    const std::vector<Piece>& pieces() const { return pieces_; }
    /// One a vertex. No more than kMaxPieces, VFIT_ERROR_ARGUMENT.
    static constexpr size_t kMaxPieces = 64;
    std::vector<uint8_t> piece_of() const;

    uint32_t vertex_count() const { return uint32_t(data_.inverse_mass.size()); }
    uint32_t simulated_count() const { return vertex_count() - uint32_t(kinematic_.size()); }
    /// Places that a step wants: one a vertex, then the centre of each backstop. Of several pieces all of
    /// their vertices come first.
    uint32_t target_count() const { return vertex_count() + uint32_t(data_.backstops.size()); }
    const FabricData& data() const { return data_; }
    const std::vector<uint32_t>& kinematic_vertices() const { return kinematic_; }

    const ParticleLayout& layout() const { return layout_; }
    /// Of each group of the layout.
    const std::vector<DistanceBatches>& bend_batches() const { return bends_; }
    const std::vector<DistanceBatches>& edge_batches() const { return edges_; }
    const std::vector<HingeBatches>& hinge_batches() const { return hinges_; }
    /// One a lane of each run (of particles that move): the anchor, and how far from it it may be.
    const std::vector<uint32_t>& tether_anchors() const { return tether_anchors_; }
    const std::vector<float>& tether_lengths() const { return tether_lengths_; }
    /// Of each part of the layout, by rising runs.
    const std::vector<std::vector<BallRun>>& backstop_runs() const { return backstop_runs_; }
    const std::vector<std::vector<BallRun>>& limit_runs() const { return limit_runs_; }
    /// The triangles about each particle; of a fixed vertex the first copy has them.
    const TriangleFans& fans() const { return fans_; }

private:
    std::vector<std::vector<BallRun>> place_balls(std::span<const DistanceLimit> balls) const;
    TriangleFans make_fans() const;

    void append(const Fabric& piece);
    void append_batches(const std::vector<std::shared_ptr<const Fabric>>& pieces);

    FabricData data_;
    std::vector<Piece> pieces_;
    std::vector<uint32_t> kinematic_;
    ParticleLayout layout_;
    std::vector<DistanceBatches> bends_, edges_;
    std::vector<HingeBatches> hinges_;
    std::vector<uint32_t> tether_anchors_;
    std::vector<float> tether_lengths_;
    std::vector<std::vector<BallRun>> backstop_runs_, limit_runs_;
    TriangleFans fans_;
};

/// The shape a fabric is cut to: positions at rest, triangles, uvs (v runs along the warp; empty: Y is the
/// warp), and which vertices are simulated.
struct FabricShape {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;
    std::span<const Vec2> uvs;
    std::span<const uint8_t> simulated;
    float horizontal_scale = 1.0f;  // of the rest lengths' X and Z: the size of the garment over the shape's
    // One a corner of a triangle, or empty: the triangles as they were cut from flat cloth, metres, y along
    // the warp. Then lengths are theirs, not those between positions; where two that are sewn together
    // differ, the mean.
    std::span<const Vec2> cut = {};
};

/// Constraints and masses of that material on that shape. Only edges with a simulated end become constraints.
FabricData cook_fabric(const FabricShape& shape, const FabricMaterial& material);

/// A tether from each free vertex that is connected to a fixed one (inverse mass 0), as long as the
/// shortest path along the edges.
std::vector<Tether> cook_tethers(std::span<const float> inverse_mass,
                                 std::span<const DistanceConstraint> edges);

}  // namespace vfit
