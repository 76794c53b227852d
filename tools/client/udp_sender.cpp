#include "client/udp_sender.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include "client/client.h"

namespace vfit::tools {

namespace {

struct Address {
    std::string host, port;
};

Address split(const std::string& address) {
    const size_t colon = address.rfind(':');
    if (colon == std::string::npos) return {address, ""};
    Address out{address.substr(0, colon), address.substr(colon + 1)};
    if (out.host.size() > 2 && out.host.front() == '[' && out.host.back() == ']')
        out.host = out.host.substr(1, out.host.size() - 2);
    return out;
}

}  // namespace

std::string address_fault(const std::string& address) {
    const Address parts = split(address);
    int port = 0;
    const char* end = parts.port.data() + parts.port.size();
    const auto read = std::from_chars(parts.port.data(), end, port);
    const bool valid =
        !parts.host.empty() && read.ec == std::errc() && read.ptr == end && port > 0 && port < 65536;
    return valid ? "" : "'" + address + "' is not HOST:PORT with a port in 1..65535";
}

UdpSender::UdpSender(const std::string& address) : address_(address) {
    const Address parts = split(address);
    addrinfo hints{}, *first = nullptr;
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_DGRAM;
    if (const int error = getaddrinfo(parts.host.c_str(), parts.port.c_str(), &hints, &first))
        throw Failure(address + ": the host has no address: " + gai_strerror(error));
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> found(first, freeaddrinfo);
    static_assert(sizeof to_ >= sizeof(sockaddr_storage));
    std::memcpy(to_, found->ai_addr, found->ai_addrlen);
    to_size_ = uint32_t(found->ai_addrlen);
    socket_ = socket(found->ai_family, SOCK_DGRAM, 0);
    if (socket_ < 0) throw Failure(address + ": no socket: " + std::strerror(errno));
}

UdpSender::~UdpSender() {
    if (socket_ >= 0) close(socket_);
}

void UdpSender::send(std::span<const uint8_t> bytes) const {
    // Not connected: a receiver that starts later, or stops for a while, costs nothing.
    if (sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(to_), to_size_) < 0)
        throw Failure(address_ + ": cannot be sent to: " + std::strerror(errno));
}

}  // namespace vfit::tools
