// A checked body mesh, ready to be cut: which triangles are trunk, where the limbs' axes run.
#pragma once

#include <vector>

#include "anthropometry/tape.h"
#include "geometry/section.h"
#include "geometry/triangle_layers.h"

namespace vfit {

/// A tape is 20 mm wide: with its edge in the armpit or the crotch its middle lies this much lower.
inline constexpr float kTapeHalfWidth_m = 0.01f;

struct Axis {
    Vec3 start, end;

    Vec3 direction() const { return glm::normalize(end - start); }
    Vec3 at(float share) const { return glm::mix(start, end, share); }
    /// Where the line passes that height.
    Vec3 at_height(float y) const { return at((y - start.y) / (end.y - start.y)); }
};

enum class Side { kLeft, kRight };

/// VFIT_ERROR_DATA where the mesh is broken, lacks a joint that a landmark needs, or has two of them in one
/// place.
void check(const TapeBody& body);

struct HeightRange {
    float floor, crown;
};
HeightRange height_range(std::span<const Vec3> positions);

/// Of a checked body.
Axis upper_arm(const TapeBody& body, Side side);

class TapeMesh {
public:
    /// Checks the body. What its spans view must outlive it.
    explicit TapeMesh(const TapeBody& body);

    const TapeBody& body() const { return body_; }
    const Vec3& joint(int id) const { return body_.joints.at(id); }
    Axis upper_arm(Side side) const { return vfit::upper_arm(body_, side); }
    Axis thigh(Side side) const;
    /// Through pelvis and neck, straight: inside the trunk at every height between.
    Axis spine() const;

    float floor() const { return range_.floor; }
    float crown() const { return range_.crown; }

    /// Horizontal section of the whole body.
    Section level(float y) const;
    /// Horizontal section of the body without its arms: triangles carried mostly by upper arm, forearm and
    /// hand are left out.
    Section trunk(float y) const;
    /// Section of the whole body by the plane x = constant.
    Section profile(float x) const;

private:
    TapeBody body_;
    HeightRange range_;
    TriangleLayers whole_, trunk_;
};

/// Sections of the whole body square to a limb's axis, or the neck's.
class TapeLimb {
public:
    /// From that many metres along the axis to so many. What the body's spans view must outlive it.
    TapeLimb(const TapeBody& body, const Axis& axis, float from_m, float to_m);

    const Axis& axis() const { return axis_; }
    const Vec3& direction() const { return direction_; }
    Vec3 place(float along_m) const { return axis_.start + along_m * direction_; }
    /// Between the two ends alone: beyond them triangles are missing.
    Section across(float along_m) const;

private:
    std::span<const Vec3> positions_;
    Axis axis_;
    Vec3 direction_;
    TriangleLayers layers_;
};

/// The smallest loop about the place; null where none encloses it.
const std::vector<Vec2>* loop_about(const Section& section, const Vec3& place);

/// The place between low and high where the function is largest: a scan of even steps, then the best step's
/// surroundings again, down to half a millimetre.
template <typename Function>
float place_of_largest(float low, float high, const Function& value) {
    constexpr int kSteps = 12;
    constexpr float kFine_m = 0.0005f;  // a fifth of the tape's own reading error
    for (;;) {
        const float step = (high - low) / kSteps;
        float best = low, best_value = value(low);
        for (int i = 1; i <= kSteps; ++i) {
            const float at = low + step * static_cast<float>(i), here = value(at);
            if (here > best_value) best = at, best_value = here;
        }
        // Far from the origin floats may lie further apart than that.
        if (!(step > kFine_m && low + step > low)) return best;
        low = best - step < low ? low : best - step;
        high = best + step > high ? high : best + step;
    }
}

/// The border between low, where the condition holds, and high, where it does not, to a tenth of a
/// millimetre.
template <typename Condition>
float border(float low, float high, const Condition& holds) {
    constexpr float kFine_m = 0.0001f;
    while (std::abs(high - low) > kFine_m) {
        const float middle = 0.5f * (low + high);
        if (middle == low || middle == high) break;  // no float lies between
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace vfit
