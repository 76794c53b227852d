// A short wait without giving the core away.
#pragma once

#include <chrono>
#include <thread>

namespace vfit {

inline void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

/// Tries `done` for about as long as it takes to wake a thread; false where it did not come true. Who waits
/// longer has to sleep or yield: a thread that spins on starves the one that it waits for where another
/// process holds a core.
template <typename Done>
bool spin_until(const Done& done) {
    constexpr auto kSpin = std::chrono::microseconds(50);
    constexpr int kTries = 32;  // between looks at the clock
    const auto end = std::chrono::steady_clock::now() + kSpin;
    do {
        for (int i = 0; i < kTries; ++i) {
            if (done()) return true;
            relax();
        }
    } while (std::chrono::steady_clock::now() < end);
    return false;
}

}  // namespace vfit
