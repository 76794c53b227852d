#include "outfit/finished_step.h"

namespace vfit {

void FinishedStep::keep(const ClothPiece& cloth, std::span<const Mat4> pose, int64_t time_ns,
                        bool with_pressure) {
    const auto copy = [](auto values, auto& to) { to.assign(values.begin(), values.end()); };
    copy(cloth.positions(), positions_);
    copy(cloth.normals(), normals_);
    copy(cloth.strain(), strain_);
    if (with_pressure) copy(cloth.pressure(), pressure_);
    pose_.assign(pose.begin(), pose.end());
    time_ns_ = time_ns;
    is_unposed_ = is_reskinned_ = false;
}

Carry::Unposed FinishedStep::unposed(const Carry& carry, Jobs& jobs) const {
    Carry::Unposed out;
    carry.take_out(pose_, positions_, normals_, out, jobs);
    return out;
}

FinishedStep::Shown FinishedStep::shown() const {
    if (is_reskinned_) return {reskinned_positions_, reskinned_pose_, reskinned_time_ns_};
    return {positions_, pose_, time_ns_};
}

FinishedStep::Reskinned FinishedStep::reskin(const Carry& carry, std::span<const Mat4> pose, int64_t time_ns,
                                             Jobs& jobs) {
    if (!is_unposed_) carry.take_out(pose_, positions_, normals_, unposed_, jobs);
    is_unposed_ = true;
    reskinned_positions_.resize(carry.vertex_count());
    reskinned_normals_.resize(carry.vertex_count());
    carry.put_in(pose, unposed_, reskinned_positions_, reskinned_normals_, jobs);
    reskinned_pose_.assign(pose.begin(), pose.end());
    reskinned_time_ns_ = time_ns;
    is_reskinned_ = true;
    return {reskinned_positions_, reskinned_normals_};
}

}  // namespace vfit
