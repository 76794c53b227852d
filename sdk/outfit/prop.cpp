#include "outfit/prop.h"

#include "core/error.h"

namespace vfit {

Prop::Prop(const Mesh& mesh) : mesh_(mesh.positions, mesh.indices) {
    mesh_.place(mesh.positions, own_);
    place();
}

void Prop::move(const Vec3& position, const Quat& rotation) {
    position_ = position, rotation_ = rotation;
    place();
}

void Prop::deform(std::span<const Vec3> given) {
    if (given.size() != mesh_.given_count())
        fail(VFIT_ERROR_ARGUMENT, given.size(), " positions for a prop of ", mesh_.given_count(),
             " vertices");
    mesh_.place(given, own_);
    place();
}

void Prop::place() {
    const Mat3 turn = glm::mat3_cast(rotation_);
    positions_.resize(own_.size());
    for (size_t i = 0; i < own_.size(); ++i) positions_[i] = turn * own_[i] + position_;
}

}  // namespace vfit
