// Counts every allocation of the test program, so that a step that must not allocate can be held to it.
// Include in exactly one source file of a program: it replaces the global operator new.
#pragma once

#include <cstdlib>
#include <new>

#include "support/allocation_count.h"

namespace vfit::test {

inline void* counted(std::size_t size) noexcept {
    ++allocations;
    return std::malloc(size > 0 ? size : 1);
}

#if !defined(_MSC_VER)  // its runtime has no std::aligned_alloc: aligned allocations go uncounted there
inline void* counted(std::size_t size, std::align_val_t align) noexcept {
    ++allocations;
    const auto unit = static_cast<std::size_t>(align);
    return std::aligned_alloc(unit, size > 0 ? (size + unit - 1) / unit * unit : unit);
}
#endif

inline void* counted_or_throw(std::size_t size) {
    if (void* p = counted(size)) return p;
    throw std::bad_alloc();
}

}  // namespace vfit::test

#if defined(__GNUC__) && !defined(__clang__)
// Where GCC inlines only one of the two, it takes free for a stranger to this operator new.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

void* operator new(std::size_t size) { return vfit::test::counted_or_throw(size); }
void* operator new[](std::size_t size) { return vfit::test::counted_or_throw(size); }
// What the standard library asks for this way (the buffer of std::stable_sort) it gives back the plain way.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return vfit::test::counted(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return vfit::test::counted(size); }
#if !defined(_MSC_VER)
void* operator new(std::size_t size, std::align_val_t align) {
    if (void* p = vfit::test::counted(size, align)) return p;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size, std::align_val_t align) { return operator new(size, align); }
void* operator new(std::size_t size, std::align_val_t align, const std::nothrow_t&) noexcept {
    return vfit::test::counted(size, align);
}
void* operator new[](std::size_t size, std::align_val_t align, const std::nothrow_t&) noexcept {
    return vfit::test::counted(size, align);
}
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
#endif
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
