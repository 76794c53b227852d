// Datagrams to another program. The only place of the tools that opens a socket; POSIX.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace vfit::tools {

/// What is wrong with an address "HOST:PORT" or "[IPV6]:PORT"; empty: nothing.
std::string address_fault(const std::string& address);

class UdpSender {
public:
    /// Throws Failure where the host has no address.
    explicit UdpSender(const std::string& address);
    ~UdpSender();
    UdpSender(const UdpSender&) = delete;
    UdpSender& operator=(const UdpSender&) = delete;

    /// Whether anybody listens is not known, and no error.
    void send(std::span<const uint8_t> bytes) const;

private:
    std::string address_;
    int socket_ = -1;
    unsigned char to_[128];  // sockaddr_storage
    uint32_t to_size_ = 0;
};

}  // namespace vfit::tools
