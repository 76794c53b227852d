// Math types of this plug-in, and angles in degrees as the motion tables write them. World: Y up, the person
// faces +Z, the person's left is +X.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "vfit.h"

namespace vfit::virtual_person {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Mat3 = glm::mat3;
using Quat = glm::quat;  // w, x, y, z

inline constexpr float kPi = 3.14159265358979323846f;

inline Quat rotate_x(float deg) { return glm::angleAxis(glm::radians(deg), Vec3(1, 0, 0)); }
inline Quat rotate_y(float deg) { return glm::angleAxis(glm::radians(deg), Vec3(0, 1, 0)); }
inline Quat rotate_z(float deg) { return glm::angleAxis(glm::radians(deg), Vec3(0, 0, 1)); }
inline const Quat kNoRotation{1, 0, 0, 0};

enum Side { kLeft = 0, kRight = 1 };
/// +1 on the person's left, where x is positive.
inline float side_sign(int side) { return side == kLeft ? 1.0f : -1.0f; }

}  // namespace vfit::virtual_person
