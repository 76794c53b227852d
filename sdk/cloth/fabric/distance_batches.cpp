#include "cloth/fabric/distance_batches.h"

#include <utility>

#include "cloth/fabric/constraint_batches.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

namespace {

DistanceBatches pack(std::vector<Bond> joints, std::span<const DistanceConstraint> list,
                     std::span<const float> inverse_mass, uint32_t spare) {
    DistanceBatches out;
    for (const std::vector<Bond>& batch : batch_up(std::move(joints))) {
        DistanceBatch& d = out.joints.emplace_back();
        BatchMasses& m = out.masses.emplace_back();
        for (size_t k = 0; k < kLanes; ++k) {
            d.a[k] = d.b[k] = uint32_t(spare * sizeof(Particle));
            d.rest_m[k] = m.a[k] = m.b[k] = 0.0f;
            m.compliance[k] = 1.0f;
            if (k >= batch.size()) continue;
            const DistanceConstraint& c = list[batch[k].index];
            d.a[k] = uint32_t(batch[k].particles[0] * sizeof(Particle));
            d.b[k] = uint32_t(batch[k].particles[1] * sizeof(Particle));
            d.rest_m[k] = c.rest_m;
            m.a[k] = inverse_mass[c.a];
            m.b[k] = inverse_mass[c.b];
            m.compliance[k] = c.compliance_m_n;
        }
    }
    return out;
}

}  // namespace

DistanceBatches moved(DistanceBatches batches, uint32_t bytes) {
    for (DistanceBatch& batch : batches.joints)
        for (size_t k = 0; k < kLanes; ++k) batch.a[k] += bytes, batch.b[k] += bytes;
    return batches;
}

std::vector<DistanceBatches> make_batches(std::span<const DistanceConstraint> list,
                                          std::span<const float> inverse_mass, const ParticleLayout& layout) {
    std::vector<std::vector<Bond>> groups(layout.group_count());
    for (uint32_t i = 0; i < list.size(); ++i) {
        const auto [a, b] = std::pair(list[i].a, list[i].b);
        if (inverse_mass[a] == 0.0f && inverse_mass[b] == 0.0f) continue;
        const uint32_t ends[2] = {a, b};
        const uint32_t group = layout.group_of(ends, inverse_mass);
        const bool of_part = group < layout.parts.size();
        groups[group].push_back(Bond::of_two(of_part ? layout.particle_in(group, a) : layout.particle_of[a],
                                             of_part ? layout.particle_in(group, b) : layout.particle_of[b],
                                             i));
    }
    std::vector<DistanceBatches> out;
    for (uint32_t group = 0; group < groups.size(); ++group)
        out.push_back(pack(std::move(groups[group]), list, inverse_mass, layout.spare_of_group(group)));
    return out;
}

}  // namespace vfit
