// A box that slides over the floor between camera and person and hides them for about a second.
#pragma once

#include "solids.h"

namespace vfit::virtual_person {

class Occluder {
public:
    /// begin_s: when the box begins to hide the whole trunk; `stand`: where they are.
    Occluder(float begin_s, const Vec3& stand) : begin_s_(begin_s), stand_(stand) {}

    Solid at(double t_s) const;

private:
    float begin_s_;
    Vec3 stand_;
};

}  // namespace vfit::virtual_person
