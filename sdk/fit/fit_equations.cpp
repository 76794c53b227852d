#include "fit/fit_equations.h"

#include <algorithm>
#include <cmath>

#include "core/wipe.h"
#include "fit/fit_kernels.h"

namespace vfit {

namespace {

constexpr size_t kTail = 3 + kFitShapes + 1;  // columns behind the bones': place, shape, residual

/// Adds direction . (turn * field) for every shape: `turned` is the direction in the field's frame.
void add_fields(const float* fields, const Vec3& turned, float* out) {
    for (size_t s = 0; s < size_t(kFitShapeLanes); ++s)
        out[s] += turned.x * fields[s] + turned.y * fields[kFitShapeLanes + s] +
                  turned.z * fields[2 * kFitShapeLanes + s];
}

bool is_ancestor(int ancestor, int bone) {
    for (; bone >= 0; bone = bone_parent(bone))
        if (bone == ancestor) return true;
    return false;
}

}  // namespace

FitEquations::FitEquations() {
    for (size_t g = 0; g < groups_.size(); ++g) {
        Group& group = groups_[g];
        if (g < size_t(kFitLimbs)) {
            const auto bones = FitModel::limb_bones(int(g));
            group.bones.assign(bones.begin(), bones.end());
        } else {
            for (int b = 0; b < kBoneCount; ++b)
                if (fit_column(b) >= 0) group.bones.push_back(b);
        }
        group.place.fill(-1);
        for (size_t i = 0; i < group.bones.size(); ++i) group.place[size_t(group.bones[i])] = int(i);
        group.columns = (3 * group.bones.size() + kTail + kRowLanes - 1) / kRowLanes * kRowLanes;
        group.rows.resize(kRowsAtOnce * group.columns);
        group.product.resize(group.columns * group.columns);
    }
}

void FitEquations::find_movers(const FitModel& model) {
    model_ = &model;
    movers_.clear();
    first_mover_.assign(1, 0);
    for (const FitModel::Vertex& vertex : model.vertices()) {
        for (const int bone : FitModel::limb_bones(vertex.limb)) {
            Mover mover{uint8_t(bone), 0, 0.0f};
            for (int k = 0; k < vertex.influence_count; ++k)
                if (is_ancestor(bone, vertex.influences[size_t(k)].bone)) {
                    mover.influences |= uint8_t(1 << k);
                    mover.weight += vertex.influences[size_t(k)].weight;
                }
            if (mover.influences != 0) movers_.push_back(mover);
        }
        first_mover_.push_back(static_cast<uint32_t>(movers_.size()));
    }
}

void FitEquations::wipe() {
    for (Group& group : groups_) {
        vfit::wipe(std::span(group.rows));
        vfit::wipe(std::span(group.product));
        group.count = 0;
    }
    vfit::wipe(start_fields_), vfit::wipe(matrix_), vfit::wipe(factor_);
    vfit::wipe(right_), vfit::wipe(half_solved_), vfit::wipe(shape_information_), vfit::wipe(shape_right_);
}

void FitEquations::start(const FitBody& body) {
    body_ = &body;
    if (model_ != &body.model()) find_movers(body.model());
    for (Group& group : groups_) {
        group.count = 0;
        if (group.used) std::fill(group.product.begin(), group.product.end(), 0.0f);
        group.used = false;
    }
    for (auto& row : matrix_) row.fill(0.0);
    right_.fill(0.0);
    for (int b = 1; b < kBoneCount; ++b) {
        const auto parent = size_t(bone_parent(b));
        const Mat3& turn = body.bone_turns()[parent];
        const auto& offset = body.model().offsets()[size_t(b)].fields;
        auto& out = start_fields_[size_t(b)];
        out = start_fields_[parent];
        for (int axis = 0; axis < 3; ++axis)
            add_fields(offset.data(), Vec3(turn[0][axis], turn[1][axis], turn[2][axis]),
                       out.data() + axis * kFitShapeLanes);
    }
}

float* FitEquations::new_row(Group& group) {
    if (group.count == kRowsAtOnce) flush(group);
    group.used = true;
    float* row = group.rows.data() + group.count++ * group.columns;
    std::fill_n(row, group.columns, 0.0f);
    return row;
}

void FitEquations::flush(Group& group) {
    add_row_products(group.rows.data(), group.count, group.columns, group.product.data());
    group.count = 0;
}

void FitEquations::add_vertex_row(uint32_t v, const Vec3& direction, float residual, float weight) {
    const FitModel::Vertex& vertex = model_->vertices()[v];
    Group& group = groups_[size_t(vertex.limb)];
    float* row = new_row(group);
    const float root = std::sqrt(weight);
    const Vec3 d = root * direction;
    const Vec3* carried = body_->carried().data() + size_t(v) * kFitInfluences;
    for (uint32_t m = first_mover_[v]; m < first_mover_[v + 1]; ++m) {
        const Mover& mover = movers_[m];
        Vec3 arm = -mover.weight * body_->bone_places()[mover.bone];
        for (int k = 0; k < kFitInfluences; ++k)
            if (mover.influences & (1 << k)) arm += vertex.influences[size_t(k)].weight * carried[k];
        const Vec3 turn = glm::cross(arm, d);
        float* out = row + 3 * group.place[mover.bone];
        out[0] = turn.x, out[1] = turn.y, out[2] = turn.z;
    }
    float* tail = row + 3 * group.bones.size();
    tail[0] = d.x, tail[1] = d.y, tail[2] = d.z;
    std::array<float, kFitShapeLanes> shapes{};
    for (int k = 0; k < vertex.influence_count; ++k) {
        const auto b = size_t(vertex.influences[size_t(k)].bone);
        const Vec3 share = vertex.influences[size_t(k)].weight * d;
        add_fields(start_fields_[b].data(), share, shapes.data());
        const auto& place = model_->places()[size_t(v) * kFitInfluences + size_t(k)];
        add_fields(place.fields.data(), share * body_->bone_turns()[b], shapes.data());  // v * M: transposed
    }
    std::copy_n(shapes.data(), kFitShapes, tail + 3);
    tail[3 + kFitShapes] = root * residual;
}

void FitEquations::add_joint_row(int joint, const Vec3& direction, float residual, float weight) {
    Group& group = groups_[size_t(kFitLimbs)];
    float* row = new_row(group);
    const float root = std::sqrt(weight);
    const Vec3 d = root * direction;
    const int bone = kJointPlaces[size_t(joint)].bone;
    const Vec3 at = body_->joints()[size_t(joint)];
    for (int b = bone; b >= 0; b = bone_parent(b)) {
        if (group.place[size_t(b)] < 0) continue;
        const Vec3 turn = glm::cross(at - body_->bone_places()[size_t(b)], d);
        float* out = row + 3 * group.place[size_t(b)];
        out[0] = turn.x, out[1] = turn.y, out[2] = turn.z;
    }
    float* tail = row + 3 * group.bones.size();
    tail[0] = d.x, tail[1] = d.y, tail[2] = d.z;
    std::array<float, kFitShapeLanes> shapes{};
    add_fields(start_fields_[size_t(bone)].data(), d, shapes.data());
    add_fields(model_->joints()[size_t(joint)].fields.data(), d * body_->bone_turns()[size_t(bone)],
               shapes.data());
    std::copy_n(shapes.data(), kFitShapes, tail + 3);
    tail[3 + kFitShapes] = root * residual;
}

void FitEquations::scatter(const Group& group) {
    std::array<int, kFitUnknowns + 1> column{};
    size_t count = 0;
    for (const int bone : group.bones)
        for (int k = 0; k < 3; ++k) column[count++] = fit_column(bone) + k;
    for (int k = 0; k < 3 + kFitShapes; ++k) column[count++] = kFitHipsColumn + k;
    for (size_t i = 0; i < count; ++i) {
        const float* product = group.product.data() + i * group.columns;
        for (size_t j = i; j < count; ++j) {
            // Groups list bones in rising order, so that the upper triangle stays the upper one.
            matrix_[size_t(column[i])][size_t(column[j])] += product[j];
        }
        right_[size_t(column[i])] += product[count];
    }
}

void FitEquations::finish() {
    for (Group& group : groups_) {
        if (!group.used) continue;
        flush(group);
        scatter(group);
    }
    for (size_t i = 0; i < size_t(kFitUnknowns); ++i)
        for (size_t j = 0; j < i; ++j) matrix_[i][j] = matrix_[j][i];
    // Turns about world axes become turns about the bones' own: w = R d.
    for (int b = 0; b < kBoneCount; ++b) {
        if (fit_column(b) < 0) continue;
        const auto c = size_t(fit_column(b));
        const Mat3& r = body_->bone_turns()[size_t(b)];
        const auto turned = [&](double& x, double& y, double& z) {
            const double w[3] = {x, y, z};
            double* out[3] = {&x, &y, &z};
            for (int k = 0; k < 3; ++k)
                *out[k] = double(r[k][0]) * w[0] + double(r[k][1]) * w[1] + double(r[k][2]) * w[2];
        };
        for (size_t j = 0; j < size_t(kFitUnknowns); ++j)
            turned(matrix_[c][j], matrix_[c + 1][j], matrix_[c + 2][j]);
        for (size_t i = 0; i < size_t(kFitUnknowns); ++i)
            turned(matrix_[i][c], matrix_[i][c + 1], matrix_[i][c + 2]);
        turned(right_[c], right_[c + 1], right_[c + 2]);
    }
}

void FitEquations::add_prior(int column, double residual, double weight) {
    matrix_[size_t(column)][size_t(column)] += weight;
    right_[size_t(column)] += weight * residual;
}

void FitEquations::add_turn_prior(int column, const Mat3& derivative, const Vec3& residual,
                                  const Vec3& weight) {
    for (int value = 0; value < 3; ++value)
        for (int i = 0; i < 3; ++i) {
            const double di =
                double(derivative[i][value]) * double(weight[value]);  // column-major: [unknown][value]
            right_[size_t(column + i)] += di * double(residual[value]);
            for (int j = 0; j < 3; ++j)
                matrix_[size_t(column + i)][size_t(column + j)] += di * double(derivative[j][value]);
        }
}

void FitEquations::add_shape_prior(const FitShapeMatrix& information,
                                   const std::array<double, kFitShapes>& residual) {
    for (size_t i = 0; i < size_t(kFitShapes); ++i)
        for (size_t j = 0; j < size_t(kFitShapes); ++j) {
            matrix_[kFitPoseUnknowns + i][kFitPoseUnknowns + j] += information[i][j];
            right_[kFitPoseUnknowns + i] += information[i][j] * residual[j];
        }
}

bool FitEquations::solve(FitVector& step) {
    // Cholesky, matrix = U^T U with U in the upper triangle, by rows: the inner loop runs along memory.
    constexpr size_t n = kFitUnknowns;
    constexpr size_t pose = kFitPoseUnknowns;
    for (size_t i = 0; i < n; ++i)
        std::copy(matrix_[i].begin() + std::ptrdiff_t(i), matrix_[i].end(),
                  factor_[i].begin() + std::ptrdiff_t(i));
    FitVector& y = half_solved_;
    y = right_;
    for (size_t k = 0; k < n; ++k) {
        double* pivot = factor_[k].data();
        if (!(pivot[k] > 1e-9) || !std::isfinite(pivot[k])) return false;
        const double inverse = 1.0 / std::sqrt(pivot[k]);
        for (size_t j = k; j < n; ++j) pivot[j] *= inverse;
        y[k] *= inverse;  // of U^T y = right side
        for (size_t i = k + 1; i < n; ++i) {
            const double share = pivot[i];
            if (share == 0.0) continue;  // limbs know nothing of each other
            double* row = factor_[i].data();
            for (size_t j = i; j < n; ++j) row[j] -= share * pivot[j];
            y[i] -= share * y[k];
        }
    }
    for (size_t i = n; i-- > pose;) {
        double sum = y[i];
        for (size_t k = i + 1; k < n; ++k) sum -= factor_[i][k] * step[k];
        step[i] = sum / factor_[i][i];
    }
    solve_pose(step);
    for (const double x : step)
        if (!std::isfinite(x)) return false;
    // The pose's unknowns stand first, so that the factor's last block is the factor of the Schur complement.
    for (size_t i = 0; i < size_t(kFitShapes); ++i)
        for (size_t j = i; j < size_t(kFitShapes); ++j) {
            double sum = 0.0;
            for (size_t k = 0; k <= i; ++k) sum += factor_[pose + k][pose + i] * factor_[pose + k][pose + j];
            shape_information_[i][j] = shape_information_[j][i] = sum;
        }
    for (size_t i = 0; i < size_t(kFitShapes); ++i) {
        shape_right_[i] = 0.0;
        for (size_t k = 0; k <= i; ++k) shape_right_[i] += factor_[pose + k][pose + i] * y[pose + k];
    }
    return true;
}

void FitEquations::solve_pose(FitVector& step) const {
    for (size_t i = size_t(kFitPoseUnknowns); i-- > 0;) {
        double sum = half_solved_[i];
        for (size_t k = i + 1; k < size_t(kFitUnknowns); ++k) sum -= factor_[i][k] * step[k];
        step[i] = sum / factor_[i][i];
    }
}

}  // namespace vfit
