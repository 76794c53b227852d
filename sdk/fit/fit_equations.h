// The normal equations of one frame: rows of residuals with their derivatives by pose and shape, summed,
// solved, and what they say of the shape alone when the pose is left open (for fits of one shape to many
// frames).
//
// A row says that the residual r = direction . (target - point) should vanish; its derivatives are those of
// direction . point. With small turns about world axes w of bone k at c, a point x that k carries in full
// moves by w x (x - c); a point of several bones by the weighted sum over the bones below k.
#pragma once

#include <array>
#include <vector>

#include "fit/fit_pose.h"

namespace vfit {

using FitVector = std::array<double, kFitUnknowns>;
using FitShapeMatrix = std::array<std::array<double, kFitShapes>, kFitShapes>;

class FitEquations {
public:
    FitEquations();

    /// Overwrites what the rows said.
    void wipe();
    /// Empty equations about that body; it must stay as it is until finish().
    void start(const FitBody& body);
    void add_vertex_row(uint32_t vertex, const Vec3& direction, float residual, float weight);
    void add_joint_row(int joint, const Vec3& direction, float residual, float weight);
    /// Sums the rows. Priors, which are in the unknowns themselves, come after it.
    void finish();
    void add_prior(int column, double residual, double weight);
    /// derivative: of the three values by the three unknowns from that column on.
    void add_turn_prior(int column, const Mat3& derivative, const Vec3& residual, const Vec3& weight);
    void add_shape_prior(const FitShapeMatrix& information, const std::array<double, kFitShapes>& residual);

    /// The step to the least sum of squares. False where there is none: nothing holds some unknown.
    bool solve(FitVector& step);
    /// After solve, with the pose eliminated (Schur complement): information . shape step = right side. Those
    /// of many frames of one person add up to the equations of their common shape.
    const FitShapeMatrix& shape_information() const { return shape_information_; }
    const std::array<double, kFitShapes>& shape_right_side() const { return shape_right_; }
    /// After solve: the best step of the pose where the shape's is given; `step` holds it in its last places.
    void solve_pose(FitVector& step) const;

    double matrix(int row, int column) const { return matrix_[size_t(row)][size_t(column)]; }  // after finish
    double right_side(int row) const { return right_[size_t(row)]; }

private:
    // Rows of one limb, or of joints, have the same columns: its bones', then place and shape, then the
    // residual.
    struct Group {
        std::vector<int> bones;
        std::array<int, kBoneCount> place{};  // of a bone among them; -1
        size_t columns = 0;                   // padded
        size_t count = 0;
        bool used = true;  // product is not zero
        std::vector<float> rows, product;
    };
    /// Which bone moves how much of a vertex.
    struct Mover {
        uint8_t bone;
        uint8_t influences;  // bits
        float weight;        // their sum
    };
    static constexpr size_t kRowsAtOnce = 128;
    void find_movers(const FitModel& model);
    float* new_row(Group& group);
    void flush(Group& group);
    void scatter(const Group& group);

    const FitBody* body_ = nullptr;
    const FitModel* model_ = nullptr;
    std::array<Group, kFitLimbs + 1> groups_;
    std::vector<Mover> movers_;
    std::vector<uint32_t> first_mover_;
    // Of bones' starts by shape, padded as FitPoint::fields; hips first, and they do not move.
    std::array<std::array<float, 3 * kFitShapeLanes>, kBoneCount> start_fields_{};
    std::array<std::array<double, kFitUnknowns>, kFitUnknowns> matrix_{}, factor_{};
    FitVector right_{}, half_solved_{};  // half_solved: U^-T right
    FitShapeMatrix shape_information_{};
    std::array<double, kFitShapes> shape_right_{};
};

}  // namespace vfit
