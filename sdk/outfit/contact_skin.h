// The collision proxy of a body: its wrapped skin (wrapped_skin.h), with mittens for hands (mitten.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/garment/bound_garment.h"
#include "math/types.h"

namespace vfit {

/// Of the body at rest.
struct ContactSkin {
    std::vector<Vec3> places;
    std::vector<uint32_t> goes_with;  // one a place: the body vertex whose bones carry it
    std::vector<uint32_t> indices;    // three a triangle, counter-clockwise from outside
};

ContactSkin contact_skin(const BoundBody& body);

}  // namespace vfit
