#include "cloth/solver.h"

#include <algorithm>
#include <cmath>

namespace vfit {

void solve_distances(std::span<const DistanceConstraint> constraints, float h, std::span<Particle> particles) {
    const float inverse_h2 = 1.0f / (h * h);
    for (const DistanceConstraint& c : constraints) {
        Particle& a = particles[c.a];
        Particle& b = particles[c.b];
        const Vec3 d = a.x - b.x;
        const float length = std::sqrt(glm::dot(d, d)) + 1e-12f;  // metres; far below any rest length
        const float weight = a.inverse_mass + b.inverse_mass + c.compliance_m_n * inverse_h2;
        const Vec3 impulse = d * ((c.rest_m - length) / (weight * length));
        a.x += impulse * a.inverse_mass;
        b.x -= impulse * b.inverse_mass;
    }
}

void distance_strains(std::span<const DistanceConstraint> constraints, std::span<const Particle> particles,
                      std::span<float> strains) {
    for (size_t i = 0; i < constraints.size(); ++i) {
        const DistanceConstraint& c = constraints[i];
        strains[i] = glm::length(particles[c.a].x - particles[c.b].x) / c.rest_m - 1.0f;
    }
}

void solve_tethers(std::span<const Tether> tethers, std::span<Particle> particles) {
    for (const Tether& t : tethers) {
        Vec3& x = particles[t.vertex].x;
        const Vec3 d = x - particles[t.anchor].x;
        const float length2 = glm::dot(d, d);
        if (length2 > t.length_m * t.length_m) x -= d * (1.0f - t.length_m / std::sqrt(length2));
    }
}

namespace {

// Vertices worked on by one job: enough to outweigh the hand-over (about 10 us). Whole blocks.
constexpr size_t kChunk = 64 * kContactBlock;

}  // namespace

void ContactPass::run(std::span<Particle> particles, Jobs& jobs) const {
    if (colliders.empty()) return;
    const auto chunk_count = uint32_t((vertices.size() + kChunk - 1) / kChunk);
    parallel_for(jobs, chunk_count, [&](uint32_t chunk) {
        const size_t end = std::min(vertices.size(), (chunk + 1) * kChunk);
        for (size_t i = chunk * kChunk; i < end; i += kContactBlock)
            run_block(vertices.subspan(i, std::min(kContactBlock, end - i)), particles);
    });
}

void ContactPass::run_block(std::span<const uint32_t> block, std::span<Particle> particles) const {
    Bounds bounds;
    float travel2 = 0.0f;
    const auto account_for = [&](uint32_t v) {
        const Vec3 way = particles[v].x - starts[v];
        travel2 = std::max(travel2, glm::dot(way, way));
        bounds.add(particles[v].x);
    };
    for (uint32_t v : block) {
        bounds.add(starts[v]);
        account_for(v);
    }
    for (const SweptCapsule& collider : colliders) {
        if (!bounds.overlaps(collider.bounds)) continue;
        const float travel = std::sqrt(travel2);
        // The box is loose about a slanting limb; the ball about the block's box is a second, cheap look.
        const float reach = 0.5f * glm::length(bounds.high - bounds.low) + travel;
        if (!may_touch(collider, 0.5f * (bounds.low + bounds.high), reach)) continue;
        for (uint32_t v : block)
            if (may_touch(collider, particles[v].x, travel) &&
                resolve_contact(collider, starts[v], settings, particles[v].x))
                account_for(v);
    }
}

}  // namespace vfit
