#include "cloth/carried_along.h"

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kLevel_rad = 1e-4f;  // a turn that does not wake a cloth

/// A blend of bones does not only turn.
Vec3 turned(const Mat3& by, const Vec3& velocity) {
    const Vec3 out = by * velocity;
    const float length = glm::length(out);
    return length > 0.0f ? out * (glm::length(velocity) / length) : Vec3(0.0f);
}

}  // namespace

void CarriedAlong::check(uint32_t vertices) const {
    for (const size_t count : {places.size(), turns.size(), speeds.empty() ? vertices : speeds.size()})
        if (count != vertices)
            fail(VFIT_ERROR_ARGUMENT, count, " places, turns or speeds carry a cloth of ", vertices,
                 " vertices along");
}

void CarriedAlong::move(const Fabric& fabric, ParticleSolver& solver) const {
    const std::vector<uint32_t>& particle_of = fabric.layout().particle_of;
    for (uint32_t v = 0; v < places.size(); ++v) {
        const Vec3 velocity = turned(turns[v], solver.velocities()[particle_of[v]].x);
        solver.place(v, places[v], speeds.empty() ? velocity : velocity + speeds[v]);
    }
}

bool CarriedAlong::keeps_rest(const Vec3& gravity, const Air& air) const {
    if (!rigid || turns.empty()) return false;
    const bool calm = air.wind_m_s == Vec3(0.0f) || (air.drag == 0.0f && air.lift == 0.0f);
    return calm && glm::length(turns[0] * gravity - gravity) <= kLevel_rad * glm::length(gravity);
}

}  // namespace vfit
