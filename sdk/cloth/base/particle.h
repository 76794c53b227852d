// The particles of a cloth while it is solved: four floats each, so that eight fill four wide registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Particles that the kernels work on together.
inline constexpr size_t kLanes = 8;
/// Two neighbours are loaded as one, and what is loaded as rows of four floats is worked on as columns: so a
/// run's even particles come first.
constexpr size_t lane_of(size_t particle) { return particle % 2 * (kLanes / 2) + particle / 2; }
constexpr size_t particle_at(size_t lane) { return lane % (kLanes / 2) * 2 + lane / (kLanes / 2); }

/// A place, a velocity or a way; the fourth float is zero.
struct alignas(16) Particle {
    Vec3 x{0.0f};
    float zero = 0.0f;
};

/// Kernels load whole registers.
template <typename T>
struct WideAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{32};

    WideAllocator() = default;
    template <typename U>
    WideAllocator(const WideAllocator<U>&) {}
    T* allocate(size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
    void deallocate(T* p, size_t) { ::operator delete(p, kAlignment); }
    bool operator==(const WideAllocator&) const { return true; }
};
using Particles = std::vector<Particle, WideAllocator<Particle>>;

/// Of particles that move.
struct Moving {
    Particle* places;
    Particle* starts;      // at the begin of the sub-step
    Particle* velocities;  // without constraints they end at starts + velocities * h
    uint32_t count;        // a multiple of kLanes
};

}  // namespace vfit
