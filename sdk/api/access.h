// Who may touch an object: [read] calls together, one [excl] call alone, a breach is VFIT_ERROR_BUSY. And
// what every object behind a handle has: its context, kept alive while a call is inside.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "core/error.h"
#include "core/handles.h"
#include "core/object.h"

namespace vfit::api {

class Context;

/// Readers-or-one-writer, which never waits: a breach of the thread rules is an error, not a stall.
class Access {
public:
    void begin_read(const char* what) {
        int32_t now = state_.load();
        do {
            if (now < 0) fail(VFIT_ERROR_BUSY, "the ", what, " is in use by an exclusive call on another thread");
        } while (!state_.compare_exchange_weak(now, now + 1));
    }
    void end_read() { state_.fetch_sub(1); }
    void begin_exclusive(const char* what) {
        int32_t free = 0;
        if (!state_.compare_exchange_strong(free, kExclusive))
            fail(VFIT_ERROR_BUSY, "the ", what, " is in use by a call on another thread");
    }
    void end_exclusive() { state_.store(0); }

private:
    static constexpr int32_t kExclusive = -1;
    std::atomic<int32_t> state_{0};  // number of readers, or kExclusive
};

/// Base of the objects behind handles, but for frames.
class ContextChild : public Object {
public:
    explicit ContextChild(Ref<Context> owner) : context(std::move(owner)) {}
    const Ref<Context> context;
    Access access;
};

/// A call that is inside a context: its destruction waits for these.
class Inside {
public:
    explicit Inside(Ref<Context> context);
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

private:
    Ref<Context> context_;
};

enum class Mode { any, read, exclusive };

/// The object of a handle for the length of a call.
template <typename T, Mode kMode>
class Use {
public:
    explicit Use(uint64_t id)
        : object_(static_cast<T*>(Handles::instance().get(id, T::kKind).get())), inside_(object_->context) {
        if constexpr (kMode == Mode::read) object_->access.begin_read(kind_name(T::kKind));
        if constexpr (kMode == Mode::exclusive) object_->access.begin_exclusive(kind_name(T::kKind));
    }
    ~Use() {
        if constexpr (kMode == Mode::read) object_->access.end_read();
        if constexpr (kMode == Mode::exclusive) object_->access.end_exclusive();
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

    T* operator->() const { return object_.get(); }
    T& operator*() const { return *object_; }
    const Ref<T>& ref() const { return object_; }

private:
    Ref<T> object_;
    Inside inside_;
};

}  // namespace vfit::api
