// A plane of the scene out of the cells of an image.
#include "track/scene_plane.h"

#include <gtest/gtest.h>

namespace vfit {
namespace {

/// Depth of an oblique wall at a cell of a grid with rays of 0.01 a cell.
float wall(float column, float row) { return 3.0f / (1.0f + 0.4f * 0.01f * column - 0.2f * 0.01f * row); }

TEST(ScenePlane, AWallGoesOnWhereAPatchOfItSays) {
    ScenePlane plane;
    for (float y = 100; y < 110; ++y)
        for (float x = 40; x < 46; ++x) plane.add(x, y, wall(x, y));
    ASSERT_TRUE(plane.fit());
    for (const float x : {0.0f, 43.0f, 150.0f}) EXPECT_NEAR(plane.depth(x, 60), wall(x, 60), 1e-3f) << x;
}

TEST(ScenePlane, AStripOfOneCellTellsNoPlane) {
    ScenePlane plane;
    EXPECT_FALSE(plane.fit());
    for (float y = 100; y < 130; ++y) plane.add(40, y, wall(40, y));
    EXPECT_FALSE(plane.fit());
    for (float y = 100; y < 130; ++y) plane.add(42, y, wall(42, y));
    EXPECT_TRUE(plane.fit());
}

}  // namespace
}  // namespace vfit
