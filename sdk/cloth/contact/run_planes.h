// Planes that runs of particles stay before through a step.
#pragma once

#include <cstdint>

#include "cloth/base/particle.h"
#include "math/types.h"

namespace vfit {

/// Of a run, by lanes: planes that its particles stay before.
struct alignas(32) RunPlanes {
    static constexpr float kNone = -1e9f;

    float x[kLanes], y[kLanes], z[kLanes];              // a point of each at the begin of the step
    float way_x[kLanes], way_y[kLanes], way_z[kLanes];  // to its end
    float normal_x[kLanes], normal_y[kLanes], normal_z[kLanes], turn_x[kLanes], turn_y[kLanes],
        turn_z[kLanes];
    float thickness_m[kLanes];  // kept from the plane; kNone: there is none
    uint32_t run;               // in Moving
    uint32_t order;             // in which planes were found

    void set(size_t lane, const Vec3& point, const Vec3& way, const Vec3& normal, const Vec3& turn,
             float thickness) {
        x[lane] = point.x, y[lane] = point.y, z[lane] = point.z;
        way_x[lane] = way.x, way_y[lane] = way.y, way_z[lane] = way.z;
        normal_x[lane] = normal.x, normal_y[lane] = normal.y, normal_z[lane] = normal.z;
        turn_x[lane] = turn.x, turn_y[lane] = turn.y, turn_z[lane] = turn.z;
        thickness_m[lane] = thickness;
    }
};

}  // namespace vfit
