// Counts every allocation of the test program, so that a step that must not allocate can be held to it. Include
// in exactly one source file of a program: it replaces the global operator new.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace vfit::test {

inline std::atomic<uint64_t> allocations{0};

inline void* counted(std::size_t size) noexcept {
    ++allocations;
    return std::malloc(size > 0 ? size : 1);
}

inline void* counted_or_throw(std::size_t size) {
    if (void* p = counted(size)) return p;
    throw std::bad_alloc();
}

}  // namespace vfit::test

void* operator new(std::size_t size) { return vfit::test::counted_or_throw(size); }
void* operator new[](std::size_t size) { return vfit::test::counted_or_throw(size); }
// What the standard library asks for this way (the buffer of std::stable_sort) it gives back the plain way.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return vfit::test::counted(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return vfit::test::counted(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
