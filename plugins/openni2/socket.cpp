#include "socket.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace openni2 {

Socket::~Socket() { ::close(descriptor_); }

bool Socket::wait(int milliseconds) const {
    pollfd entry{descriptor_, POLLIN, 0};
    int ready;
    do ready = ::poll(&entry, 1, milliseconds);
    while (ready < 0 && errno == EINTR);
    if (ready < 0) throw Broken(std::string("poll: ") + std::strerror(errno));
    return ready > 0;
}

void Socket::receive(void* data, size_t bytes, int patience_ms) const {
    auto* to = static_cast<char*>(data);
    while (bytes > 0) {
        if (!wait(patience_ms)) throw Broken("it says nothing");
        const ssize_t got = ::recv(descriptor_, to, bytes, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw Broken(std::strerror(errno));
        if (got == 0) throw Broken("it ended");
        to += got, bytes -= size_t(got);
    }
}

void Socket::interrupt() const { ::shutdown(descriptor_, SHUT_RDWR); }

void Socket::send(const void* data, size_t bytes) const {
    const auto* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t sent = ::send(descriptor_, from, bytes, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) throw Broken(std::strerror(errno));
        from += sent, bytes -= size_t(sent);
    }
}

void Socket::send(Kind kind, const void* data, size_t bytes) const {
    const Head head{kMagic, kind, uint32_t(bytes), 0};
    send(&head, sizeof head);
    send(data, bytes);
}

Head Socket::receive_head(int patience_ms) const {
    Head head{};
    receive(&head, sizeof head, patience_ms);
    if (head.magic != kMagic) throw Broken("it sent something else");
    return head;
}

}  // namespace openni2
