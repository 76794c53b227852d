// How much further than others some vertices stay off a garment below: contact keeps vertices off it, and
// where it comes through between them, the triangle's three go outwards until it is clear.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/contact/contact_mesh.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class MeshLift {
public:
    explicit MeshLift(std::shared_ptr<const Fabric> fabric);

    /// After a step: looks at some of the cloth's triangles, moved to where they are now.
    void look(const TriangleGroups& cloth, std::span<const ContactMesh> meshes);
    /// One a particle, metres.
    std::span<const float> particles() const { return lift_m_; }
    float of_vertex(uint32_t vertex) const { return lift_m_[fabric_->layout().particle_of[vertex]]; }

private:
    void forget(std::span<const ContactMesh> meshes);

    std::shared_ptr<const Fabric> fabric_;
    std::vector<float> lift_m_;
    std::vector<uint32_t> groups_, looked_again_;  // of triangles that crossed at the last look
    std::vector<uint32_t> crossed_, near_;         // room to work in
    uint32_t next_ = 0;                            // group
};

}  // namespace vfit
