// Looks for leaks when the last test has ended. At the process's exit, where AddressSanitizer looks by
// itself, threads that libraries share (TBB's, for OpenCV) are just ending, and it reads their storage while
// it goes.
#include <gtest/gtest.h>
#include <sanitizer/lsan_interface.h>

namespace {

class LeakCheck : public testing::Environment {
    void TearDown() override { __lsan_do_leak_check(); }
};

[[maybe_unused]] const testing::Environment* leak_check = testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
