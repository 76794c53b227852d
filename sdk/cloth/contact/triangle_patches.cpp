#include "cloth/contact/triangle_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "cloth/base/triangles_about.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr uint32_t kPatchesOfAJob = 64;
// Normals of one cone, 75 degrees from its axis: beyond, a patch may fold onto itself.
constexpr float kConeCosine = 0.26f;

/// Divides at the median of the longest side, so that registers and blocks of them (powers of eight) are
/// compact.
void sort_in_space(const std::vector<Vec3>& places, std::span<uint32_t> which) {
    if (which.size() <= kLanes) return;
    Bounds box;
    for (const uint32_t i : which) box.add(places[i]);
    const Vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    size_t block = kLanes;
    while (block * kLanes <= which.size() / 2) block *= kLanes;
    const size_t middle = std::max(block, which.size() / 2 / block * block);
    std::nth_element(which.begin(), which.begin() + std::ptrdiff_t(middle), which.end(),
                     [&](uint32_t a, uint32_t b) {
                         return std::pair(places[a][axis], a) < std::pair(places[b][axis], b);
                     });
    sort_in_space(places, which.first(middle));
    sort_in_space(places, which.subspan(middle));
}

std::vector<Vec3> middles_of(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    std::vector<Vec3> middles;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Vec3 sum = positions[indices[i]] + positions[indices[i + 1]] + positions[indices[i + 2]];
        middles.push_back(finite(sum) ? sum / 3.0f : Vec3(0.0f));
    }
    return middles;
}

/// Grows connected patches: each from the triangle that has the fewest neighbours left, by those closest to
/// it.
class Growth {
public:
    Growth(std::span<const Vec3> positions, std::span<const uint32_t> indices)
        : indices_(indices), about_(positions.size(), indices), middles_(middles_of(positions, indices)) {
        is_taken_.assign(middles_.size(), 0);
        border_.assign(1, 0);
        for (uint32_t next = 0; next < middles_.size();) {
            if (is_taken_[next]) {
                ++next;
                continue;
            }
            grow(border_seed(next));
        }
    }
    /// Triangles patch by patch, and where each patch ends; patches that follow each other lie together.
    void list(std::vector<uint32_t>& triangles, std::vector<uint32_t>& ends) const {
        std::vector<Vec3> middles;
        std::vector<uint32_t> patches;
        for (uint32_t patch = 0; patch < ends_.size(); ++patch) {
            patches.push_back(patch);
            middles.push_back(middles_[order_[begin_of(patch)]]);
        }
        sort_in_space(middles, patches);
        for (const uint32_t patch : patches) {
            triangles.insert(triangles.end(), order_.begin() + begin_of(patch),
                             order_.begin() + ends_[patch]);
            ends.push_back(uint32_t(triangles.size()));
        }
    }

private:
    uint32_t begin_of(uint32_t patch) const { return patch == 0 ? 0 : ends_[patch - 1]; }
    /// A free triangle beside the patches so far: between them no islands are left.
    uint32_t border_seed(uint32_t otherwise) {
        while (border_seen_ < border_.size())
            if (const uint32_t t = border_[border_seen_++]; !is_taken_[t]) return t;
        return otherwise;
    }
    void grow(uint32_t seed) {
        std::vector<uint32_t> beside{seed};
        for (size_t size = 0; size < kLanes; ++size) {
            auto next = beside.end();
            float best = INFINITY;
            for (auto it = beside.begin(); it != beside.end(); ++it) {
                const Vec3 way = middles_[*it] - middles_[seed];
                if (is_taken_[*it] || glm::dot(way, way) >= best) continue;
                next = it, best = glm::dot(way, way);
            }
            if (next == beside.end()) break;
            const uint32_t t = *next;
            is_taken_[t] = 1;
            order_.push_back(t);
            for (size_t k = 0; k < 3; ++k)
                for (const uint32_t other : about_.of(indices_[3 * t + k]))
                    if (!is_taken_[other]) beside.push_back(other);
        }
        ends_.push_back(uint32_t(order_.size()));
        for (const uint32_t t : beside)
            if (!is_taken_[t]) border_.push_back(t);
    }

    std::span<const uint32_t> indices_;
    TrianglesAbout about_;
    std::vector<Vec3> middles_;
    std::vector<uint8_t> is_taken_;
    std::vector<uint32_t> border_, order_, ends_;
    size_t border_seen_ = 0;
};

/// Cosine of the sum of two angles; -1 where it may be more than 180 degrees.
float cosine_of_sum(float a, float b) {
    if (a <= 0.0f && b <= 0.0f) return -1.0f;
    return a * b - std::sqrt(std::max(0.0f, 1.0f - a * a)) * std::sqrt(std::max(0.0f, 1.0f - b * b));
}

