// Pairs of triangles that come close to each other in a step, and which of them may have crossed on the way.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/triangle_patches.h"
#include "core/jobs.h"

namespace vfit {

class Proximity {
public:
    using Triangle = TrianglePatches::Triangle;

    /// Triangles of one surface against each other.
    Proximity(std::span<const Vec3> positions, std::span<const uint32_t> indices);

    /// Finds the pairs within reach_m between both ends of the step, and classifies them. Does not allocate
    /// once it has met as many.
    void find(std::span<const Particle> begin, std::span<const Particle> end, float reach_m, Jobs& jobs);
    /// Classifies anew the pairs with a marked vertex (one flag a vertex), as the vertices are now; all others
    /// count as certain. Pairs stay those that were found.
    void find_uncertain_of(std::span<const uint8_t> marked, std::span<const Particle> begin,
                           std::span<const Particle> end, Jobs& jobs);

    struct Pair {
        const Triangle *first, *second;

        bool shares_vertex() const;
    };
    /// Pairs that no axis separates at both ends of their ways.
    template <typename Body>
    void for_uncertain(Body&& body) const {
        for_bits(*last_, [](const TrianglePairs& pairs) { return pairs.uncertain; }, body);
    }
    /// Pairs that find() saw within the reach now, or after the same way again; none that share a vertex.
    template <typename Body>
    void for_close(Body&& body) const {
        for_bits(all_, [](const TrianglePairs& pairs) { return pairs.close; }, body);
    }
    size_t pair_count() const { return all_.pairs.size(); }

private:
    struct Classified {
        std::vector<TrianglePatches::Pair> pairs;
        std::vector<TrianglePairs> batches;  // of these, eight by eight
    };
    template <typename Bits, typename Body>
    void for_bits(const Classified& of, Bits&& bits, Body&& body) const;
    void classify_all(Classified& of, std::span<const Particle> begin, std::span<const Particle> end,
                      Jobs& jobs) const;

    TrianglePatches patches_;
    float reach_m_ = 0.0f;
    Classified all_, of_marked_;
    const Classified* last_ = &all_;
};

template <typename Bits, typename Body>
void Proximity::for_bits(const Classified& of, Bits&& bits, Body&& body) const {
    const std::span<const Triangle> triangles = patches_.triangles();
    for (size_t i = 0; i < of.batches.size(); ++i)
        for (uint32_t left = bits(of.batches[i]); left; left &= left - 1) {
            const TrianglePatches::Pair& pair = of.pairs[i * kLanes + size_t(std::countr_zero(left))];
            body(Pair{&triangles[pair.first], &triangles[pair.second]});
        }
}

}  // namespace vfit
