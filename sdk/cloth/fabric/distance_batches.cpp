#include "cloth/fabric/distance_batches.h"

#include <algorithm>
#include <array>
#include <deque>

#include "cloth/fabric/fabric.h"

namespace vfit {

namespace {

// Batches that are filled at the same time: a constraint whose particles the first one has goes to the next.
constexpr size_t kOpen = 24;
// Batches in a row that share no particle, where that can be: one need not wait for what the last one stores.
constexpr size_t kApart = 4;

struct Bond {
    uint32_t a, b, index;
};
using Batch = std::vector<Bond>;

bool shares(const Batch& x, const Bond& j) {
    return std::any_of(x.begin(), x.end(), [&](const Bond& o) { return o.a == j.a || o.a == j.b || o.b == j.a || o.b == j.b; });
}
bool shares(const Batch& x, const Batch& y) {
    return std::any_of(y.begin(), y.end(), [&](const Bond& j) { return shares(x, j); });
}

std::vector<Batch> fill(const std::vector<Bond>& bonds) {
    std::vector<Batch> done;
    std::deque<Batch> open;
    for (const Bond& bond : bonds) {
        const auto place = std::find_if(open.begin(), open.end(), [&](const Batch& b) { return !shares(b, bond); });
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
    std::deque<Batch> waiting;
    size_t next = 0;
    while (next < batches.size() || !waiting.empty()) {
        while (next < batches.size() && waiting.size() < kAhead) waiting.push_back(std::move(batches[next++]));
        const auto apart = std::find_if(waiting.begin(), waiting.end(), [&](const Batch& b) {
            for (size_t k = 1; k <= std::min(kApart, out.size()); ++k)
                if (shares(out[out.size() - k], b)) return false;
            return true;
        });
        const auto chosen = apart == waiting.end() ? waiting.begin() : apart;
        out.push_back(std::move(*chosen));
        waiting.erase(chosen);
    }
    return out;
}

DistanceBatches pack(std::vector<Bond> bonds, std::span<const DistanceConstraint> list,
                     std::span<const float> inverse_mass, uint32_t spare) {
    std::stable_sort(bonds.begin(), bonds.end(),
                     [](const Bond& x, const Bond& y) { return std::min(x.a, x.b) < std::min(y.a, y.b); });
    DistanceBatches out;
    for (const Batch& batch : spread(fill(bonds))) {
        DistanceBatch& d = out.joints.emplace_back();
        BatchMasses& m = out.masses.emplace_back();
        for (size_t k = 0; k < kLanes; ++k) {
            d.a[k] = d.b[k] = uint32_t(spare * sizeof(Particle));
            d.rest_m[k] = m.a[k] = m.b[k] = 0.0f;
            m.compliance[k] = 1.0f;
            if (k >= batch.size()) continue;
            const DistanceConstraint& c = list[batch[k].index];
            d.a[k] = uint32_t(batch[k].a * sizeof(Particle));
            d.b[k] = uint32_t(batch[k].b * sizeof(Particle));
            d.rest_m[k] = c.rest_m;
            m.a[k] = inverse_mass[c.a];
            m.b[k] = inverse_mass[c.b];
            m.compliance[k] = c.compliance_m_n;
        }
    }
    return out;
}

}  // namespace

std::vector<DistanceBatches> make_batches(std::span<const DistanceConstraint> list, std::span<const float> inverse_mass,
                                          const ParticleLayout& layout) {
    std::vector<std::vector<Bond>> groups(layout.group_count());
    for (uint32_t i = 0; i < list.size(); ++i) {
        const auto [a, b] = std::pair(list[i].a, list[i].b);
        if (inverse_mass[a] == 0.0f && inverse_mass[b] == 0.0f) continue;
        const uint32_t group = layout.group_of(a, b, inverse_mass);
        const bool of_part = group < layout.parts.size();
        groups[group].push_back({of_part ? layout.particle_in(group, a) : layout.particle_of[a],
                                 of_part ? layout.particle_in(group, b) : layout.particle_of[b], i});
    }
    std::vector<DistanceBatches> out;
    for (uint32_t group = 0; group < groups.size(); ++group)
        out.push_back(pack(std::move(groups[group]), list, inverse_mass, layout.spare_of_group(group)));
    return out;
}

}  // namespace vfit
