#include "cloth/contact/flat_distances.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vfit {

namespace {

/// The cloth's edges, from both ends.
class Links {
public:
    struct Link {
        uint32_t from, to;
        float length_m;
    };

    explicit Links(const FabricData& data) : first_(data.inverse_mass.size() + 1, 0) {
        links_.reserve(2 * data.edges.size());
        for (const DistanceConstraint& e : data.edges) add(e.a, e.b, e.rest_m);
        // Edges between two fixed vertices are no constraints, and still belong to the cloth.
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

/// Shortest ways from one vertex after the other.
class Search {
public:
    Search(const Links& links, size_t vertices, float radius_m)
        : links_(links), radius_m_(radius_m), distance_m_(vertices, INFINITY) {}

    /// Those reached; their distances are distance_m() until the next search.
    const std::vector<uint32_t>& from(uint32_t seed) {
        for (const uint32_t v : reached_) distance_m_[v] = INFINITY;
        // So few are reached that to visit some twice takes less time than to keep them in order.
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
        for (const Links::Link& link : links_.of(seed)) {
            if (distance_m_[link.to] == INFINITY) reached_.push_back(link.to);
            distance_m_[link.to] = 0.0f;
        }
        std::sort(reached_.begin(), reached_.end());
        return reached_;
    }
    float distance_m(uint32_t vertex) const { return distance_m_[vertex]; }

private:
    const Links& links_;
    const float radius_m_;
    std::vector<float> distance_m_;  // of each vertex; infinite where it is not reached
    std::vector<uint32_t> reached_, open_;
};

}  // namespace

FlatDistances::FlatDistances(const FabricData& fabric, float radius_m, Jobs* jobs) {
    constexpr uint32_t kShare = 512;  // vertices: enough to outweigh the memory of a search
    const Links links(fabric);
    const auto vertices = uint32_t(fabric.inverse_mass.size()), shares = (vertices + kShare - 1) / kShare;
    struct Found {
        std::vector<uint32_t> counts;
        std::vector<Neighbour> neighbours;
    };
    std::vector<Found> found(shares);
    parallel_for(jobs, shares, [&](uint32_t share) {
        Search search(links, vertices, radius_m);
        for (uint32_t v = share * kShare; v < std::min((share + 1) * kShare, vertices); ++v) {
            const std::vector<uint32_t>& reached = search.from(v);
            for (const uint32_t other : reached)
                found[share].neighbours.push_back({other, search.distance_m(other)});
            found[share].counts.push_back(uint32_t(reached.size()));
        }
    });
    first_.push_back(0);
    for (const Found& part : found) {
        for (const uint32_t count : part.counts) first_.push_back(first_.back() + count);
        neighbours_.insert(neighbours_.end(), part.neighbours.begin(), part.neighbours.end());
    }
}

float FlatDistances::between(uint32_t vertex, uint32_t other) const {
    const auto begin = neighbours_.begin() + std::ptrdiff_t(first_[vertex]),
               end = neighbours_.begin() + std::ptrdiff_t(first_[vertex + 1]);
    const auto at =
        std::lower_bound(begin, end, other, [](const Neighbour& n, uint32_t v) { return n.vertex < v; });
    return at != end && at->vertex == other ? at->distance_m : INFINITY;
}

}  // namespace vfit
