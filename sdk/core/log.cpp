#include "core/log.h"

#include <cstdio>

namespace vfit {

void Log::write(vfit_log_level level, const std::string& message) {
    {
        std::lock_guard lock(mutex_);
        if (lines_.size() == kKeptLines) lines_.pop_front();
        lines_.emplace_back(level, message);
    }
    // Outside the lock: the callback may call back into vfit_log_next.
    if (callback_) {
        callback_(user_, level, message.c_str());
    } else if (level <= VFIT_LOG_WARNING) {
        std::fprintf(stderr, "vfit: %s: %s\n", level == VFIT_LOG_ERROR ? "error" : "warning",
                     message.c_str());
    }
}

bool Log::next(vfit_log_level& level, std::string& message) {
    std::lock_guard lock(mutex_);
    if (lines_.empty()) return false;
    level = lines_.front().first;
    message = std::move(lines_.front().second);
    lines_.pop_front();
    return true;
}

}  // namespace vfit
