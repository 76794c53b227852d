// Whole messages over a socket, with a patience.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "wire.h"

namespace openni2 {

/// The other side is gone, or says nothing.
struct Broken : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Socket {
public:
    explicit Socket(int descriptor) : descriptor_(descriptor) {}
    ~Socket();
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    int descriptor() const { return descriptor_; }
    /// false: nothing comes within that time.
    bool wait(int milliseconds) const;
    /// Throws Broken; nothing for so long is broken too (< 0: it waits for ever).
    void receive(void* data, size_t bytes, int patience_ms) const;
    /// Who waits here hears that it is broken.
    void interrupt() const;
    void send(const void* data, size_t bytes) const;
    void send(Kind kind, const void* data = nullptr, size_t bytes = 0) const;
    template <typename T>
    void send(Kind kind, const T& what) const {
        send(kind, &what, sizeof what);
    }
    Head receive_head(int patience_ms) const;

private:
    int descriptor_;
};

}  // namespace openni2
