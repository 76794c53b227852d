#include "cloth/solver/air.h"

#include <cmath>

namespace vfit {

void blow(const Air& air, float dt, const Fabric& fabric, uint32_t part, const Particles& places,
          Particles& velocities) {
    constexpr float kDensity_kg_m3 = 1.2f;  // of air at 20 degrees
    const ParticleLayout& layout = fabric.layout();
    const ParticleLayout::Part& p = layout.parts[part];
    for (uint32_t i = p.begin; i < p.moving_end; ++i) {
        if (layout.vertex_of[i] == ParticleLayout::kNobody) continue;
        Vec3 area(0.0f);  // vector of a third of the triangles' areas
        for (const TriangleFans::Corners& c : fabric.fans().of(i))
            area += glm::cross(places[c.second].x - places[i].x, places[c.third].x - places[i].x) / 6.0f;
        const Vec3 flow = air.wind_m_s - velocities[i].x;
        const float area_m2 = glm::length(area), speed = glm::length(flow);
        if (area_m2 < 1e-12f || speed < 1e-6f) continue;
        const Vec3 normal = area / area_m2, along = flow / speed;
        const float facing = glm::dot(normal, along);
        const float push = 0.5f * kDensity_kg_m3 * area_m2 * std::abs(facing) * speed * dt *
                           fabric.data().inverse_mass[layout.vertex_of[i]];
        // Square to the flow, to the side to which the sheet leans.
        const Vec3 aside = (facing > 0.0f ? normal : -normal) - along * std::abs(facing);
        // Implicit in the speed: however strong, drag brings it to the wind's and no further.
        velocities[i].x += (air.drag * flow + air.lift * speed * aside) * (push / (1.0f + air.drag * push));
    }
}

}  // namespace vfit
