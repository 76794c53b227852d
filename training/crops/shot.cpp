// A z-buffer: the triangles are a few pixels large, so a box and three edge functions each will do.
#include "shot.h"

#include <algorithm>
#include <cmath>

namespace vfit::training {

namespace {

constexpr float kNearest_m = 0.25f;

struct Projected {
    float u, v, inverse_z;
};

void draw(const Projected& a, const Projected& b, const Projected& c, float cosine, Shot& out,
          std::vector<float>& inverse) {
    const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    if (std::abs(area) < 1e-9f) return;
    const int x0 = std::max(0, int(std::ceil(std::min({a.u, b.u, c.u}))));
    const int y0 = std::max(0, int(std::ceil(std::min({a.v, b.v, c.v}))));
    const int x1 = std::min(int(out.camera.width) - 1, int(std::floor(std::max({a.u, b.u, c.u}))));
    const int y1 = std::min(int(out.camera.height) - 1, int(std::floor(std::max({a.v, b.v, c.v}))));
    const float scale = 1.0f / area;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const float wa = ((b.u - x) * (c.v - y) - (b.v - y) * (c.u - x)) * scale;
            const float wb = ((c.u - x) * (a.v - y) - (c.v - y) * (a.u - x)) * scale;
            const float wc = 1.0f - wa - wb;
            if (wa < 0.0f || wb < 0.0f || wc < 0.0f) continue;
            const float inverse_z = wa * a.inverse_z + wb * b.inverse_z + wc * c.inverse_z;
            const size_t i = out.index(x, y);
            if (inverse_z <= inverse[i]) continue;
            inverse[i] = inverse_z;
            out.cosine[i] = cosine;
        }
}

}  // namespace

bool take_shot(const Mesh& mesh, const Camera& camera, int margin, Shot& out) {
    thread_local std::vector<Vec3> seen;
    thread_local std::vector<Projected> pixels;
    thread_local std::vector<float> inverse;
    const Mat4 to_camera = camera.camera_from_world();
    const size_t count = mesh.positions.size();
    seen.resize(count), pixels.resize(count);
    float u0 = 1e9f, v0 = 1e9f, u1 = -1e9f, v1 = -1e9f;
    for (size_t i = 0; i < count; ++i) {
        const Vec3 p = seen[i] = transform_point(to_camera, mesh.positions[i]);
        if (p.z < kNearest_m) continue;
        const Vec2 q = camera.project(p);
        pixels[i] = {q.x, q.y, 1.0f / p.z};
        u0 = std::min(u0, q.x), u1 = std::max(u1, q.x), v0 = std::min(v0, q.y), v1 = std::max(v1, q.y);
    }
    const int left = std::max(0, int(u0) - margin), top = std::max(0, int(v0) - margin);
    const int right = std::min(int(camera.width), int(u1) + margin + 1);
    const int bottom = std::min(int(camera.height), int(v1) + margin + 1);
    if (right - left < 8 || bottom - top < 8) return false;

    out.camera = camera;
    out.camera.width = uint32_t(right - left), out.camera.height = uint32_t(bottom - top);
    out.camera.cx -= float(left), out.camera.cy -= float(top);
    const size_t n = size_t(out.camera.width) * out.camera.height;
    inverse.assign(n, 0.0f);
    out.cosine.assign(n, 0.0f);
    for (size_t i = 0; i < count; ++i) pixels[i].u -= float(left), pixels[i].v -= float(top);
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
        const Vec3 &pa = seen[a], &pb = seen[b], &pc = seen[c];
        if (pa.z < kNearest_m || pb.z < kNearest_m || pc.z < kNearest_m) continue;
        const Vec3 normal = glm::cross(pb - pa, pc - pa);
        const float length = glm::length(normal) * glm::length(pa);
        if (length <= 0.0f) continue;
        draw(pixels[a], pixels[b], pixels[c], std::abs(glm::dot(normal, pa)) / length, out, inverse);
    }
    out.depth_m.resize(n);
    size_t covered = 0;
    for (size_t i = 0; i < n; ++i) {
        out.depth_m[i] = inverse[i] > 0.0f ? 1.0f / inverse[i] : 0.0f;
        covered += inverse[i] > 0.0f;
    }
    return covered >= 200;
}

}  // namespace vfit::training
