// Drag and lift of the air on a cloth, once a step.
#pragma once

#include "cloth/base/particle.h"
#include "cloth/fabric/fabric.h"
#include "math/types.h"

namespace vfit {

struct Air {
    Vec3 wind_m_s{0.0f};
    float drag = 0.0f, lift = 0.0f;  // coefficients of a plate: about 1; both 0: no air
};

/// Changes the speeds of a part's moving particles by what the air does in dt to the triangles about them.
/// Reads the places of all parts.
void blow(const Air& air, float dt, const Fabric& fabric, uint32_t part, const Particles& places,
          Particles& velocities);

}  // namespace vfit
