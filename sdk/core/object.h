// Reference-counted base of everything that a handle can name, and the smart pointer to it. Counts are
// intrusive so that handing out a reference never allocates.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace vfit {

class Object {
public:
    Object() = default;
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    void retain() const { references_.fetch_add(1, std::memory_order_relaxed); }
    void release() const {
        if (references_.fetch_sub(1, std::memory_order_acq_rel) == 1)
            const_cast<Object*>(this)->unreferenced();
    }

    /// Its last handle has died; calls that were inside before may go on.
    virtual void handle_died() {}

protected:
    virtual ~Object() = default;
    /// The last reference has gone. Pooled objects return to their pool here instead.
    virtual void unreferenced() { delete this; }

private:
    mutable std::atomic<uint32_t> references_{0};
};

/// Shared pointer to an Object.
template <typename T>
class Ref {
public:
    Ref() = default;
    Ref(std::nullptr_t) {}
    explicit Ref(T* object) : object_(object) {
        if (object_) object_->retain();
    }
    Ref(const Ref& other) : Ref(other.object_) {}
    Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    template <typename U>
    Ref(const Ref<U>& other) : Ref(static_cast<T*>(other.get())) {}
    ~Ref() {
        if (object_) object_->release();
    }
    Ref& operator=(Ref other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }

    T* get() const { return object_; }
    T* operator->() const { return object_; }
    T& operator*() const { return *object_; }
    explicit operator bool() const { return object_ != nullptr; }
    bool operator==(const Ref& other) const = default;

private:
    T* object_ = nullptr;
};

template <typename T, typename... Arguments>
Ref<T> make(Arguments&&... arguments) {
    return Ref<T>(new T(std::forward<Arguments>(arguments)...));
}

}  // namespace vfit
