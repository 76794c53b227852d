#include "core/jobs.h"

#include <gtest/gtest.h>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

namespace vfit {
namespace {

class JobsTest : public testing::TestWithParam<uint32_t> {};

TEST_P(JobsTest, EveryItemRunsOnce) {
    const auto jobs = Jobs::own(GetParam());
    std::vector<std::atomic<int>> runs(1000);
    parallel_for(*jobs, 1000, [&](uint32_t i) { ++runs[i]; });
    for (const auto& n : runs) EXPECT_EQ(n.load(), 1);
}

TEST_P(JobsTest, TheFirstExceptionOfAnItemComesBack) {
    const auto jobs = Jobs::own(GetParam());
    EXPECT_THROW(parallel_for(*jobs, 64,
                              [](uint32_t i) {
                                  if (i == 7) throw std::runtime_error("seven");
                              }),
                 std::runtime_error);
    int after = 0;
    parallel_for(*jobs, 1, [&](uint32_t) { ++after; });
    EXPECT_EQ(after, 1);
}

TEST_P(JobsTest, ItemsMayStartParallelWorkOfTheirOwn) {
    const auto jobs = Jobs::own(GetParam());
    std::atomic<int> sum{0};
    parallel_for(*jobs, 8, [&](uint32_t) { parallel_for(*jobs, 8, [&](uint32_t) { ++sum; }); });
    EXPECT_EQ(sum.load(), 64);
}

TEST_P(JobsTest, SeveralThreadsMayUseOnePool) {
    const auto jobs = Jobs::own(GetParam());
    std::atomic<int> sum{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 50; ++i) parallel_for(*jobs, 16, [&](uint32_t) { ++sum; });
        });
    for (auto& t : threads) t.join();
    EXPECT_EQ(sum.load(), 3 * 50 * 16);
}

TEST_P(JobsTest, ATaskRunsBesideTheCallerOrInEnd) {
    const auto jobs = Jobs::own(GetParam());
    int value = 0;
    Jobs::Later later;
    later.task = [](void* data, uint32_t) { *static_cast<int*>(data) = 42; };
    later.data = &value;
    for (int i = 0; i < 20; ++i) {
        value = 0;
        jobs->begin(later);
        jobs->end(later);
        EXPECT_EQ(value, 42);
    }
}

TEST_P(JobsTest, EndThrowsWhatTheTaskThrew) {
    const auto jobs = Jobs::own(GetParam());
    Jobs::Later later;
    later.task = [](void*, uint32_t) { throw std::runtime_error("no"); };
    jobs->begin(later);
    EXPECT_THROW(jobs->end(later), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Workers, JobsTest, testing::Values(0u, 1u, 3u));

/// A host that runs items one after the other when it is asked to wait.
struct LazyHost {
    vfit_task_fn fn = nullptr;
    void* task = nullptr;
    uint32_t count = 0, submits = 0;
    static void* submit(void* user, vfit_task_fn fn, void* task, uint32_t count) {
        auto* host = static_cast<LazyHost*>(user);
        host->fn = fn;
        host->task = task;
        host->count = count;
        ++host->submits;
        return host;
    }
    static void wait(void* user, void*) {
        auto* host = static_cast<LazyHost*>(user);
        for (uint32_t i = host->count; i-- > 0;) host->fn(host->task, i);
    }
};

TEST(HostJobs, TheHostRunsTheItemsInAnyOrder) {
    LazyHost host;
    const auto jobs = Jobs::host(LazyHost::submit, LazyHost::wait, &host, 2);
    std::vector<int> runs(10);
    parallel_for(*jobs, 10, [&](uint32_t i) { ++runs[i]; });
    EXPECT_EQ(host.submits, 1u);
    for (const int n : runs) EXPECT_EQ(n, 1);
    EXPECT_THROW(parallel_for(*jobs, 3, [](uint32_t) { throw std::runtime_error("item"); }),
                 std::runtime_error);
}

TEST(HostJobs, WhatAnItemStartsRunsInsideIt) {
    LazyHost host;
    const auto jobs = Jobs::host(LazyHost::submit, LazyHost::wait, &host, 2);
    std::atomic<int> sum{0};
    parallel_for(*jobs, 4, [&](uint32_t) { parallel_for(*jobs, 8, [&](uint32_t) { ++sum; }); });
    EXPECT_EQ(sum.load(), 32);
    EXPECT_EQ(host.submits, 1u);
    parallel_for(*jobs, 4, [&](uint32_t) { ++sum; });
    EXPECT_EQ(host.submits, 2u) << "after an item its thread submits again";
}

TEST(HostJobs, ATaskThatRunsBesideTheCallerSubmitsNothing) {
    LazyHost host;
    const auto jobs = Jobs::host(LazyHost::submit, LazyHost::wait, &host, 2);
    struct Task {
        Jobs* jobs;
        int sum = 0;
    } task{jobs.get()};
    Jobs::Later later;
    later.task = [](void* data, uint32_t) {
        auto* t = static_cast<Task*>(data);
        parallel_for(*t->jobs, 8, [&](uint32_t) { ++t->sum; });
    };
    later.data = &task;
    jobs->begin(later);
    jobs->end(later);
    EXPECT_EQ(task.sum, 8);
    EXPECT_EQ(host.submits, 1u);
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Runs in a process of its own.
void work_without_memory_for_threads() {
    rlimit limit{};
    size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    limit.rlim_cur = limit.rlim_max = pages * static_cast<size_t>(sysconf(_SC_PAGESIZE)) + (size_t(64) << 20);
    if (setrlimit(RLIMIT_AS, &limit) != 0) std::exit(2);
    const auto jobs = Jobs::own(256);
    std::atomic<int> sum{0};
    parallel_for(*jobs, 100, [&](uint32_t) { ++sum; });
    std::exit(sum.load() == 100 && jobs->concurrency() < 257 ? 0 : 1);
}

TEST(JobsDeathTest, ASystemThatGivesNoMoreThreadsCostsSpeedAlone) {
    EXPECT_EXIT(work_without_memory_for_threads(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace vfit
