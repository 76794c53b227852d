#include "outfit/finished_step.h"

namespace vfit {

void FinishedStep::keep(const Cloth& cloth, std::span<const Mat4> pose, int64_t time_ns, bool with_pressure) {
    positions_ = cloth.positions();
    normals_ = cloth.normals();
    strain_ = cloth.strain();
    if (with_pressure) pressure_ = cloth.pressure();
    pose_.assign(pose.begin(), pose.end());
    time_ns_ = time_ns;
    is_unposed_ = false;
}

Carry::Unposed FinishedStep::unposed(const Carry& carry, Jobs& jobs) const {
    Carry::Unposed out;
    carry.take_out(pose_, positions_, normals_, out, jobs);
    return out;
}

FinishedStep::Reskinned FinishedStep::reskin(const Carry& carry, std::span<const Mat4> pose, Jobs& jobs) {
    if (!is_unposed_) carry.take_out(pose_, positions_, normals_, unposed_, jobs);
    is_unposed_ = true;
    reskinned_positions_.resize(carry.vertex_count());
    reskinned_normals_.resize(carry.vertex_count());
    carry.put_in(pose, unposed_, reskinned_positions_, reskinned_normals_, jobs);
    return {reskinned_positions_, reskinned_normals_};
}

}  // namespace vfit
