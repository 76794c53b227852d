// Which plug-ins are let in, and how the others are refused.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "fake_plugin.h"

namespace vfit::test {
namespace {

Failure refusal(FakeHost& fake) {
    return failure_of([&] { fake.attach(); });
}

TEST(PluginLoad, AGoodOneIsListed) {
    FakeHost fake;
    fake.attach();
    ASSERT_EQ(fake.host.plugins().size(), 1u);
    const PluginInfo info = fake.host.plugins()[0];
    EXPECT_EQ(info.name, "fake");
    EXPECT_EQ(info.schemes, "fake,spare");
    EXPECT_EQ(info.path, "fake.so");
    EXPECT_EQ(info.version, 7u);
}

TEST(PluginLoad, AnotherAbiIsAVersionErrorThatNamesTheFile) {
    FakeHost fake;
    fake.plugin.table.abi = VFIT_PLUGIN_ABI + 1;
    EXPECT_EQ(refusal(fake).code, VFIT_ERROR_VERSION);
    EXPECT_TRUE(refusal(fake).says("fake.so"));
    fake.plugin.table.abi = VFIT_PLUGIN_ABI;
    fake.plugin.negotiated = VFIT_ERROR_VERSION;
    EXPECT_EQ(refusal(fake).code, VFIT_ERROR_VERSION);
    EXPECT_TRUE(fake.host.plugins().empty());
}

TEST(PluginLoad, ARefusalOfThePluginIsAPluginError) {
    FakeHost fake;
    fake.plugin.negotiated = VFIT_ERROR_IO;
    EXPECT_EQ(refusal(fake).code, VFIT_ERROR_PLUGIN);
}

TEST(PluginLoad, MissingFunctionsAreNamed) {
    for (const std::string missing : {"open", "start", "stop", "close"}) {
        FakeHost fake;
        if (missing == "open") fake.plugin.table.open = nullptr;
        if (missing == "start") fake.plugin.table.start = nullptr;
        if (missing == "stop") fake.plugin.table.stop = nullptr;
        if (missing == "close") fake.plugin.table.close = nullptr;
        const Failure failure = refusal(fake);
        EXPECT_EQ(failure.code, VFIT_ERROR_PLUGIN);
        EXPECT_TRUE(failure.says("no " + missing + " function")) << failure.message;
        EXPECT_EQ(fake.plugin.calls, std::vector<std::string>{"shutdown"}) << "what it took it gives back";
    }
}

TEST(PluginLoad, WorksWithoutAnyOptionalFunction) {
    FakeHost fake;
    vfit_plugin& t = fake.plugin.table;
    t.discover = nullptr;
    t.last_error = nullptr;
    t.set_option = nullptr;
    t.mode = nullptr;
    t.option = nullptr;
    t.shutdown = nullptr;
    const Ref<Sensor> sensor = fake.open_and_start();
    EXPECT_TRUE(fake.host.discover().empty());
    EXPECT_TRUE(sensor->modes().empty());
    EXPECT_EQ(sensor->options().size(), 2u);  // mode and pace are every sensor's
    EXPECT_EQ(failure_of([&] { sensor->set_option("gain", "1"); }).code, VFIT_ERROR_UNSUPPORTED);
    fake.plugin.push_frame(5);
    Ref<Frame> frame;
    EXPECT_EQ(sensor->acquire(0, frame), VFIT_OK);
}

TEST(PluginLoad, NamesAndSchemesAreChecked) {
    const std::string long_name(100, 'x');
    const auto with = [](const char* name, const char* schemes) {
        FakeHost fake;
        fake.plugin.table.name = name;
        fake.plugin.table.schemes = schemes;
        return refusal(fake).code;
    };
    EXPECT_EQ(with(nullptr, "fake"), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("", "fake"), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with(long_name.c_str(), "fake"), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", nullptr), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", ""), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", "fa ke"), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", "a,,b"), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", long_name.c_str()), VFIT_ERROR_PLUGIN);
    EXPECT_EQ(with("fake", "fake"), VFIT_OK);
}

TEST(PluginLoad, ASchemeHasOneServer) {
    FakeHost fake;
    fake.attach();
    const Failure failure = refusal(fake);
    EXPECT_EQ(failure.code, VFIT_ERROR_PLUGIN);
    EXPECT_TRUE(failure.says("'fake' is served by fake.so")) << failure.message;
}

TEST(PluginLoad, ANewerPluginMayFillFieldsBeyondTheTable) {
    FakeHost fake;
    const auto negotiate = [](const vfit_host*, vfit_plugin* out) -> vfit_result {
        *out = FakePlugin::current()->table;
        out->struct_size = sizeof(vfit_plugin) + 64;
        std::memset(out + 1, 0xAB, 64);
        return VFIT_OK;
    };
    fake.host.attach("newer.so", negotiate);
    EXPECT_EQ(fake.host.plugins().size(), 1u);
}

TEST(PluginLoad, WhatIsNoLibraryIsAPluginErrorThatNamesTheFile) {
    FakeHost fake;
    const auto folder = std::filesystem::temp_directory_path() / "vfit_plugin_load_test";
    std::filesystem::create_directories(folder);
    const std::string bad = (folder / "vfit_bad.so").string();
    std::ofstream(bad) << "this is no library";
    const Failure failure = failure_of([&] { fake.host.load(bad); });
    EXPECT_EQ(failure.code, VFIT_ERROR_PLUGIN);
    EXPECT_TRUE(failure.says("vfit_bad.so")) << failure.message;
    EXPECT_EQ(failure_of([&] { fake.host.load("/nowhere/vfit_none.so"); }).code, VFIT_ERROR_PLUGIN);

    fake.host.load_folder(folder.string());
    EXPECT_EQ(fake.lines_with("plug-in skipped"), 1u);
    fake.host.load_folder("/nowhere");  // holds none
    EXPECT_TRUE(fake.host.plugins().empty());
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace vfit::test
