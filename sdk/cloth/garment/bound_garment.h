// A garment bound to the body it was authored on: the place of the skin below each vertex, and the bones that
// carry it. The same for all avatars of one topology.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/garment/carried.h"
#include "cloth/garment/garment.h"
#include "core/jobs.h"
#include "geometry/mesh_query.h"
#include "math/types.h"

namespace vfit {

/// A body in its rest pose; all spans are one a vertex but indices.
struct BoundBody {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const SkinBones> skin_bones;
    std::span<const SkinWeights> skin_weights;  // sum 1
    std::span<const BodyPart> parts;  // empty: all vertices may carry the garment; else none of the arms

    /// The triangles that may carry a garment: without arms, or, for sleeves, without hands.
    std::vector<uint32_t> bindable_triangles(bool with_arms) const;
    size_t bone_count() const;
};

/// A place on the body's surface: three corners and their weights.
struct Binding {
    uint32_t corner[3];
    float weight[3];

    static Binding of(const MeshQuery::Closest& closest, std::span<const uint32_t> triangles);
    Vec3 on(std::span<const Vec3> body) const {
        return weight[0] * body[corner[0]] + weight[1] * body[corner[1]] + weight[2] * body[corner[2]];
    }
    /// Weight of each bone there.
    void add_bones(const BoundBody& body, std::span<float> bones) const;
};

/// Hanging cloth is bound to whichever leg is nearer; between them it must not tear. Evens the rows of
/// simulated vertices out over their neighbours, the more the further they hang from the skin; the skinned
/// ones keep theirs.
class HangingSmoother {
public:
    HangingSmoother(const Garment& garment, std::span<const float> skin_distances);

    template <size_t kColumns>
    void smooth(std::vector<std::array<float, kColumns>>& rows) const {
        // Spreads over about 10 vertices, the gap between the legs, with steps that go beyond the mean
        // (successive over-relaxation).
        constexpr int kRounds = 28;
        constexpr float kBeyond = 1.7f;
        const std::vector<std::array<float, kColumns>> own = rows;
        for (int round = 0; round < kRounds; ++round)
            for (const Vertex& v : hanging_) {
                std::array<float, kColumns> sum{};
                for (uint32_t at = v.first; at < v.end; ++at)
                    for (size_t k = 0; k < kColumns; ++k) sum[k] += rows[neighbours_[at]][k];
                std::array<float, kColumns>& row = rows[v.vertex];
                for (size_t k = 0; k < kColumns; ++k)
                    row[k] += kBeyond * (v.kept * own[v.vertex][k] + v.share * sum[k] - row[k]);
            }
    }

private:
    struct Vertex {
        uint32_t vertex, first, end;  // and its neighbours
        float kept, share;            // of its own row, and of each neighbour's
    };
    std::vector<Vertex> hanging_;
    std::vector<uint32_t> neighbours_;
};

/// One a garment vertex.
struct BoundGarment {
    /// body: the one that the garment was authored on.
    BoundGarment(const Garment& garment, const BoundBody& body, Jobs* jobs = nullptr);

    size_t body_vertices;
    std::vector<Binding> bindings;
    std::vector<BodyPart> parts_below;
    std::optional<HangingSmoother> smoother;
    Carried skin_below;  // places on the authored body; their bones are evened out over what hangs
};

}  // namespace vfit
