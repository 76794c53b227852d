// Distance constraints as the kernels take them: eight at a time that share no particle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/fabric/particle_layout.h"

namespace vfit {

struct DistanceConstraint;

/// Lanes that are left over join a spare particle to itself.
struct alignas(32) DistanceBatch {
    uint32_t a[kLanes], b[kLanes];  // bytes from the first particle: an address is one addition
    float rest_m[kLanes];
};
/// 1/kg and m/N.
struct alignas(32) BatchMasses {
    float a[kLanes], b[kLanes], compliance[kLanes];
};
/// Of the length that is amiss: what a moves by, and b the other way.
struct alignas(32) BatchGains {
    float a[kLanes], b[kLanes];
};

struct DistanceBatches {
    std::vector<DistanceBatch> joints;
    std::vector<BatchMasses> masses;
};

/// The same of particles that lie so many bytes further on.
DistanceBatches moved(DistanceBatches batches, uint32_t bytes);

/// Those of each group of the layout. Constraints between two vertices that cannot move are left out.
std::vector<DistanceBatches> make_batches(std::span<const DistanceConstraint> list,
                                          std::span<const float> inverse_mass, const ParticleLayout& layout);

}  // namespace vfit
