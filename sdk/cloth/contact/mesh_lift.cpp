#include "cloth/contact/mesh_lift.h"

#include <algorithm>

namespace vfit {

namespace {

struct Pace {
    float step_m, most_m;
    float forgets;  // share, for each millimetre that the mesh moves
};
/// The skin stands out by little, and what is lifted is seen. Of other cloth whole folds may have come
/// through.
constexpr Pace pace_off(MeshOf what) {
    return what == MeshOf::solid ? Pace{0.0005f, 0.012f, 0.05f} : Pace{0.0015f, 0.03f, 0.01f};
}

}  // namespace

MeshLift::MeshLift(std::shared_ptr<const Fabric> fabric, MeshOf what)
    : fabric_(std::move(fabric)), what_(what), lift_m_(fabric_->layout().count(), 0.0f) {}

void MeshLift::forget(std::span<const ContactMesh> meshes) {
    float way_m = 0.0f;
    for (const ContactMesh& mesh : meshes)
        if (mesh.what() == what_) way_m = std::max(way_m, mesh.greatest_way());
    const float keep = std::max(0.0f, 1.0f - pace_off(what_).forgets * 1000.0f * way_m);
    if (keep < 1.0f)
        for (float& lift : lift_m_) lift *= keep;
}

/// By a fixed vertex.
bool MeshLift::is_held(uint32_t triangle) const {
    const uint32_t* v = &fabric_->data().indices[3 * triangle];
    return std::any_of(v, v + 3,
                       [&](uint32_t corner) { return fabric_->data().inverse_mass[corner] == 0.0f; });
}

void MeshLift::look(const TriangleGroups& cloth, std::span<const ContactMesh> meshes, uint32_t steps) {
    forget(meshes);
    const uint32_t count = cloth.group_count(), first = next_ >= count ? 0 : next_,
                   end = std::min(count, first + count / steps + 1);
    next_ = end;
    groups_.swap(looked_again_);
    for (uint32_t group = first; group < end; ++group)
        if (std::find(groups_.begin(), groups_.end(), group) == groups_.end()) groups_.push_back(group);
    looked_again_.clear();
    for (const uint32_t group : groups_) {
        crossed_.clear();
        for (const ContactMesh& mesh : meshes)
            if (mesh.what() == what_) mesh.find_crossed(cloth, group, near_, crossed_);
        if (crossed_.empty()) continue;
        looked_again_.push_back(group);
        std::sort(crossed_.begin(), crossed_.end());
        crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
        for (const uint32_t t : crossed_) {
            if (what_ == MeshOf::solid && is_held(t)) continue;
            for (size_t k = 0; k < 3; ++k) {
                float& lift = lift_m_[fabric_->layout().particle_of[fabric_->data().indices[3 * t + k]]];
                lift = std::min(lift + pace_off(what_).step_m, pace_off(what_).most_m);
            }
        }
    }
    groups_.clear();
}

}  // namespace vfit
