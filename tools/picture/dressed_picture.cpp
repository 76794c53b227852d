#include "picture/dressed_picture.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace vfit::tools {

namespace {

constexpr Color kSkin{0.86f, 0.67f, 0.56f};
constexpr float kClothSheen = 0.35f;

struct Stop {
    float value;
    Color color;
};
constexpr Color kFits{0.93f, 0.93f, 0.91f}, kLoose{0.20f, 0.42f, 0.80f}, kFirm{0.98f, 0.80f, 0.25f},
    kTight{0.78f, 0.10f, 0.12f};
constexpr Stop kStretch[] = {{-0.05f, kLoose}, {0.0f, kFits}, {0.04f, kFirm}, {0.1f, kTight}};
constexpr Stop kFit[] = {{-1.0f, kLoose}, {-0.1f, kFits}, {0.15f, kFits}, {0.5f, kFirm}, {1.0f, kTight}};
constexpr Stop kPressure_pa[] = {{0.0f, kFits}, {500.0f, kFirm}, {2000.0f, kTight}};

Color color_at(std::span<const Stop> stops, float value) {
    for (size_t i = 1; i < stops.size(); ++i)
        if (value < stops[i].value) {
            const float share = (value - stops[i - 1].value) / (stops[i].value - stops[i - 1].value);
            return mix(stops[i - 1].color, stops[i].color, std::max(share, 0.0f));
        }
    return stops.back().color;
}

std::vector<Color> colors_of(vfit_cloth garment, vfit_frame cloth, FitMap map) {
    std::vector<Color> colors;
    if (map == FitMap::fit) {
        std::vector<float> values(view_of(cloth, VFIT_STREAM_POSITION).width);
        check(vfit_cloth_fit_map(garment, values.data(), uint32_t(values.size())));
        for (const float value : values) colors.push_back(color_at(kFit, value));
        return colors;
    }
    const bool stretch = map == FitMap::stretch;
    for (const float value : items_of<float>(cloth, stretch ? VFIT_STREAM_STRAIN : VFIT_STREAM_PRESSURE))
        colors.push_back(stretch ? color_at(kStretch, value) : color_at(kPressure_pa, value));
    return colors;
}

RenderMesh mesh_of(vfit_frame frame, const Color& color) {
    RenderMesh mesh;
    mesh.positions = items_of<glm::vec3>(frame, VFIT_STREAM_POSITION);
    mesh.normals = items_of<glm::vec3>(frame, VFIT_STREAM_NORMAL);
    mesh.indices = items_of<uint32_t>(frame, VFIT_STREAM_INDEX);
    mesh.color = color;
    return mesh;
}

/// IEC 61966-2-1, near enough for a picture.
float srgb(float linear) { return std::pow(std::max(linear, 0.0f), 1.0f / 2.2f); }

void paint(vfit_garment garment, RenderMesh& mesh) {
    for (const vfit_garment_part& part : stated_parts(garment)) {
        mesh.vertex_colors.resize(mesh.positions.size(), mesh.color);
        const Color color{srgb(part.color[0]), srgb(part.color[1]), srgb(part.color[2])};
        for (uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
            mesh.vertex_colors[mesh.indices[i]] = color;
    }
}

}  // namespace

std::vector<RenderMesh> dressed_meshes(vfit_avatar avatar, std::span<const DrawnCloth> cloths, FitMap map) {
    std::vector<vfit_cloth> outfit;
    for (const DrawnCloth& drawn : cloths) outfit.push_back(drawn.cloth);
    Frame body_frame;
    check(outfit.empty()
              ? vfit_avatar_acquire(avatar, body_frame.out())
              : vfit_outfit_skin(outfit.data(), uint32_t(outfit.size()), body_frame.out(), nullptr));
    std::vector<RenderMesh> meshes{mesh_of(body_frame.get(), kSkin)};
    for (const DrawnCloth& drawn : cloths) {
        Frame cloth_frame;
        check(vfit_cloth_acquire(drawn.cloth, cloth_frame.out()));
        RenderMesh mesh = mesh_of(cloth_frame.get(), kGarmentColor);
        if (map == FitMap::none) {
            mesh.sheen = kClothSheen;
            if (drawn.garment.id) paint(drawn.garment, mesh);
        } else {
            mesh.vertex_colors = colors_of(drawn.cloth, cloth_frame.get(), map);
        }
        meshes.push_back(std::move(mesh));
    }
    if (!outfit.empty()) meshes[0].indices = seen_triangles(avatar, outfit);
    return meshes;
}

std::vector<DrawnCloth> drawn(const WornOutfit& outfit) {
    std::vector<DrawnCloth> out;
    for (const Layer& layer : outfit.layers()) out.push_back({layer.cloth.get(), layer.garment.get()});
    return out;
}

glm::vec3 centre_of(const RenderMesh& mesh) {
    glm::vec3 low(1e9f), high(-1e9f);
    for (const auto& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {0.5f * (low.x + high.x), 0.0f, 0.5f * (low.z + high.z)};
}

Canvas draw_dressed(const std::vector<RenderMesh>& meshes, const glm::vec3& centre, float yaw,
                    const PortraitStyle& style) {
    // The floor of the picture is the world's: meshes move under the camera, not the camera over them.
    std::vector<RenderMesh> moved = meshes;
    for (RenderMesh& mesh : moved)
        for (glm::vec3& p : mesh.positions) p -= centre;
    RenderView view;
    view.width = style.width;
    view.height = style.height;
    view.samples = style.samples;
    constexpr float kDistance = 5.2f, kEyeHeight = 1.35f, kTargetHeight = 0.92f;
    view.eye = {kDistance * std::sin(yaw), kEyeHeight, kDistance * std::cos(yaw)};
    view.target = {0.0f, kTargetHeight, 0.0f};
    view.fov_y_rad = 0.43f;
    step_back_to_show(moved, view);
    return render(moved, view);
}

}  // namespace vfit::tools
