// A user map of the tracker's own and the bodies of somebody else: each person gets the number of the body
// whose joints lie on them.
#pragma once

#include <cstdint>
#include <span>

#include "frame/body.h"
#include "frame/camera.h"
#include "track/people_map.h"

namespace vfit {

/// Renumbers `users` (one byte a pixel of the camera's image). A body is of the person on whom the majority
/// of its joints lies, as far as they are in the image; a person without a body gets a number that no body
/// has. Bodies in camera space, at most 255.
void number_by_bodies(std::span<const Body> bodies, const Camera& camera,
                      std::span<const PersonRegion> people, uint8_t* users);

}  // namespace vfit
