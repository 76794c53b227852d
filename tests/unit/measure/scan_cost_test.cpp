// The scan allocates nothing after its first frame.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "figure_scene.h"
#include "measure/scan.h"

namespace {
std::atomic<bool> counting{false};
std::atomic<int> allocations{0};
}  // namespace

void* operator new(size_t size) {
    if (counting) ++allocations;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, size_t) noexcept { std::free(p); }

namespace vfit {
namespace {

using namespace testing;

TEST(ScanCost, DoesNotAllocateAfterTheFirstFrame) {
    const Picture picture = take_picture(standing_figure(), level_camera());
    Scan scan{ScanDesc{}};
    scan.add({picture.image(), &picture.body, 1});
    counting = true;
    for (int i = 0; i < 10; ++i) scan.add({picture.image(), &picture.body, 1});
    counting = false;
    EXPECT_EQ(scan.frames_taken(), 11u);
    EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace vfit
