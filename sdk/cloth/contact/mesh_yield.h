// Where cloth is worn over other cloth that does not fit below it, or got caught at the other's hem, one of
// the two has to give way: the outer one is let in, as deep as it takes, rather than torn.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cloth/fabric/fabric.h"

namespace vfit {

class MeshYield {
public:
    explicit MeshYield(std::shared_ptr<const Fabric> fabric);

    /// After a step. strain: mean of its threads, one a vertex. lift_m: what the particles keep off meshes,
    /// may be empty.
    void look(std::span<const float> strain, std::span<const float> lift_m);
    /// The same less what they give way, one a particle; empty: nobody does.
    std::span<const float> particles() const {
        return any_ ? std::span<const float>(left_m_) : std::span<const float>();
    }

private:
    std::shared_ptr<const Fabric> fabric_;
    std::vector<float> yield_m_, left_m_;
    bool any_ = false;
};

}  // namespace vfit
