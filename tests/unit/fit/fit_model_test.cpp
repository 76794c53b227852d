// The reduced body: its surface, its shapes, and that it moves as the avatar does.
#include "fit/fit_model.h"

#include <gtest/gtest.h>

#include <map>

#include "fit/fit_pose.h"
#include "fit_scene.h"

namespace vfit {
namespace {

TEST(FitModel, ItsTrianglesCloseTheSurfaceButForAFewSeams) {
    const FitModel& model = *fit_model();
    ASSERT_EQ(model.vertex_count(), 1200u);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    const auto& t = model.triangles();
    for (size_t i = 0; i < t.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) ++edges[{t[i + k], t[i + (k + 1) % 3]}];
    size_t open = 0;
    for (const auto& [edge, count] : edges) open += edges.count({edge.second, edge.first}) == 0;
    EXPECT_GT(t.size() / 3, 2200u);  // 2 n - 4 of a closed surface
    EXPECT_LT(double(open), 0.03 * double(edges.size()));
}

TEST(FitModel, StandsOnTheAvatarsSkinInAnyPose) {
    AvatarDesc desc;
    desc.single_bones = true;
    for (const std::vector<float>& components :
         {std::vector<float>{}, {1.2f, -0.8f, 0.5f}, {-1.5f, 1.0f, 0.0f, 0.8f}}) {
        Avatar avatar(body_model(), desc, shape_of(components), Vec2(1.0f));
        const Pose pose = easy_pose(avatar.skeleton());
        avatar.pose(pose, *Jobs::own(0));
        FitState state;
        state.hips = avatar.posed_skeleton().position[VFIT_BONE_HIPS];
        state.rotation = pose.rotation;
        std::copy(components.begin(), components.end(), state.shape.begin());
        FitBody body(*fit_model());
        body.place(state);
        double sum = 0.0;
        for (uint32_t v = 0; v < fit_model()->vertex_count(); ++v)
            sum += glm::distance(body.positions()[v], avatar.positions()[fit_model()->vertices()[v].source]);
        // What linear shapes and three bones a vertex lose.
        EXPECT_LT(sum / fit_model()->vertex_count(), 0.012) << components.size();
        const Body joints = avatar.joints();
        for (int j = 0; j < kPaperJointCount; ++j)
            EXPECT_LT(glm::distance(body.joints()[size_t(j)], joints.at(j)), 0.02) << joint_name(j);
    }
}

TEST(FitModel, FineAndCoarseVerticesMoveAlike) {
    const FitModel fine = fit_model()->refined(*body_model());
    ASSERT_EQ(fine.vertex_count(), body_model()->topology(0).vertex_count);
    FitState state;
    for (size_t i = 0; i < state.shape.size(); ++i) state.shape[i] = 0.5f - float(i % 3);
    FitBody a(*fit_model()), b(fine);
    a.place(state);
    b.place(state);
    std::vector<Vec3> by_source(fine.vertex_count());
    for (uint32_t v = 0; v < fine.vertex_count(); ++v)
        by_source[fine.vertices()[v].source] = b.positions()[v];
    for (uint32_t v = 0; v < fit_model()->vertex_count(); v += 50)
        EXPECT_LT(glm::distance(a.positions()[v], by_source[fit_model()->vertices()[v].source]), 1e-4f);
}

TEST(FitModel, LayersPushTheSkinOutwardsByTheirUnit) {
    FitState naked, dressed;
    dressed.shape[kFitComponents] = 2.0f;  // trunk
    FitBody a(*fit_model()), b(*fit_model());
    a.place(naked);
    b.place(dressed);
    float most = 0.0f;
    for (uint32_t v = 0; v < fit_model()->vertex_count(); ++v) {
        const Vec3 moved = b.positions()[v] - a.positions()[v];
        EXPECT_GE(glm::dot(moved, a.normals()[v]), -1e-4f);
        most = std::max(most, glm::length(moved));
    }
    EXPECT_NEAR(most, 2.0f * kLayerUnit_m, 1e-3f);
}

TEST(FitModel, RefusesAVertexCountThatMakesNoBody) {
    EXPECT_ANY_THROW(FitModel(*body_model(), 10));
    EXPECT_ANY_THROW(FitModel(*body_model(), 100000));
}

}  // namespace
}  // namespace vfit
