// Rooms of planes and boxes for vfit-bench track --only rooms, seen by a depth camera that stands in any way.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "bench/frames.h"

namespace vfit::tools {

/// What the floor sends back of the sensor's light.
enum class FloorLook { kMatt, kBlack, kShiny };

/// World space: the camera stands at (0, height, 0) and looks along -Z. The floor is y = 0.
struct VirtualRoom {
    struct Wall {
        Vec3 normal;       // into the room
        float distance_m;  // normal . p + distance = 0
    };
    struct Box {
        Vec3 low, high;
    };
    /// Turned in any way.
    struct Solid {
        enum class Shape { kBox, kEllipsoid } shape;
        Vec3 centre;
        Mat3 half_axes;  // columns, at right angles to each other
    };
    FloorLook floor = FloorLook::kMatt;
    std::vector<Wall> walls;
    std::vector<Box> boxes;
    std::vector<Solid> solids;
    bool empty = false;  // the background was cut away

    /// What a sensor of that kind says to a surface at z metres.
    static float reading(float z, bool time_of_flight, std::mt19937& random);
    /// Depth in metres, with the noise of a time-of-flight or structured-light sensor; 0: no reading.
    void render(const Camera& camera, bool time_of_flight, std::mt19937& random,
                std::vector<float>& depth_m) const;
};

}  // namespace vfit::tools
