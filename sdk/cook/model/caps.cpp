#include "cook/model/caps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace vfit {

namespace {

using Side = std::pair<uint32_t, uint32_t>;

class CapFinder {
public:
    explicit CapFinder(const Soup& soup) : soup_(soup) {
        for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const auto& v = soup.triangles[t].vertex;
            const Vec3 across =
                glm::cross(soup.places[v[1]] - soup.places[v[0]], soup.places[v[2]] - soup.places[v[0]]);
            const float length = glm::length(across);
            area_.push_back(0.5f * length);
            normal_.push_back(length > 0.0f ? across / length : Vec3(0.0f));
            for (size_t k = 0; k < 3; ++k) sides_[std::minmax(v[k], v[(k + 1) % 3])].push_back(t);
        }
    }

    std::vector<std::vector<uint32_t>> run() {
        std::vector<std::vector<uint32_t>> out;
        std::vector<uint8_t> taken(soup_.triangles.size(), 0);
        // Edges may be rounded.
        for (const float sharp : {0.5f, 0.77f, 0.9f}) {
            make_patches(sharp);
            for (const auto& [root, patch] : patches_) {
                if (taken[root] || !is_cap(root, patch)) continue;
                std::vector<uint32_t> cap = patch;
                for (const uint32_t t : pit_about(root, patch)) cap.push_back(t);
                std::erase_if(cap, [&](uint32_t t) { return taken[t] != 0; });
                for (const uint32_t t : cap) taken[t] = 1;
                out.push_back(std::move(cap));
            }
        }
        return out;
    }

private:
    uint32_t root(uint32_t t) {
        while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
        return t;
    }

    /// Between sharp edges.
    void make_patches(float cosine) {
        patches_.clear();
        parent_.resize(soup_.triangles.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (const auto& [side, of] : sides_)
            if (of.size() == 2 && glm::dot(normal_[of[0]], normal_[of[1]]) > cosine)
                parent_[root(of[0])] = root(of[1]);
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t) patches_[root(t)].push_back(t);
    }

    bool is_cap(uint32_t of, const std::vector<uint32_t>& patch) {
        constexpr float kMinRing_m = 0.12f, kMaxRing_m = 2.5f, kFlat = 1.8f;
        // Collars and cuffs have ragged edges; what is as large as a waist has not, or is a panel.
        constexpr float kRound = 0.35f, kWaist_m2 = 0.03f, kRoundWaist = 0.7f;
        std::set<uint32_t> vertices;
        std::set<Side> all, ring;
        std::map<uint32_t, int> on_ring;
        float area = 0.0f;
        for (const uint32_t t : patch) {
            area += area_[t];
            const auto& v = soup_.triangles[t].vertex;
            for (size_t k = 0; k < 3; ++k) {
                const Side side = std::minmax(v[k], v[(k + 1) % 3]);
                vertices.insert(v[k]);
                all.insert(side);
                const auto& beside = sides_.at(side);
                if (beside.size() != 2) return false;  // it ends there, or is joined to several
                if (root(beside[0]) == of && root(beside[1]) == of) continue;
                ring.insert(side);
            }
        }
        float around = 0.0f;
        Vec3 middle(0.0f);
        for (const Side& side : ring) {
            ++on_ring[side.first], ++on_ring[side.second];
            around += glm::length(soup_.places[side.second] - soup_.places[side.first]);
            middle += (soup_.places[side.first] + soup_.places[side.second]) / (2.0f * float(ring.size()));
        }
        // A disc, about round and flat.
        if (int(vertices.size()) - int(all.size()) + int(patch.size()) != 1) return false;
        if (around < kMinRing_m || around > kMaxRing_m) return false;
        const float of_circle = area * 4.0f * kPi / (around * around);
        if (of_circle < (area > kWaist_m2 ? kRoundWaist : kRound) || of_circle > kFlat) return false;
        if (!std::all_of(on_ring.begin(), on_ring.end(), [](const auto& v) { return v.second == 2; }))
            return false;
        return lies_across(of, patch, on_ring);
    }

