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

}  // namespace

void VirtualRoom::render(const Camera& camera, bool time_of_flight, std::mt19937& random,
                         std::vector<float>& depth_m) const {
    depth_m.assign(size_t(camera.width) * camera.height, 0.0f);
    if (empty) return;
    std::normal_distribution<float> noise;
    std::uniform_real_distribution<float> chance;
    const Mat3 world(camera.world_from_camera());
    const Vec3 from(0.0f, camera.floor_distance_m, 0.0f);
    for (uint32_t y = 0; y < camera.height; ++y)
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
            float z = hit.t;
            if (z > kRange_m || hit.cosine < kGrazing) continue;
            z += noise(random) * (time_of_flight ? 0.0015f + 0.0003f * z * z  // Fankhauser et al. 2015
                                                 : 0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f));
            if (!time_of_flight) {  // steps of disparity: Khoshelham and Elberink 2012
                const float step = 2.85e-3f;
                z = 1.0f / (std::round(1.0f / z / step) * step);
            }
            depth_m[size_t(y) * camera.width + x] = z;
        }
}

}  // namespace vfit::tools
