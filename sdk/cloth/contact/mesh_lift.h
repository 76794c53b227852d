// How much further than others some vertices stay off meshes: contact keeps vertices off the skin, and where it stands out between
// them, the triangle's three go outwards until it is clear.
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
    explicit MeshLift(std::shared_ptr<const Fabric> fabric);

    /// After a step: looks at some of the cloth's triangles, moved to where they are now, at all of them in so many steps.
    /// body_way_m: how far the meshes moved in this one.
    void look(const TriangleGroups& cloth, std::span<const ContactMesh> meshes, uint32_t steps, float body_way_m);
    /// One a particle, metres.
    std::span<const float> particles() const { return lift_m_; }

private:
    std::shared_ptr<const Fabric> fabric_;
    std::vector<float> lift_m_;
    std::vector<uint32_t> groups_, looked_again_;  // of triangles that crossed at the last look
    std::vector<uint32_t> crossed_, near_;         // room to work in
    uint32_t next_ = 0;  // group
};

}  // namespace vfit
