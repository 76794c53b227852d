#include "picture/hide_skin.h"

#include "picture/ray_scene.h"

namespace vfit::tools {

namespace {

constexpr float kAbove = 0.08f;  // m: cloth that far over the skin covers it
constexpr float kBelow = 0.09f;  // m: skin that sticks out of the cloth by that much is covered too

}  // namespace

std::vector<uint32_t> visible_triangles(const RenderMesh& body, const RenderMesh& cloth,
                                        const std::vector<uint8_t>& coverable) {
    RayScene scene;
    scene.add(cloth.positions, cloth.indices);
    scene.commit();
    std::vector<uint8_t> covered(body.positions.size(), 0);
    for (size_t i = 0; i < covered.size(); ++i) {
        if (!coverable[i]) continue;
        const glm::vec3 n = body.normals[i];
        covered[i] = scene.blocked(body.positions[i] - n * kBelow, n, kBelow + kAbove);
    }

    std::vector<uint32_t> out;
    out.reserve(body.indices.size());
    for (size_t t = 0; t + 2 < body.indices.size(); t += 3) {
        const uint32_t* v = &body.indices[t];
        if (!(covered[v[0]] && covered[v[1]] && covered[v[2]])) out.insert(out.end(), v, v + 3);
    }
    return out;
}

}  // namespace vfit::tools
