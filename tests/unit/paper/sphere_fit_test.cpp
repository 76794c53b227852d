// Algorithm 2 on depth images whose spheres are known.
#include "paper/sphere_fit.h"

#include <gtest/gtest.h>

#include "figure_scene.h"

namespace vfit {
namespace {

using namespace testing;

Camera straight_camera() {
    Camera camera = level_camera();
    set_floor(camera, 1.0f, 0.0f, 0.0f, VFIT_FLOOR_GIVEN);
    return camera;
}

struct Fitted {
    Fitted(const Figure& figure, const Camera& camera) : picture(take_picture(figure, camera)) {
        depth = filter.run(picture.image(), 1);
    }
    float at(const Vec3& world) {
        return fit_sphere(depth, picture.camera, transform_point(picture.camera.camera_from_world(), world));
    }
    Picture picture;
    DepthFilter filter;
    FilteredDepth depth;
};

TEST(SphereFit, FindsTheRadiusOfASphere) {
    const Vec3 center(0.1f, 1.1f, -2.0f);
    Figure ball;
    ball.spheres.push_back({center, 0.10f});
    EXPECT_NEAR(Fitted(ball, straight_camera()).at(center), 0.10f, 0.005f);
}

TEST(SphereFit, TakesTheSmallestOfTheFiveDirections) {
    Figure slab;
    const Vec3 center(0.0f, 0.70f, -2.0f);  // its upper edge level with the camera: no perspective there
    slab.boxes.push_back({center - Vec3(0.06f, 0.30f, 0.10f), center + Vec3(0.06f, 0.30f, 0.10f)});
    Fitted fit(slab, straight_camera());
    EXPECT_NEAR(fit.at(center), 0.06f, 0.005f) << "side to side";
    EXPECT_NEAR(fit.at(center + Vec3(0.03f, 0, 0)), 0.03f, 0.005f) << "off the middle";
    EXPECT_NEAR(fit.at(center + Vec3(0, 0.28f, 0)), 0.02f, 0.005f) << "below the upper edge";
    EXPECT_NEAR(fit.at(center + Vec3(0, 0, 0.07f)), 0.03f, 0.005f) << "behind the surface, Eq. 3";
}

TEST(SphereFit, EndsWhereTheDepthJumpsWithinThePerson) {
    Figure arm;
    const Vec3 center(0.0f, 1.0f, -1.8f);
    arm.boxes.push_back({{-0.30f, 0.6f, -2.3f}, {0.30f, 1.4f, -2.2f}});  // the trunk behind
    arm.boxes.push_back({center - Vec3(0.04f, 0.30f, 0.06f), center + Vec3(0.04f, 0.30f, 0.06f)});
    EXPECT_NEAR(Fitted(arm, straight_camera()).at(center), 0.04f, 0.004f);
}

TEST(SphereFit, DiscardsDirectionsThatReachTheBorderOfTheImage) {
    Figure wide;
    wide.boxes.push_back({{-0.9f, 0.8f, -2.2f}, {3.0f, 1.2f, -1.8f}});  // runs out of the image to the right
    Fitted fit(wide, straight_camera());
    const float right_border = 2.0f * (639.0f - 319.5f) / 576.0f;
    EXPECT_NEAR(fit.at({right_border - 0.05f, 1.0f, -2.0f}), 0.2f, 0.01f);

    Figure all;
    all.boxes.push_back({{-5, -5, -2.2f}, {5, 5, -1.8f}});
    EXPECT_NEAR(Fitted(all, straight_camera()).at({0, 1, -2.0f}), 0.2f, 0.005f) << "r_z alone is left";
    EXPECT_EQ(Fitted(all, straight_camera()).at({0, 1, -1.7f}), 0.0f) << "and nothing before the surface";
}

TEST(SphereFit, DoesNotMeasureJointsOutsideThePerson) {
    Fitted fit(standing_figure(), straight_camera());
    EXPECT_EQ(fit.at({1.0f, 1.0f, -2.8f}), 0.0f);
    EXPECT_EQ(fit.at({0.0f, 1.0f, 1.0f}), 0.0f) << "behind the camera";
    EXPECT_EQ(fit.at({40.0f, 1.0f, -2.8f}), 0.0f) << "outside the image";
    EXPECT_EQ(fit_sphere(fit.depth, fit.picture.camera, {1.0f, 1.0f, 1e-30f}), 0.0f) << "in the camera";
}

TEST(SphereFit, FitsTheFifteenJointsAndLeavesOutTheUnseen) {
    Figure figure = standing_figure();
    figure.joints.joints[VFIT_JOINT_LEFT_HAND].state = VFIT_JOINT_NOT_SEEN;
    Fitted fit(figure, straight_camera());
    const auto radii = fit_spheres(fit.depth, fit.picture.camera, fit.picture.body);
    EXPECT_EQ(radii[VFIT_JOINT_LEFT_HAND], 0.0f);
    EXPECT_NEAR(radii[VFIT_JOINT_HEAD], kHeadRadius_m, 0.006f);
    EXPECT_NEAR(radii[VFIT_JOINT_RIGHT_ELBOW], 0.02f, 0.005f);  // 45 mm wide, the joint 20 mm inside
    EXPECT_NEAR(radii[VFIT_JOINT_TORSO], 0.10f, 0.005f);        // half of the trunk's depth
}

}  // namespace
}  // namespace vfit
