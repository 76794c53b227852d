// Job systems that a host may bring along: threads that never help the one who waits, and none at all.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "vfit.h"

namespace contract {

/// What every job system here counts.
struct HostJobSystem {
    std::atomic<uint32_t> submits{0};
    std::atomic<uint32_t> from_items{0};  // submits and waits on a thread that runs an item: never allowed
    std::atomic<uint32_t> late{0};        // calls after the context was destroyed
    std::atomic<bool> destroyed{false};

    virtual ~HostJobSystem() = default;
    virtual void* submit(vfit_task_fn fn, void* task, uint32_t count) = 0;
    virtual void wait(void* job) = 0;

    void give_to(vfit_context_desc& desc) {
        desc.submit = [](void* user, vfit_task_fn fn, void* task, uint32_t count) {
            auto& host = *static_cast<HostJobSystem*>(user);
            ++host.submits;
            host.count_breaches();
            return host.submit(fn, task, count);
        };
        desc.wait = [](void* user, void* job) {
            auto& host = *static_cast<HostJobSystem*>(user);
            host.count_breaches();
            host.wait(job);
        };
        desc.user = this;
    }

protected:
    static bool& in_item() {
        thread_local bool inside = false;
        return inside;
    }
    static void run_item(vfit_task_fn fn, void* task, uint32_t index) {
        in_item() = true;
        fn(task, index);
        in_item() = false;
    }

private:
    void count_breaches() {
        from_items += in_item();
        late += destroyed.load();
    }
};

/// A pool whose wait only waits: with one worker, an item that waits for another would wait for ever.
class ThreadPool final : public HostJobSystem {
public:
    explicit ThreadPool(uint32_t workers) {
        for (uint32_t i = 0; i < workers; ++i) threads_.emplace_back([this] { serve(); });
    }
    ~ThreadPool() override {
        {
            std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        work_.notify_all();
        for (std::thread& t : threads_) t.join();
    }
    void* submit(vfit_task_fn fn, void* task, uint32_t count) override {
        auto* job = new Job{fn, task, count};
        std::lock_guard lock(mutex_);
        open_.push_back(job);
        work_.notify_all();
        return job;
    }
    void wait(void* waited) override {
        auto* job = static_cast<Job*>(waited);
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return job->done == job->count; });
        delete job;
    }

private:
    struct Job {
        vfit_task_fn fn;
        void* task;
        uint32_t count, next = 0, done = 0;
    };
    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            work_.wait(lock, [&] { return stopping_ || !open_.empty(); });
            if (open_.empty()) return;
            Job* job = open_.front();
            const uint32_t index = job->next++;
            if (job->next == job->count) open_.pop_front();
            lock.unlock();
            run_item(job->fn, job->task, index);
            lock.lock();
            if (++job->done == job->count) done_.notify_all();
        }
    }
    std::mutex mutex_;
    std::condition_variable work_, done_;
    std::deque<Job*> open_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

/// Runs the items within submit, last one first, and gives a job or none.
class InlineJobs final : public HostJobSystem {
public:
    explicit InlineJobs(bool null_job) : null_job_(null_job) {}
    void* submit(vfit_task_fn fn, void* task, uint32_t count) override {
        for (uint32_t i = count; i-- > 0;) run_item(fn, task, i);
        return null_job_ ? nullptr : this;
    }
    void wait(void* job) override { waited_for_null = waited_for_null || !job; }
    bool waited_for_null = false;

private:
    const bool null_job_;
};

}  // namespace contract
