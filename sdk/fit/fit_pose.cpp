#include "fit/fit_pose.h"

#include <cmath>

#include "core/wipe.h"

namespace vfit {

Vec3 log_of(const Quat& q) {
    const Quat shortest = q.w < 0.0f ? -q : q;
    const Vec3 v(shortest.x, shortest.y, shortest.z);
    const float sine = glm::length(v);
    if (sine < 1e-7f) return 2.0f * v;
    return v * (2.0f * std::atan2(sine, shortest.w) / sine);
}

Quat exp_of(const Vec3& v) {
    const float angle = glm::length(v);
    if (angle < 1e-7f) return glm::normalize(Quat(1.0f, 0.5f * v.x, 0.5f * v.y, 0.5f * v.z));
    const Vec3 axis = v * (std::sin(0.5f * angle) / angle);
    return Quat(std::cos(0.5f * angle), axis.x, axis.y, axis.z);
}

void apply_step(const std::array<double, kFitUnknowns>& step, FitState& state) {
    const auto vector = [&](size_t i) { return Vec3(step[i], step[i + 1], step[i + 2]); };
    for (int b = 0; b < kBoneCount; ++b) {
        const int column = fit_column(b);
        if (column < 0) continue;
        Quat& q = state.rotation[size_t(b)];
        q = glm::normalize(q * exp_of(vector(size_t(column))));
    }
    state.hips += vector(kFitHipsColumn);
    for (size_t s = 0; s < size_t(kFitShapes); ++s) state.shape[s] += float(step[kFitPoseUnknowns + s]);
}

FitBody::FitBody(const FitModel& model)
    : model_(model),
      places_(model.places().size()),
      positions_(model.vertex_count()),
      normals_(model.vertex_count()),
      carried_(model.places().size()) {}

void FitBody::wipe() {
    for (auto* points : {&places_, &positions_, &normals_, &carried_}) vfit::wipe(std::span(*points));
    for (auto* points : {&offsets_, &bone_places_}) vfit::wipe(*points);
    for (auto* points : {&joint_places_, &joints_}) vfit::wipe(*points);
    vfit::wipe(skin_shape_), vfit::wipe(bone_shape_);
    vfit::wipe(bone_turns_), vfit::wipe(bone_rotations_);
    skin_shaped_ = bones_shaped_ = false;
}

void FitBody::place_bones(const FitState& state) {
    if (!bones_shaped_ || bone_shape_ != state.shape) {
        bone_shape_ = state.shape;
        bones_shaped_ = true;
        for (size_t b = 0; b < offsets_.size(); ++b) offsets_[b] = model_.offsets()[b].at(bone_shape_);
        for (size_t j = 0; j < joint_places_.size(); ++j)
            joint_places_[j] = model_.joints()[j].at(bone_shape_);
    }
    for (int b = 0; b < kBoneCount; ++b) {
        const auto i = size_t(b);
        const int parent = bone_parent(b);
        if (parent < 0) {
            bone_rotations_[i] = state.rotation[i];
            bone_places_[i] = state.hips;
        } else {
            const auto p = size_t(parent);
            bone_rotations_[i] = glm::normalize(bone_rotations_[p] * state.rotation[i]);
            bone_places_[i] = bone_places_[p] + bone_turns_[p] * offsets_[i];
        }
        bone_turns_[i] = glm::mat3_cast(bone_rotations_[i]);
    }
    for (size_t j = 0; j < joints_.size(); ++j) {
        const auto b = size_t(kJointPlaces[j].bone);
        joints_[j] = bone_places_[b] + bone_turns_[b] * joint_places_[j];
    }
}

void FitBody::place(const FitState& state) {
    place_bones(state);
    if (!skin_shaped_ || skin_shape_ != state.shape) {
        skin_shape_ = state.shape;
        skin_shaped_ = true;
        for (size_t v = 0; v < positions_.size(); ++v)
            for (size_t k = 0; k < size_t(model_.vertices()[v].influence_count); ++k)
                places_[v * kFitInfluences + k] = model_.places()[v * kFitInfluences + k].at(skin_shape_);
    }
    const auto& vertices = model_.vertices();
    for (size_t v = 0; v < vertices.size(); ++v) {
        Vec3 position(0.0f), normal(0.0f);
        for (int k = 0; k < vertices[v].influence_count; ++k) {
            const size_t i = v * kFitInfluences + size_t(k);
            const auto b = size_t(vertices[v].influences[size_t(k)].bone);
            const float weight = vertices[v].influences[size_t(k)].weight;
            carried_[i] = bone_places_[b] + bone_turns_[b] * places_[i];
            position += weight * carried_[i];
            normal += weight * (bone_turns_[b] * model_.normals()[i]);
        }
        positions_[v] = position;
        const float length = glm::length(normal);
        normals_[v] = length > 1e-6f ? normal / length : Vec3(0, 0, -1);
    }
}

}  // namespace vfit
