#include "cook/model/draw.h"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "body/mesh.h"
#include "cook/model/surface.h"

namespace vfit {

void draw(const Soup& soup, const std::vector<uint32_t>& triangles, const MeshQuery& cloth,
          Garment& garment) {
    const Model& model = *soup.model;
    std::vector<ModelTriangle> drawn;
    for (const uint32_t t : triangles) drawn.push_back(soup.triangles[t]);
    std::stable_sort(drawn.begin(), drawn.end(), [&](const ModelTriangle& a, const ModelTriangle& b) {
        return model.faces[a.face].material < model.faces[b.face].material;
    });
    std::vector<Vec3> normals_of_places(soup.places.size(), Vec3(0.0f));
    for (const ModelTriangle& t : drawn) {
        const Vec3 across = glm::cross(soup.places[t.vertex[1]] - soup.places[t.vertex[0]],
                                       soup.places[t.vertex[2]] - soup.places[t.vertex[0]]);
        for (const uint32_t v : t.vertex) normals_of_places[v] += across;
    }
    std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> known;  // by place and uv
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<uint32_t> indices;
    for (const ModelTriangle& t : drawn)
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 uv = t.uv[k] == kNoUv ? Vec2(0.0f) : model.uvs[t.uv[k]];
            const auto [it, fresh] =
                known.try_emplace({t.vertex[k], std::bit_cast<uint32_t>(uv.x), std::bit_cast<uint32_t>(uv.y)},
                                  uint32_t(positions.size()));
            if (fresh) {
                const Vec3& n = normals_of_places[t.vertex[k]];
                const float length = glm::length(n);
                positions.push_back(soup.places[t.vertex[k]]);
                normals.push_back(length > 0.0f ? n / length : Vec3(0, 1, 0));
                uvs.push_back(uv);
            }
            indices.push_back(it->second);
        }
    std::vector<Vec3> carrying;
    compute_normals(garment.cut_shape, garment.mesh.indices, carrying);
    garment.drawn =
        bind_drawn({garment.mesh.indices, garment.cut_shape, carrying}, cloth, positions, normals);
    garment.drawn.uvs = std::move(uvs);
    garment.drawn.indices = std::move(indices);
    garment.parts = parts_of(model, drawn);
}

}  // namespace vfit
