#include "room_scene.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vfit::testing {

namespace {

/// A figure and a sphere around it, outside of which no ray need look for it.
struct Shown {
    const std::vector<Capsule>* figure;
    uint8_t who;
    Vec3 centre{0.0f};
    float radius = 0.0f;
    Shown(const std::vector<Capsule>& capsules, uint8_t number) : figure(&capsules), who(number) {
        for (const Capsule& c : capsules) centre += (c.a + c.b) / (2.0f * float(capsules.size()));
        for (const Capsule& c : capsules)
            for (const Vec3& end : {c.a, c.b})
                radius = std::max(radius, glm::distance(centre, end) + c.radius);
    }
    bool near(const Vec3& eye, const Vec3& ray) const {
        const Vec3 to = centre - eye;
        const float along = glm::dot(to, ray);
        return glm::dot(to, to) - along * along / glm::dot(ray, ray) < radius * radius;
    }
};

float meet(const Vec3& eye, const Vec3& ray, const Block& b) {
    float near = 0.0f, far = 1e9f;
    for (int k = 0; k < 3; ++k) {
        const float one = (b.low[k] - eye[k]) / ray[k], two = (b.high[k] - eye[k]) / ray[k];
        near = std::max(near, std::min(one, two));
        far = std::min(far, std::max(one, two));
    }
    return near < far ? near : -1.0f;
}

float meet_sphere(const Vec3& eye, const Vec3& ray, const Vec3& centre, float radius) {
    const Vec3 o = eye - centre;
    const float a = glm::dot(ray, ray), b = glm::dot(ray, o), c = glm::dot(o, o) - radius * radius;
    const float root = b * b - a * c;
    return root < 0 ? -1.0f : (-b - std::sqrt(root)) / a;
}

float meet(const Vec3& eye, const Vec3& ray, const Capsule& c) {
    const Vec3 axis = c.b - c.a, o = eye - c.a;
    const float aa = glm::dot(axis, axis), ar = glm::dot(axis, ray), ao = glm::dot(axis, o);
    const float rr = glm::dot(ray, ray), ro = glm::dot(ray, o), oo = glm::dot(o, o);
    const float p = aa * rr - ar * ar, q = aa * ro - ao * ar,
                s = aa * oo - ao * ao - c.radius * c.radius * aa;
    const float root = q * q - p * s;
    if (root < 0) return -1.0f;
    const float t = (-q - std::sqrt(root)) / p, along = ao + t * ar;
    if (along > 0 && along < aa) return t;
    return meet_sphere(eye, ray, along <= 0 ? c.a : c.b, c.radius);
}

}  // namespace

void RoomScene::render(uint32_t seed) {
    depth.assign(size_t(camera.width) * camera.height, 0);
    truth.assign(depth.size(), 0);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    const Mat3 turn(camera.world_from_camera());
    const Vec3 eye(0, camera.floor_distance_m, 0);
    std::vector<Shown> shown;
    for (const auto& dummy : dummies) shown.emplace_back(dummy, uint8_t(0));
    for (size_t i = 0; i < people.size(); ++i) shown.emplace_back(people[i], uint8_t(i + 1));
    for (uint32_t v = 0; v < camera.height; ++v)
        for (uint32_t u = 0; u < camera.width; ++u) {
            const Vec3 ray = turn * camera.unproject(float(u), float(v), 1.0f);
            float z = 1e9f;
            uint8_t who = 0;
            const auto hit = [&](float at, uint8_t person) {
                if (at > 0.1f && at < z) z = at, who = person;
            };
            if (floor && ray.y < 0) hit(-eye.y / ray.y, 0);
            if (wall_z < 0 && ray.z < 0) hit(wall_z / ray.z, 0);
            if (side_x > 0 && ray.x > 0) hit(side_x / ray.x, 0);
            for (const Block& b : things) hit(meet(eye, ray, b), 0);
            for (const Shown& f : shown)
                if (f.near(eye, ray))
                    for (const Capsule& c : *f.figure) hit(meet(eye, ray, c), f.who);
            if (z > 6.0f) continue;
            if (noise) {
                z += normal(random) * (0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f));
                constexpr float kStep = 2.85e-3f;  // of 1 / z, 1/m
                z = 1.0f / (std::round(1.0f / z / kStep) * kStep);
            }
            const size_t i = size_t(v) * camera.width + u;
            depth[i] = uint16_t(std::lround(z / camera.depth_unit_m));
            truth[i] = who;
        }
}

}  // namespace vfit::testing
