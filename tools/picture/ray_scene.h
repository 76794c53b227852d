// Triangle meshes to shoot rays at (Embree 3 or 4).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace vfit::tools {

class RayScene {
public:
    RayScene();
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Meshes are numbered from 0 as they are added.
    void add(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices);
    /// After the last mesh, before the first ray.
    void commit();

    struct Hit {
        float distance;
        uint32_t mesh, triangle;
        float u, v;  // weights of the triangle's second and third corner
    };
    std::optional<Hit> first_hit(const glm::vec3& origin, const glm::vec3& direction, float far) const;
    bool blocked(const glm::vec3& origin, const glm::vec3& direction, float far) const;

private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace vfit::tools
