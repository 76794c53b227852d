// Plug-ins that break the contract where the host can still help it: they throw, or never come back.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <stdexcept>

#include "fake_plugin.h"

namespace vfit::test {
namespace {

bool logged(FakeHost& fake, const std::string& what) {
    std::lock_guard lock(fake.lines_mutex);
    for (const std::string& line : fake.lines)
        if (line.find(what) != std::string::npos) return true;
    return false;
}

TEST(HostilePlugin, WhatItThrowsBecomesAnErrorAndIsLogged) {
    FakeHost fake;
    vfit_plugin& table = fake.plugin.table;
    fake.plugin.on_discover = [] { throw std::runtime_error("no list"); };
    table.start = [](void*) -> vfit_result { throw std::runtime_error("no start"); };
    table.stop = [](void*) -> vfit_result { throw 7; };
    table.mode = [](void*, uint32_t, vfit_sensor_mode*) -> vfit_result {
        throw std::runtime_error("no modes");
    };
    table.option = [](void*, uint32_t, vfit_sensor_option*) -> vfit_result {
        throw std::runtime_error("no options");
    };
    table.set_option = [](void*, const char*, const char*) -> vfit_result {
        throw std::runtime_error("no gain");
    };
    fake.attach();
    EXPECT_TRUE(fake.host.discover().empty());
    EXPECT_TRUE(logged(fake, "threw an exception: no list"));
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    EXPECT_TRUE(sensor->modes().empty());
    EXPECT_TRUE(logged(fake, "no modes"));
    EXPECT_TRUE(logged(fake, "no options"));
    EXPECT_EQ(failure_of([&] { sensor->set_option("gain", "1"); }).code, VFIT_ERROR_PLUGIN);
    EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_PLUGIN);
    EXPECT_TRUE(logged(fake, "no start"));
    EXPECT_EQ(failure_of([&] { sensor->stop(); }).code, VFIT_OK);  // it did not run
    sensor->close();
}

TEST(HostilePlugin, AnOpenThatThrowsLeavesNothing) {
    FakeHost fake;
    fake.plugin.table.open = [](void*, const char*, void*, void**) -> vfit_result {
        throw std::runtime_error("no device");
    };
    fake.attach();
    EXPECT_EQ(failure_of([&] { fake.host.open("fake:1"); }).code, VFIT_ERROR_PLUGIN);
    EXPECT_TRUE(logged(fake, "no device"));
    fake.host.shutdown();
    EXPECT_EQ(fake.plugin.calls, std::vector<std::string>{"shutdown"});
}

TEST(HostilePlugin, OneThatHangsInStopIsLeftAlone) {
    using Clock = std::chrono::steady_clock;
    static std::promise<void> released;
    static std::promise<void> returned;
    {
        FakeHost fake;
        fake.plugin.table.stop = [](void*) -> vfit_result {
            released.get_future().wait();
            returned.set_value();
            return VFIT_OK;
        };
        const Ref<Sensor> sensor = fake.open_and_start();
        const auto begin = Clock::now();
        sensor->stop();
        EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));
        EXPECT_TRUE(logged(fake, "stop has not returned for 10 s"));
        EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_PLUGIN);
        EXPECT_EQ(failure_of([&] { fake.host.open("fake:2"); }).code, VFIT_ERROR_PLUGIN);
        EXPECT_TRUE(fake.host.discover().empty());
        sensor->close();
        fake.host.shutdown();
        EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));  // nothing else waits for it
        const std::vector<std::string> calls = {"open fake:1", "start"};
        EXPECT_EQ(fake.plugin.calls, calls);  // nor is anything else of it called
    }
    released.set_value();  // after its host has gone
    returned.get_future().wait();
}

}  // namespace
}  // namespace vfit::test
