#include "picture/render.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "picture/ray_scene.h"

namespace vfit::tools {

namespace {

using glm::vec3;

constexpr float kPi = 3.14159265f;
constexpr float kFar = 100.0f;                // m
constexpr float kShadowReach = 3.0f;          // m, farther things throw no shadow
constexpr float kOffset = 1e-4f;              // m, off the surface that a shadow ray leaves
constexpr int kShadowRays = 3, kSkyRays = 5;  // a primary ray
const vec3 kKeyLight = glm::normalize(vec3(-0.45f, 0.85f, 0.75f));
constexpr float kKeySpread = 0.22f;  // tangent of the light's half angle: how soft its shadows are
const vec3 kKeyColor(1.05f, 0.98f, 0.88f), kSkyColor(0.52f, 0.57f, 0.66f), kRimColor(0.30f, 0.34f, 0.42f);
const vec3 kFloorAlbedo(0.46f, 0.46f, 0.48f);

// Work in linear light; colours come and go as sRGB.
float to_linear(float s) { return std::pow(s, 2.2f); }
float to_srgb(float l) { return std::pow(l, 1.0f / 2.2f); }
vec3 linear(const Color& c) { return {to_linear(c.r), to_linear(c.g), to_linear(c.b)}; }
/// Rolls bright light off softly in place of clipping it.
Color shown(vec3 c) {
    c = c / (1.0f + 0.18f * c);
    return {to_srgb(glm::clamp(c.r, 0.0f, 1.0f)), to_srgb(glm::clamp(c.g, 0.0f, 1.0f)),
            to_srgb(glm::clamp(c.b, 0.0f, 1.0f))};
}

/// A stream of numbers in [0, 1) of its own for each ray: PCG hash of a counter (O'Neill 2014).
class Noise {
public:
    explicit Noise(uint32_t seed) : state_(seed * 747796405u + 2891336453u) {}
    float next() {
        state_ = state_ * 747796405u + 2891336453u;
        uint32_t word = ((state_ >> ((state_ >> 28) + 4)) ^ state_) * 277803737u;
        word = (word >> 22) ^ word;
        return float(word >> 8) * (1.0f / 16777216.0f);
    }

private:
    uint32_t state_;
};

vec3 cosine_direction(const vec3& normal, Noise& noise) {
    const float phi = 2.0f * kPi * noise.next(), r2 = noise.next(), r = std::sqrt(r2);
    const vec3 other = std::abs(normal.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 u = glm::normalize(glm::cross(normal, other)), v = glm::cross(normal, u);
    return u * (r * std::cos(phi)) + v * (r * std::sin(phi)) + normal * std::sqrt(1.0f - r2);
}

vec3 backdrop(const vec3& direction) {
    const float t = glm::clamp(direction.y * 1.6f + 0.35f, 0.0f, 1.0f);
    return glm::mix(vec3(0.50f, 0.50f, 0.53f), vec3(0.19f, 0.21f, 0.27f), t);
}

class Scene {
public:
    explicit Scene(const std::vector<RenderMesh>& meshes) : meshes_(meshes) {
        for (const RenderMesh& mesh : meshes_) rays_.add(mesh.positions, mesh.indices);
        rays_.commit();
    }

    struct Surface {
        vec3 point, normal, albedo;
        float sheen;
    };

    bool hit(const vec3& origin, const vec3& direction, Surface& out) const {
        const auto found = rays_.first_hit(origin, direction, kFar);
        if (!found) return false;
        const RenderMesh& mesh = meshes_[found->mesh];
        const uint32_t* t = &mesh.indices[3 * size_t(found->triangle)];
        const float u = found->u, v = found->v, w = 1.0f - u - v;
        out.point = origin + direction * found->distance;
        out.normal = glm::normalize(mesh.normals[t[0]] * w + mesh.normals[t[1]] * u + mesh.normals[t[2]] * v);
        if (glm::dot(out.normal, direction) > 0.0f) out.normal = -out.normal;  // the inside of a cloth
        out.albedo = linear(mesh.color);
        if (!mesh.vertex_colors.empty())
            out.albedo = linear(mesh.vertex_colors[t[0]]) * w + linear(mesh.vertex_colors[t[1]]) * u +
                         linear(mesh.vertex_colors[t[2]]) * v;
        out.sheen = mesh.sheen;
        return true;
    }

    vec3 light(const Surface& s, const vec3& towards_eye, Noise& noise) const {
        const vec3 start = s.point + s.normal * kOffset;
        float key = 0.0f;
        for (int i = 0; i < kShadowRays; ++i) {
            const vec3 spread(noise.next() - 0.5f, noise.next() - 0.5f, noise.next() - 0.5f);
            const vec3 to_light = glm::normalize(kKeyLight + spread * (2.0f * kKeySpread));
            const float cosine = glm::dot(s.normal, to_light);
            if (cosine > 0.0f && !rays_.blocked(start, to_light, kShadowReach)) key += cosine;
        }
        float sky = 0.0f;
        for (int i = 0; i < kSkyRays; ++i) {
            const vec3 direction = cosine_direction(s.normal, noise);
            // Light from below is what the floor sends back.
            if (!rays_.blocked(start, direction, kShadowReach)) sky += direction.y > 0.0f ? 1.0f : 0.45f;
        }
        const float grazing = std::pow(1.0f - glm::clamp(glm::dot(s.normal, towards_eye), 0.0f, 1.0f), 4.0f);
        const vec3 diffuse = kKeyColor * (key / kShadowRays) + kSkyColor * (sky / kSkyRays);
        return s.albedo * diffuse + (kRimColor * 0.35f + s.albedo * s.sheen) * grazing * (sky / kSkyRays);
    }

private:
    const std::vector<RenderMesh>& meshes_;
    RayScene rays_;
};

class Camera {
public:
    explicit Camera(const RenderView& view) : eye_(view.eye) {
        forward_ = glm::normalize(view.target - view.eye);
        right_ = glm::normalize(glm::cross(forward_, vec3(0, 1, 0)));
        up_ = glm::cross(right_, forward_);
        tangent_ = std::tan(0.5f * view.fov_y_rad);
        half_width_ = 0.5f * float(view.width);
        half_height_ = 0.5f * float(view.height);
    }
    vec3 direction(float x, float y) const {
        const float s = tangent_ / half_height_;
        return glm::normalize(forward_ + right_ * ((x - half_width_) * s) - up_ * ((y - half_height_) * s));
    }
    const vec3& eye() const { return eye_; }
    /// How much closer the eye may come along its line of sight before the point leaves the picture; below
    /// zero: how far it has to step back.
    float room(const vec3& point) const {
        constexpr float kMargin = 0.04f;  // of the picture, on each side
        const vec3 to_point = point - eye_;
        const float s = (1.0f - 2.0f * kMargin) * tangent_ / half_height_;
        const float across = std::abs(glm::dot(to_point, right_)) / (s * half_width_);
        const float along = std::abs(glm::dot(to_point, up_)) / (s * half_height_);
        return glm::dot(to_point, forward_) - std::max(across, along);
    }

private:
    vec3 eye_, forward_, right_, up_;
    float tangent_, half_width_, half_height_;
};

vec3 trace(const Scene& scene, const RenderView& view, const vec3& eye, const vec3& direction, Noise& noise) {
    Scene::Surface surface;
    if (scene.hit(eye, direction, surface)) return scene.light(surface, -direction, noise);
    if (!view.floor || direction.y > -1e-3f) return backdrop(direction);
    const float distance = -eye.y / direction.y;
    surface = {eye + direction * distance, vec3(0, 1, 0), kFloorAlbedo, 0.0f};
    // The floor runs out into the backdrop, as the paper roll of a studio does.
    const float fade = glm::smoothstep(1.2f, 4.5f, glm::length(glm::vec2(surface.point.x, surface.point.z)));
    return glm::mix(scene.light(surface, -direction, noise), backdrop(direction), fade);
}

}  // namespace

void step_back_to_show(const std::vector<RenderMesh>& meshes, RenderView& view) {
    const Camera camera(view);
    float room = 0.0f;
    for (const RenderMesh& mesh : meshes)
        for (const vec3& p : mesh.positions) room = std::min(room, camera.room(p));
    view.eye += room * glm::normalize(view.target - view.eye);
}

Canvas render(const std::vector<RenderMesh>& meshes, const RenderView& view) {
    const Scene scene(meshes);
    const Camera camera(view);
    Canvas canvas(view.width, view.height);
    std::atomic<int> next_row{0};
    const auto rows = [&] {
        for (int y = next_row.fetch_add(1); y < view.height; y = next_row.fetch_add(1))
            for (int x = 0; x < view.width; ++x) {
                vec3 sum(0.0f);
                for (int k = 0; k < view.samples * view.samples; ++k) {
                    Noise noise(
                        static_cast<uint32_t>((y * view.width + x) * view.samples * view.samples + k));
                    const float sx = (float(k % view.samples) + noise.next()) / float(view.samples);
                    const float sy = (float(k / view.samples) + noise.next()) / float(view.samples);
                    const vec3 direction = camera.direction(float(x) + sx, float(y) + sy);
                    sum += trace(scene, view, camera.eye(), direction, noise);
                }
                canvas.set(x, y, shown(sum / float(view.samples * view.samples)));
            }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(rows);
    rows();
    for (std::thread& t : threads) t.join();
    return canvas;
}

}  // namespace vfit::tools
