// The monotonic clock of all time stamps.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace vfit {

inline int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Time stamps come from hosts too: however far apart, their difference does not overflow.
inline double seconds_between(int64_t earlier_ns, int64_t later_ns) {
    return (double(later_ns) - double(earlier_ns)) * 1e-9;
}

/// A moment after another, and no later than the clock's end.
inline int64_t later(int64_t time_ns, int64_t by_ns) {
    return by_ns > INT64_MAX - std::max<int64_t>(time_ns, 0) ? INT64_MAX : time_ns + by_ns;
}

/// Milliseconds since it was made.
class Stopwatch {
public:
    double ms() const { return double(now_ns() - start_) * 1e-6; }

private:
    int64_t start_ = now_ns();
};

}  // namespace vfit
