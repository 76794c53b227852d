// Log lines: to the host's callback, or to stderr, and always into a bounded ring that can be polled.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "core/error.h"
#include "vfit.h"

namespace vfit {

class Log {
public:
    Log(vfit_log_fn callback, void* user) : callback_(callback), user_(user) {}

    void write(vfit_log_level level, const std::string& message);

    template <typename... Parts>
    void warning(const Parts&... parts) {
        write(VFIT_LOG_WARNING, text(parts...));
    }
    template <typename... Parts>
    void info(const Parts&... parts) {
        write(VFIT_LOG_INFO, text(parts...));
    }
    template <typename... Parts>
    void error(const Parts&... parts) {
        write(VFIT_LOG_ERROR, text(parts...));
    }

    /// The oldest line that was not polled yet.
    bool next(vfit_log_level& level, std::string& message);

private:
    static constexpr size_t kKeptLines = 256;
    vfit_log_fn callback_;
    void* user_;
    std::mutex mutex_;
    std::deque<std::pair<vfit_log_level, std::string>> lines_;
};

}  // namespace vfit
