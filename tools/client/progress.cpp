#include "client/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace vfit::tools {

namespace {

constexpr std::chrono::seconds kQuiet{1};  // shorter work needs no bar
constexpr std::chrono::milliseconds kRedraw{100};
constexpr int kBar = 30;  // characters

bool is_terminal(int descriptor) {
#if defined(_WIN32)
    return _isatty(descriptor) != 0;
#else
    return isatty(descriptor) != 0;
#endif
}

}  // namespace

Progress::Progress(std::string what, bool prints)
    : what_(std::move(what)),
      wanted_(is_terminal(2) && !(prints && is_terminal(1))),
      next_(Clock::now() + kQuiet) {}

Progress::~Progress() {
    if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::at(uint64_t done, uint64_t total) {
    if (!wanted_ || Clock::now() < next_) return;
    next_ = Clock::now() + kRedraw;
    shown_ = true;
    if (total == 0) {
        std::fprintf(stderr, "\r\033[K%s: %llu", what_.c_str(), static_cast<unsigned long long>(done));
        return;
    }
    const int full = static_cast<int>(kBar * std::min(done, total) / total);
    std::fprintf(stderr, "\r\033[K%s [%s%s] %llu/%llu", what_.c_str(), std::string(size_t(full), '#').c_str(),
                 std::string(size_t(kBar - full), '.').c_str(), static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(total));
}

}  // namespace vfit::tools
