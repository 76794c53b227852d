// Derivatives against differences, SIMD kernels against plain loops, and the shape's information.
#include "fit/fit_equations.h"

#include <gtest/gtest.h>

#include <random>

#include "fit/fit_kernels.h"
#include "fit/fit_priors.h"
#include "fit_scene.h"

namespace vfit {
namespace {

FitState bent_state() {
    FitState state;
    state.hips = Vec3(0.1f, 0.2f, 2.5f);
    for (int b = 0; b < kBoneCount; ++b)
        state.rotation[size_t(b)] =
            exp_of(0.3f * Vec3(std::sin(float(b)), std::cos(2.0f * float(b)), std::sin(3.0f * float(b))));
    state.rotation[VFIT_BONE_HIPS] = exp_of(Vec3(kPi - 0.2f, 0.1f, 0.2f));  // upright before a camera
    for (size_t s = 0; s < state.shape.size(); ++s) state.shape[s] = 0.3f * float(s % 4) - 0.4f;
    return state;
}

/// Derivatives of one row are its normal equations' right side for a residual of 1.
template <typename Row, typename Value>
void expect_derivatives(Row&& add_row, Value&& value_at) {
    const FitState state = bent_state();
    FitBody body(*fit_model());
    body.place(state);
    FitEquations equations;
    equations.start(body);
    add_row(equations, 1.0f);
    equations.finish();
    constexpr double h = 4e-3;
    for (int c = 0; c < kFitUnknowns; ++c) {
        FitVector step{};
        double value[2];
        for (int side = 0; side < 2; ++side) {
            step[size_t(c)] = side == 0 ? -h : h;
            FitState moved = state;
            apply_step(step, moved);
            FitBody there(*fit_model());
            there.place(moved);
            value[side] = double(value_at(there));
        }
        EXPECT_NEAR(equations.right_side(c), (value[1] - value[0]) / (2 * h), 4e-4) << "column " << c;
        EXPECT_NEAR(equations.matrix(c, c), equations.right_side(c) * equations.right_side(c), 1e-5);
    }
}

TEST(FitEquations, DerivativesOfAVertexAreThoseOfDifferences) {
    const Vec3 direction = glm::normalize(Vec3(0.3f, -0.5f, 0.8f));
    for (uint32_t v = 7; v < fit_model()->vertex_count(); v += 131)
        expect_derivatives(
            [&](FitEquations& e, float residual) { e.add_vertex_row(v, direction, residual, 1.0f); },
            [&](const FitBody& body) { return glm::dot(direction, body.positions()[v]); });
}

TEST(FitEquations, DerivativesOfAJointAreThoseOfDifferences) {
    const Vec3 direction = glm::normalize(Vec3(-0.6f, 0.2f, 0.7f));
    for (int j = 0; j < kJointCount; ++j)
        expect_derivatives(
            [&](FitEquations& e, float residual) { e.add_joint_row(j, direction, residual, 1.0f); },
            [&](const FitBody& body) { return glm::dot(direction, body.joints()[size_t(j)]); });
}

TEST(FitEquations, DerivativeOfATurnVectorIsThatOfDifferences) {
    for (const Vec3 v : {Vec3(0.0f), Vec3(0.4f, -0.3f, 0.2f), Vec3(1.5f, 0.8f, -0.9f), Vec3(1e-4f, 0, 0)}) {
        const Mat3 derivative = turn_derivative(v);
        for (int i = 0; i < 3; ++i) {
            constexpr float h = 1e-2f;
            Vec3 step(0.0f);
            step[i] = h;
            const Vec3 difference =
                (log_of(exp_of(v) * exp_of(step)) - log_of(exp_of(v) * exp_of(-step))) / (2 * h);
            EXPECT_LT(glm::length(difference - derivative[i]), 2e-3f);
        }
    }
}

TEST(FitEquations, AStepFromManyRowsBringsThePointsHome) {
    FitState state = bent_state(), wanted = state;
    FitVector step{};
    for (size_t i = 0; i < step.size(); ++i) step[i] = 0.01 * std::sin(double(i));
    apply_step(step, wanted);
    FitBody body(*fit_model()), target(*fit_model());
    target.place(wanted);
    FitEquations equations;
    for (int i = 0; i < 6; ++i) {
        body.place(state);
        equations.start(body);
        for (uint32_t v = 0; v < fit_model()->vertex_count(); ++v)
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 direction(0.0f);
                direction[axis] = 1.0f;
                equations.add_vertex_row(v, direction,
                                         target.positions()[v][axis] - body.positions()[v][axis], 1000.0f);
            }
        equations.finish();
        for (int c = 0; c < kFitUnknowns; ++c) equations.add_prior(c, 0.0, 1e-4);
        FitVector found;
        ASSERT_TRUE(equations.solve(found));
        apply_step(found, state);
    }
    body.place(state);
    for (uint32_t v = 0; v < fit_model()->vertex_count(); v += 40)
        EXPECT_LT(glm::distance(body.positions()[v], target.positions()[v]), 1e-3f);
    // All of the shape was seen through the open pose.
    for (size_t s = 0; s < size_t(kFitShapes); ++s) EXPECT_GT(equations.shape_information()[s][s], 1.0);
}

TEST(FitEquations, TheShapesOwnEquationsHaveTheSameSolution) {
    FitBody body(*fit_model());
    body.place(bent_state());
    FitEquations equations;
    equations.start(body);
    for (uint32_t v = 0; v < fit_model()->vertex_count(); ++v)
        equations.add_vertex_row(v, body.normals()[v], 0.01f * std::sin(float(v)), 1000.0f);
    equations.finish();
    for (int c = 0; c < kFitUnknowns; ++c) equations.add_prior(c, 0.01, 1.0);
    FitVector step, again{};
    ASSERT_TRUE(equations.solve(step));
    for (size_t i = 0; i < size_t(kFitShapes); ++i) {
        double sum = 0.0;
        for (size_t j = 0; j < size_t(kFitShapes); ++j)
            sum += equations.shape_information()[i][j] * step[kFitPoseUnknowns + j];
        EXPECT_NEAR(sum, equations.shape_right_side()[i], 1e-6 * (1.0 + std::abs(sum)));
        again[kFitPoseUnknowns + i] = step[kFitPoseUnknowns + i];
    }
    equations.solve_pose(again);
    for (size_t i = 0; i < size_t(kFitUnknowns); ++i) EXPECT_NEAR(again[i], step[i], 1e-9);
    // And it is the solution: the matrix times it is the right side.
    for (int i = 0; i < kFitUnknowns; ++i) {
        double sum = 0.0;
        for (int j = 0; j < kFitUnknowns; ++j) sum += equations.matrix(i, j) * step[size_t(j)];
        EXPECT_NEAR(sum, equations.right_side(i), 1e-6 * (1.0 + std::abs(sum)));
    }
}

TEST(FitEquations, NoRowsHaveNoSolution) {
    FitBody body(*fit_model());
    body.place(bent_state());
    FitEquations equations;
    equations.start(body);
    equations.finish();
    FitVector step;
    EXPECT_FALSE(equations.solve(step));
}

TEST(FitKernels, TheNearestIsThatOfAPlainLoop) {
    std::mt19937 bits(3);
    std::normal_distribution<float> normal(0.0f, 1.0f);
    const auto vector = [&] { return Vec3(normal(bits), normal(bits), normal(bits)); };
    for (const uint32_t count : {0u, 1u, 7u, 16u, 555u}) {
        FitTargets targets;
        std::vector<Vec3> places, normals;
        for (uint32_t i = 0; i < count; ++i) {
            places.push_back(0.5f * vector());
            normals.push_back(glm::normalize(vector()));
            targets.add(places.back(), normals.back(), 100 + i);
        }
        targets.finish();
        for (int k = 0; k < 50; ++k) {
            const Vec3 place = 0.5f * vector(), n = glm::normalize(vector());
            float score = -1.0f;
            const uint32_t found = nearest_target(targets, place, n, score);
            if (count == 0) {
                EXPECT_EQ(found, FitTargets::kNone);
                continue;
            }
            float best = 1e9f;
            for (uint32_t i = 0; i < count; ++i) {
                const Vec3 d = place - places[i];
                best =
                    std::min(best, glm::dot(d, d) + FitTargets::kBend_m2 * (1.0f - glm::dot(n, normals[i])));
            }
            EXPECT_NEAR(score, best, 1e-5f);
            const Vec3 d = place - places[found - 100];
            EXPECT_NEAR(glm::dot(d, d) + FitTargets::kBend_m2 * (1.0f - glm::dot(n, normals[found - 100])),
                        best, 1e-5f);
        }
    }
}

TEST(FitKernels, ProductsOfRowsAreThoseOfAPlainLoop) {
    std::mt19937 bits(5);
    std::normal_distribution<float> normal(0.0f, 1.0f);
    for (const size_t columns : {size_t(16), size_t(48), size_t(80)}) {
        const size_t count = 37;
        std::vector<float> rows(count * columns), product(columns * columns, 1.0f);
        for (float& x : rows) x = normal(bits);
        add_row_products(rows.data(), count, columns, product.data());
        for (size_t i = 0; i < columns; ++i)
            for (size_t j = i; j < columns; ++j) {
                double sum = 1.0;
                for (size_t r = 0; r < count; ++r)
                    sum += double(rows[r * columns + i]) * double(rows[r * columns + j]);
                EXPECT_NEAR(product[i * columns + j], sum, 1e-4);
            }
    }
}

}  // namespace
}  // namespace vfit
