// Pose and shape of the fitted body, the unknowns that they are solved for, and where both put the body.
#pragma once

#include <array>
#include <vector>

#include "fit/fit_model.h"

namespace vfit {

/// Camera space. Rotations are local to the parent bone and relative to the T-pose, as in Pose; that of the
/// hips is from the T-pose's axes to the camera's.
struct FitState {
    Vec3 hips{0.0f};
    std::array<Quat, kBoneCount> rotation;
    FitShape shape{};

    FitState() { rotation.fill(Quat(1, 0, 0, 0)); }
};

// Unknowns: three a bone (a small turn about the bone's own axes, applied first), the hips' place, then the
// shape.
inline constexpr int kFitBones = 20;  // all but the toes
inline constexpr int kFitHipsColumn = 3 * kFitBones;
inline constexpr int kFitPoseUnknowns = kFitHipsColumn + 3;
inline constexpr int kFitUnknowns = kFitPoseUnknowns + kFitShapes;

/// First column of that bone, or -1 for toes.
constexpr int fit_column(int bone) {
    if (bone == VFIT_BONE_LEFT_TOES || bone == VFIT_BONE_RIGHT_TOES) return -1;
    return 3 * (bone < VFIT_BONE_LEFT_TOES ? bone : bone - 1);
}

/// Adds a step in the unknowns.
void apply_step(const std::array<double, kFitUnknowns>& step, FitState& state);

/// Turn vector (axis times angle, shortest way) of a rotation, and the turn by a vector.
Vec3 log_of(const Quat& q);
Quat exp_of(const Vec3& v);

/// The model in one shape and pose. Camera space.
class FitBody {
public:
    explicit FitBody(const FitModel& model);

    /// Bones, joints and skin. Does not allocate. The shape is evaluated anew only where it has changed.
    void place(const FitState& state);
    /// Bones and joints alone: the skin stays where it was.
    void place_bones(const FitState& state);

    /// Overwrites the person's place and shape.
    void wipe();

    const FitModel& model() const { return model_; }
    const std::vector<Vec3>& positions() const { return positions_; }
    const std::vector<Vec3>& normals() const { return normals_; }  // unit
    /// kFitInfluences a vertex: where each of its bones alone would put it.
    const std::vector<Vec3>& carried() const { return carried_; }
    const std::array<Vec3, kBoneCount>& bone_places() const { return bone_places_; }
    const std::array<Mat3, kBoneCount>& bone_turns() const { return bone_turns_; }
    const std::array<Quat, kBoneCount>& bone_rotations() const { return bone_rotations_; }
    const std::array<Vec3, kJointCount>& joints() const { return joints_; }

private:
    const FitModel& model_;
    FitShape skin_shape_{}, bone_shape_{};  // that places_ and offsets_ are of
    bool skin_shaped_ = false, bones_shaped_ = false;
    std::vector<Vec3> places_;  // kFitInfluences a vertex, in bone frames
    std::array<Vec3, kBoneCount> offsets_{};
    std::array<Vec3, kJointCount> joint_places_{};
    std::vector<Vec3> positions_, normals_, carried_;
    std::array<Vec3, kBoneCount> bone_places_{};
    std::array<Mat3, kBoneCount> bone_turns_{};
    std::array<Quat, kBoneCount> bone_rotations_{};
    std::array<Vec3, kJointCount> joints_{};
};

}  // namespace vfit
