// The body's surface at its levels of detail: topology, UV seams, skin; built on first use.
#pragma once

#include <mutex>

#include "body/body_data.h"
#include "body/simplification.h"

namespace vfit {

class BodySurface {
public:
    /// Keeps a reference to `body`.
    explicit BodySurface(const BodyData& body) : body_(body) {}

    const BodyTopology& topology(uint32_t level) const;
    void subdivide(uint32_t level, const std::vector<Vec3>& base, std::vector<Vec3>& out) const;

private:
    struct Level {
        std::once_flag built;
        BodyTopology topology;
        Refinement to_next, uv_to_next;  // of the levels below the last
        std::vector<Vec3> positions;     // of the unshaped body, to choose diagonals by
        std::vector<Vec2> uvs;
    };
    struct Coarse {
        std::once_flag built;
        SimplifiedSurface surface;
    };
    const Level& level(uint32_t index) const;
    const SimplifiedSurface& coarse() const;
    void build(uint32_t index, Level& level) const;

    const BodyData& body_;
    mutable std::array<Level, kBodyLevels> levels_;
    mutable Coarse coarse_;
};

}  // namespace vfit
