#include "core/jobs.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/spin.h"

namespace vfit {

namespace {

/// The items of one run() call; lives on the caller's stack.
struct Batch {
    Jobs::Task task;
    void* data;
    uint32_t count;
    std::atomic<uint32_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr error;
    std::atomic<uint32_t> helpers{0};  // workers inside this batch; changed under the pool's mutex
    Batch* following = nullptr;

    Batch(Jobs::Task t, void* d, uint32_t n) : task(t), data(d), count(n) {}

    void item(uint32_t i) {
        try {
            task(data, i);
        } catch (...) {
            if (!failed.exchange(true)) error = std::current_exception();
        }
    }
    void work() {
        for (uint32_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) item(i);
    }
    void rethrow() const {
        if (failed) std::rethrow_exception(error);
    }
};

/// This thread runs an item for a host.
thread_local bool inside_host_item = false;

class HostItem {
public:
    HostItem() : before_(std::exchange(inside_host_item, true)) {}
    ~HostItem() { inside_host_item = before_; }
    HostItem(const HostItem&) = delete;
    HostItem& operator=(const HostItem&) = delete;

private:
    const bool before_;
};

}  // namespace

void Jobs::Later::run() noexcept {
    try {
        task(data, 0);
    } catch (...) {
        error = std::current_exception();
    }
}

class PoolJobs final : public Jobs {
public:
    explicit PoolJobs(uint32_t workers) {
        threads_.reserve(workers);
        try {
            for (uint32_t i = 0; i < workers; ++i) threads_.emplace_back([this] { serve(); });
        } catch (const std::system_error&) {
            // No more threads are to be had: those that are there, and the caller, do the same work.
        }
    }
    ~PoolJobs() override {
        {
            std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        wake_.notify_all();
        for (std::thread& t : threads_) t.join();
    }

    void run(Task task, void* data, uint32_t count) override {
        Batch batch(task, data, count);
        if (threads_.empty() || count < 2) {
            batch.work();
            return batch.rethrow();
        }
        {
            std::lock_guard lock(mutex_);
            batch.following = open_;
            open_ = &batch;
            calls_.fetch_add(1, std::memory_order_relaxed);
        }
        wake_.notify_all();
        batch.work();
        {
            std::lock_guard lock(mutex_);
            for (Batch** link = &open_; *link; link = &(*link)->following)
                if (*link == &batch) {
                    *link = batch.following;
                    break;
                }
        }
        const auto alone = [&] { return batch.helpers.load() == 0; };
        if (!spin_until(alone)) {
            std::unique_lock lock(mutex_);
            done_.wait(lock, alone);
        }
        batch.rethrow();
    }

    uint32_t concurrency() const override { return static_cast<uint32_t>(threads_.size()) + 1; }

    void begin(Later& later) override {
        later.error = nullptr;
        {
            std::lock_guard lock(mutex_);
            later.state = Later::State::waiting;
            later.following = later_;
            later_ = &later;
            calls_.fetch_add(1, std::memory_order_relaxed);
        }
        wake_.notify_one();
    }

    void end(Later& later) override {
        std::unique_lock lock(mutex_);
        if (later.state == Later::State::waiting) {
            for (Later** link = &later_; *link; link = &(*link)->following)
                if (*link == &later) {
                    *link = later.following;
                    break;
                }
            lock.unlock();
            later.run();
            lock.lock();
            later.state = Later::State::done;
        }
        done_.wait(lock, [&] { return later.state == Later::State::done; });
        later.state = Later::State::idle;
        if (later.error) std::rethrow_exception(later.error);
    }

private:
    void serve() {
        std::unique_lock lock(mutex_);
        bool rested = true;
        for (;;) {
            if (Later* later = later_) {
                later_ = later->following;
                rested = false;
                later->state = Later::State::running;
                lock.unlock();
                later->run();
                lock.lock();
                later->state = Later::State::done;
                done_.notify_all();
                continue;
            }
            Batch* batch = open_;
            while (batch && batch->next.load() >= batch->count) batch = batch->following;
            if (!batch) {
                if (stopping_) return;
                if (!rested) {
                    // Work comes in bursts: who has just worked is ready for more at once.
                    rested = true;
                    const uint32_t seen = calls_.load();
                    lock.unlock();
                    spin_until([&] { return calls_.load(std::memory_order_relaxed) != seen; });
                    lock.lock();
                    continue;
                }
                wake_.wait(lock);
                continue;
            }
            rested = false;
            ++batch->helpers;
            lock.unlock();
            batch->work();
            lock.lock();
            if (--batch->helpers == 0) done_.notify_all();
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_, done_;
    Batch* open_ = nullptr;
    Later* later_ = nullptr;
    bool stopping_ = false;
    std::atomic<uint32_t> calls_{0};  // run() and begin()
    std::vector<std::thread> threads_;
};

class HostJobs final : public Jobs {
public:
    HostJobs(vfit_submit_fn submit, vfit_wait_fn wait, void* user, uint32_t workers)
        : submit_(submit), wait_(wait), user_(user), workers_(workers) {}

    void run(Task task, void* data, uint32_t count) override {
        Batch batch(task, data, count);
        if (count < 2 || inside_host_item) {
            batch.work();
            return batch.rethrow();
        }
        const auto item = [](void* b, uint32_t i) {
            HostItem inside;
            static_cast<Batch*>(b)->item(i);
        };
        void* job = submit_(user_, item, &batch, count);
        if (job) wait_(user_, job);
        batch.rethrow();
    }

    uint32_t concurrency() const override { return workers_ + 1; }

    void begin(Later& later) override {
        later.error = nullptr;
        const auto item = [](void* l, uint32_t) {
            HostItem inside;
            static_cast<Later*>(l)->run();
        };
        later.job = submit_(user_, item, &later, 1);
    }

    void end(Later& later) override {
        if (later.job) wait_(user_, later.job);
        later.job = nullptr;
        if (later.error) std::rethrow_exception(later.error);
    }

private:
    vfit_submit_fn submit_;
    vfit_wait_fn wait_;
    void* user_;
    uint32_t workers_;
};

std::unique_ptr<Jobs> Jobs::own(uint32_t workers) { return std::make_unique<PoolJobs>(workers); }

std::unique_ptr<Jobs> Jobs::host(vfit_submit_fn submit, vfit_wait_fn wait, void* user, uint32_t workers) {
    return std::make_unique<HostJobs>(submit, wait, user, workers);
}

}  // namespace vfit
