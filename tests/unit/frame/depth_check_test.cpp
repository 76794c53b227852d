// Depth images that are none, and those that are.
#include "frame/depth_check.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"

namespace vfit {
namespace {

class DepthCheck : public testing::Test {
protected:
    DepthCheck() : depth(640 * 480, 0) {
        image.camera.width = 640, image.camera.height = 480;
        image.camera.fx = image.camera.fy = 590.0f;
        image.camera.cx = 319.5f, image.camera.cy = 239.5f;
        image.camera.depth_unit_m = 0.001f;
        image.depth = depth.data();
    }
    /// A wall that leans, from one reading to the other.
    void fill(uint16_t from, uint16_t to) {
        for (size_t i = 0; i < depth.size(); ++i)
            depth[i] = uint16_t(from + (uint32_t(to) - from) * uint32_t(i / 640) / 479);
    }
    std::string cause() {
        try {
            check_depth(image);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            return error.what();
        }
        return {};
    }
    std::vector<uint16_t> depth;
    DepthImage image;
};

TEST_F(DepthCheck, ARoomIsOneAndAnEmptyImageTellsNothing) {
    EXPECT_FALSE(check_depth(image));
    fill(800, 4500);
    EXPECT_TRUE(check_depth(image));
    fill(300, 2100);  // close, and beyond 2047
    EXPECT_TRUE(check_depth(image));
    fill(600, 9000);
    EXPECT_TRUE(check_depth(image));
}

TEST_F(DepthCheck, AWrongUnitIsNamed) {
    fill(800, 4500);
    image.camera.depth_unit_m = 0.01f;
    EXPECT_NE(cause().find("median is 26"), std::string::npos) << cause();
    image.camera.depth_unit_m = 0.00001f;
    EXPECT_NE(cause().find("a unit of 1e-05 m is wrong"), std::string::npos) << cause();
}

TEST_F(DepthCheck, PackedAndRawValuesAreNamed) {
    fill(800 * 8, 4500 * 8);  // as a Kinect v1 packs them, with three bits for the player
    EXPECT_NE(cause().find("packed with other bits"), std::string::npos) << cause();
    fill(600, 1000);
    for (size_t i = 0; i < depth.size(); i += 10) depth[i] = 2047;
    EXPECT_NE(cause().find("raw disparities"), std::string::npos) << cause();
}

TEST_F(DepthCheck, AFieldOfViewThatNoCameraHasIsNamed) {
    fill(800, 4500);
    image.camera.fx = 0.9f;
    EXPECT_NE(cause().find("a field of view of 180 by 44 degrees"), std::string::npos) << cause();
}

}  // namespace
}  // namespace vfit