    /// Square to the cloth about it, as the lid of a pocket or a button is not.
    bool lies_across(uint32_t of, const std::vector<uint32_t>& patch, const std::map<uint32_t, int>& ring) {
        constexpr float kAbout_m = 0.05f, kAcross = 0.5f;
        Vec3 sum(0.0f);
        for (const uint32_t t : patch) sum += area_[t] * normal_[t];
        if (!(glm::length(sum) > 0.0f)) return false;
        const Vec3 along = glm::normalize(sum);
        std::set<uint32_t> seen(patch.begin(), patch.end());
        std::vector<uint32_t> open(patch);
        double across = 0.0, weight = 0.0;
        while (!open.empty()) {
            const uint32_t t = open.back();
            open.pop_back();
            const auto& v = soup_.triangles[t].vertex;
            for (size_t k = 0; k < 3; ++k)
                for (const uint32_t other : sides_.at(std::minmax(v[k], v[(k + 1) % 3]))) {
                    if (root(other) == of || !seen.insert(other).second) continue;
                    const Vec3 at = middle_of(other);
                    float off = INFINITY;
                    for (const auto& [vertex, count] : ring)
                        off = std::min(off, glm::length(soup_.places[vertex] - at));
                    if (off > kAbout_m) continue;
                    across += double(area_[other] * std::abs(glm::dot(normal_[other], along)));
                    weight += double(area_[other]);
                    open.push_back(other);
                }
        }
        return weight > 0.0 && across < double(kAcross) * weight;
    }

    /// The walls of a pit of which the cap is the floor: a band that looks inwards.
    std::vector<uint32_t> pit_about(uint32_t of, const std::vector<uint32_t>& patch) {
        constexpr float kInwards = 0.5f, kDeep_m = 0.3f;
        Vec3 middle(0.0f), along(0.0f);
        float area = 0.0f;
        for (const uint32_t t : patch) {
            middle += area_[t] * middle_of(t), along += area_[t] * normal_[t];
            area += area_[t];
        }
        middle /= area;
        along = glm::normalize(along);
        std::set<uint32_t> beside;
        for (const uint32_t t : patch) {
            const auto& v = soup_.triangles[t].vertex;
            for (size_t k = 0; k < 3; ++k)
                for (const uint32_t other : sides_.at(std::minmax(v[k], v[(k + 1) % 3])))
                    if (root(other) != of) beside.insert(root(other));
        }
        std::vector<uint32_t> out;
        for (const uint32_t wall : beside) {
            float inwards = 0.0f, all = 0.0f, deep_m = 0.0f;
            for (const uint32_t t : patches_.at(wall)) {
                const Vec3 off = middle_of(t) - middle, up = glm::dot(off, along) * along;
                if (glm::length(off - up) > 0.0f)
                    inwards -= area_[t] * glm::dot(normal_[t], glm::normalize(off - up));
                all += area_[t];
                deep_m = std::max(deep_m, glm::length(up));
            }
            if (inwards > kInwards * all && deep_m < kDeep_m)
                out.insert(out.end(), patches_.at(wall).begin(), patches_.at(wall).end());
        }
        return out;
    }
    Vec3 middle_of(uint32_t t) const {
        const auto& v = soup_.triangles[t].vertex;
        return (soup_.places[v[0]] + soup_.places[v[1]] + soup_.places[v[2]]) / 3.0f;
    }

    const Soup& soup_;
    std::vector<float> area_;
    std::vector<Vec3> normal_;
    std::map<Side, std::vector<uint32_t>> sides_;
    std::vector<uint32_t> parent_;
    std::map<uint32_t, std::vector<uint32_t>> patches_;
};

}  // namespace

std::vector<std::vector<uint32_t>> find_caps(const Soup& soup) { return CapFinder(soup).run(); }

Soup without(const Soup& soup, const std::vector<std::vector<uint32_t>>& lists) {
    std::vector<uint8_t> left_out(soup.triangles.size(), 0);
    for (const auto& list : lists)
        for (const uint32_t t : list) left_out[t] = 1;
    Soup out = soup;
    out.triangles.clear();
    for (size_t t = 0; t < soup.triangles.size(); ++t)
        if (!left_out[t]) out.triangles.push_back(soup.triangles[t]);
    return out;
}

}  // namespace vfit
