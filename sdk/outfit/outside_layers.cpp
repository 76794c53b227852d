#include "outfit/outside_layers.h"

#include <algorithm>
#include <utility>

#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr float kFurthest_m = 0.15f;  // beyond a vertex; what is further off is another limb
constexpr float kFold_m = 0.04f;      // no wider is a fold open
constexpr float kSlope = 1.0f;        // of an edge, by which the ways of its ends differ, at most
constexpr float kAlong = 0.5f;        // cosine between ways that are about the same limb
constexpr float kPast_m = 1e-4f;      // a hit, where a ray goes on
constexpr int kRounds = 3;

struct Ray {
    Vec3 from, way;
    float length_m;
};

std::vector<Ray> rays_to(const AboutBones& garment) {
    std::vector<Ray> out;
    for (size_t v = 0; v < garment.positions.size(); ++v) {
        const Vec3 off = garment.positions[v] - garment.on_bones[v];
        const float length_m = glm::length(off);
        out.push_back({garment.on_bones[v], off / std::max(length_m, 1e-6f), length_m});
    }
    return out;
}

/// Where a ray from within the mesh comes out of it and of its folds; 0: nowhere.
float last_exit(const MeshQuery& mesh, const Ray& ray) {
    const float far_m = ray.length_m + kFurthest_m;
    float at = 0.0f, exit = 0.0f;
    while (at < far_m) {
        const auto hit = mesh.cast(ray.from + at * ray.way, ray.way, far_m - at);
        if (!hit) break;
        at += hit->distance;
        if (glm::dot(hit->normal, ray.way) > 0.0f)
            exit = at;
        else if (exit == 0.0f || at > exit + kFold_m)
            break;  // it comes to another part
        at += kPast_m;
    }
    return exit;
}

/// Moves the vertices of one garment along their rays until it is outside of others.
class Outside {
public:
    Outside(const AboutBones& garment, float clearance_m)
        : garment_(garment),
          clearance_m_(clearance_m),
          rays_(rays_to(garment)),
          ways_m_(rays_.size(), 0.0f),
          places_(garment.positions.begin(), garment.positions.end()) {}

    /// Its vertices past the triangles of another.
    void pass(const MeshQuery& other) {
        for (size_t v = 0; v < rays_.size(); ++v)
            if (const float exit = last_exit(other, rays_[v]); exit > 0.0f)
                ways_m_[v] = std::max(ways_m_[v], exit + clearance_m_ - rays_[v].length_m);
    }

    /// Its triangles past the vertices of another. False: they were.
    bool pass(const AboutBones& other, const MeshQuery& moved) {
        std::vector<float> more_m(rays_.size(), 0.0f);
        bool any = false;
        for (const Ray& ray : rays_to(other)) {
            const auto hit = moved.cast(ray.from, ray.way, ray.length_m + 0.5f * clearance_m_);
            if (!hit || hit->distance < ray.length_m - kFurthest_m || glm::dot(hit->normal, ray.way) < kAlong)
                continue;
            any = true;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t v = garment_.indices[3 * hit->triangle + k];
                if (glm::dot(rays_[v].way, ray.way) > kAlong)
                    more_m[v] = std::max(more_m[v], ray.length_m + clearance_m_ - hit->distance);
            }
        }
        for (size_t v = 0; v < rays_.size(); ++v)
            ways_m_[v] = std::max(ways_m_[v], std::min(ways_m_[v] + more_m[v], kFurthest_m));
        return any;
    }

    const std::vector<Vec3>& move() {
        spread();
        for (size_t v = 0; v < rays_.size(); ++v)
            places_[v] = garment_.positions[v] + ways_m_[v] * rays_[v].way;
        return places_;
    }

private:
    /// So that no edge gets much steeper: what hangs below a hem goes along, instead of catching there.
    void spread() {
        for (bool any = true; any;) {
            any = false;
            for (size_t i = 0; i < garment_.indices.size(); ++i) {
                const uint32_t a = garment_.indices[i], b = garment_.indices[i % 3 == 2 ? i - 2 : i + 1];
                const float most_m = kSlope * glm::distance(garment_.positions[a], garment_.positions[b]);
                for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
                    if (ways_m_[to] >= ways_m_[from] - most_m) continue;
                    ways_m_[to] = ways_m_[from] - most_m;
                    any = true;
                }
            }
        }
    }

    const AboutBones& garment_;
    const float clearance_m_;
    std::vector<Ray> rays_;
    std::vector<float> ways_m_;
    std::vector<Vec3> places_;
};

}  // namespace

std::vector<Vec3> outside_of(std::span<const AboutBones> inner, const AboutBones& outer, float clearance_m) {
    Outside outside(outer, clearance_m);
    for (const AboutBones& garment : inner) outside.pass(MeshQuery(garment.positions, garment.indices));
    std::vector<Vec3> places = outside.move();
    MeshQuery moved(places, outer.indices);
    for (int round = 0; round < kRounds; ++round) {
        bool any = false;
        for (const AboutBones& garment : inner) any = outside.pass(garment, moved) || any;
        if (!any) break;
        places = outside.move();
        moved.update(places);
    }
    return places;
}

}  // namespace vfit
