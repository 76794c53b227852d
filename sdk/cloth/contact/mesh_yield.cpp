#include "cloth/contact/mesh_yield.h"

#include <algorithm>

namespace vfit {

namespace {
constexpr float kTorn = 0.5f, kWhole = 0.25f;  // mean strain of a vertex's threads
constexpr float kGives_m = 0.002f, kComesBack_m = 0.0005f, kGivesMost_m = 0.15f;  // a step
}  // namespace

MeshYield::MeshYield(std::shared_ptr<const Fabric> fabric)
    : fabric_(std::move(fabric)), yield_m_(fabric_->layout().count(), 0.0f), left_m_(yield_m_) {}

void MeshYield::look(std::span<const float> strain, std::span<const float> lift_m) {
    any_ = false;
    for (size_t v = 0; v < strain.size(); ++v) {
        const uint32_t particle = fabric_->layout().particle_of[v];
        float& yield = yield_m_[particle];
        if (strain[v] > kTorn)
            yield = std::min(yield + kGives_m, kGivesMost_m);
        else if (strain[v] < kWhole)
            yield = std::max(yield - kComesBack_m, 0.0f);
        any_ |= yield > 0.0f;
        left_m_[particle] = (lift_m.empty() ? 0.0f : lift_m[particle]) - yield;
    }
    any_ |= !lift_m.empty();
}

}  // namespace vfit
