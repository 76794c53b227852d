// Contact of a cloth with itself: contacts that a step keeps open, and what ended up crossing all the same is
// set right once it is over.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cloth/contact/contact_list.h"
#include "cloth/contact/crossing_guard.h"
#include "cloth/contact/proximity.h"
#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit {

class SelfContact {
public:
    /// thickness_m: kept between layers. positions: one a vertex, by which triangles are grouped.
    SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m, std::span<const Vec3> positions,
                Jobs* jobs = nullptr);

    /// The cloth was placed there anew, at rest.
    void place(std::span<const Vec3> positions, Jobs& jobs);
    /// Moves triangles that cross apart.
    void part(std::span<Vec3> positions, Jobs& jobs);

    /// After a step: changes its `end` so that nothing crosses which did not at its begin, and finds the
    /// contacts of the next step. True: no two triangles of the cloth cross, which is proven.
    bool keep(std::span<const Vec3> begin, std::span<Vec3> end, Jobs& jobs);
    /// Vertices that keep() moved; is_in_zone: as one with others, whose velocity is their way.
    std::span<const uint32_t> moved() const { return guard_.moved(); }
    bool is_in_zone(uint32_t vertex) const { return guard_.is_in_zone(vertex); }

    ContactList& contacts() { return contacts_; }

private:
    Proximity proximity_;
    ContactList contacts_;
    CrossingGuard guard_;
    std::vector<Particle> begin_, end_;
};

}  // namespace vfit
