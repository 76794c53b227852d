// The handles of a storm, which all of its threads take from, put into and destroy.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <unordered_map>

#include "draw.h"
#include "handles.h"
#include "vfit.h"

namespace storm {

template <typename H>
struct HandleType;
namespace detail {
enum Number : size_t {
#define X(type, end) number_##type,
    VFIT_STORM_HANDLES(X)
#undef X
        number_count
};
}  // namespace detail
#define X(type, end)                                                   \
    template <>                                                        \
    struct HandleType<type> {                                          \
        static constexpr size_t kNumber = detail::number_##type;       \
        static vfit_result let_go(type handle) { return end(handle); } \
    };
VFIT_STORM_HANDLES(X)
#undef X

class Pool {
public:
    /// The first context is gone: calls would find nothing but stale handles until there is another.
    std::atomic<bool> barren{true};

    /// Mostly of the first slots: their objects are of one context.
    uint64_t get(size_t kind, Draw& draw) {
        return slots_[kind][draw.one_in(4) ? draw.below(kSlots) : 0].load();
    }
    uint64_t get_any(Draw& draw) { return get(draw.below(uint32_t(detail::number_count)), draw); }
    /// One that was let go of, mostly.
    uint64_t gone(Draw& draw) { return gone_[draw.below(kGone)].load(); }

    /// Takes the place of another one, which is let go of. The first slots are kept for objects that work
    /// together.
    template <typename H>
    void put(H handle, Draw& draw) {
        put_at(1 + draw.below(kSlots - 1), handle, draw);
    }
    template <typename H>
    void put_first(H handle, Draw& draw) {
        put_at(0, handle, draw);
    }
    bool first_context_alive() const {
        int64_t time_ns;
        return vfit_context_time({slots_[HandleType<vfit_context>::kNumber][0].load()}, &time_ns) == VFIT_OK;
    }

    /// What a function made of bytes, for its counterpart to read.
    void learn(const std::string& function, std::string bytes) {
        const std::lock_guard lock(mutex_);
        learnt_[function] = std::move(bytes);
    }
    std::string learnt(const std::string& function) {
        const std::lock_guard lock(mutex_);
        return learnt_[function];
    }

private:
    template <typename H>
    void put_at(uint32_t slot, H handle, Draw& draw) {
        const uint64_t before = slots_[HandleType<H>::kNumber][slot].exchange(handle.id);
        gone_[draw.below(kGone)] = before;
        HandleType<H>::let_go(H{before});
    }

    static constexpr uint32_t kSlots = 4, kGone = 64;
    std::array<std::array<std::atomic<uint64_t>, kSlots>, detail::number_count> slots_{};
    std::array<std::atomic<uint64_t>, kGone> gone_{};
    std::mutex mutex_;
    std::unordered_map<std::string, std::string> learnt_;
};

}  // namespace storm
