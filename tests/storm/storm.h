// One thread's stream of random arguments. All memory that a call gets is of its exact size and is freed
// after it, so that AddressSanitizer sees whoever reads or writes beyond, or later.
#pragma once

#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <type_traits>
#include <utility>

#include "draw.h"
#include "pool.h"

namespace storm {

class Storm;

/// Of a host's frame: freed when the library gives them back, else after the call.
struct Pixels {
    std::vector<unsigned char> of[3];
    static inline std::atomic<int64_t> lent{0};
    static void release(void* user) {
        delete static_cast<Pixels*>(user);
        --lent;
    }
};

struct Call {
    const char* name;
    vfit_result (*run)(Storm&);
};

/// What a careful caller puts into a struct, the i-th of a list; the header's _init alone where nothing
/// stands here.
template <typename T>
void usual(Storm&, T&, uint32_t) {}
/// What no caller may get wrong, such as memory that is not there; or what would take seconds.
template <typename T>
void restrain(Storm&, T&) {}

class Storm : public Draw {
public:
    Storm(Pool& pool, uint64_t seed) : Draw(seed), pool_(pool) {}

    /// Frees what the call before was given.
    void after_call(vfit_result result) {
        if (pixels_ && lends_ && result == VFIT_OK) {
            ++Pixels::lent;
            pixels_.release();  // the library's, until it gives them back
        }
        pixels_.reset();
        lends_ = false;
        blocks_.clear();
        texts_.clear();
    }
    /// What the call did that no call may do.
    std::string broken() { return std::exchange(broken_, {}); }

    void* block(size_t size) {
        blocks_.emplace_back(std::malloc(size ? size : 1), &std::free);
        std::memset(blocks_.back().get(), 0xAB, size ? size : 1);
        return blocks_.back().get();
    }

    // ---- handles

    template <typename H>
    H handle() {
        constexpr size_t kNumber = HandleType<H>::kNumber;
        switch (below(32)) {
            case 0: return {0};
            case 1: return {bits()};
            case 2: return {pool_.get_any(*this)};
            case 3: return {pool_.gone(*this)};
            case 4: return {pool_.get(kNumber, *this) ^ (uint64_t(1) << below(64))};
            default: return {pool_.get(kNumber, *this)};
        }
    }

    template <typename H>
    struct HandleOut {
        H* place;
    };
    template <typename H>
    HandleOut<H> handle_out() {
        return {one_in(40) ? nullptr : static_cast<H*>(block(sizeof(H)))};
    }
    template <typename H>
    void keep(HandleOut<H> out, vfit_result result) {
        if (!out.place) return;
        if (result < 0 && out.place->id != 0) broken_ = "an error left a handle";
        if (result == VFIT_OK && out.place->id == 0) broken_ = "success without a handle";
        if (result == VFIT_OK) pool_.put(*out.place, *this);
    }

    template <typename H>
    struct HandlesIn {
        const H* handles;
        uint32_t count;
    };
    template <typename H>
    HandlesIn<H> handles_in() {
        const uint32_t count = below(5);
        if (one_in(20)) return {nullptr, count};
        H* memory = static_cast<H*>(block(count * sizeof(H)));
        for (uint32_t i = 0; i < count; ++i) memory[i] = handle<H>();
        return {memory, one_in(40) ? 0xFFFFFFFF : count};
    }

    // ---- structs

    template <typename T>
    const T* struct_in() {
        if (one_in(16)) return nullptr;
        T value = filled<T>(0);
        uint32_t size = drawn_size<T>();
        value.struct_size = size;
        const bool sane = size >= 8 && size <= 4096;
        if constexpr (std::is_same_v<T, vfit_frame_desc>) {
            if (!sane || size < sizeof(T)) value.release = nullptr;  // it would have no user
            lends_ = value.release != nullptr;
        }
        char* memory = static_cast<char*>(block(sane ? size : sizeof(T)));
        copy_item(memory, value, sane ? size : uint32_t(sizeof(T)));
        return reinterpret_cast<const T*>(memory);
    }

    template <typename T>
    T* struct_out() {
        if (one_in(30)) return nullptr;
        const uint32_t size = drawn_size<T>();
        T* memory = static_cast<T*>(block(size >= 8 && size <= 4096 ? size : sizeof(T)));
        std::memcpy(static_cast<void*>(memory), &size, sizeof size);
        return memory;
    }

    // ---- lists

