// Hinges as the kernels take them: eight at a time that share no particle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/fabric/particle_layout.h"

namespace vfit {

struct Hinge;

/// Lanes that are left over join the spare particle to itself.
struct alignas(32) HingeBatch {
    uint32_t at[4][kLanes];  // bytes from the first particle
    float weight[4][kLanes];
};
/// 1/kg and m/N.
struct alignas(32) HingeMasses {
    float inverse_mass[4][kLanes], compliance[kLanes];
};
/// Of the sum that is amiss: what each moves by.
struct alignas(32) HingeGains {
    float at[4][kLanes];
    bool soft;  // all of the batch
};

struct HingeBatches {
    std::vector<HingeBatch> hinges;
    std::vector<HingeMasses> masses;
};

/// The same of particles that lie so many bytes further on.
HingeBatches moved(HingeBatches batches, uint32_t bytes);

/// Those of each group of the layout.
std::vector<HingeBatches> make_hinge_batches(std::span<const Hinge> list, std::span<const float> inverse_mass,
                                             const ParticleLayout& layout);

}  // namespace vfit
