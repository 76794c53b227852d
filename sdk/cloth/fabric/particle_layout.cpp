#include "cloth/fabric/particle_layout.h"

#include <algorithm>
#include <utility>

#include "cloth/fabric/fabric.h"

namespace vfit {

namespace {

// Of a part: below some hundred particles, threads wait for each other more than they work.
constexpr uint32_t kLeastOfPart = 512, kMostParts = 8;

/// Who is joined to whom by edges.
class Neighbours {
public:
    Neighbours(size_t vertices, std::span<const DistanceConstraint> edges)
        : first_(vertices + 1, 0), list_(2 * edges.size()) {
        for (const DistanceConstraint& e : edges) ++first_[e.a + 1], ++first_[e.b + 1];
        for (size_t i = 0; i < vertices; ++i) first_[i + 1] += first_[i];
        std::vector<uint32_t> fill(first_.begin(), first_.end() - 1);
        for (const DistanceConstraint& e : edges) list_[fill[e.a]++] = e.b, list_[fill[e.b]++] = e.a;
    }
    std::span<const uint32_t> of(uint32_t v) const {
        return {list_.data() + first_[v], first_[v + 1] - first_[v]};
    }

private:
    std::vector<uint32_t> first_, list_;
};

/// The moving vertices by how many edges they are from where the cloth is held (a piece that nothing holds:
/// from one of its ends); pieces one after the other. levels: of each vertex, rising along the list.
std::vector<uint32_t> from_the_top(std::span<const float> inverse_mass, const Neighbours& neighbours,
                                   std::vector<uint32_t>& levels) {
    const size_t n = inverse_mass.size();
    levels.assign(n, UINT32_MAX);
    std::vector<uint32_t> order;
    const auto spread_from = [&](size_t begin) {
        for (size_t i = begin; i < order.size(); ++i)
            for (uint32_t v : neighbours.of(order[i]))
                if (inverse_mass[v] > 0.0f && levels[v] == UINT32_MAX) {
                    levels[v] = levels[order[i]] + 1;
                    order.push_back(v);
                }
    };
    for (uint32_t v = 0; v < n; ++v) {
        if (inverse_mass[v] == 0.0f) continue;
        for (uint32_t u : neighbours.of(v))
            if (inverse_mass[u] == 0.0f) {
                levels[v] = 0;
                order.push_back(v);
                break;
            }
    }
    spread_from(0);
    for (uint32_t v = 0; v < n; ++v) {
        if (inverse_mass[v] == 0.0f || levels[v] != UINT32_MAX) continue;
        const size_t begin = order.size();
        const uint32_t base = begin == 0 ? 0 : levels[order.back()] + 1;
        for (uint32_t start : {v, UINT32_MAX}) {  // the last one reached from anywhere is an end
            if (start == UINT32_MAX) start = order.back();
            for (size_t i = begin; i < order.size(); ++i) levels[order[i]] = UINT32_MAX;
            order.resize(begin);
            levels[start] = base;
            order.push_back(start);
            spread_from(begin);
        }
    }
    return order;
}

/// The part of each moving vertex, cut between levels.
std::vector<uint32_t> cut_across(const std::vector<uint32_t>& order, const std::vector<uint32_t>& levels,
                                 uint32_t parts) {
    std::vector<uint32_t> part_of(levels.size(), ParticleLayout::kNobody);
    uint32_t part = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        const bool level_begins = i > 0 && levels[order[i]] != levels[order[i - 1]];
        if (level_begins && i * parts >= size_t(part + 1) * order.size()) ++part;
        part_of[order[i]] = part;
    }
    return part_of;
}

template <typename Take>
void for_each_joint(const FabricData& data, const Take& take) {
    for (const auto* list : {&data.edges, &data.bends})
        for (const DistanceConstraint& c : *list) {
            const uint32_t ends[2] = {c.a, c.b};
            take(std::span<const uint32_t>(ends));
        }
    for (const Hinge& h : data.hinges) take(std::span<const uint32_t>(h.vertices));
}

/// What is joined lies in one part or in two that are next to each other, and no vertex is joined across two
/// cuts: then cuts can be worked on side by side. A fixed vertex is a part's own copy, and has no place in a
/// cut.
bool cuts_are_apart(const FabricData& data, const std::vector<uint32_t>& part_of) {
    std::vector<uint32_t> cut_of(part_of.size(), ParticleLayout::kNobody);
    bool apart = true;
    for_each_joint(data, [&](std::span<const uint32_t> vertices) {
        uint32_t low = ParticleLayout::kNobody, high = 0, fixed = 0;
        for (uint32_t v : vertices) {
            if (data.inverse_mass[v] == 0.0f)
                ++fixed;
            else
                low = std::min(low, part_of[v]), high = std::max(high, part_of[v]);
        }
        if (low >= high) return;
        if (high != low + 1 || fixed > 0) apart = false;
        for (uint32_t v : vertices) {
            if (cut_of[v] != ParticleLayout::kNobody && cut_of[v] != low) apart = false;
            cut_of[v] = low;
        }
    });
    return apart;
}

/// In runs of kLanes neighbours, so that a run has a small box and runs that follow each other are near.
std::vector<uint32_t> compact_runs(const std::vector<uint32_t>& vertices, const Neighbours& neighbours,
                                   std::vector<uint8_t>& taken) {
    std::vector<uint32_t> order;
    for (uint32_t seed : vertices) {
        if (taken[seed]) continue;
        const size_t begin = order.size();
        const auto take = [&](uint32_t v) {
            if (taken[v] || order.size() - begin == kLanes) return;
            taken[v] = 1;
            order.push_back(v);
        };
        take(seed);
        for (size_t i = begin; i < order.size() && order.size() - begin < kLanes; ++i)
            for (uint32_t v : neighbours.of(order[i])) take(v);
    }
    return order;
}

void fill_up(std::vector<uint32_t>& vertex_of) {
    vertex_of.resize((vertex_of.size() + kLanes - 1) / kLanes * kLanes, ParticleLayout::kNobody);
}

}  // namespace