Vec3 farther(const Vec3& a, const Vec3& b) { return glm::max(glm::abs(a), glm::abs(b)); }

}  // namespace

bool TrianglePatches::Pair::shares_vertex() const {
    return std::any_of(first->vertex, first->vertex + 3, [&](uint32_t v) {
        return v == second->vertex[0] || v == second->vertex[1] || v == second->vertex[2];
    });
}

TrianglePatches::TrianglePatches(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                                 uint32_t first_vertex) {
    std::vector<uint32_t> order;
    Growth(positions, indices).list(order, ends_);
    for (const uint32_t t : order)
        triangles_.push_back({{first_vertex + indices[3 * t], first_vertex + indices[3 * t + 1],
                               first_vertex + indices[3 * t + 2]},
                              t,
                              0,
                              0,
                              0});
    patches_.resize(ends_.size());
    boxes_.resize(ends_.size());
    moving_.resize(ends_.size());
    for (uint32_t patch = 0; patch < ends_.size(); ++patch) {
        for (uint32_t t = begin_of(patch); t < ends_[patch]; ++t) triangles_[t].patch = patch;
        Corners& corners = corners_.emplace_back();
        for (uint32_t k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < kLanes; ++i)
                corners.at[k][i] = triangles_[std::min(begin_of(patch) + i, ends_[patch] - 1)].vertex[k];
    }
    shares_.resize((ends_.size() + kPatchesOfAJob - 1) / kPatchesOfAJob);
    list_owners(first_vertex + positions.size());
    if (first_vertex == 0) list_adjacent(positions.size());
}

void TrianglePatches::list_owners(size_t vertices) {
    std::vector<uint8_t> seen(vertices, 0);
    std::vector<uint32_t> ends(vertices, 0);  // of the edges that are filed under each vertex, the lower one
    const auto edge = [](const Triangle& t, uint32_t k) {
        return std::minmax(t.vertex[k], t.vertex[(k + 1) % 3]);
    };
    for (const Triangle& t : triangles_)
        for (uint32_t k = 0; k < 3; ++k) ++ends[edge(t, k).first];
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), 0u);
    const std::vector<uint32_t> begins = ends;
    std::vector<uint32_t> higher(3 * triangles_.size());
    for (Triangle& t : triangles_)
        for (uint32_t k = 0; k < 3; ++k) {
            if (!seen[t.vertex[k]]) t.own_vertices |= uint8_t(1u << k);
            seen[t.vertex[k]] = 1;
            const auto [low, high] = edge(t, k);
            const auto filed = higher.begin() + begins[low], end = higher.begin() + ends[low];
            if (std::find(filed, end, high) != end) continue;
            t.own_edges |= uint8_t(1u << k);
            *end = high;
            ++ends[low];
        }
}

void TrianglePatches::list_adjacent(size_t vertices) {
    std::vector<uint32_t> corners, patch_of(triangles_.size());
    for (const Triangle& t : triangles_) corners.insert(corners.end(), t.vertex, t.vertex + 3);
    const TrianglesAbout about(vertices, corners);
    const auto count = uint32_t(ends_.size());
    for (uint32_t patch = 0; patch < count; ++patch)
        std::fill(patch_of.begin() + begin_of(patch), patch_of.begin() + ends_[patch], patch);
    first_adjacent_.assign(1, 0);
    for (uint32_t patch = 0; patch < count; ++patch) {
        const auto first = std::ptrdiff_t(adjacent_.size());
        for (uint32_t i = 3 * begin_of(patch); i < 3 * ends_[patch]; ++i)
            for (const uint32_t other : about.of(corners[i])) adjacent_.push_back(patch_of[other]);
        std::sort(adjacent_.begin() + first, adjacent_.end());
        adjacent_.erase(std::unique(adjacent_.begin() + first, adjacent_.end()), adjacent_.end());
        first_adjacent_.push_back(uint32_t(adjacent_.size()));
    }
}

bool TrianglePatches::are_adjacent(uint32_t patch, uint32_t other) const {
    const auto begin = adjacent_.begin() + std::ptrdiff_t(first_adjacent_[patch]),
               end = adjacent_.begin() + std::ptrdiff_t(first_adjacent_[patch + 1]);
    return std::binary_search(begin, end, other);
}

void TrianglePatches::move(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs) {
    parallel_for(jobs, uint32_t(shares_.size()), [&](uint32_t share) {
        const auto last = std::min((share + 1) * kPatchesOfAJob, uint32_t(ends_.size()));
        for (uint32_t patch = share * kPatchesOfAJob; patch < last; ++patch) move_patch(begin, end, patch);
    });
    moving_.find_levels();
}

