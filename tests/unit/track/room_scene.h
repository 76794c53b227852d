// A room with people of capsules and things of boxes before a pinhole camera, seen ray by ray with the noise
// of a Kinect v1 (Nguyen, Izadi and Lovell 2012; steps: Khoshelham and Elberink 2012): the truth is known by
// construction.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "frame/depth_image.h"

namespace vfit::testing {

struct Capsule {
    Vec3 a, b;
    float radius;
};

struct Block {
    Vec3 low, high;
};

/// World space: the camera stands above the origin and looks along -Z.
struct RoomScene {
    Camera camera;
    bool floor = true;
    float wall_z = -4.0f;  // behind; 0: none
    float side_x = 0.0f;   // wall on the image's right; 0: none
    std::vector<std::vector<Capsule>> people;
    std::vector<std::vector<Capsule>> dummies;  // of a person's shape, and nobody
    std::vector<Block> things;
    bool noise = true;

    std::vector<uint16_t> depth;
    std::vector<uint8_t> truth;  // number of the person from 1, 0: nobody

    RoomScene() {
        camera.width = 320;
        camera.height = 240;
        camera.fx = camera.fy = 290.0f;
        camera.cx = 159.5f;
        camera.cy = 119.5f;
        stand(1.0f, 0.0f, 0.0f);
    }

    void stand(float height_m, float tilt_deg, float roll_deg) {
        set_floor(camera, height_m, tilt_deg * kPi / 180.0f, roll_deg * kPi / 180.0f, VFIT_FLOOR_GIVEN);
    }

    /// The image as a tracker gets it: without user map, and without floor.
    DepthImage bare() const {
        DepthImage image{depth.data(), nullptr, camera};
        image.camera.floor_state = VFIT_FLOOR_DEFAULT;
        image.camera.floor_normal = Vec3(0, -1, 0);
        image.camera.floor_distance_m = 1.0f;
        return image;
    }