uint32_t ParticleLayout::part_of(uint32_t particle) const {
    uint32_t part = 0;
    while (particle >= parts[part].end) ++part;
    return part;
}

uint32_t ParticleLayout::group_of(std::span<const uint32_t> vertices,
                                  std::span<const float> inverse_mass) const {
    uint32_t low = kNobody, high = 0;
    for (uint32_t v : vertices) {
        if (inverse_mass[v] == 0.0f) continue;
        const uint32_t part = part_of(particle_of[v]);
        low = std::min(low, part), high = std::max(high, part);
    }
    return low == high ? low : uint32_t(parts.size()) + low;
}

uint32_t ParticleLayout::spare_of_group(uint32_t group) const {
    if (group < parts.size()) return parts[group].spare();
    return cut_spares + (group - uint32_t(parts.size())) * uint32_t(kLanes);
}

uint32_t ParticleLayout::particle_in(uint32_t part, uint32_t vertex) const {
    const auto copies = vertex_of.begin() + parts[part].moving_end, end = vertex_of.begin() + parts[part].end;
    const auto copy = std::lower_bound(copies, end, vertex);  // they are sorted, and nobody comes last
    return copy != end && *copy == vertex ? uint32_t(copy - vertex_of.begin()) : particle_of[vertex];
}

ParticleLayout lay_out(const FabricData& data) {
    const size_t n = data.inverse_mass.size();
    const Neighbours neighbours(n, data.edges);
    std::vector<uint32_t> levels;
    const std::vector<uint32_t> order = from_the_top(data.inverse_mass, neighbours, levels);
    uint32_t count = std::clamp(uint32_t(order.size()) / kLeastOfPart, 1u, kMostParts);
    std::vector<uint32_t> part_of = cut_across(order, levels, count);
    while (count > 1 && !cuts_are_apart(data, part_of)) part_of = cut_across(order, levels, --count);

    // Fixed vertices that a part's own are joined or tied to.
    std::vector<std::vector<uint32_t>> moving(count), fixed(count);
    for (uint32_t v : order) moving[part_of[v]].push_back(v);
    const auto needs = [&](uint32_t v, uint32_t other) {
        if (data.inverse_mass[v] > 0.0f && data.inverse_mass[other] == 0.0f)
            fixed[part_of[v]].push_back(other);
    };
    for_each_joint(data, [&](std::span<const uint32_t> vertices) {
        for (uint32_t a : vertices)
            for (uint32_t b : vertices) needs(a, b);
    });
    for (const Tether& t : data.tethers) needs(t.vertex, t.anchor);
    for (uint32_t v = 0; v < n; ++v)
        if (data.inverse_mass[v] == 0.0f) fixed[0].push_back(v);

    ParticleLayout out;
    std::vector<uint8_t> taken(n, 1);
    for (uint32_t part = 0; part < count; ++part) {
        for (uint32_t v : moving[part]) taken[v] = 0;
        const uint32_t begin = out.count();
        for (uint32_t v : compact_runs(moving[part], neighbours, taken)) out.vertex_of.push_back(v);
        fill_up(out.vertex_of);
        const uint32_t moving_end = out.count();
        std::sort(fixed[part].begin(), fixed[part].end());
        fixed[part].erase(std::unique(fixed[part].begin(), fixed[part].end()), fixed[part].end());
        out.vertex_of.insert(out.vertex_of.end(), fixed[part].begin(), fixed[part].end());
        out.vertex_of.push_back(ParticleLayout::kNobody);
        fill_up(out.vertex_of);
        out.parts.push_back({begin, moving_end, out.count()});
    }
    out.cut_spares = out.count();
    out.vertex_of.resize(out.vertex_of.size() + (count - 1) * kLanes, ParticleLayout::kNobody);
    out.particle_of.assign(n, ParticleLayout::kNobody);
    for (uint32_t p = 0; p < out.count(); ++p) {
        const uint32_t v = out.vertex_of[p];
        if (v != ParticleLayout::kNobody && out.particle_of[v] == ParticleLayout::kNobody)
            out.particle_of[v] = p;
    }
    return out;
}

}  // namespace vfit
