// Skin that gives way to the cloth over it, as flesh does.
//
// Contact keeps the vertices of cloth off the body. Where skin is folded, as in an armpit, or bends more
// sharply than a triangle of cloth, it stands between these vertices, some millimetres beyond the cloth. Here
// the skin moves instead: each vertex of a triangle of skin that crosses a triangle of cloth goes inwards
// along its normal until it is below the plane of that one. This is repeated until no triangles cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/triangles_about.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/crossings.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

/// A posed garment. groups: of that mesh, moved there.
struct PressingCloth {
    MeshView mesh;
    TriangleGroups* groups;
};

class SkinPress {
public:
    /// Of a closed surface at rest, three indices a triangle.
    SkinPress(std::span<const Vec3> rest, std::span<const uint32_t> indices);

    struct Result {
        uint32_t pressed;     // vertices
        float deepest_m;      // of these
        uint32_t left_pairs;  // of triangles that still cross
    };
    /// Moves positions, world space. normals: unit, outwards. A patch of skin that would have to give way by
    /// more than 2 cm, as that of an arm that goes through the cloth, stays where it was. The same for any
    /// number of threads. Does not allocate once it has met its largest number of crossings.
    Result press(std::span<const PressingCloth> cloths, std::span<const Vec3> normals,
                 std::span<Vec3> positions, Jobs& jobs);

private:
    struct Crossing {
        uint32_t cloth, of_cloth, of_skin;  // triangles of these
    };
    void find_all(std::span<const PressingCloth> cloths, std::span<const Vec3> positions, Jobs& jobs);
    void find_of_moved(std::span<const PressingCloth> cloths, std::span<const Vec3> positions);
    void ask(const MeshView& cloth, const Crossing& crossing, std::span<const Vec3> normals,
             std::span<const Vec3> positions);
    bool move_asked(std::span<const Vec3> normals, std::span<Vec3> positions);
    void undo_patches(std::span<const Vec3> normals, std::span<Vec3> positions);

    const std::vector<uint32_t> indices_;
    const TrianglesAbout about_;
    TriangleGroups groups_;
    std::vector<float> depth_m_, ask_m_;  // of vertices: so far; in this round
    std::vector<uint32_t> pressed_, asked_, moved_, patch_, near_, found_;
    std::vector<TrianglePair> pairs_;
    std::vector<Crossing> crossings_;
    std::vector<uint8_t> is_looked_at_;  // triangles, in this round
};

}  // namespace vfit
