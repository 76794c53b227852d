#include "core/phases.h"

#include <atomic>
#include <bit>

#include "core/spin.h"

namespace vfit {

namespace {

/// Which phase runs and which of its items nobody has taken, in one word: who takes an item knows its phase.
class Board {
public:
    explicit Board(const PhasedWork& work) : work_(work) { open(0); }

    void work(uint32_t rank, uint32_t threads) {
        for (uint64_t seen = word_.load(std::memory_order_acquire); phase_of(seen) < work_.phases;) {
            if (uint32_t(seen) == 0) {
                seen = wait(seen);
                continue;
            }
            const uint32_t phase = phase_of(seen);
            const uint32_t item = choose(uint32_t(seen), rank * work_.items(work_.data, phase) / threads);
            if (!word_.compare_exchange_weak(seen, seen & ~(uint64_t(1) << item), std::memory_order_acquire))
                continue;
            work_.run(work_.data, phase, item);
            if (done_.fetch_add(1, std::memory_order_acq_rel) + 1 == work_.items(work_.data, phase))
                open(phase + 1);
            seen = word_.load(std::memory_order_acquire);
        }
    }

private:
    static uint32_t phase_of(uint64_t word) { return uint32_t(word >> 32); }

    /// The first free item from `own` on, round the end.
    static uint32_t choose(uint32_t free, uint32_t own) {
        const uint32_t after = free >> own << own;
        return uint32_t(std::countr_zero(after ? after : free));
    }

    void open(uint32_t phase) {
        done_.store(0, std::memory_order_relaxed);
        const uint32_t items = phase < work_.phases ? work_.items(work_.data, phase) : 0;
        word_.store(uint64_t(phase) << 32 | ((uint64_t(1) << items) - 1), std::memory_order_release);
    }

    uint64_t wait(uint64_t seen) const {
        uint64_t now = seen;
        const auto changed = [&] { return (now = word_.load(std::memory_order_acquire)) != seen; };
        if (!spin_until(changed))
            while (!changed()) std::this_thread::yield();
        return now;
    }

    const PhasedWork& work_;
    alignas(64) std::atomic<uint64_t> word_{0};
    alignas(64) std::atomic<uint32_t> done_{0};
};

}  // namespace

void run_phases(Jobs& jobs, const PhasedWork& work) {
    const uint32_t threads = std::clamp(work.threads, 1u, jobs.concurrency());
    if (threads == 1) {
        for (uint32_t phase = 0; phase < work.phases; ++phase)
            for (uint32_t item = 0; item < work.items(work.data, phase); ++item)
                work.run(work.data, phase, item);
        return;
    }
    Board board(work);
    parallel_for(jobs, threads, [&](uint32_t rank) { board.work(rank, threads); });
}

}  // namespace vfit
