// Creases of the skin, opened: where two parts of the body press into each other, the skin of both gives way
// to the middle between them, with room for cloth.
//
// One rule for all pairs of parts. Each part P has a signed distance f_P (bone_fields.h), and between P and Q
// lies the middle surface f_Q - f_P = 0. A vertex of P moves along the gradient of f_Q - f_P until that is at
// least the room, a vertex of Q until f_P - f_Q is. As f_Q - f_P has one value at each place, no vertex of P
// can then be where one of Q is. Towards the line where P and Q are one surface, as arm and trunk are, the
// room and the depth fade to zero with the way along the skin.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "avatar/bone_fields.h"
#include "avatar/skin.h"

namespace vfit {

class Creases {
public:
    /// Opens nothing.
    Creases() = default;
    /// `rest`, `bones` and `weights` are of the topology's render vertices.
    Creases(const AvatarRig& rig, const BodyTopology& topology, std::span<const Vec3> rest,
            std::span<const SkinBones> bones, std::span<const SkinWeights> weights);

    /// Vertices that are moved together: a mesh, or part of one.
    class Mesh {
        friend class Creases;
        struct Vertex {
            uint32_t number;
            uint8_t part, field;
            struct Own {
                uint8_t part;
                float weight;
            };
            struct Neighbour {
                uint8_t part;  // that it is one surface with, or close to at rest
                float room_m;
                float max_depth_m;  // that the vertex gives way to it
            };
            std::array<Own, 3> own;  // parts that carry it
            std::array<Neighbour, 3> near_parts;
        };
        struct Cluster {
            uint32_t first, count;  // of the vertices
            uint8_t field;
            uint32_t middle;  // vertex number
            float radius_m;
        };
        /// A cell of a field that follows a vertex: where skinning is not rigid.
        struct Loose {
            uint8_t field;
            uint16_t cell;
            uint32_t number;
            float beyond_m, min_m, max_m;  // radius of the cell beyond the vertex'; bounds of it
        };
        std::vector<Vertex> vertices_;  // cluster by cluster
        std::vector<Loose> loose_;
        std::vector<Cluster> clusters_;
    };
    /// Position i of the mesh is that of body vertex `vertices[i]`, at rest `places[i]`.
    Mesh mesh_of(std::span<const uint32_t> vertices, std::span<const Vec3> places) const;

    /// Opens the creases of posed positions. `matrices` are those of the pose, one a rig bone. Does not
    /// allocate.
    void open(std::span<const Mat4> matrices, const Mesh& mesh, std::span<Vec3> positions, Jobs& jobs) const;
    /// The same in the host's memory and axes.
    void open(std::span<const Mat4> matrices, const Mesh& mesh, const SkinTarget& target, const Axes& axes,
              Jobs& jobs) const;

private:
    struct Posed;
    struct FieldRange {
        uint8_t first = 0, end = 0;
    };
    struct Active;
    void measure_ways(const BodyTopology& topology, std::span<const Vec3> rest);
    void pose_fields(std::span<const Mat4> matrices, Posed& out) const;
    PosedField::Sample part_sample(const Posed& posed, size_t part, const Vec3& p) const;
    float part_distance(const Posed& posed, size_t part, const Vec3& p) const;
    template <typename Place>
    void open_places(std::span<const Mat4> matrices, const Mesh& mesh, Place&& place, Jobs& jobs) const;
    Vec3 moved(const Posed& posed, const Mesh::Vertex& vertex, const Active& active, const Vec3& p) const;

    std::vector<BoneField> fields_;
    std::array<FieldRange, kBodyPartCount> fields_of_{};
    std::vector<uint8_t> part_of_, field_of_;  // one a body vertex
    // One a body vertex: how much each part carries of it, and the way there along the skin, in metres.
    std::vector<std::array<float, kBodyPartCount>> carried_, way_to_;
};

}  // namespace vfit
