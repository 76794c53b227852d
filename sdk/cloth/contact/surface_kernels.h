// The hot loops of contact with surfaces, in SIMD with run-time dispatch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/base/triangle_fans.h"

namespace vfit {

/// The nearest point to each lane of a run.
struct NearestOfRun {
    alignas(32) float distance2[kLanes];
    alignas(32) uint32_t id[kLanes];

    explicit NearestOfRun(float reach);  // none within that
};
/// Boxes, eight to a register.
struct Boxes {
    std::vector<float> low[3], high[3];  // x, y, z; filled up to whole registers with boxes that meet nothing
    void resize(size_t count);
    void set(size_t at, const Vec3& from, const Vec3& to);
    Vec3 low_of(size_t at) const { return {low[0][at], low[1][at], low[2][at]}; }
    Vec3 high_of(size_t at) const { return {high[0][at], high[1][at], high[2][at]}; }
};
/// Boxes about runs of particles, and about eight runs in a row each.
struct RunBoxes {
    Boxes runs, blocks;
    void resize(size_t count);
    void find_blocks();  // once all runs are set
};
/// The runs whose boxes meet that one, rising.
void find_meeting(const RunBoxes& boxes, const Vec3& low, const Vec3& high, std::vector<uint32_t>& runs);
/// Looks at the particles of these runs, which are their ids (not finite: nobody), for a run's eight
/// particles. What is nearer than out says, replaces it.
void find_nearest_in_runs(const Particle* run, const Particle* all, std::span<const uint32_t> runs,
                          NearestOfRun& out);

/// For each lane of a run the nearest place on the triangles about one point.
struct alignas(32) NearestOnFans {
    float distance2[kLanes];
    uint32_t corners[kLanes];                   // which of the fans' corners(); kNone: there is no triangle
    float at_second[kLanes], at_third[kLanes];  // weights of those two; the rest is the point's own
    static constexpr uint32_t kNone = UINT32_MAX;

    Vec3 weights(size_t lane) const {
        return {1.0f - at_second[lane] - at_third[lane], at_second[lane], at_third[lane]};
    }
};
/// points: one a lane, kNone: nobody; of them and of their corners `all` holds the places.
void find_nearest_on_fans(const Particle* run, const uint32_t* points, const TriangleFans& fans,
                          const Particle* all, NearestOnFans& out);

}  // namespace vfit
