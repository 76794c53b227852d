// Work in parallel: items 0..count-1 on a small pool of threads, or on the host's job system. An item never
// waits for one that has not started; one worker alone completes any call.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <type_traits>

#include "vfit.h"

namespace vfit {

class Jobs {
public:
    /// Own pool; workers beside the calling thread, which works too. 0 workers, or none that the system
    /// gives: everything runs in the caller.
    static std::unique_ptr<Jobs> own(uint32_t workers);
    /// The host's job system (vfit_context_desc). What an item starts runs inside that item: only a thread in
    /// a vfit call may submit and wait.
    static std::unique_ptr<Jobs> host(vfit_submit_fn submit, vfit_wait_fn wait, void* user, uint32_t workers);
    virtual ~Jobs() = default;

    using Task = void (*)(void* data, uint32_t index);
    /// Runs task(data, i) for every i < count and returns when all have run. The first exception of an
    /// item is thrown again here. Does not allocate.
    virtual void run(Task task, void* data, uint32_t count) = 0;
    /// Threads that can work at the same time, the caller included.
    virtual uint32_t concurrency() const = 0;

    /// One task that runs beside the caller. It stays where it is until end() has returned.
    class Later {
    public:
        Task task = nullptr;  // called with index 0
        void* data = nullptr;

    private:
        friend class PoolJobs;
        friend class HostJobs;
        enum class State { idle, waiting, running, done };
        State state = State::idle;
        Later* following = nullptr;
        void* job = nullptr;
        std::exception_ptr error;
        void run() noexcept;
    };
    /// Hands the task over and returns; without a free thread it runs in end(). Does not allocate.
    virtual void begin(Later& later) = 0;
    /// Returns when the task has run, and throws what it threw.
    virtual void end(Later& later) = 0;
};

template <typename Body>
void parallel_for(Jobs& jobs, uint32_t count, Body&& body) {
    using Function = std::remove_reference_t<Body>;
    jobs.run([](void* data, uint32_t i) { (*static_cast<Function*>(data))(i); },
             const_cast<void*>(static_cast<const void*>(&body)), count);
}

/// On this thread where there are no jobs.
template <typename Body>
void parallel_for(Jobs* jobs, uint32_t count, Body&& body) {
    if (jobs) return parallel_for(*jobs, count, body);
    for (uint32_t i = 0; i < count; ++i) body(i);
}

/// The same for bodies as short as one vertex.
template <typename Body>
void parallel_for_vertices(Jobs* jobs, uint32_t count, Body&& body) {
    constexpr uint32_t kShare = 128;
    parallel_for(jobs, (count + kShare - 1) / kShare, [&](uint32_t at) {
        for (uint32_t i = at * kShare; i < std::min((at + 1) * kShare, count); ++i) body(i);
    });
}

}  // namespace vfit
