// What a frame shows: cells, depth points with normals, and the model drawn on the same cells.
#include "fit/fit_view.h"

#include <gtest/gtest.h>

#include "fit/fit_raster.h"
#include "fit_scene.h"

namespace vfit {
namespace {

/// A tilted board of the person's: z = distance + slope x (x in metres to the right).
FitScene board(float slope, float distance_m = 2.5f) {
    FitScene scene;
    scene.depth.assign(640 * 480, 6000);
    scene.users.assign(640 * 480, 0);
    for (int y = 140; y < 340; ++y)
        for (int x = 220; x < 420; ++x) {
            const float a = (float(x) - scene.camera.cx) / scene.camera.fx;
            const float z = distance_m / (1.0f - slope * a);
            scene.depth[size_t(y * 640 + x)] = uint16_t(std::lround(z * 1000.0f));
            scene.users[size_t(y * 640 + x)] = 1;
        }
    return scene;
}

TEST(FitView, PointsLieOnTheBoardWithItsNormal) {
    for (const float slope : {0.0f, 0.6f, -1.0f}) {
        const FitScene scene = board(slope);
        FitView view;
        ASSERT_TRUE(view.look(scene.image(), 1, {}));
        ASSERT_GT(view.points().size(), 300u);
        ASSERT_LE(view.points().size(), 2000u);
        const Vec3 normal = glm::normalize(Vec3(slope, 0, -1));
        float sum = 0.0f;
        for (const FitDepthPoint& p : view.points()) {
            EXPECT_NEAR(p.place.z, 2.5f + slope * p.place.x, 0.004f);
            sum += glm::dot(p.normal, normal);
        }
        EXPECT_GT(sum / float(view.points().size()), 0.995f) << slope;
    }
}

TEST(FitView, CellsHoldThePersonsMeanDepthFromNearAndFar) {
    // Cells of one, two, three and more pixels.
    for (const float distance_m : {4.5f, 2.5f, 1.8f, 1.2f}) {
        FitScene scene = board(0.0f, distance_m);
        for (int y = 140; y < 340; ++y)
            for (int x = 220; x < 420; ++x) scene.depth[size_t(y * 640 + x)] += uint16_t(x % 2 ? 4 : 0);
        FitView view;
        ASSERT_TRUE(view.look(scene.image(), 1, {}));
        uint32_t people = 0, others = 0;
        float sum = 0.0f;
        for (int y = 0; y < view.height(); ++y)
            for (int x = 0; x < view.width(); ++x) {
                if (view.cell(x, y) == FitCell::kPerson) {
                    ++people, sum += view.depth(x, y);
                    EXPECT_NEAR(view.depth(x, y), distance_m + 0.002f, 0.0021f);
                } else if (view.cell(x, y) == FitCell::kOther) {
                    ++others;
                    EXPECT_NEAR(view.depth(x, y), 6.0f, 1e-3f);
                }
            }
        EXPECT_EQ(people, view.person_cells());
        EXPECT_GT(others, 0u);
        EXPECT_NEAR(sum / float(people), distance_m + 0.002f, 5e-4f) << distance_m;
    }
}

TEST(FitView, TellsThePersonFromWhatIsBehindAndFromHoles) {
    FitScene scene = board(0.0f);
    for (int y = 200; y < 220; ++y)
        for (int x = 300; x < 320; ++x)
            scene.depth[size_t(y * 640 + x)] = 0, scene.users[size_t(y * 640 + x)] = 0;
    FitView view;
    ASSERT_TRUE(view.look(scene.image(), 1, {}));
    const auto cell_at = [&](float u, float v) {
        const Vec2 c = view.project(scene.camera.unproject(u, v, 2.0f));
        return view.cell(int(std::lround(c.x)), int(std::lround(c.y)));
    };
    EXPECT_EQ(cell_at(250, 250), FitCell::kPerson);
    EXPECT_EQ(cell_at(200, 250), FitCell::kOther);
    EXPECT_EQ(cell_at(310, 210), FitCell::kFree);
    EXPECT_TRUE(view.beyond_image(view.project(scene.camera.unproject(-3, 100, 2.0f))));
    EXPECT_FALSE(view.beyond_image(view.project(scene.camera.unproject(3, 100, 2.0f))));
}

TEST(FitView, SaysNothingOfNobody) {
    FitScene scene = board(0.0f);
    FitView view;
    EXPECT_FALSE(view.look(scene.image(), 2, {}));
    EXPECT_FALSE(view.look(scene.image(), 1, {0, 0, 10, 10}));
    EXPECT_FALSE(view.look({scene.depth.data(), nullptr, scene.camera}, 1, {}));
    EXPECT_TRUE(view.look(scene.image(), 1, {-50, -50, 9000, 9000}));
}

TEST(FitRaster, TheTrueBodyCoversItsOwnPicture) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    const FitScene scene = shoot(avatar, easy_pose(avatar.skeleton()));
    FitView view;
    ASSERT_TRUE(view.look(scene.image(), 1, {}));
    FitState state;
    state.hips = scene.joints.at(VFIT_JOINT_PELVIS);
    state.rotation = easy_pose(avatar.skeleton()).rotation;
    state.rotation[VFIT_BONE_HIPS] = scene.joints.joints[VFIT_JOINT_PELVIS].rotation;
    FitBody body(*fit_model());
    body.place(state);
    FitRaster raster;
    raster.draw(body, view);
    const FitScore score = raster.score(view);
    EXPECT_GT(score.iou, 0.90f);
    EXPECT_LT(score.median_m, 0.008f);
    uint32_t visible = 0;
    for (uint32_t v = 0; v < fit_model()->vertex_count(); ++v) visible += raster.visible(body, view, v);
    EXPECT_GT(visible, 350u);
    EXPECT_LT(visible, 700u);
}

}  // namespace
}  // namespace vfit
