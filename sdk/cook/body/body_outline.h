// The outline of a standing body without arms and head, level by level, as a taut tape sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "geometry/mesh_query.h"

namespace vfit {

/// Horizontal outline as distances from an axis, at even angles: 0 is the front (+Z), a quarter the left
/// (+X). Left and right are made equal: garments are cut symmetric.
struct Outline {
    static constexpr uint32_t kAngles = 144;
    std::vector<float> radius = std::vector<float>(kAngles, 0.0f);

    void grow(float by);
    void cover(const Outline& other);  // the larger of both everywhere
    float perimeter() const;
    /// `count` points (x, z, from the axis) evenly spread along the outline, the first in the front.
    std::vector<Vec2> spread(uint32_t count) const;
    static Outline mix(const Outline& a, const Outline& b, float t);
};

/// Heights that a tailor looks for, in metres above the soles.
struct TailorLevels {
    float shoulder, bust, waist, hip, knee, ankle;
};

/// The highest place where the mesh lies flat, seen from above over depth_m to the back and to the front.
std::optional<Vec3> ridge(const MeshQuery& mesh, const Vec3& above, float depth_m);

class BodyOutline {
public:
    /// The model's default body of that sex.
    BodyOutline(const BodyModel& model, vfit_sex sex);
    BodyOutline(const BodyModel& model, EvaluatedBody body);

    const TailorLevels& levels() const { return levels_; }
    float axis_z() const { return axis_z_; }
    const Vec3& left_shoulder() const { return left_shoulder_; }
    const MeshQuery& skin() const { return skin_; }

    /// The top of the shoulder, or of the arm beside it, at that x; nothing beside the body.
    std::optional<Vec3> shoulder_ridge(float x) const;

    /// Convex outline at that height (a tape does not follow hollows).
    Outline at(float y) const;
    /// Outline of the trunk cut by the upright plane through two places, convex, from one over the shoulder
    /// to the other: `count` points evenly spread between them, `ease_m` off the skin.
    std::vector<Vec3> over_shoulder(const Vec3& front, const Vec3& back, uint32_t count, float ease_m) const;

private:
    std::vector<Vec2> points_at(float y) const;
    float find(float low, float high, bool largest, float (BodyOutline::*value)(float) const) const;
    float girth(float y) const;
    float front(float y) const;

    EvaluatedBody body_;
    std::vector<uint32_t> trunk_indices_;
    MeshQuery skin_;
    TailorLevels levels_{};
    Vec3 left_shoulder_{0.0f};
    float axis_z_ = 0.0f;
};

}  // namespace vfit
