#include "cook/body/body_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "geometry/section.h"

namespace vfit {

namespace {

EvaluatedBody default_body(const BodyModel& model, vfit_sex sex) {
    EvaluatedBody body;
    model.evaluate(model.default_shape(sex), body);
    return body;
}

std::vector<uint32_t> trunk_and_legs(const BodyTopology& topology) {
    std::vector<uint32_t> kept;
    const auto covered = [&](uint32_t v) {
        const BodyPart part = topology.parts[v];
        return part == BodyPart::kTorso || part >= BodyPart::kLeftThigh;
    };
    for (size_t i = 0; i < topology.indices.size(); i += 3) {
        const uint32_t* v = &topology.indices[i];
        if (covered(v[0]) && covered(v[1]) && covered(v[2])) kept.insert(kept.end(), v, v + 3);
    }
    return kept;
}

Vec2 direction(uint32_t angle) {
    const float a = 2.0f * kPi * float(angle) / float(Outline::kAngles);
    return {std::sin(a), std::cos(a)};
}

float cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Points evenly spread over the open or closed line, by length.
template <typename Point>
std::vector<Point> spread_evenly(const std::vector<Point>& line, uint32_t count, float first, float step) {
    std::vector<Point> out;
    size_t i = 0;
    float begin = 0.0f;
    for (uint32_t k = 0; k < count; ++k) {
        const float wanted = first + step * float(k);
        float length = glm::length(line[i + 1] - line[i]);
        while (begin + length < wanted && i + 2 < line.size()) {
            begin += length;
            ++i;
            length = glm::length(line[i + 1] - line[i]);
        }
        out.push_back(glm::mix(line[i], line[i + 1], length > 0.0f ? (wanted - begin) / length : 0.0f));
    }
    return out;
}

}  // namespace

void Outline::grow(float by) {
    for (float& r : radius) r += by;
}

void Outline::cover(const Outline& other) {
    for (uint32_t i = 0; i < kAngles; ++i) radius[i] = std::max(radius[i], other.radius[i]);
}

float Outline::perimeter() const {
    float length = 0.0f;
    for (uint32_t i = 0; i < kAngles; ++i) {
        const uint32_t j = (i + 1) % kAngles;
        length += glm::length(direction(i) * radius[i] - direction(j) * radius[j]);
    }
    return length;
}

std::vector<Vec2> Outline::spread(uint32_t count) const {
    std::vector<Vec2> line;
    for (uint32_t i = 0; i <= kAngles; ++i) line.push_back(direction(i) * radius[i % kAngles]);
    return spread_evenly(line, count, 0.0f, perimeter() / float(count));
}

Outline Outline::mix(const Outline& a, const Outline& b, float t) {
    Outline out;
    for (uint32_t i = 0; i < kAngles; ++i) out.radius[i] = a.radius[i] + (b.radius[i] - a.radius[i]) * t;
    return out;
}

BodyOutline::BodyOutline(const BodyModel& model, vfit_sex sex)
    : BodyOutline(model, default_body(model, sex)) {}

BodyOutline::BodyOutline(const BodyModel& model, EvaluatedBody body)
    : body_(std::move(body)),
      trunk_indices_(trunk_and_legs(model.topology(0))),
      skin_(body_.positions, model.topology(0).indices) {
    const auto joint = [&](int bone) { return body_.bone_heads[size_t(model.rig_bone(bone))]; };
    left_shoulder_ = joint(VFIT_BONE_LEFT_UPPER_ARM);
    levels_.shoulder = left_shoulder_.y;
    levels_.knee = joint(VFIT_BONE_LEFT_LOWER_LEG).y;
    levels_.ankle = joint(VFIT_BONE_LEFT_FOOT).y;
    const float hips = joint(VFIT_BONE_LEFT_UPPER_LEG).y, chest = joint(VFIT_BONE_UPPER_CHEST).y;
    // Bust: where the front stands out most; waist: the smallest girth; hip: the largest.
    levels_.bust =
        find(joint(VFIT_BONE_CHEST).y, glm::mix(chest, levels_.shoulder, 0.7f), true, &BodyOutline::front);
    levels_.waist = find(hips, levels_.bust, false, &BodyOutline::girth);
    levels_.hip = find(hips - 0.25f * (levels_.waist - hips), levels_.waist, true, &BodyOutline::girth);
    // The middle of the thinnest section lies well inside the others.
    const Extent waist = extent(points_at(levels_.waist));
    axis_z_ = 0.5f * (waist.minimum.y + waist.maximum.y);
}

std::optional<Vec3> ridge(const MeshQuery& mesh, const Vec3& above, float depth_m) {
    constexpr float kStep_m = 0.01f, kUpright = 0.6f, kFar_m = 8.0f;
    std::optional<Vec3> out;
    for (float z = -depth_m; z <= depth_m; z += kStep_m) {
        const Vec3 from = above + Vec3(0.0f, 0.0f, z);
        const auto hit = mesh.cast(from, {0, -1, 0}, kFar_m);
        if (!hit || std::abs(hit->normal.y) < kUpright) continue;
        if (const float y = from.y - hit->distance; !out || y > out->y) out = Vec3(from.x, y, from.z);
    }
    return out;
}

std::optional<Vec3> BodyOutline::shoulder_ridge(float x) const {
    constexpr float kNear_m = 0.08f, kBelowChin_m = 0.1f;
    return ridge(skin_, {x, left_shoulder_.y + kBelowChin_m, left_shoulder_.z}, kNear_m);
}

std::vector<Vec2> BodyOutline::points_at(float y) const {
    const Section section = cut(body_.positions, trunk_indices_, Vec3(0, y, axis_z_), Vec3(0, 1, 0));
    std::vector<Vec2> points;
    for (const Vec2& p : section.points()) {
        const Vec3 place = section.lift(p);
        for (const float side : {1.0f, -1.0f}) points.emplace_back(side * place.x, place.z - axis_z_);
    }
    if (points.size() < 6) fail(VFIT_ERROR_DATA, "the body has no section at ", y, " m");
    return points;
}

Outline BodyOutline::at(float y) const {
    const std::vector<Vec2> hull = convex_hull(points_at(y));
    Outline out;
    for (uint32_t i = 0; i < Outline::kAngles; ++i) {
        const Vec2 d = direction(i);
        for (size_t k = 0; k < hull.size(); ++k) {
            const Vec2 &a = hull[k], side = hull[(k + 1) % hull.size()] - a;
            const float denominator = cross(d, side);
            if (std::abs(denominator) < 1e-12f) continue;
            const float along = cross(a, d) / denominator, distance = cross(a, side) / denominator;
            if (along >= -1e-5f && along <= 1.00001f) out.radius[i] = std::max(out.radius[i], distance);
        }
        if (!(out.radius[i] > 0.0f)) fail(VFIT_ERROR_DATA, "the body's section at ", y, " m misses its axis");
    }
    return out;
}

float BodyOutline::girth(float y) const { return hull_perimeter(points_at(y)); }
float BodyOutline::front(float y) const { return extent(points_at(y)).maximum.y; }

float BodyOutline::find(float low, float high, bool largest, float (BodyOutline::*value)(float) const) const {
    constexpr float kStep_m = 0.0025f;  // far below what a hand can mark on a body
    const float sign = largest ? 1.0f : -1.0f;
    float best = low, best_value = sign * (this->*value)(low);
    for (float y = low; y <= high; y += kStep_m)
        if (const float v = sign * (this->*value)(y); v > best_value) best = y, best_value = v;
    return best;
}

std::vector<Vec3> BodyOutline::over_shoulder(const Vec3& front, const Vec3& back, uint32_t count,
                                             float ease_m) const {
    const Vec3 up(0, 1, 0);
    const Vec3 across = glm::normalize(glm::cross(back - front, up));
    const Vec3 along = glm::normalize(glm::cross(up, across));  // from front to back
    const Section section = cut(body_.positions, trunk_indices_, front, across);
    std::vector<Vec2> points;
    const auto flat = [&](const Vec3& p) { return Vec2(glm::dot(p - front, along), p.y - front.y); };
    for (const Vec2& p : section.points()) {
        const Vec2 q = flat(section.lift(p));
        const Vec2 end = flat(back);
        if (cross(end, q) > 0.0f && q.x > 0.0f && q.x < end.x)
            points.push_back(q);  // above the line between both
    }
    if (points.empty()) fail(VFIT_ERROR_DATA, "the strap meets no shoulder");
    // The ease goes on before the hull is taken: a string tightened over the thickened shoulder.
    for (Vec2& p : points) p.y += ease_m;
    points.push_back(Vec2(0.0f));
    points.push_back(flat(back));
    std::vector<Vec2> hull = convex_hull(points);
    // Counter-clockwise from the back's end: over the shoulder to the front.
    const auto at_back = std::min_element(hull.begin(), hull.end(), [&](const Vec2& a, const Vec2& b) {
        return glm::length(a - flat(back)) < glm::length(b - flat(back));
    });
    std::rotate(hull.begin(), at_back, hull.end());
    std::reverse(hull.begin(), hull.end());
    float length = 0.0f;
    for (size_t i = 0; i + 1 < hull.size(); ++i) length += glm::length(hull[i + 1] - hull[i]);
    const float step = length / float(count + 1);
    std::vector<Vec3> out;
    for (const Vec2& p : spread_evenly(hull, count, step, step))
        out.push_back(front + along * p.x + up * p.y);
    return out;
}

}  // namespace vfit
