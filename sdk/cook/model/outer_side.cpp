#include "cook/model/outer_side.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr float kThick_m = 0.02f;
constexpr size_t kDirections = 64;
constexpr float kOff_m = 3e-4f, kFar_m = 4.0f;

std::vector<Vec3> directions() {
    std::vector<Vec3> out;  // a spiral about the sphere, evenly
    const float turn = kPi * (3.0f - std::sqrt(5.0f));
    for (size_t i = 0; i < kDirections; ++i) {
        const float y = 1.0f - 2.0f * (float(i) + 0.5f) / float(kDirections), r = std::sqrt(1.0f - y * y);
        out.emplace_back(r * std::cos(turn * float(i)), y, r * std::sin(turn * float(i)));
    }
    return out;
}

/// Triangles that face about the same way in a cell.
struct Patch {
    Vec3 area{0.0f};
    float largest = 0.0f;  // of its triangles
    Vec3 at{0.0f}, normal{0.0f};
    float front = 0.0f, back = 0.0f;  // share of the ways that lead out
    float out(bool along_normal) const { return along_normal ? front : back; }
};

class OuterSideFinder {
public:
    OuterSideFinder(const Soup& soup, float cell_m)
        : soup_(soup), cell_m_(cell_m), indices_(soup.indices()), query_(soup.places, indices_) {}

    OuterSide run() {
        make_patches();
        look_out();
        turn_outwards();
        OuterSide out;
        std::vector<Facet> facets(patches_.size(), {Vec3(0.0f), Vec3(0.0f)});
        std::vector<float> weight(patches_.size(), 0.0f);
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            if (area_[t] == 0.0f) continue;
            const bool along = outwards_[component(t)] > 0.0f;
            if (is_inner(t, along)) continue;
            const uint32_t* v = &indices_[3 * size_t(t)];
            out.indices.insert(out.indices.end(), {v[0], along ? v[1] : v[2], along ? v[2] : v[1]});
            if (const int steps = steps_of(t); steps > 1) {
                add_parts(t, steps, along, out.facets);
                continue;
            }
            Facet& facet = facets[patch_of_[t]];
            facet.area += (along ? 1.0f : -1.0f) * area_[t] * normal_[t];
            facet.at += area_[t] * middle(t);
            weight[patch_of_[t]] += area_[t];
        }
        for (size_t p = 0; p < facets.size(); ++p)
            if (weight[p] > 0.0f) out.facets.push_back({facets[p].at / weight[p], facets[p].area});
        return out;
    }

