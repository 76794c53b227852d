// How a garment sits: by zones of the body, a girth of the body against the garment's own; and place by
// place.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cloth/garment/garment.h"
#include "math/types.h"
#include "measure/mesh_query.h"

namespace vfit {

/// Where a girth is taken on a body at rest, and how long it is.
struct GirthLevel {
    std::string key;        // of measure_keys.h
    float height_m = 0.0f;  // on the body at rest
    float body_m = 0.0f;
    float axis_z_m = 0.0f;  // middle of the body there
};

/// A garment on a body at rest; one a vertex but where it says otherwise.
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

/// Of those levels that the garment goes around. Sleeves are left out.
std::vector<GirthFit> fit_of(const UnposedGarment& garment, std::span<const GirthLevel> levels);

enum class Fit { right, tight, loose };
/// By the girths that sizes are made for: within the half of the way to the next smaller and the next larger
/// one. label empty, or a garment that tells of no such girth: by stretch and ease.
Fit judge_fit(const Garment& garment, const std::string& label, const GirthFit& fit);

/// The most strain, over the levels at which the garment is closed, with which it would go around the body;
/// 0: it does without. `at`: where.
float needed_strain(std::span<const GirthFit> fits, const GirthFit** at);

/// A neck, an armhole, a skirt's hem: as long as it is cut, and stretched so much.
struct Opening {
    float garment_m = 0.0f, strain = 0.0f;
    Vec3 middle{0.0f};
};
/// So much gives cloth of little stretch at an opening, which runs across its threads for most of its way.
inline constexpr float kOpeningGives = 0.15f;
/// The one that is stretched most, as the garment is worn; what is skinned does not count, nor what slides
/// along a limb. counts: flags, one a vertex.
Opening tightest_opening(const UnposedGarment& garment, std::span<const uint8_t> counts);

/// Of trousers and overalls: from the upper border in front to that behind, between the legs, as long as it
/// is cut; how much it is stretched. 0: the garment has no such line.
struct CrotchLine {
    float garment_m = 0.0f, strain = 0.0f;
};
/// Stretched by more, trousers that are too short in their rise cut into the body instead of being worn.
inline constexpr float kCrotchGives = 0.08f;
/// garment: on the body at rest, whose middle is x = 0. now: where its vertices are, in any pose.
CrotchLine crotch_line(const UnposedGarment& garment, std::span<const Vec3> now);

/// A tenth of the cloth is stretched by more, in the mean about its vertices.
float most_strained(std::span<const float> strain);
/// More than so many times what its fabric gives, the cloth is drawn rather than worn.
inline constexpr float kDrawn = 2.5f;

/// One a vertex, from -1 to 1: above 0 tight, the share of `most_strain` or of 2 kPa, whichever is more;
/// below 0 loose, the way to the skin over 6 cm.
std::vector<float> tightness_of(const UnposedGarment& garment, std::span<const float> strain,
                                float most_strain, const MeshQuery& skin);

}  // namespace vfit