void TrianglePatches::move_marked(std::span<const uint8_t> marked, std::span<const Particle> begin,
                                  std::span<const Particle> end, std::vector<uint32_t>& moved) {
    moved.clear();
    for (const Triangle& t : triangles_)
        if ((marked[t.vertex[0]] || marked[t.vertex[1]] || marked[t.vertex[2]]) &&
            (moved.empty() || moved.back() != t.patch))
            moved.push_back(t.patch);
    for (const uint32_t patch : moved) move_patch(begin, end, patch);
    moving_.find_levels();
}

void TrianglePatches::move_patch(std::span<const Particle> begin, std::span<const Particle> end,
                                 uint32_t patch) {
    patches_[patch] = find_shape(corners_[patch].at, ends_[patch] - begin_of(patch), begin.data(), end.data(),
                                 boxes_[patch]);
    moving_.set(patch, patches_[patch].box, patches_[patch].way);
}

/// All normals of both, at either end.
bool TrianglePatches::in_one_cone(uint32_t patch, uint32_t other) const {
    const PatchShape &a = patches_[patch], &b = patches_[other];
    if (patch == other) return a.min_cosine > kConeCosine;
    const Vec3 axis = a.normal + b.normal;
    const float length = glm::length(axis);
    if (length < 0.5f) return false;
    return cosine_of_sum(glm::dot(a.normal, axis) / length, a.min_cosine) > kConeCosine &&
           cosine_of_sum(glm::dot(b.normal, axis) / length, b.min_cosine) > kConeCosine;
}

void TrianglePatches::find_pairs(const TrianglePatches& other, float reach_m, const Particle* of_solid,
                                 std::vector<Pair>& out, Jobs& jobs) {
    const bool own = this == &other;
    parallel_for(jobs, uint32_t(shares_.size()), [&](uint32_t number) {
        Share& share = shares_[number];
        share.pairs.clear();
        const auto last = std::min((number + 1) * kPatchesOfAJob, uint32_t(ends_.size()));
        for (uint32_t patch = number * kPatchesOfAJob; patch < last; ++patch) {
            find_meeting_patches(patch, other, own ? patch : 0, reach_m,
                                 of_solid ? kMaxWayPastSolid_m : kMaxWay_m, share.meeting);
            for (const uint32_t q : share.meeting) meet(patch, other, q, reach_m, of_solid, share.pairs);
        }
    });
    for (const Share& share : shares_) out.insert(out.end(), share.pairs.begin(), share.pairs.end());
}

void TrianglePatches::find_pairs_of(std::span<const uint32_t> patches, const TrianglePatches& other,
                                    float reach_m, std::vector<Pair>& out) {
    std::vector<uint32_t>& meeting = shares_.front().meeting;
    for (const uint32_t patch : patches) {
        find_meeting_patches(patch, other, 0, reach_m, kMaxWay_m, meeting);
        for (const uint32_t q : meeting) {
            if (this != &other || q >= patch)
                meet(patch, other, q, reach_m, nullptr, out);
            else if (!std::binary_search(patches.begin(), patches.end(), q))
                meet(q, other, patch, reach_m, nullptr, out);
        }
    }
}

void TrianglePatches::find_meeting_patches(uint32_t patch, const TrianglePatches& other, uint32_t first,
                                           float reach_m, float max_way_m, std::vector<uint32_t>& out) const {
    out.clear();
    find_meeting(other.moving_, first, patches_[patch].box, patches_[patch].way, reach_m, max_way_m, out);
    if (this == &other)
        std::erase_if(out, [&](uint32_t q) { return are_adjacent(patch, q) && in_one_cone(patch, q); });
}

void TrianglePatches::meet(uint32_t patch, const TrianglePatches& other, uint32_t of_other, float reach_m,
                           const Particle* of_solid, std::vector<Pair>& out) const {
    const bool own = this == &other && patch == of_other;
    const float max_way_m = of_solid ? kMaxWayPastSolid_m : kMaxWay_m;
    const Bounds &way = patches_[patch].way, &other_way = other.patches_[of_other].way,
                 past{way.low - other_way.high, way.high - other_way.low};
    const Vec3 margin = glm::min(farther(past.low, past.high), Vec3(max_way_m)) + reach_m;
    const uint32_t first = begin_of(patch), of_second = other.begin_of(of_other);
    std::array<uint8_t, kLanes> all = meeting_triangles(boxes_[patch], other.boxes_[of_other], margin);
    if (of_solid)
        clear_before_planes(corners_[patch].at, of_solid, other.boxes_[of_other], past, reach_m, max_way_m,
                            all);
    for (uint32_t i = 0; i < ends_[patch] - first; ++i)
        for (uint32_t left = own ? all[i] & ~0u << (i + 1) : all[i]; left; left &= left - 1)
            out.push_back(
                {&triangles_[first + i], &other.triangles_[of_second + uint32_t(std::countr_zero(left))]});
}

}  // namespace vfit