private:
    Vec3 corner(uint32_t t, size_t k) const { return soup_.places[indices_[3 * size_t(t) + k]]; }
    Vec3 middle(uint32_t t) const { return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0f; }

    /// How many times larger than a patch its sides are.
    int steps_of(uint32_t t) const {
        constexpr float kMaxSteps = 64.0f;
        const float longest =
            std::max({glm::length(corner(t, 1) - corner(t, 0)), glm::length(corner(t, 2) - corner(t, 1)),
                      glm::length(corner(t, 0) - corner(t, 2))});
        return int(std::clamp(std::ceil(longest / cell_m_), 1.0f, kMaxSteps));
    }
    /// A large triangle as facets that are as small as the others.
    void add_parts(uint32_t t, int steps, bool along, std::vector<Facet>& out) const {
        const Vec3 u = (corner(t, 1) - corner(t, 0)) / float(steps),
                   v = (corner(t, 2) - corner(t, 0)) / float(steps),
                   area = (along ? 1.0f : -1.0f) * area_[t] / float(steps * steps) * normal_[t];
        for (int i = 0; i < steps; ++i)
            for (int j = 0; i + j < steps; ++j) {
                const Vec3 at = corner(t, 0) + float(i) * u + float(j) * v;
                out.push_back({at + (u + v) / 3.0f, area});
                if (i + j + 1 < steps) out.push_back({at + 2.0f * (u + v) / 3.0f, area});
            }
    }

    void make_patches() {
        std::map<std::tuple<int, int, int, int>, uint32_t> known;
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const Vec3 across = glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
            const float area2 = glm::length(across);
            area_.push_back(0.5f * area2);
            normal_.push_back(area2 > 0.0f ? across / area2 : Vec3(0.0f));
            const Vec3& n = normal_.back();
            const Vec3 size = glm::abs(n);
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const glm::ivec3 cell(glm::floor(middle(t) / cell_m_));
            const auto [it, fresh] = known.try_emplace({cell.x, cell.y, cell.z, 2 * axis + (n[axis] < 0.0f)},
                                                       uint32_t(patches_.size()));
            if (fresh) patches_.emplace_back();
            Patch& patch = patches_[it->second];
            patch.area += area_[t] * n;
            if (area_[t] > patch.largest) patch.largest = area_[t], patch.at = middle(t), patch.normal = n;
            patch_of_.push_back(it->second);
        }
    }

    void look_out() {
        const std::vector<Vec3> all = directions();
        for (Patch& patch : patches_) {
            if (patch.largest == 0.0f) continue;
            constexpr float kGrazing = 0.15f;
            float front = 0.0f, back = 0.0f;
            for (const Vec3& d : all) {
                const float up = glm::dot(d, patch.normal);
                if (std::abs(up) < kGrazing) continue;
                const Vec3 from = patch.at + patch.normal * (up > 0.0f ? kOff_m : -kOff_m);
                if (query_.cast(from, d, kFar_m)) continue;
                (up > 0.0f ? front : back) += 1.0f;
            }
            patch.front = 2.0f * front / float(kDirections), patch.back = 2.0f * back / float(kDirections);
        }
    }

    /// Triangles that are joined and run along their common sides in opposite directions are turned alike.
    void turn_outwards() {
        parent_.resize(soup_.triangles.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        std::map<std::pair<uint32_t, uint32_t>, std::pair<uint32_t, uint32_t>> sides;  // triangle, how many
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                auto& side = sides[{indices_[3 * size_t(t) + k], indices_[3 * size_t(t) + (k + 1) % 3]}];
                side.first = t, ++side.second;
            }
        for (const auto& [side, of] : sides) {
            const auto other = sides.find({side.second, side.first});
            if (of.second != 1 || other == sides.end() || other->second.second != 1) continue;
            parent_[component(of.first)] = component(other->second.first);
        }
        outwards_.assign(soup_.triangles.size(), 0.0f);
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const Patch& patch = patches_[patch_of_[t]];
            const float same = glm::dot(patch.normal, normal_[t]) < 0.0f ? -1.0f : 1.0f;
            outwards_[component(t)] += same * area_[t] * (patch.front - patch.back);
        }
    }
    uint32_t component(uint32_t t) {
        while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
        return t;
    }

    /// Another layer lies behind it, which is less hidden on its far side.
    bool is_inner(uint32_t t, bool along_normal) const {
        const Vec3 inwards = along_normal ? -normal_[t] : normal_[t];
        // A layer may lie as close as rounding allows, so its own triangle is met as well.
        constexpr float kNext_m = 2e-6f;
        auto hit = query_.cast(middle(t), inwards, kThick_m);
        for (float off = kNext_m; hit && hit->triangle == t && off < kOff_m; off *= 4.0f)
            hit = query_.cast(middle(t) + inwards * off, inwards, kThick_m);
        if (!hit || hit->triangle == t) return false;
        const auto out = [&](uint32_t of, const Vec3& way) {
            const Patch& patch = patches_[patch_of_[of]];
            return patch.out(glm::dot(patch.normal, way) > 0.0f);
        };
        return out(t, -inwards) < out(hit->triangle, inwards);
    }

    const Soup& soup_;
    float cell_m_;
    std::vector<uint32_t> indices_;
    MeshQuery query_;
    std::vector<Patch> patches_;
    std::vector<uint32_t> patch_of_, parent_;  // of each triangle
    std::vector<float> area_, outwards_;
    std::vector<Vec3> normal_;
};

}  // namespace

OuterSide outer_side(const Soup& soup, float cell_m) { return OuterSideFinder(soup, cell_m).run(); }

}  // namespace vfit
