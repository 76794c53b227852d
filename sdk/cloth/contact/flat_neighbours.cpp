#include "cloth/contact/flat_neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace vfit {

namespace {

/// The cloth's edges, from both ends.
class Links {
public:
    struct Link {
        uint32_t from, to;
        float length_m;
    };

    explicit Links(const Fabric& fabric) : first_(fabric.vertex_count() + 1, 0) {
        const FabricData& data = fabric.data();
        links_.reserve(2 * data.edges.size());
        for (const DistanceConstraint& e : data.edges) add(e.a, e.b, e.rest_m);
        // Edges between two fixed vertices are no constraints, and still the cloth.
        for (size_t t = 0; t < data.indices.size(); t += 3)
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = data.indices[t + k], b = data.indices[t + (k + 1) % 3];
                if (data.inverse_mass[a] == 0.0f && data.inverse_mass[b] == 0.0f) add(a, b, 0.0f);
            }
        std::sort(links_.begin(), links_.end(), [](const Link& x, const Link& y) {
            return std::pair(x.from, x.to) < std::pair(y.from, y.to);
        });
        for (const Link& link : links_) ++first_[link.from + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
    }
    std::span<const Link> of(uint32_t v) const {
        return std::span(links_).subspan(first_[v], first_[v + 1] - first_[v]);
    }

private:
    void add(uint32_t a, uint32_t b, float length_m) {
        links_.push_back({a, b, length_m}), links_.push_back({b, a, length_m});
    }

    std::vector<Link> links_;
    std::vector<uint32_t> first_;
};

/// Finds them for one run after the other.
class Finder {
public:
    Finder(const Fabric& fabric, const Links& links, float radius_m, float never_m)
        : fabric_(fabric),
          links_(links),
          radius_m_(radius_m),
          never_m_(never_m),
          distance_m_(fabric.vertex_count(), INFINITY),
          never_(fabric.vertex_count(), 0),
          beside_(never_) {}

    void find(uint32_t run, std::vector<NearRun>& out) {
        const ParticleLayout& layout = fabric_.layout();
        of_run_.clear();
        for (uint32_t i = 0; i < kLanes; ++i) {
            const uint32_t seed = layout.vertex_of[run * kLanes + i];
            if (seed != ParticleLayout::kNobody && fabric_.data().inverse_mass[seed] > 0.0f)
                reach_from(seed, uint8_t(1u << lane_of(i)));
        }
        std::sort(of_run_.begin(), of_run_.end(),
                  [&](uint32_t a, uint32_t b) { return layout.particle_of[a] < layout.particle_of[b]; });
        const size_t first = out.size();
        for (const uint32_t v : of_run_) {
            const uint32_t particle = layout.particle_of[v], other = particle / uint32_t(kLanes);
            if (out.size() == first || out.back().run != other) out.push_back({other, 0, 0, 0, 0, false});
            out.back().excluded |= uint64_t(never_[v]) << (8 * (particle % kLanes));
            out.back().beside |= uint64_t(beside_[v]) << (8 * (particle % kLanes));
            never_[v] = beside_[v] = 0;
        }
    }

private:
    void reach_from(uint32_t seed, uint8_t lane) {
        // So few are reached that to look at some twice takes less time than to keep them in order.
        reached_.assign(1, seed), open_.assign(1, seed);
        distance_m_[seed] = 0.0f;
        for (size_t at = 0; at < open_.size(); ++at)
            for (const Links::Link& link : links_.of(open_[at])) {
                const float to = distance_m_[open_[at]] + link.length_m;
                if (to > radius_m_ || to >= distance_m_[link.to]) continue;
                if (distance_m_[link.to] == INFINITY) reached_.push_back(link.to);
                distance_m_[link.to] = to;
                open_.push_back(link.to);
            }
        for (const uint32_t v : reached_) {
            if (beside_[v] == 0) of_run_.push_back(v);
            beside_[v] |= lane;
            if (distance_m_[v] <= never_m_) never_[v] |= lane;
            distance_m_[v] = INFINITY;
        }
        for (const Links::Link& link : links_.of(seed)) never_[link.to] |= lane;
    }

    const Fabric& fabric_;
    const Links& links_;
    const float radius_m_, never_m_;
    std::vector<float> distance_m_;  // of a vertex from the seed; INFINITY: not reached
    std::vector<uint8_t> never_, beside_;
    std::vector<uint32_t> reached_, open_, of_run_;
};

}  // namespace

FlatNeighbours flat_neighbours(const Fabric& fabric, float radius_m, float never_m, Jobs* jobs) {
    constexpr uint32_t kShare = 64;  // runs: enough to outweigh the room that each needs
    const Links links(fabric);
    const auto runs = uint32_t(fabric.layout().count() / kLanes), shares = (runs + kShare - 1) / kShare;
    std::vector<FlatNeighbours> found(shares);
    parallel_for(jobs, shares, [&](uint32_t share) {
        Finder finder(fabric, links, radius_m, never_m);
        for (uint32_t run = share * kShare; run < std::min((share + 1) * kShare, runs); ++run) {
            finder.find(run, found[share].of_runs);
            found[share].first.push_back(uint32_t(found[share].of_runs.size()));
        }
    });
    FlatNeighbours out;
    out.first.push_back(0);
    for (const FlatNeighbours& part : found) {
        const auto before = uint32_t(out.of_runs.size());
        for (const uint32_t end : part.first) out.first.push_back(before + end);
        out.of_runs.insert(out.of_runs.end(), part.of_runs.begin(), part.of_runs.end());
    }
    return out;
}

}  // namespace vfit
