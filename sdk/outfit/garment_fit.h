// The garment fit: girths of the body against those of the garment, and tightness vertex by vertex.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cloth/garment/garment.h"
#include "geometry/mesh_query.h"
#include "math/types.h"

namespace vfit {

/// Where a girth is taken on a body at rest, and how long it is.
struct GirthLevel {
    std::string key;        // of measure_keys.h
    float height_m = 0.0f;  // on the body at rest
    float body_m = 0.0f;
    float axis_z_m = 0.0f;  // middle of the body there
};

/// A garment on a body at rest; one value a vertex unless it says otherwise.
struct UnposedGarment {
    std::span<const Vec3> positions;    // with the pose taken out
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const Vec2> cut;          // one an index: the triangles as they are cut from flat cloth, metres
    std::span<const uint8_t> on_arm;    // may be empty
    std::span<const float> pressure_pa;  // may be empty
};

struct GirthFit {
    std::string key;
    float body_m = 0.0f;
    float garment_m = 0.0f;    // of the cloth around the body at that level, unstretched
    float ease_m = 0.0f;       // garment less body
    float strain = 0.0f;       // of that cloth as it is worn, along the girth
    float pressure_pa = 0.0f;  // mean of what is within 2 cm of the level; 0: not known
    float opening_m =
        0.0f;  // across the front of a coat that is open there, beside garment_m; 0: it is closed
};

/// One for each level that the garment goes around, without sleeves.
std::vector<GirthFit> fit_of(const UnposedGarment& garment, std::span<const GirthLevel> levels);

enum class Fit { right, tight, loose };
/// Tight: the body's girth is nearer to that of the next larger size and less than 5 cm of ease are left, or
/// it presses; loose: nearer to that of the next smaller size, with more ease. For an empty label, and a
/// garment without nominal girths: by strain and ease.
Fit judge_fit(const Garment& garment, const std::string& label, const GirthFit& fit);

/// The maximum, over the levels at which the garment is closed, of the strain with which it goes around the
/// body; 0: it goes around without strain. `at`: where.
float needed_strain(std::span<const GirthFit> fits, const GirthFit** at);

/// A neck, an armhole, a hem of a skirt: its length as it is cut, and its strain.
struct Opening {
    float garment_m = 0.0f, strain = 0.0f;
    Vec3 middle{0.0f};
};
/// Woven cloth gives this strain at an opening, which runs across its yarns for most of its length.
inline constexpr float kOpeningGives = 0.15f;
/// The opening of maximum strain, as the garment is worn. counts: flags, one a vertex; edges without a
/// counted vertex, such as pinned ones and those that slide along a limb, are left out.
Opening tightest_opening(const UnposedGarment& garment, std::span<const uint8_t> counts);

/// Of trousers and overalls: the line from the upper border in front, between the legs, to that behind: its
/// length as it is cut, and its strain. 0: the garment has no such line.
struct CrotchLine {
    float garment_m = 0.0f, strain = 0.0f;
};
/// With more strain, trousers whose rise is too short cut into the body.
inline constexpr float kCrotchGives = 0.08f;
/// garment: on the body at rest, whose middle is x = 0. now: positions of its vertices, in any pose.
CrotchLine crotch_line(const UnposedGarment& garment, std::span<const Vec3> now);

/// The 90th percentile of the strain at vertices.
float most_strained(std::span<const float> strain);
/// Times the fabric's maximum strain: beyond it, cloth is too small to be worn.
inline constexpr float kDrawn = 2.5f;

/// One value a vertex, from -1 to 1. Above 0 tight: strain as a fraction of `most_strain`, or pressure as a
/// fraction of 2 kPa, whichever is more. Below 0 loose: distance from the skin as a fraction of 6 cm.
std::vector<float> tightness_of(const UnposedGarment& garment, std::span<const float> strain,
                                float most_strain, const MeshQuery& skin);

}  // namespace vfit
