// Phases: order, completeness, one thread alone, a host that runs items one after the other.
#include "core/phases.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace vfit {
namespace {

void check(Jobs& jobs, uint32_t threads) {
    constexpr uint32_t kPhases = 50;
    const auto items = [](uint32_t phase) { return 1 + phase % kMostItems; };
    std::atomic<uint32_t> done[kPhases] = {};
    std::atomic<bool> early{false}, twice{false};
    std::atomic<uint8_t> taken[kPhases][kMostItems] = {};
    run_phases(jobs, kPhases, threads, items, [&](uint32_t phase, uint32_t item) {
        if (phase > 0 && done[phase - 1].load() != items(phase - 1)) early = true;
        if (taken[phase][item].fetch_add(1) != 0) twice = true;
        ++done[phase];
    });
    EXPECT_FALSE(early);
    EXPECT_FALSE(twice);
    for (uint32_t phase = 0; phase < kPhases; ++phase) EXPECT_EQ(done[phase].load(), items(phase));
}

TEST(Phases, NoneBeginsBeforeTheLastHasEnded) {
    for (const uint32_t workers : {0u, 1u, 3u}) {
        const auto jobs = Jobs::own(workers);
        for (int i = 0; i < 200; ++i) check(*jobs, 8);
    }
}

TEST(Phases, OneThreadAloneDoesItAll) {
    // A host that has one thread runs the items of a call one after the other.
    const auto submit = [](void*, vfit_task_fn job, void* data, uint32_t count) -> void* {
        for (uint32_t i = 0; i < count; ++i) job(data, i);
        return nullptr;
    };
    const auto jobs = Jobs::host(submit, [](void*, void*) {}, nullptr, 3);
    check(*jobs, 4);
}

TEST(Phases, NoPhaseIsNoWork) {
    const auto jobs = Jobs::own(1);
    run_phases(*jobs, 0, 2, [](uint32_t) { return 1u; }, [](uint32_t, uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace vfit