    void render(uint32_t seed = 1) {
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

private:
    /// A figure and a sphere around it, outside of which no ray need look for it.
    struct Shown {
        const std::vector<Capsule>* figure;
        uint8_t who;
        Vec3 centre{0.0f};
        float radius = 0.0f;
        Shown(const std::vector<Capsule>& capsules, uint8_t number) : figure(&capsules), who(number) {
            for (const Capsule& c : capsules) centre += (c.a + c.b) / (2.0f * float(capsules.size()));
            for (const Capsule& c : capsules)
                for (const Vec3& end : {c.a, c.b}) radius = std::max(radius, glm::distance(centre, end) + c.radius);
        }
        bool near(const Vec3& eye, const Vec3& ray) const {
            const Vec3 to = centre - eye;
            const float along = glm::dot(to, ray);
            return glm::dot(to, to) - along * along / glm::dot(ray, ray) < radius * radius;
        }
    };

    static float meet(const Vec3& eye, const Vec3& ray, const Block& b) {
        float near = 0.0f, far = 1e9f;
        for (int k = 0; k < 3; ++k) {
            const float one = (b.low[k] - eye[k]) / ray[k], two = (b.high[k] - eye[k]) / ray[k];
            near = std::max(near, std::min(one, two));
            far = std::min(far, std::max(one, two));
        }
        return near < far ? near : -1.0f;
    }
    static float meet_sphere(const Vec3& eye, const Vec3& ray, const Vec3& centre, float radius) {
        const Vec3 o = eye - centre;
        const float a = glm::dot(ray, ray), b = glm::dot(ray, o), c = glm::dot(o, o) - radius * radius;
        const float root = b * b - a * c;
        return root < 0 ? -1.0f : (-b - std::sqrt(root)) / a;
    }
    static float meet(const Vec3& eye, const Vec3& ray, const Capsule& c) {
        const Vec3 axis = c.b - c.a, o = eye - c.a;
        const float aa = glm::dot(axis, axis), ar = glm::dot(axis, ray), ao = glm::dot(axis, o);
        const float rr = glm::dot(ray, ray), ro = glm::dot(ray, o), oo = glm::dot(o, o);
        const float p = aa * rr - ar * ar, q = aa * ro - ao * ar, s = aa * oo - ao * ao - c.radius * c.radius * aa;
        const float root = q * q - p * s;
        if (root < 0) return -1.0f;
        const float t = (-q - std::sqrt(root)) / p, along = ao + t * ar;
        if (along > 0 && along < aa) return t;
        return meet_sphere(eye, ray, along <= 0 ? c.a : c.b, c.radius);
    }
};

using Figure = std::vector<Capsule>;

/// Scaled about the floor, then put to x and z.
inline Figure placed(Figure p, float x, float z, float scale = 1.0f) {
    for (Capsule& c : p) {
        c.a = scale * c.a + Vec3(x, 0, z);
        c.b = scale * c.b + Vec3(x, 0, z);
        c.radius *= scale;
    }
    return p;
}

/// Head, neck, shoulders and trunk of somebody 1.72 m tall; `lower` lowers them all, for those who sit.
inline Figure upper_body(float lower = 0.0f) {
    Figure p = {
        {{0, 1.60f, 0}, {0, 1.62f, 0}, 0.10f},        // head
        {{0, 1.42f, 0}, {0, 1.52f, 0}, 0.06f},        // neck
        {{-0.10f, 1.30f, 0}, {0.10f, 1.30f, 0}, 0.13f},  // shoulders
        {{0, 0.98f, 0}, {0, 1.28f, 0}, 0.15f},        // trunk
        {{-0.06f, 0.93f, 0}, {0.06f, 0.93f, 0}, 0.12f},  // hips
    };
    for (Capsule& c : p) c.a.y -= lower, c.b.y -= lower;
    return p;
}

inline Figure standing_legs() {
    Figure p;
    for (const float s : {-1.0f, 1.0f}) {
        p.push_back({{s * 0.09f, 0.88f, 0}, {s * 0.11f, 0.10f, 0}, 0.065f});
        p.push_back({{s * 0.11f, 0.05f, -0.03f}, {s * 0.12f, 0.04f, 0.14f}, 0.04f});  // foot
    }
    return p;
}

/// Both arms from the shoulders over the elbows to hands at (+-hand.x, hand.y, hand.z); z: before the trunk's axis.
inline Figure arms(const Vec3& elbow, const Vec3& hand, float lower = 0.0f) {
    Figure p;
    for (const float s : {-1.0f, 1.0f}) {
        const Vec3 side(s, 1, 1);
        p.push_back({{s * 0.20f, 1.36f - lower, 0}, elbow * side, 0.045f});
        p.push_back({elbow * side, hand * side, 0.04f});
    }
    return p;
}

inline Figure operator+(Figure a, const Figure& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Upright, 1.72 m tall, facing the camera; arms hang a little off the trunk.
inline Figure standing_person(float x, float z, float scale = 1.0f) {
    Figure p = upper_body() + standing_legs();
    for (const float s : {-1.0f, 1.0f}) p.push_back({{s * 0.20f, 1.36f, 0}, {s * 0.30f, 0.80f, 0.03f}, 0.045f});
    return placed(p, x, z, scale);
}

/// Upright, forearms forward: to a table, around a box.
inline Figure reaching_person(float x, float z, const Vec3& hand) {
    return placed(upper_body() + standing_legs() + arms({0.27f, 1.05f, 0.08f}, hand), x, z);
}

/// On a seat 0.45 m high, hands on the knees.
inline Figure sitting_person(float x, float z) {
    Figure p = upper_body(0.40f) + arms({0.27f, 0.70f, 0.05f}, {0.13f, 0.62f, 0.38f}, 0.40f);
    for (const float s : {-1.0f, 1.0f}) {
        p.push_back({{s * 0.09f, 0.53f, 0}, {s * 0.11f, 0.50f, 0.42f}, 0.07f});
        p.push_back({{s * 0.11f, 0.50f, 0.42f}, {s * 0.11f, 0.10f, 0.42f}, 0.055f});
        p.push_back({{s * 0.11f, 0.05f, 0.40f}, {s * 0.12f, 0.04f, 0.57f}, 0.04f});
    }
    return placed(p, x, z);
}

}  // namespace vfit::testing
