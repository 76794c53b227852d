// Work in phases: the items of one run in parallel, and none of the next begins before all have ended.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "core/jobs.h"

namespace vfit {

inline constexpr uint32_t kMostItems = 32;  // of a phase

struct PhasedWork {
    uint32_t phases = 0;
    uint32_t threads = 1;                                              // that can be of use
    uint32_t (*items)(void* data, uint32_t phase) = nullptr;           // 1..kMostItems
    void (*run)(void* data, uint32_t phase, uint32_t item) = nullptr;  // does not throw
    void* data = nullptr;
};
/// Threads of `jobs` stay with the work to its end, and wait for nothing but items that another one is
/// running: one alone does it all. Each thread keeps to the same items of a phase where it can. Does not
/// allocate.
void run_phases(Jobs& jobs, const PhasedWork& work);

template <typename Items, typename Run>
void run_phases(Jobs& jobs, uint32_t phases, uint32_t threads, Items&& items, Run&& run) {
    struct Both {
        std::remove_reference_t<Items>* items;
        std::remove_reference_t<Run>* run;
    } both{&items, &run};
    PhasedWork work;
    work.phases = phases;
    work.threads = threads;
    work.items = [](void* data, uint32_t phase) -> uint32_t {
        return (*static_cast<Both*>(data)->items)(phase);
    };
    work.run = [](void* data, uint32_t phase, uint32_t item) {
        (*static_cast<Both*>(data)->run)(phase, item);
    };
    work.data = &both;
    run_phases(jobs, work);
}

}  // namespace vfit
