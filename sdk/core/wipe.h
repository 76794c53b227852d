// Overwrites body data that is no longer needed.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

namespace vfit {

template <typename T>
void wipe(std::span<T> items) {
    static_assert(std::is_trivially_copyable_v<T>);
    // volatile: the stores must survive although the memory may be freed next.
    volatile unsigned char* bytes = reinterpret_cast<volatile unsigned char*>(items.data());
    for (size_t i = 0; i < items.size_bytes(); ++i) bytes[i] = 0;
}

template <typename T>
void wipe(T& value) {
    wipe(std::span(&value, 1));
}

}  // namespace vfit
