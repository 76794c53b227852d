// Structs of a plug-in that was built with an older or newer header: what both sides know is read.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "core/error.h"

namespace vfit {

/// One item of `size` bytes; fields beyond it are zero.
template <typename T>
T read_sized(const void* item, uint32_t size, const char* name) {
    if (!item) fail(VFIT_ERROR_ARGUMENT, name, " is null");
    // No struct of any future version is larger than a page: a bigger size is garbage.
    if (size < 2 * sizeof(uint32_t) || size > 4096)
        fail(VFIT_ERROR_ARGUMENT, name, ": struct size ", size, " is not sane");
    T value{};
    std::memcpy(static_cast<void*>(&value), item, std::min<size_t>(size, sizeof(T)));
    return value;
}

template <typename T>
T read_sized(const T* item, const char* name) {
    if (!item) fail(VFIT_ERROR_ARGUMENT, name, " is null");
    return read_sized<T>(item, item->struct_size, name);
}

/// Ends a fixed text field that may have been left without an end.
template <size_t N>
void end_text(char (&field)[N]) {
    field[N - 1] = 0;
}

/// Length of a text, or `limit` where it is longer; reads no further.
inline size_t bounded_length(const char* text, size_t limit) {
    const void* end = std::memchr(text, 0, limit);
    return end ? static_cast<size_t>(static_cast<const char*>(end) - text) : limit;
}

/// At most `limit` characters of a text that may be null.
inline std::string bounded_text(const char* text, size_t limit) {
    return text ? std::string(text, bounded_length(text, limit)) : std::string();
}

}  // namespace vfit
