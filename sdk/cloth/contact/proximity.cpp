#include "cloth/contact/proximity.h"

#include <algorithm>

namespace vfit {

Proximity::Proximity(std::span<const Vec3> positions, std::span<const uint32_t> indices)
    : patches_(positions, indices) {}

bool Proximity::Pair::shares_vertex() const {
    return std::any_of(first->vertex, first->vertex + 3, [&](uint32_t v) {
        return v == second->vertex[0] || v == second->vertex[1] || v == second->vertex[2];
    });
}

void Proximity::find(std::span<const Particle> begin, std::span<const Particle> end, float reach_m,
                     Jobs& jobs) {
    reach_m_ = reach_m;
    patches_.move(begin, end, jobs);
    all_.pairs.clear();
    patches_.find_pairs(patches_, reach_m, all_.pairs, jobs);
    classify_all(all_, begin, end, jobs);
    last_ = &all_;
}

void Proximity::find_uncertain_of(std::span<const uint8_t> marked, std::span<const Particle> begin,
                                  std::span<const Particle> end, Jobs& jobs) {
    const std::span<const Triangle> triangles = patches_.triangles();
    const auto has_marked = [&](uint32_t t) {
        const uint32_t* v = triangles[t].vertex;
        return marked[v[0]] || marked[v[1]] || marked[v[2]];
    };
    of_marked_.pairs.clear();
    for (const TrianglePatches::Pair& pair : all_.pairs)
        if (has_marked(pair.first) || has_marked(pair.second)) of_marked_.pairs.push_back(pair);
    classify_all(of_marked_, begin, end, jobs);
    last_ = &of_marked_;
}

void Proximity::classify_all(Classified& of, std::span<const Particle> begin, std::span<const Particle> end,
                             Jobs& jobs) const {
    constexpr uint32_t kBatchesOfAJob = 256;
    const std::span<const Triangle> triangles = patches_.triangles();
    of.batches.resize((of.pairs.size() + kLanes - 1) / kLanes);
    const auto count = uint32_t(of.batches.size());
    parallel_for(jobs, (count + kBatchesOfAJob - 1) / kBatchesOfAJob, [&](uint32_t share) {
        const uint32_t first = share * kBatchesOfAJob, last = std::min(first + kBatchesOfAJob, count);
        for (uint32_t i = first; i < last; ++i)
            for (size_t k = 0; k < kLanes; ++k) {
                const TrianglePatches::Pair& pair = of.pairs[std::min(i * kLanes + k, of.pairs.size() - 1)];
                for (size_t corner = 0; corner < 3; ++corner) {
                    of.batches[i].first[corner][k] = triangles[pair.first].vertex[corner];
                    of.batches[i].second[corner][k] = triangles[pair.second].vertex[corner];
                }
            }
        classify(std::span(of.batches).subspan(first, last - first), begin.data(), end.data(), reach_m_);
    });
    if (const size_t in_last = of.pairs.size() % kLanes; in_last != 0) {
        of.batches.back().uncertain &= uint8_t((1u << in_last) - 1);
        of.batches.back().close &= uint8_t((1u << in_last) - 1);
    }
}

}  // namespace vfit
