// The reader, a process beside the host: started, spoken to, and never waited for longer than a moment.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "socket.h"

namespace openni2 {

class ReaderProcess {
public:
    /// What follows the program's name.
    explicit ReaderProcess(std::vector<std::string> words);
    /// Closes the socket, upon which the reader goes; one that does not is ended.
    ~ReaderProcess();
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    const Socket& socket() const { return *socket_; }
    /// How it came to its end, after the socket broke; it is ended where it has not.
    std::string end();

private:
    bool ended(int milliseconds);

    std::unique_ptr<Socket> socket_;
    int process_ = -1;
    int status_ = 0;
};

}  // namespace openni2
