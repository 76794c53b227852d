#include "cloth/fabric/constraint_batches.h"

#include <algorithm>
#include <deque>
#include <iterator>

namespace vfit {

namespace {

// Batches that are filled at the same time: a constraint whose particles the first one has goes to the next.
constexpr size_t kOpen = 24;
// Batches in a row that share no particle, where that can be: one need not wait for what the last one stores.
constexpr size_t kApart = 4;

using Batch = std::vector<Bond>;

bool shares(const Bond& x, const Bond& y) {
    for (uint32_t a : x.particles)
        for (uint32_t b : y.particles)
            if (a == b) return true;
    return false;
}
bool shares(const Batch& x, const Bond& j) {
    return std::any_of(x.begin(), x.end(), [&](const Bond& o) { return shares(o, j); });
}

std::vector<Batch> fill(const std::vector<Bond>& bonds) {
    std::vector<Batch> done;
    std::deque<Batch> open;
    for (const Bond& bond : bonds) {
        const auto place =
            std::find_if(open.begin(), open.end(), [&](const Batch& b) { return !shares(b, bond); });
        if (place == open.end()) {
            if (open.size() == kOpen) {
                done.push_back(std::move(open.front()));
                open.pop_front();
            }
            open.push_back({bond});
            continue;
        }
        place->push_back(bond);
        if (place->size() < kLanes) continue;
        done.push_back(std::move(*place));
        open.erase(place);
    }
    std::move(open.begin(), open.end(), std::back_inserter(done));
    return done;
}

/// Nearly in the same order, but with kApart batches between two that share a particle.
std::vector<Batch> spread(std::vector<Batch> batches) {
    constexpr size_t kAhead = 64;  // how far it looks
    std::vector<Batch> out;
    out.reserve(batches.size());
    uint32_t particles = 0;
    for (const Batch& b : batches)
        for (const Bond& bond : b)
            for (const uint32_t p : bond.particles) particles = std::max(particles, p + 1);
    std::vector<size_t> last(particles, 0);  // batch that has the particle, counted from 1; 0: none yet
    std::deque<Batch> waiting;
    size_t next = 0;
    while (next < batches.size() || !waiting.empty()) {
        while (next < batches.size() && waiting.size() < kAhead)
            waiting.push_back(std::move(batches[next++]));
        const auto apart = std::find_if(waiting.begin(), waiting.end(), [&](const Batch& b) {
            return std::all_of(b.begin(), b.end(), [&](const Bond& bond) {
                return std::all_of(bond.particles.begin(), bond.particles.end(), [&](uint32_t p) {
                    return last[p] == 0 || last[p] + kApart <= out.size();
                });
            });
        });
        const auto chosen = apart == waiting.end() ? waiting.begin() : apart;
        out.push_back(std::move(*chosen));
        for (const Bond& bond : out.back())
            for (const uint32_t p : bond.particles) last[p] = out.size();
        waiting.erase(chosen);
    }
    return out;
}

}  // namespace

std::vector<std::vector<Bond>> batch_up(std::vector<Bond> bonds) {
    const auto lowest = [](const Bond& j) {
        return *std::min_element(j.particles.begin(), j.particles.end());
    };
    std::stable_sort(bonds.begin(), bonds.end(),
                     [&](const Bond& x, const Bond& y) { return lowest(x) < lowest(y); });
    return spread(fill(bonds));
}

}  // namespace vfit
