// Points of a coarse mesh's triangles that meet colliders as its vertices do, so that no sphere gets through
// between them (the paper's virtual particles).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/contact/contact.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class VirtualParticles {
public:
    /// So many that none is further than that from the next one of its triangle, or a corner.
    VirtualParticles(const Fabric& fabric, float spacing_m);

    size_t count() const { return points_.size(); }
    /// What each may meet in a step of dt, by its speed and that of colliders on their way through the step.
    void find_near(const Particles& places, const Particles& velocities, float dt,
                   std::span<const SweptCapsule> colliders);
    /// The end of a sub-step: out of the colliders, by moving the corners. `pushed`, empty or one a particle,
    /// gets what they are moved by added.
    void solve(std::span<const SweptCapsule> colliders, const ContactSettings& settings,
               const Particles& starts, Particles& places, Particles& pushed) const;

private:
    struct Point {
        uint32_t corners[3];  // particles
        float weights[3];     // where it is
        float gains[3];       // what a corner moves by, of what the point is to
    };
    struct Near {
        Vec3 center;
        float way_m;  // that it is expected to stay within; who goes further is tried against everything
        uint32_t first, last;  // of near_
    };
    static Vec3 at(const Point& point, const Particles& particles);
    void meet(const Point& point, const SweptCapsule& collider, const ContactSettings& settings,
              const Particles& starts, Particles& places, Particles& pushed) const;

    std::vector<Point> points_;
    std::vector<Near> of_point_;
    std::vector<uint32_t> near_;  // colliders
};

}  // namespace vfit
