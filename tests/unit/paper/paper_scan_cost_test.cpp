// The scan allocates nothing after its first frame.
#include <gtest/gtest.h>

#include "figure_scene.h"
#include "paper/paper_scan.h"
#include "support/allocations.h"

namespace vfit {
namespace {

using namespace testing;

TEST(PaperScanCost, DoesNotAllocateAfterTheFirstFrame) {
    const Picture picture = take_picture(standing_figure(), level_camera());
    PaperScan scan{ScanDesc{}};
    scan.add({picture.image(), &picture.body, 1});
    const uint64_t before = test::allocations;
    for (int i = 0; i < 10; ++i) scan.add({picture.image(), &picture.body, 1});
    const uint64_t during = test::allocations - before;
    EXPECT_EQ(scan.frames_taken(), 11u);
    EXPECT_EQ(during, 0u);
}

}  // namespace
}  // namespace vfit
