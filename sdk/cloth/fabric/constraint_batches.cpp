#include "cloth/fabric/constraint_batches.h"

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <utility>

namespace vfit {

namespace {

// Batches that are filled at the same time: a constraint whose particles the first one has goes to the next.
constexpr size_t kOpen = 24;
// Batches in a row that share no particle, where that can be: one need not wait for what the last one stores.
constexpr size_t kApart = 4;

using Batch = std::vector<Bond>;

uint32_t particle_count(const std::vector<Bond>& bonds) {
    uint32_t count = 0;
    for (const Bond& bond : bonds)
        for (const uint32_t p : bond.particles) count = std::max(count, p + 1);
    return count;
}

/// Batches that are being filled, oldest first, by slots.
class OpenBatches {
public:
    explicit OpenBatches(uint32_t particles) : slots_of_(particles, 0) {}

    size_t count() const { return order_.size(); }
    /// The oldest one without a particle of the bond; none: count().
    size_t place_for(const Bond& bond) const {
        uint32_t taken = 0;
        for (const uint32_t p : bond.particles) taken |= slots_of_[p];
        size_t at = 0;
        while (at < order_.size() && (taken >> order_[at] & 1)) ++at;
        return at;
    }
    void open() {
        const auto slot = uint32_t(std::countr_one(used_));
        used_ |= 1u << slot;
        order_.push_back(slot);
    }
    void add(size_t at, const Bond& bond) {
        for (const uint32_t p : bond.particles) slots_of_[p] |= 1u << order_[at];
        batches_[order_[at]].push_back(bond);
    }
    bool is_full(size_t at) const { return batches_[order_[at]].size() == kLanes; }
    Batch close(size_t at) {
        const uint32_t slot = order_[at];
        order_.erase(order_.begin() + std::ptrdiff_t(at));
        used_ &= ~(1u << slot);
        for (const Bond& bond : batches_[slot])
            for (const uint32_t p : bond.particles) slots_of_[p] &= ~(1u << slot);
        return std::exchange(batches_[slot], {});
    }

private:
    std::vector<uint32_t> slots_of_;  // of each particle: bit s, the batch in slot s has it
    std::array<Batch, kOpen> batches_;
    std::vector<uint32_t> order_;  // slots
    uint32_t used_ = 0;
};

std::vector<Batch> fill(const std::vector<Bond>& bonds) {
    std::vector<Batch> done;
    OpenBatches open(particle_count(bonds));
    for (const Bond& bond : bonds) {
        const size_t at = open.place_for(bond);
        if (at == open.count()) {
            if (at == kOpen) done.push_back(open.close(0));
            open.open();
            open.add(open.count() - 1, bond);
            continue;
        }
        open.add(at, bond);
        if (open.is_full(at)) done.push_back(open.close(at));
    }
    while (open.count() > 0) done.push_back(open.close(0));
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
