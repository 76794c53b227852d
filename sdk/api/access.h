// Who may touch an object: [read] calls together, one [excl] call alone, a breach is VFIT_ERROR_BUSY. And
// what every object behind a handle has: its context, kept alive while a call is inside.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <utility>

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
            if (now < 0)
                fail(VFIT_ERROR_BUSY, "the ", what, " is in use by an exclusive call on another thread");
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

/// A [read] call's access to an object beside the one that it was called on.
class Reading {
public:
    Reading(Access& access, const char* what) : access_(&access) { access.begin_read(what); }
    Reading(Reading&& other) noexcept : access_(std::exchange(other.access_, nullptr)) {}
    Reading& operator=(Reading&&) = delete;
    ~Reading() {
        if (access_) access_->end_read();
    }

private:
    Access* access_;
};

/// The same of an [excl] call.
class Alone {
public:
    Alone(Access& access, const char* what) : access_(access) { access.begin_exclusive(what); }
    Alone(const Alone&) = delete;
    Alone& operator=(const Alone&) = delete;
    ~Alone() { access_.end_exclusive(); }

private:
    Access& access_;
};

/// Base of the objects behind handles, but for frames.
class ContextChild : public Object {
public:
    explicit ContextChild(Ref<Context> owner);
    ~ContextChild() override;
    const Ref<Context> context;
    Access access;
};

/// A call that is inside a context: its destruction waits for these. A call is counted under the lock of the
/// handles' table, so that none gets in once the context's own handle is dead.
class Inside {
public:
    static void enter(Context& context);
    /// Takes over what enter() counted.
    explicit Inside(Ref<Context> entered);
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
    explicit Use(uint64_t id) : Use(entered(id)) {}
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
    static Ref<T> entered(uint64_t id) {
        const auto enter = [](const Handles::Entry& entry) {
            Inside::enter(*static_cast<T&>(*entry.object).context);
        };
        return Ref<T>(static_cast<T*>(Handles::instance().find(id, T::kKind, enter).object.get()));
    }
    explicit Use(Ref<T>&& object) : inside_(object->context), object_(std::move(object)) {
        if constexpr (kMode == Mode::read) object_->access.begin_read(kind_name(T::kKind));
        if constexpr (kMode == Mode::exclusive) object_->access.begin_exclusive(kind_name(T::kKind));
    }

    const Inside inside_;
    Ref<T> object_;  // let go of inside the context: it may be the last to know the object
};

/// Kills a handle and all below it; null is a no-op.
template <typename T>
void destroy(uint64_t id) {
    if (id == 0) return;
    Use<T, Mode::any> last(id);
    Handles::instance().destroy(id, T::kKind);
}

}  // namespace vfit::api
