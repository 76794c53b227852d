// A prop: a solid that the host puts beside a body, such as a chair, a weapon, a bag or hair.
#pragma once

#include <span>
#include <vector>

#include "body/mesh.h"
#include "math/types.h"
#include "outfit/prop_mesh.h"

namespace vfit {

class Prop {
public:
    /// In its own frame, which is the world's until it is moved. Fails as PropMesh does.
    explicit Prop(const Mesh& mesh);

    /// Where its frame is.
    void move(const Vec3& position, const Quat& rotation);
    /// Other places of the vertices that were given, in its own frame. VFIT_ERROR_ARGUMENT for another count.
    void deform(std::span<const Vec3> given);

    const std::vector<uint32_t>& indices() const { return mesh_.indices(); }
    size_t vertex_count() const { return mesh_.vertex_count(); }
    /// World space.
    const std::vector<Vec3>& positions() const { return positions_; }

private:
    void place();

    PropMesh mesh_;
    std::vector<Vec3> own_;  // in its own frame
    Vec3 position_{0.0f};
    Quat rotation_{1.0f, 0.0f, 0.0f, 0.0f};
    std::vector<Vec3> positions_;
};

}  // namespace vfit