    template <typename T>
    struct ListIn {
        const T* items;
        uint32_t stride, count;
    };
    template <typename T>
    ListIn<T> list_in() {
        const uint32_t count = below(32), stride = drawn_size<T>();
        if (one_in(20)) return {nullptr, stride, count};
        if (stride < 8 || stride > 4096)
            return {static_cast<const T*>(block(count * sizeof(T))), stride, count};
        char* memory = static_cast<char*>(block(size_t(stride) * count));
        for (uint32_t i = 0; i < count; ++i) copy_item(memory + size_t(i) * stride, filled<T>(i), stride);
        return {reinterpret_cast<const T*>(memory), stride, one_in(40) ? 0xFFFFFFFF : count};
    }

    template <typename T>
    struct ListOut {
        T* items;
        uint32_t stride;
        uint32_t* count;
    };
    template <typename T>
    ListOut<T> list_out() {
        static const uint32_t kRooms[] = {0, 1, 23, 100, 400};
        const uint32_t stride = drawn_size<T>(), room = pick(kRooms);
        T* items =
            one_in(4) ? nullptr : static_cast<T*>(block(room * size_t(stride > 4096 ? sizeof(T) : stride)));
        return {items, stride, count_cell(room)};
    }

    template <typename T>
    struct PlainList {
        T* items;
        uint32_t* count;
    };
    template <typename T>
    PlainList<T> plain_list_out() {
        const uint32_t room = below(12);
        return {one_in(4) ? nullptr : static_cast<T*>(block(room * sizeof(T))), count_cell(room)};
    }

    // ---- bytes and texts

    struct BytesIn {
        const void* data;
        uint32_t count;
    };
    BytesIn bytes_in(const std::string& function) {
        std::string bytes = sample(function);
        if (one_in(3) && !bytes.empty()) bytes.resize(below(uint32_t(bytes.size())));
        if (one_in(3) && !bytes.empty())
            for (uint32_t i = below(8); i > 0; --i) bytes[below(uint32_t(bytes.size()))] = char(bits());
        if (one_in(30)) return {nullptr, uint32_t(bytes.size())};
        void* memory = block(bytes.size());
        std::memcpy(memory, bytes.data(), bytes.size());
        return {memory, uint32_t(bytes.size())};
    }

    struct BytesOut {
        void* data;
        char* text;
        uint32_t* count;
    };
    BytesOut bytes_out() {
        static const uint32_t kRooms[] = {0, 10, 130, 300, 20000};
        const uint32_t room = pick(kRooms);
        void* data = one_in(4) ? nullptr : block(room);
        return {data, static_cast<char*>(data), count_cell(room)};
    }
    void learn(const char* function, const BytesOut& out, vfit_result result) {
        if (result == VFIT_OK && out.data && out.count)
            pool_.learn(function, {static_cast<char*>(out.data), *out.count});
    }

    struct Buffer {
        char* text;
        uint32_t capacity;
    };
    Buffer buffer() {
        static const uint32_t kRooms[] = {0, 1, 7, 64, 512};
        const uint32_t room = pick(kRooms);
        return {one_in(12) ? nullptr : static_cast<char*>(block(room)), room};
    }

    struct Marks {
        uint8_t* data;
        uint32_t count;
    };
    Marks marks() {
        static const uint32_t kCounts[] = {0, 1, 100, 2000,
                                           180};  // of the smallest body, of a tiny character
        const uint32_t count = pick(kCounts);
        return {one_in(12) ? nullptr : static_cast<uint8_t*>(block(count)), count};
    }

    const char* text(const char* name) { return one_in(16) ? nullptr : keep_text(Draw::text(name)); }
    const char* keep_text(std::string value) {
        texts_.push_back(std::move(value));
        return texts_.back().c_str();
    }
    template <size_t N>
    void letters(char (&field)[N]) {
        if (stays()) return;
        if (one_in(2)) {
            for (char& c : field) c = char(bits());  // without an end
        } else {
            const std::string value = Draw::text("key");
            std::memset(field, 0, N);
            std::memcpy(field, value.data(), std::min(N - 1, value.size()));
        }
    }

    Pixels& pixels() {
        pixels_ = std::make_unique<Pixels>();
        return *pixels_;
    }

    // ---- numbers

