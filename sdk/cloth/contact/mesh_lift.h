// How much further than others some vertices stay off meshes: contact keeps vertices off the skin, and where
// it stands out between them, the triangle's three go outwards until it is clear. Off the skin that is of no
// use where one of the three is fixed to it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/contact_mesh.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class MeshLift {
public:
    /// Off meshes of that kind.
    MeshLift(std::shared_ptr<const Fabric> fabric, MeshOf what);

    /// After a step: looks at some of the cloth's triangles, moved to where they are now, at all of them in
    /// so many steps.
    void look(const TriangleGroups& cloth, std::span<const ContactMesh> meshes, uint32_t steps);
    /// One a particle, metres.
    std::span<const float> particles() const { return lift_m_; }
    float of_vertex(uint32_t vertex) const { return lift_m_[fabric_->layout().particle_of[vertex]]; }

private:
    void forget(std::span<const ContactMesh> meshes);
    bool is_held(uint32_t triangle) const;

    std::shared_ptr<const Fabric> fabric_;
    MeshOf what_;
    std::vector<float> lift_m_;
    std::vector<uint32_t> groups_, looked_again_;  // of triangles that crossed at the last look
    std::vector<uint32_t> crossed_, near_;         // room to work in
    uint32_t next_ = 0;                            // group
};

}  // namespace vfit
