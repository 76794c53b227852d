// Brings a garment onto a body from within: the body stands in it thin, and grows.
#pragma once

#include <vector>

#include "cook/body/cook_body.h"
#include "cook/drape/settle.h"

namespace vfit {

/// Clear of the body, as if that went from a stance to its own posture and thickness, and pushed the cloth
/// ahead of it.
std::vector<Vec3> grow_body_into(const WholeCloth& cloth, std::vector<Vec3> places, const CookBody& body,
                                 const Stance& from, const Hold& hold, float thickness_m, Jobs& jobs);

}  // namespace vfit