    /// A place or direction; four values are a rotation.
    const float* vector(uint32_t length) {
        if (one_in(12)) return nullptr;
        float* values = static_cast<float*>(block(length * sizeof(float)));
        for (uint32_t i = 0; i < length; ++i) values[i] = i == 3 ? 1.0f : 0.0f;
        if (!one_in(4))
            for (uint32_t i = 0; i < length; ++i)
                if (one_in(2)) values[i] = number();
        return values;
    }
    struct PointsIn {
        const float* positions;
        uint32_t count;
    };
    PointsIn points_in() {
        const uint32_t count = one_in(2) ? 4 : below(32);
        if (one_in(20)) return {nullptr, count};
        float* values = static_cast<float*>(block(count * 3 * sizeof(float)));
        const bool is_wild = one_in(4);
        for (uint32_t i = 0; i < count * 3; ++i) values[i] = is_wild ? number() : 0.01f * float(below(20));
        return {values, one_in(40) ? 0xFFFFFFFF : count};
    }
    struct PairsIn {
        const float *here, *there;
        uint32_t count;
    };
    PairsIn pairs_in() {
        const PointsIn points = points_in();
        return {points.positions, one_in(20) ? nullptr : points.positions, points.count};
    }
    template <typename T>
    T* cell(uint32_t length = 1) {
        return one_in(12) ? nullptr : static_cast<T*>(block(length * sizeof(T)));
    }
    int32_t an_enum(int32_t low, int32_t high) {
        if (one_in(12)) return int32_t(whole());
        return low + int32_t(below(uint32_t(high - low + 1)));
    }
    template <typename T>
    T a(const std::string& name) {
        if (name == "timeout_ns") return T(below(3) * 100000);  // below 0: without end
        if (name == "dt") return one_in(4) ? T(number()) : T(0.016);
        if (name == "body_id" && !one_in(6)) return T(1);
        if constexpr (std::is_floating_point_v<T>) {
            return one_in(2) ? T(0) : T(number());
        } else {
            return one_in(2) ? T(below(40)) : T(whole());
        }
    }
    template <typename T>
    void put(T& value, const char* name) {
        if (!stays()) value = a<T>(name);
    }
    void put_enum(int32_t& value, int32_t low, int32_t high) {
        if (!stays()) value = an_enum(low, high);
    }

private:
    bool stays() { return below(100) < staying_percent_; }

    template <typename T>
    T filled(uint32_t index) {
        static const uint32_t kStaying[] = {100, 100, 100, 100, 100, 95, 80, 0};
        T value{};
        value.struct_size = sizeof(T);
        usual(*this, value, index);
        const uint32_t before = staying_percent_;
        staying_percent_ = pick(kStaying);
        fill(*this, value);
        staying_percent_ = before;
        value.struct_size = sizeof(T);
        restrain(*this, value);
        return value;
    }

    template <typename T>
    uint32_t drawn_size() {
        static const uint32_t kGarbage[] = {0, 3, 4, 7, 4097, 5000, 0xFFFFFFFF};
        // An older header's struct ended between two fields, not in the middle of a pointer.
        constexpr uint32_t kSize = sizeof(T), kStep = alignof(T);
        switch (below(20)) {
            case 0: return pick(kGarbage);
            case 1: return 8 + kStep * below((kSize - 8) / kStep + 1);
            case 2: return kSize + 4 * below(20);
            case 3: return one_in(10) ? 4096 : kSize + 4;
            default: return kSize;
        }
    }

    template <typename T>
    void copy_item(char* to, const T& value, uint32_t size) {
        std::memcpy(to, static_cast<const void*>(&value), std::min<size_t>(size, sizeof(T)));
        if (size > sizeof(T)) {
            std::memset(to + sizeof(T), 0, size - sizeof(T));
            if (one_in(4))
                to[sizeof(T) + below(uint32_t(size - sizeof(T)))] = 1;  // a field of a later version
        }
    }

    uint32_t* count_cell(uint32_t room) {
        if (one_in(25)) return nullptr;
        uint32_t* count = static_cast<uint32_t*>(block(sizeof(uint32_t)));
        *count = room;
        return count;
    }

    std::string sample(const std::string& function) {
        const auto of = [&](const char* reader, const char* writer) {
            std::string maker = function;
            maker.replace(maker.find(reader), std::strlen(reader), writer);
            return pool_.learnt(maker);
        };
        if (one_in(8)) {
            std::string noise(below(300), ' ');
            for (char& c : noise) c = char(bits());
            return noise;
        }
        if (function.find("_unpack") != std::string::npos) return of("_unpack", "_pack");
        if (function.find("_read") != std::string::npos) return of("_read", "_write");
        return pool_.learnt(function);
    }

    Pool& pool_;
    uint32_t staying_percent_ = 100;
    std::deque<std::unique_ptr<void, void (*)(void*)>> blocks_;
    std::deque<std::string> texts_;
    std::unique_ptr<Pixels> pixels_;
    bool lends_ = false;
    std::string broken_;
};

}  // namespace storm
