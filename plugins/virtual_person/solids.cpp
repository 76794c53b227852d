#include "solids.h"

#include <algorithm>
#include <cmath>

namespace vfit::virtual_person {

namespace {

constexpr float kNearestCorner_m =
    0.05f;  // a corner nearer than this cannot be projected: the whole image is tried

struct Hit {
    float depth = 0.0f;  // 0: none
    Vec3 normal{0.0f};   // in the solid's own unit space
};

// Both work in the space where the solid is the unit cube or the unit sphere; the ray's parameter stays the
// depth.
Hit meet_box(const Vec3& o, const Vec3& d) {
    float in = 0.0f, out = 1e9f;
    int axis = -1;
    for (int k = 0; k < 3; ++k) {
        if (d[k] == 0.0f) {
            if (std::abs(o[k]) > 1.0f) return {};
            continue;
        }
        const float a = (-1.0f - o[k]) / d[k], b = (1.0f - o[k]) / d[k];
        if (std::min(a, b) > in) in = std::min(a, b), axis = k;
        out = std::min(out, std::max(a, b));
    }
    if (axis < 0 || in > out) return {};
    Hit hit{in, Vec3(0.0f)};
    hit.normal[axis] = 1.0f;
    return hit;
}

Hit meet_sphere(const Vec3& o, const Vec3& d) {
    const float a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0f, root = b * b - a * c;
    if (root <= 0.0f || c <= 0.0f) return {};
    const float t = (-b - std::sqrt(root)) / a;
    return t > 0.0f ? Hit{t, o + t * d} : Hit{};
}

}  // namespace

Solid placed(const Solid& solid, float yaw_deg, const Vec3& by) {
    const Mat3 turn = glm::mat3_cast(rotate_y(yaw_deg));
    return {solid.shape, turn * solid.centre + by, turn * solid.axes};
}

SolidPainter::SolidPainter(const SensorModel& model, const Mat3& world_from_camera, float camera_height_m)
    : model_(model), rotation_(world_from_camera), eye_(0, camera_height_m, 0) {}

SolidPainter::Window SolidPainter::window_of(const Solid& solid) const {
    const Window all{0, 0, model_.width, model_.height};
    Vec2 low(1e9f), high(-1e9f);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const Vec3 p = glm::transpose(rotation_) * (solid.centre + solid.axes * sign - eye_);
        if (p.z < kNearestCorner_m) return all;
        const Vec2 pixel(p.x / p.z * model_.fx + model_.cx, p.y / p.z * model_.fy + model_.cy);
        low = glm::min(low, pixel), high = glm::max(high, pixel);
    }
    const auto clamped = [](float v, uint32_t most) {
        return static_cast<uint32_t>(std::clamp(v, 0.0f, static_cast<float>(most)));
    };
    return {clamped(std::floor(low.x), model_.width), clamped(std::floor(low.y), model_.height),
            clamped(std::ceil(high.x) + 1.0f, model_.width),
            clamped(std::ceil(high.y) + 1.0f, model_.height)};
}

void SolidPainter::paint(const Solid& solid, CleanImage& image) const {
    const Mat3 to_unit = glm::inverse(solid.axes), turn = to_unit * rotation_;
    const Vec3 o = to_unit * (eye_ - solid.centre);
    const Window w = window_of(solid);
    for (uint32_t y = w.y0; y < w.y1; ++y)
        for (uint32_t x = w.x0; x < w.x1; ++x) {
            const Vec3 ray((static_cast<float>(x) - model_.cx) / model_.fx,
                           (static_cast<float>(y) - model_.cy) / model_.fy, 1.0f);
            const Vec3 d = turn * ray;
            const Hit hit = solid.shape == Solid::Shape::kBox ? meet_box(o, d) : meet_sphere(o, d);
            const size_t i = size_t{y} * model_.width + x;
            if (hit.depth <= 0.0f || (image.depth_m[i] > 0.0f && image.depth_m[i] <= hit.depth)) continue;
            // A gradient goes by the transposed inverse.
            const Vec3 normal = glm::transpose(to_unit) * hit.normal;
            image.depth_m[i] = hit.depth;
            image.cosine[i] =
                std::abs(glm::dot(normal, rotation_ * ray)) / (glm::length(normal) * glm::length(ray));
            image.user[i] = 0;
        }
}

void SolidPainter::paint(std::span<const Solid> solids, CleanImage& image) const {
    for (const Solid& solid : solids) paint(solid, image);
}

}  // namespace vfit::virtual_person
