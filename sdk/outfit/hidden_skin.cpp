#include "outfit/hidden_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>

#include "body/mesh.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr float kSteepest =
    -0.7071068f;  // sine of the rays' slope: nobody looks up under a skirt more steeply
constexpr float kFar_m = 3.0f;
constexpr int kRays = 64;
constexpr uint32_t kChunk = 256;  // vertices of a job

/// Over the hemisphere about +Z, but for what grazes; evenly (a Fibonacci lattice).
std::array<Vec3, kRays> hemisphere() {
    constexpr float kLowest = 0.05f;
    const float golden = kPi * (3.0f - std::sqrt(5.0f));
    std::array<Vec3, kRays> rays;
    for (int i = 0; i < kRays; ++i) {
        const float z = 1.0f - (1.0f - kLowest) * (float(i) + 0.5f) / float(kRays),
                    r = std::sqrt(1.0f - z * z), turn = golden * float(i);
        rays[size_t(i)] = {r * std::cos(turn), r * std::sin(turn), z};
    }
    return rays;
}

/// The hemisphere's rays about a normal.
Mat3 axes_about(const Vec3& normal) {
    const Vec3 side =
        glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    return Mat3(side, glm::cross(normal, side), normal);
}

/// skin: null, or it hides as well.
bool is_enclosed(const MeshQuery& garment, const MeshQuery* skin, const std::array<Vec3, kRays>& rays,
                 const Vec3& p, const Vec3& normal) {
    constexpr float kOff_m = 1e-3f;
    const Mat3 axes = axes_about(normal);
    int by_garment = 0, by_skin = 0;
    for (const Vec3& ray : rays) {
        const Vec3 outward = axes * ray;
        if (outward.y <= kSteepest) continue;
        if (garment.cast(p, outward, kFar_m))
            ++by_garment;
        else if (skin && skin->cast(p + kOff_m * normal, outward, kFar_m))
            ++by_skin;
        else
            return false;
    }
    return by_garment >= by_skin;  // a mouth is hidden by no garment
}

/// Along the mesh's edges from each vertex to the nearest that is seen; found as far as most_m.
std::vector<float> distances_to_seen(const Covered& c, const std::vector<uint8_t>& enclosed, float most_m) {
    struct Neighbour {
        uint32_t vertex;
        float distance;
    };
    std::vector<std::vector<Neighbour>> neighbours(c.body.size());
    for (size_t i = 0; i + 2 < c.body_indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = c.body_indices[i + k], b = c.body_indices[i + (k + 1) % 3];
            const float length = glm::length(c.body[a] - c.body[b]);
            neighbours[a].push_back({b, length}), neighbours[b].push_back({a, length});
        }
    std::vector<float> distances(c.body.size(), INFINITY);
    using Item = std::pair<float, uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    for (uint32_t v = 0; v < enclosed.size(); ++v)
        if (!enclosed[v]) open.emplace(distances[v] = 0.0f, v);
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > distances[v] || distance > most_m) continue;
        for (const Neighbour& n : neighbours[v])
            if (distance + n.distance < distances[n.vertex])
                open.emplace(distances[n.vertex] = distance + n.distance, n.vertex);
    }
    return distances;
}

}  // namespace

std::vector<float> cover_of(const Covered& covered, Jobs& jobs) {
    const std::vector<Vec3> body(covered.body.begin(), covered.body.end());
    std::vector<Vec3> normals;
    compute_normals(body, {covered.body_indices.begin(), covered.body_indices.end()}, normals);
    const MeshQuery garment(covered.garment, covered.garment_indices);
    const std::array<Vec3, kRays> rays = hemisphere();
    const uint32_t count = uint32_t(body.size());
    std::vector<float> cover(count);
    parallel_for(jobs, (count + kChunk - 1) / kChunk, [&](uint32_t chunk) {
        for (uint32_t v = chunk * kChunk; v < std::min(count, (chunk + 1) * kChunk); ++v) {
            const Mat3 axes = axes_about(normals[v]);
            int hits = 0;
            for (const Vec3& ray : rays) hits += garment.cast(body[v], axes * ray, kFar_m).has_value();
            cover[v] = float(hits) / float(kRays);
        }
    });
    return cover;
}

std::vector<uint8_t> hidden_triangles(const Covered& covered, float margin_m, Jobs& jobs) {
    const std::vector<Vec3> body(covered.body.begin(), covered.body.end());
    std::vector<Vec3> normals;
    compute_normals(body, {covered.body_indices.begin(), covered.body_indices.end()}, normals);
    const MeshQuery garment(covered.garment, covered.garment_indices);
    std::optional<MeshQuery> skin;
    if (covered.skin_hides) skin.emplace(covered.body, covered.body_indices);
    const std::array<Vec3, kRays> rays = hemisphere();
    const uint32_t count = uint32_t(body.size());
    std::vector<uint8_t> enclosed(count);
    parallel_for(jobs, (count + kChunk - 1) / kChunk, [&](uint32_t chunk) {
        for (uint32_t v = chunk * kChunk; v < std::min(count, (chunk + 1) * kChunk); ++v)
            enclosed[v] = is_enclosed(garment, skin ? &*skin : nullptr, rays, body[v], normals[v]);
    });
    const std::vector<float> to_seen = distances_to_seen(covered, enclosed, margin_m);
    std::vector<uint8_t> hidden(covered.body_indices.size() / 3);
    for (size_t t = 0; t < hidden.size(); ++t) {
        const uint32_t* v = &covered.body_indices[3 * t];
        hidden[t] = std::min({to_seen[v[0]], to_seen[v[1]], to_seen[v[2]]}) > margin_m;
    }
    return hidden;
}

}  // namespace vfit
