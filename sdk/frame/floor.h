// Where the floor is when no sensor says so: below the feet of the first body that is seen.
#pragma once

#include <optional>

#include "frame/body.h"
#include "frame/camera.h"

namespace vfit {

/// The lowest point of the body's soles, in camera space; none where no foot is seen below the camera.
std::optional<Vec3> lowest_sole(const Body& body, const Vec3& up);

/// Puts the floor of a level camera below that body's feet (joints in camera space) and marks it ESTIMATED.
/// False, and nothing changed, where no foot is seen below the camera.
bool estimate_floor(Camera& camera, const Body& body);

/// The body's positions and rotations carried from camera space to world space by the camera's floor.
Body to_world(const Body& camera_space, const Camera& camera);
/// And back.
Body to_camera(const Body& world, const Camera& camera);

}  // namespace vfit
