#include "cloth/contact/contact_culling.h"

#include <cmath>

namespace vfit {

namespace {

size_t run_count(size_t moving) { return moving / kLanes; }
size_t whole_registers(size_t runs) { return (runs + kLanes - 1) / kLanes * kLanes; }

}  // namespace

void reserve(NearColliders& near, size_t moving, size_t colliders) {
    const size_t count = whole_registers(run_count(moving));
    for (std::vector<float>* list : {&near.x, &near.y, &near.z, &near.radii_m, &near.speeds2, &near.ways_m})
        list->reserve(count);
    near.bits.reserve(count * ((colliders + 63) / 64));
}

void cull(std::span<const Particle> moving, std::span<const Particle> velocities, float dt,
          std::span<const SweptCapsule> colliders, NearColliders& near) {
    const size_t runs = run_count(moving.size()), count = whole_registers(runs);
    near.colliders = colliders.size();
    for (std::vector<float>* list : {&near.x, &near.y, &near.z, &near.radii_m, &near.speeds2, &near.ways_m})
        list->resize(count);
    near.bits.resize(count * near.words());
    find_run_balls(moving, velocities, near);
    for (size_t run = 0; run < runs; ++run) {
        near.ways_m[run] = expected_way_m(
            dt * std::sqrt(near.speeds2[run]));  // who goes further is tried against everything
        near.radii_m[run] += near.ways_m[run];
    }
    find_near(colliders, moving, near);
}

}  // namespace vfit
