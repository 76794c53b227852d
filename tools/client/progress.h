// How far long work is: a bar on standard error, after a second, where that is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace vfit::tools {

class Progress {
public:
    /// prints: the work prints as it goes; where that shows on the same terminal, there is no bar.
    explicit Progress(std::string what, bool prints = false);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// total 0: not known.
    void at(uint64_t done, uint64_t total);

private:
    using Clock = std::chrono::steady_clock;

    const std::string what_;
    const bool wanted_;
    bool shown_ = false;
    Clock::time_point next_;  // when the bar is drawn again
};

}  // namespace vfit::tools
