#include "core/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
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
    EXPECT_THROW(parallel_for(*jobs, 64, [](uint32_t i) { if (i == 7) throw std::runtime_error("seven"); }),
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
    EXPECT_THROW(parallel_for(*jobs, 3, [](uint32_t) { throw std::runtime_error("item"); }), std::runtime_error);
}

}  // namespace
}  // namespace vfit
