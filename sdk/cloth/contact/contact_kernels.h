// The hot loops of contact between triangles, in SIMD with run-time dispatch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/surface_kernels.h"
#include "math/types.h"

namespace vfit {

/// Boxes about patches and the ways of their vertices, eight to a register; and of eight in a row each, level
/// by level, up to one register.
struct MovingBoxes {
    struct Level {
        Boxes boxes, ways;
    };
    std::vector<Level> levels;  // the patches' first

    void resize(size_t count);
    void set(size_t i, const Bounds& box, const Bounds& way) {
        levels[0].boxes.set(i, box.low, box.high), levels[0].ways.set(i, way.low, way.high);
    }
    void find_levels();  // once all patches are set
    Bounds way() const;  // of all
};
/// Ways past each other that are longer are looked at as if they were that long: cloth that is thrown about
/// meets all of itself.
inline constexpr float kMaxWay_m = 0.3f;
/// The same past a solid, before which planes keep the vertices of fast cloth.
inline constexpr float kMaxWayPastSolid_m = 0.004f;

/// Adds the patches from `first` on that come within reach_m of a box, now, on the way from where they were,
/// or on the same way again, of max_way_m at most. Rising.
void find_meeting(const MovingBoxes& patches, uint32_t first, const Bounds& box, const Bounds& way,
                  float reach_m, float max_way_m, std::vector<uint32_t>& out);

/// Boxes about the triangles of a patch; empty where there is none.
struct alignas(32) PatchBoxes {
    float low[3][kLanes], high[3][kLanes];
    float normal[3][kLanes], offset[kLanes];  // the plane of each triangle, of unit length
};
/// A patch over the motion of a step: boxes at its end.
struct PatchShape {
    Bounds box, way;
    Vec3 normal;       // mean, at the end
    float min_cosine;  // of a triangle's normal, at either end, with the mean
};
/// corners: indices of the corners of eight triangles; the last one again where there are fewer (count).
PatchShape find_shape(const uint32_t (&corners)[3][kLanes], uint32_t count, const Particle* begin,
                      const Particle* end, PatchBoxes& boxes);
/// Bit k of entry i: triangle k of b comes within `margin` of triangle i of a.
std::array<uint8_t, kLanes> meeting_triangles(const PatchBoxes& a, const PatchBoxes& b, const Vec3& margin);
/// Clears the bits of those where triangle i of a, by the indices of its corners, lies before the plane of
/// triangle k by more than reach_m and what the two come closer by on the same way again, which is max_way_m
/// at most. past: ways of the corners of a less those of b.
void clear_before_planes(const uint32_t (&corners)[3][kLanes], const Particle* at, const PatchBoxes& b,
                         const Bounds& past, float reach_m, float max_way_m,
                         std::array<uint8_t, kLanes>& meeting);

/// Eight pairs of triangles by the indices of their corners, and what is known of them.
struct alignas(32) TrianglePairs {
    uint32_t first[3][kLanes], second[3][kLanes];
    uint8_t uncertain;  // bit k: no axis separates the two at both ends of their ways: they may have crossed
    uint8_t
        close;  // bit k: no axis keeps the two further apart than reach_m, now or after the same way again
};
/// Looks along four axes: both normals, the way between the middles, and that way within the mean plane. Of
/// two that share a vertex, or two vertices, an axis need only touch; they are never close. certifies: else
/// none is called uncertain, which takes a third less.
void classify(std::span<TrianglePairs> pairs, const Particle* begin, const Particle* end, float reach_m,
              bool certifies);

/// Eight pairs of primitives by the indices of their vertices, and their closest points.
struct alignas(32) PrimitivePairs {
    uint32_t at[4][kLanes];
    float weight[4][kLanes];  // of the closest points: the first minus the second
    float way[3][kLanes];     // from the second to the first
    float distance_m[kLanes];
    float comes_m[kLanes];  // how much closer the two may be after the same way again
};
/// Of a vertex and the triangle of the other three, or of two edges. sideways: share of the way past each
/// other that counts as well, as the direction between the two turns.
void find_closest(std::span<PrimitivePairs> pairs, bool edges, const Particle* begin, const Particle* end,
                  float sideways);

/// Of the largest inverse mass of a contact: less is not taken for how easily its closest points move. Where
/// only vertices with small weights can move, beside fixed ones, they would be thrown far.
inline constexpr float kMinMobility = 0.05f;

/// Eight contacts of a vertex with a triangle, or of two edges: the sum of weights * places, along the
/// normal, is kept at distance_m.
struct alignas(32) ContactBatch {
    uint32_t at[4][kLanes];  // bytes from the first particle
    float inverse_mass[4][kLanes];
    float normal[3][kLanes];
    float distance_m[kLanes];
    float side[kLanes];  // of a vertex above its triangle: 1 on the outside, -1 inside; 0: it is not above it
    // Of refresh_contacts:
    float weight[4][kLanes];
    float gain[4][kLanes];  // how far each of the four moves, of what the distance lacks
};
/// Closest points and normals as particles lie now. The normal of a vertex above its triangle is the
/// triangle's, of two crossed edges the one square to both: the way between the closest points turns with
/// each rounding, and turns round where one goes through the other.
void refresh_contacts(std::span<ContactBatch> contacts, bool edges, const Particle* particles);
struct ContactPush {
    float max_m = 0.0f;  // by which a contact opens in a sub-step
    float friction = 0.0f;
};
/// One batch after the other; what the eight lanes of one do to one particle is added up. starts: places at
/// the begin of the sub-step.
void solve_contacts(std::span<const ContactBatch> contacts, const ContactPush& push, const Particle* starts,
                    Particle* particles);

}  // namespace vfit
