#include "bench/virtual_room.h"

#include <algorithm>
#include <cmath>

namespace vfit::tools {

namespace {

constexpr float kRange_m = 4.5f, kNothing = 1e9f;
constexpr float kGrazing = 0.1f;  // cosine below which a surface sends back nothing
// Of a shiny floor's pixels: what shows itself, and what shows the mirrored room. The rest is lost.
constexpr float kShowsItself = 0.15f, kShowsMirrored = 0.35f;

struct Hit {
    float t = kNothing, cosine = 1.0f;
    void take(float at, float cos) {
        if (at > 1e-3f && at < t) t = at, cosine = std::abs(cos);
    }
};

void take_box(const VirtualRoom::Box& box, const Vec3& from, const Vec3& ray, Hit& hit) {
    float first = -kNothing, last = kNothing;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
        const float inverse = 1.0f / (std::abs(ray[k]) < 1e-9f ? 1e-9f : ray[k]);
        const float a = (box.low[k] - from[k]) * inverse, b = (box.high[k] - from[k]) * inverse;
        if (std::min(a, b) > first) first = std::min(a, b), axis = k;
        last = std::min(last, std::max(a, b));
    }
    if (first < last) hit.take(first, ray[axis] / glm::length(ray));
}

/// A solid as the camera has it: the way into the space where it is the unit cube or sphere, and the pixels
/// that can show it.
struct Shown {
    bool round;
    Mat3 into, normals;
    Vec3 from;  // the camera
    int x0, y0, x1, y1;
};

Shown shown(const VirtualRoom::Solid& solid, const Camera& camera) {
    Shown s;
    s.round = solid.shape == VirtualRoom::Solid::Shape::kEllipsoid;
    s.into = glm::inverse(solid.half_axes);
    s.normals = glm::transpose(s.into);
    s.from = s.into * (Vec3(0.0f, camera.floor_distance_m, 0.0f) - solid.centre);
    float radius = 0.0f;
    for (int k = 0; k < 3; ++k) radius += glm::dot(solid.half_axes[k], solid.half_axes[k]);
    radius = std::sqrt(radius);
    const Vec3 at = transform_point(camera.camera_from_world(), solid.centre);
    s.x0 = s.y0 = 0, s.x1 = int(camera.width), s.y1 = int(camera.height);
    if (at.z < 2.0f * radius) {  // close to the camera: anywhere
        if (at.z < -radius) s.x1 = 0;
        return s;
    }
    const Vec2 middle = camera.project(at);
    const float reach =
        1.0f + camera.fx * radius / (at.z - radius) * (1.0f + std::abs(at.x) / at.z + std::abs(at.y) / at.z);
    s.x0 = std::max(s.x0, int(middle.x - reach)), s.x1 = std::min(s.x1, int(middle.x + reach) + 1);
    s.y0 = std::max(s.y0, int(middle.y - reach)), s.y1 = std::min(s.y1, int(middle.y + reach) + 1);
    return s;
}

void take(const Shown& solid, const Vec3& ray, Hit& hit) {
    const Vec3 d = solid.into * ray;
    Vec3 normal;
    float at;
    if (solid.round) {
        const float a = glm::dot(d, d), b = glm::dot(solid.from, d),
                    c = glm::dot(solid.from, solid.from) - 1.0f;
        if (b * b < a * c) return;
        at = (-b - std::sqrt(b * b - a * c)) / a;
        normal = solid.from + at * d;
    } else {
        float first = -kNothing, last = kNothing;
        int axis = 0;
        for (int k = 0; k < 3; ++k) {
            const float inverse = 1.0f / (std::abs(d[k]) < 1e-9f ? 1e-9f : d[k]);
            const float one = (-1.0f - solid.from[k]) * inverse, two = (1.0f - solid.from[k]) * inverse;
            if (std::min(one, two) > first) first = std::min(one, two), axis = k;
            last = std::min(last, std::max(one, two));
        }
        if (first >= last) return;
        at = first;
        normal = Vec3(0.0f);
        normal[axis] = 1.0f;
    }
    hit.take(at, glm::dot(glm::normalize(solid.normals * normal), ray) / glm::length(ray));
}

float with_noise(float z, bool time_of_flight, float deviation) {
    z += deviation * (time_of_flight ? 0.0015f + 0.0003f * z * z  // Fankhauser et al. 2015
                                     : 0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f));
    if (time_of_flight) return z;
    const float step = 2.85e-3f;  // of disparity: Khoshelham and Elberink 2012
    return 1.0f / (std::round(1.0f / z / step) * step);
}

}  // namespace

float VirtualRoom::reading(float z, bool time_of_flight, std::mt19937& random) {
    return with_noise(z, time_of_flight, std::normal_distribution<float>()(random));
}

void VirtualRoom::render(const Camera& camera, bool time_of_flight, std::mt19937& random,
                         std::vector<float>& depth_m) const {
    depth_m.assign(size_t(camera.width) * camera.height, 0.0f);
    if (empty) return;
    std::normal_distribution<float> noise;
    std::uniform_real_distribution<float> chance;
    const Mat3 world(camera.world_from_camera());
    const Vec3 from(0.0f, camera.floor_distance_m, 0.0f);
    std::vector<Shown> all, row;
    for (const Solid& solid : solids) all.push_back(shown(solid, camera));
    for (uint32_t y = 0; y < camera.height; ++y) {
        row.clear();
        for (const Shown& s : all)
            if (int(y) >= s.y0 && int(y) < s.y1) row.push_back(s);
        for (uint32_t x = 0; x < camera.width; ++x) {
            const Vec3 ray = world * camera.unproject(float(x), float(y), 1.0f);  // t is the depth
            const float length = glm::length(ray);
            Hit hit;
            for (const Wall& wall : walls) {
                const float along = glm::dot(wall.normal, ray);
                if (along < -1e-6f)
                    hit.take(-(glm::dot(wall.normal, from) + wall.distance_m) / along, along / length);
            }
            for (const Box& box : boxes) take_box(box, from, ray, hit);
            for (const Shown& solid : row)
                if (int(x) >= solid.x0 && int(x) < solid.x1) take(solid, ray, hit);
            if (ray.y < -1e-6f) {
                Hit on_floor;
                on_floor.take(-from.y / ray.y, ray.y / length);
                if (on_floor.t < hit.t) {
                    const float luck = chance(random);
                    if (floor == FloorLook::kBlack) continue;
                    if (floor == FloorLook::kShiny && luck > kShowsItself + kShowsMirrored) continue;
                    // The mirrored walls lie where the ray meets them below the floor.
                    if (floor == FloorLook::kMatt || luck < kShowsItself) hit = on_floor;
                }
            }
            const float z = hit.t;
            if (z > kRange_m || hit.cosine < kGrazing) continue;
            depth_m[size_t(y) * camera.width + x] = with_noise(z, time_of_flight, noise(random));
        }
    }
}

}  // namespace vfit::tools
