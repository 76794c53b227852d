// Reading and writing what crosses the C ABI: sized structs, arrays with a stride, lists, texts, enums.
// The rules are those of STRUCT, LIST and TEXT in vfit.h.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "vfit.h"

namespace vfit::api {

/// No struct of any future version is larger: a bigger size is garbage, not a newer caller.
inline constexpr uint32_t kMaxStructSize = 4096;
inline constexpr uint32_t kMaxItems = 1u << 20;

template <typename T>
void check_pointer(const T* pointer, const char* name) {
    if (!pointer) fail(VFIT_ERROR_ARGUMENT, name, " is null");
}

inline bool all_zero(const unsigned char* bytes, size_t count) {
    return std::all_of(bytes, bytes + count, [](unsigned char b) { return b == 0; });
}

inline void check_size(uint32_t size, const char* name) {
    if (size < 2 * sizeof(uint32_t) || size > kMaxStructSize || size % 4 != 0)
        fail(VFIT_ERROR_ARGUMENT, name, ": struct_size ", size, " is not set; start from its _init function");
}

template <typename T>
T read_item(const void* from, uint32_t size, const char* name) {
    T value{};
    const auto* bytes = static_cast<const unsigned char*>(from);
    if (size > sizeof(T) && !all_zero(bytes + sizeof(T), size - sizeof(T)))
        fail(VFIT_ERROR_UNSUPPORTED, name, " has fields that this version of the library does not know");
    std::memcpy(static_cast<void*>(&value), bytes, std::min<size_t>(size, sizeof(T)));
    return value;
}

/// A required input struct, as this library knows it.
template <typename T>
T read(const T* in, const char* name) {
    check_pointer(in, name);
    check_size(in->struct_size, name);
    return read_item<T>(in, in->struct_size, name);
}

/// An optional one: null reads as all zero.
template <typename T>
T read_or_default(const T* in, const char* name) {
    return in ? read(in, name) : T{};
}

template <typename T>
void write_item(void* to, uint32_t size, const T& value) {
    std::memcpy(to, static_cast<const void*>(&value), std::min<size_t>(size, sizeof(T)));
    if (size > sizeof(T)) std::memset(static_cast<char*>(to) + sizeof(T), 0, size - sizeof(T));
    std::memcpy(to, &size, sizeof size);
}

/// Checks an output struct before any work is done; write() then cannot fail.
template <typename T>
void check_output(const T* out, const char* name) {
    check_pointer(out, name);
    check_size(out->struct_size, name);
}

template <typename T>
void write(T* out, const T& value) {
    write_item(out, out->struct_size, value);
}

inline void check_stride(uint32_t stride, const char* name) {
    if (stride < 2 * sizeof(uint32_t) || stride > kMaxStructSize || stride % 4 != 0)
        fail(VFIT_ERROR_ARGUMENT, name, ": stride ", stride, " is not the size of a struct");
}

/// An input array of structs, read item by item, so that a step allocates nothing for it.
template <typename T>
class Items {
public:
    Items(const T* items, uint32_t stride, uint32_t count, const char* name)
        : bytes_(reinterpret_cast<const unsigned char*>(items)), stride_(stride), count_(count), name_(name) {
        if (count == 0) return;
        check_pointer(items, name);
        check_stride(stride, name);
        if (count > kMaxItems) fail(VFIT_ERROR_ARGUMENT, name, ": count ", count, " is out of range");
    }

    uint32_t size() const { return count_; }
    T operator[](uint32_t i) const { return read_item<T>(bytes_ + size_t(i) * stride_, stride_, name_); }

private:
    const unsigned char* bytes_;
    uint32_t stride_, count_;
    const char* name_;
};

/// An output list of `total` items; item(i) makes each.
template <typename T, typename Item>
vfit_result write_list(T* items, uint32_t stride, uint32_t* count, size_t total, Item&& item) {
    check_pointer(count, "count");
    if (!items) {
        *count = static_cast<uint32_t>(total);
        return VFIT_OK;
    }
    check_stride(stride, "items");
    if (*count < total) {
        const uint32_t given = *count;
        *count = static_cast<uint32_t>(total);
        fail(VFIT_ERROR_CAPACITY, "the array has room for ", given, " items, ", total, " are needed");
    }
    auto* bytes = reinterpret_cast<unsigned char*>(items);
    for (size_t i = 0; i < total; ++i) write_item<T>(bytes + i * stride, stride, item(i));
    *count = static_cast<uint32_t>(total);
    return VFIT_OK;
}

/// Text into a caller's buffer: cut to fit, always ended; returns the whole length.
inline uint32_t write_text(const char* text, size_t length, char* buffer, uint32_t capacity) {
    if (buffer && capacity > 0) {
        const size_t n = std::min<size_t>(length, capacity - 1);
        std::memcpy(buffer, text, n);
        buffer[n] = 0;
    }
    return static_cast<uint32_t>(length);
}

/// Bytes into a caller's memory: null asks how many, too little is VFIT_ERROR_CAPACITY.
inline vfit_result write_bytes(const void* from, size_t count, void* to, uint32_t* byte_count) {
    check_pointer(byte_count, "byte_count");
    const uint32_t given = *byte_count;
    *byte_count = static_cast<uint32_t>(count);
    if (!to) return VFIT_OK;
    if (given < count)
        fail(VFIT_ERROR_CAPACITY, "there is room for ", given, " bytes, ", count, " are needed");
    std::memcpy(to, from, count);
    return VFIT_OK;
}

/// The same for a text, whose end counts too.
inline vfit_result write_whole_text(const std::string& from, char* to, uint32_t* capacity) {
    check_pointer(capacity, "capacity");
    if (from.size() >= UINT32_MAX) fail(VFIT_ERROR_CAPACITY, "a text of ", from.size(), " bytes");
    const uint32_t given = *capacity, need = static_cast<uint32_t>(from.size()) + 1;
    *capacity = need;
    if (!to) return VFIT_OK;
    if (given < need) fail(VFIT_ERROR_CAPACITY, "capacity ", given, ": the text has ", need, " bytes");
    std::memcpy(to, from.c_str(), need);
    return VFIT_OK;
}

/// Text into a fixed field of a struct.
template <size_t N>
void set_text(char (&field)[N], const std::string& text) {
    std::memset(field, 0, N);
    std::memcpy(field, text.data(), std::min(text.size(), N - 1));
}

/// Text out of a fixed field, which the caller may have left without an end.
template <size_t N>
std::string get_text(const char (&field)[N]) {
    return {field, strnlen(field, N)};
}

/// A setting of a description: zero means "default", a negative number zero.
inline float setting(float given, float preset) { return given == 0.0f ? preset : std::max(given, 0.0f); }

inline void check_enum(int32_t value, int32_t last, const char* name) {
    if (value < 0 || value > last) fail(VFIT_ERROR_ARGUMENT, name, ": ", value, " is not one of its values");
}

inline void check_flags(uint32_t value, uint32_t known, const char* name) {
    if (value & ~known) fail(VFIT_ERROR_ARGUMENT, name, ": unknown bits in ", value);
}

inline vfit_result write_data_names(const std::vector<std::string>& names, vfit_data_name* items,
                                    uint32_t stride, uint32_t* count) {
    return write_list(items, stride, count, names.size(), [&](size_t i) {
        vfit_data_name name{};
        set_text(name.name, names[i]);
        return name;
    });
}

}  // namespace vfit::api
