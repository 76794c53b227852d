#include "cloth/fabric/hinge_batches.h"

#include "cloth/fabric/constraint_batches.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

namespace {

/// Would it take back more than a quarter of a fold in a sub-step of 1/480 s with twice its force? A sliver
/// of a triangle does.
bool is_stiff(const Hinge& hinge, std::span<const float> inverse_mass) {
    constexpr float kSoft = 0.5f, kRate2 = 480.0f * 480.0f / 2.0f;
    float sum = 0.0f;
    for (size_t k = 0; k < 4; ++k)
        sum += inverse_mass[hinge.vertices[k]] * hinge.weights[k] * hinge.weights[k];
    return sum > kSoft * (sum + hinge.compliance_m_n * kRate2);
}

void add_batches(std::vector<Bond> bonds, std::span<const Hinge> list, std::span<const float> inverse_mass,
                 uint32_t spare, HingeBatches& out) {
    for (const std::vector<Bond>& batch : batch_up(std::move(bonds))) {
        HingeBatch& h = out.hinges.emplace_back();
        HingeMasses& m = out.masses.emplace_back();
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const Hinge* hinge = lane < batch.size() ? &list[batch[lane].index] : nullptr;
            for (size_t k = 0; k < 4; ++k) {
                h.at[k][lane] = hinge ? uint32_t(batch[lane].particles[k] * sizeof(Particle)) : spare;
                h.weight[k][lane] = hinge ? hinge->weights[k] : 0.0f;
                m.inverse_mass[k][lane] = hinge ? inverse_mass[hinge->vertices[k]] : 0.0f;
            }
            m.compliance[lane] = hinge ? hinge->compliance_m_n : 1.0f;
        }
    }
}

}  // namespace

HingeBatches moved(HingeBatches batches, uint32_t bytes) {
    for (HingeBatch& batch : batches.hinges)
        for (auto& particles : batch.at)
            for (uint32_t& at : particles) at += bytes;
    return batches;
}

/// Stiff ones in batches of their own: the soft ones have to push less often.
std::vector<HingeBatches> make_hinge_batches(std::span<const Hinge> list, std::span<const float> inverse_mass,
                                             const ParticleLayout& layout) {
    struct Group {
        std::vector<Bond> stiff, soft;
    };
    std::vector<Group> groups(layout.group_count());
    for (uint32_t i = 0; i < list.size(); ++i) {
        const uint32_t group = layout.group_of(list[i].vertices, inverse_mass);
        Bond bond{{}, i};
        for (size_t k = 0; k < 4; ++k)
            bond.particles[k] = group < layout.parts.size() ? layout.particle_in(group, list[i].vertices[k])
                                                            : layout.particle_of[list[i].vertices[k]];
        (is_stiff(list[i], inverse_mass) ? groups[group].stiff : groups[group].soft).push_back(bond);
    }
    std::vector<HingeBatches> out;
    for (uint32_t group = 0; group < groups.size(); ++group) {
        HingeBatches& batches = out.emplace_back();
        const auto spare = uint32_t(layout.spare_of_group(group) * sizeof(Particle));
        for (auto* bonds : {&groups[group].stiff, &groups[group].soft})
            add_batches(std::move(*bonds), list, inverse_mass, spare, batches);
    }
    return out;
}

}  // namespace vfit
