// The math types of the library: GLM's, under short names. Quaternions are unit length and rotate by
// q * v; matrices are column-major and multiply columns.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace vfit {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Quat = glm::quat;  // constructor order is w, x, y, z; identity is Quat(1, 0, 0, 0)
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

inline constexpr float kPi = 3.14159265358979323846f;

}  // namespace vfit
