// Allocations of the test program so far; counted where one of its source files includes allocations.h.
#pragma once

#include <atomic>
#include <cstdint>

namespace vfit::test {

inline std::atomic<uint64_t> allocations{0};

}  // namespace vfit::test
