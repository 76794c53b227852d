// Edges have a greatest length. Where a body leaves cloth less room than it needs, since limbs pinch it or
// the way around them is longer than it is, contact with the skin gives way, and not the cloth. Contact of
// triangles comes after that: it may stretch edges again, up to another length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class LengthLimit {
public:
    static constexpr float kMaxStrain = 0.18f;        // of an edge
    static constexpr float kMaxContactStrain = 0.5f;  // that contact leaves
    explicit LengthLimit(const Fabric& fabric);

    /// The cloth is put on there: an edge that is beyond kMaxStrain, since the body is too wide for it, may
    /// be as long until it gets shorter. Before that, kMaxContactStrain is the only limit.
    void accept(std::span<const Particle> at);

    /// Gauss-Seidel over the edges that are too long at `end`, until none is, or for some passes. An edge
    /// that was too long at `begin` already gets shorter by shortens_m. Returns the vertices that moved, once
    /// each, until the next call.
    std::span<const uint32_t> keep(std::span<const Particle> begin, std::span<Particle> end,
                                   float shortens_m);
    /// After contact: the same by its limit, of edges at these vertices, and at those that move. Flagged
    /// vertices stay where they are.
    std::span<const uint32_t> keep_about(std::span<const uint32_t> vertices, std::span<const uint8_t> stays,
                                         std::span<const Particle> begin, std::span<Particle> end,
                                         float shortens_m);

private:
    struct Edge {
        uint32_t a, b;
        float rest_m, most_m;
        float share_a, share_b;  // of the correction
    };
    struct Step {
        std::span<const Particle> begin;
        std::span<Particle> end;
        std::span<const uint8_t> stays;  // empty: none
        float shortens_m;
        bool after_contact;
    };
    std::span<const uint32_t> run(const Step& step);
    void shorten(const Edge& edge, const Step& step);
    void forget_moved();
    void mark(uint32_t vertex);
    void look_about(uint32_t vertex);

    bool is_accepted_ = false;
    std::vector<Edge> edges_;
    std::vector<uint32_t> first_, edges_at_;  // by vertex
    std::vector<uint32_t> pass_, next_;       // edges of this pass over them, and of the next one
    std::vector<uint32_t> moved_;
    std::vector<uint8_t> is_next_, is_moved_;
};

}  // namespace vfit
