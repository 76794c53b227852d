// A room with people of capsules and things of boxes before a pinhole camera, seen ray by ray with the noise
// of a Kinect v1 (Nguyen, Izadi and Lovell 2012; steps: Khoshelham and Elberink 2012): the truth is known by
// construction.
#pragma once

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
    /// Of the camera no more is known than which side of its image is up.
    DepthImage bare() const {
        DepthImage image{depth.data(), nullptr, camera};
        image.camera.floor_state = VFIT_FLOOR_DEFAULT;
        image.camera.floor_normal = camera.side_up();
        image.camera.floor_distance_m = 1.0f;
        return image;
    }

    /// Fills depth and truth.
    void render(uint32_t seed = 1);
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
        {{0, 1.60f, 0}, {0, 1.62f, 0}, 0.10f},           // head
        {{0, 1.42f, 0}, {0, 1.52f, 0}, 0.06f},           // neck
        {{-0.10f, 1.30f, 0}, {0.10f, 1.30f, 0}, 0.13f},  // shoulders
        {{0, 0.98f, 0}, {0, 1.28f, 0}, 0.15f},           // trunk
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

/// Both arms from the shoulders over the elbows to hands at (+-hand.x, hand.y, hand.z); z: before the trunk's
/// axis.
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
    for (const float s : {-1.0f, 1.0f})
        p.push_back({{s * 0.20f, 1.36f, 0}, {s * 0.30f, 0.80f, 0.03f}, 0.045f});
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
