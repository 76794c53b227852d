// The URI of a source: how it is split, what is refused, and how its options reach the plug-in.
#include "sensor/source_uri.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "fake_plugin.h"

namespace vfit::test {
namespace {

namespace fs = std::filesystem;
using Pairs = std::vector<std::pair<std::string, std::string>>;
using Calls = std::vector<std::string>;

Pairs pairs_of(const std::vector<SourceOption>& options) {
    Pairs out;
    for (const SourceOption& option : options) out.emplace_back(option.key, option.value);
    return out;
}

Failure refusal(const std::string& query) {
    return failure_of([&] { parse_source_options(query); });
}

/// A host whose plug-in serves "recording" and "oni", and a folder of the test's own.
class SourceOpen : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / ("vfit_source_uri_" + std::string(test->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        fake_.plugin.table.schemes = "recording,oni";
        fake_.plugin.table.set_option = [](void* self, const char* key, const char* value) -> vfit_result {
            FakePlugin& plugin = FakePlugin::of(self);
            plugin.set.emplace_back(key, value);
            if (std::string(value) != "bad") return VFIT_OK;
            plugin.error = text("option ", key, ": '", value, "' is not a whole number in 0..9");
            return VFIT_ERROR_ARGUMENT;
        };
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string make_folder(const std::string& name) const {
        fs::create_directories(folder_ / name);
        return (folder_ / name).string();
    }
    /// What the plug-in was asked to open.
    std::string device_of(const std::string& uri) {
        fake_.plugin.calls.clear();
        fake_.plugin.set.clear();
        const Ref<Sensor> sensor = fake_.host.open(uri);
        std::string opened = fake_.plugin.calls.at(0);
        sensor->close();
        return opened.substr(std::string("open ").size());
    }

    fs::path folder_;
    FakeHost fake_;
};

TEST(SourceUri, IsSchemeAddressAndOptionsInOrder) {
    const SourceUri uri = parse_source_uri("recording:/data/rec?start=5&loop=1", true);
    EXPECT_EQ(uri.scheme, "recording");
    EXPECT_EQ(uri.address, "/data/rec");
    EXPECT_EQ(uri.device(), "recording:/data/rec");
    EXPECT_EQ(pairs_of(uri.options), (Pairs{{"start", "5"}, {"loop", "1"}}));
}

TEST(SourceUri, MayLackAddressOrOptions) {
    EXPECT_EQ(parse_source_uri("openni2:", true).device(), "openni2:");
    EXPECT_TRUE(parse_source_uri("openni2:", true).options.empty());
    EXPECT_TRUE(parse_source_uri("openni2:?", true).options.empty());
    EXPECT_EQ(parse_source_uri("openni2:?mode=a", true).options.at(0).key, "mode");
    EXPECT_EQ(parse_source_uri("recording:C:\\rec?start=1", true).address, "C:\\rec");
}

TEST(SourceUri, TheFirstQuestionMarkEndsTheAddressAndTheFirstEqualsSignTheKey) {
    const SourceUri uri = parse_source_uri("recording:a?bvh=b?c=d", true);
    EXPECT_EQ(uri.address, "a");
    EXPECT_EQ(pairs_of(uri.options), (Pairs{{"bvh", "b?c=d"}}));
}

TEST(SourceUri, PercentCodesAreDecodedEverywhere) {
    const SourceUri uri = parse_source_uri("recording:what%3F/100%25?b%76h=%2Fdata%2fa%20b%26c", true);
    EXPECT_EQ(uri.address, "what?/100%");
    EXPECT_EQ(pairs_of(uri.options), (Pairs{{"bvh", "/data/a b&c"}}));
    EXPECT_EQ(parse_source_uri("recording:100%/%4g%", true).address, "100%/%4g%") << "no code";
    EXPECT_EQ(parse_source_uri("recording:%2541", true).address, "%41") << "once";
}

TEST(SourceUri, WithoutAnAddressOptionsFollowTheColon) {
    const Pairs both{{"motion", "demo"}, {"sex", "f"}};
    EXPECT_EQ(pairs_of(parse_source_uri("virtual:motion=demo&sex=f", false).options), both);
    EXPECT_EQ(pairs_of(parse_source_uri("virtual:?motion=demo&sex=f", false).options), both);
    EXPECT_EQ(parse_source_uri("virtual:motion=demo", false).device(), "virtual:");
    EXPECT_TRUE(parse_source_uri("virtual:", false).options.empty());
}

TEST(SourceUri, EmptyPartsAreSkippedAndValuesMayBeEmpty) {
    EXPECT_EQ(pairs_of(parse_source_options("&&loop=1&&sex=&")), (Pairs{{"loop", "1"}, {"sex", ""}}));
    EXPECT_TRUE(parse_source_options("").empty());
}

TEST(SourceUri, WhatIsNoOptionIsRefusedByItsText) {
    const Failure word = refusal("start=1&loop");
    EXPECT_EQ(word.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(word.says("'loop'") && word.says("KEY=VALUE") && word.says("%3F")) << word.message;
    const Failure nameless = refusal("=5");
    EXPECT_EQ(nameless.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(nameless.says("'=5'") && nameless.says("no key") && nameless.says("KEY=VALUE"))
        << nameless.message;
    const Failure twice = refusal("start=1&loop=1&st%61rt=2");
    EXPECT_EQ(twice.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(twice.says("option start") && twice.says("'1'") && twice.says("'2'") && twice.says("once"))
        << twice.message;
    const Failure zero = refusal("start=5%00x");
    EXPECT_EQ(zero.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(zero.says("option 'start=5%00x'") && zero.says("%00")) << zero.message;
    EXPECT_EQ(failure_of([] { parse_source_uri("recording:a%00b", true); }).code, VFIT_ERROR_ARGUMENT);
}

TEST(SourceUri, AnEncodedDeviceIsParsedBackToItself) {
    for (const char* address :
         {"", "1d27/0609@1/5", "\\\\?\\usb#vid_1d27&pid_0609", "a%3Fb?c=d&e%", "100%"}) {
        const std::string device = std::string("openni2:") + address;
        const SourceUri uri = parse_source_uri(encode_device(device), true);
        EXPECT_EQ(uri.device(), device);
        EXPECT_TRUE(uri.options.empty()) << device;
    }
}

TEST_F(SourceOpen, OptionsReachThePluginAfterTheDeviceIsOpen) {
    fake_.attach();
    const Ref<Sensor> sensor = fake_.host.open("recording:/rec?start=5&loop=1&pace=realtime&mode=small");
    EXPECT_EQ(fake_.plugin.calls, (Calls{"open recording:/rec"}));
    EXPECT_EQ(fake_.plugin.set, (Pairs{{"start", "5"}, {"loop", "1"}, {"pace", "realtime"}}))
        << "the only mode of a device is on already";
    EXPECT_EQ(sensor->uri(), "recording:/rec");
    sensor->start();
    EXPECT_EQ(fake_.plugin.push_frame(1), VFIT_OK);
    EXPECT_EQ(fake_.plugin.push_frame(2), VFIT_OK) << "realtime: a push does not wait";
}

TEST_F(SourceOpen, AnOptionFailsAsSetOptionDoesAndTheDeviceIsClosed) {
    fake_.attach();
    const Ref<Sensor> sensor = fake_.host.open("recording:/rec");
    for (const auto& [key, value] : Pairs{{"start", "bad"}, {"pace", "fast"}, {"mode", "huge"}}) {
        const Failure expected = failure_of([&] { sensor->set_option(key, value); });
        fake_.plugin.calls.clear();
        const Failure failure = failure_of([&] { fake_.host.open("recording:?" + key + "=" + value); });
        EXPECT_EQ(failure.code, expected.code) << key;
        EXPECT_EQ(failure.message, expected.message);
        EXPECT_TRUE(failure.says(key) && failure.says("'" + value + "'")) << failure.message;
        EXPECT_EQ(fake_.plugin.calls, (Calls{"open recording:", "close"}));
    }
}

TEST_F(SourceOpen, AMalformedQueryOpensNoDevice) {
    fake_.attach();
    for (const char* uri : {"recording:/rec?loop", "recording:/rec?=1", "recording:/rec?a=1&a=1"})
        EXPECT_EQ(failure_of([&] { fake_.host.open(uri); }).code, VFIT_ERROR_ARGUMENT) << uri;
    EXPECT_TRUE(fake_.plugin.calls.empty());
}

TEST_F(SourceOpen, WithoutAnOptionFunctionTheKnownKeysAreNamed) {
    fake_.plugin.table.set_option = nullptr;
    fake_.attach();
    const Failure failure = failure_of([&] { fake_.host.open("recording:/rec?loop=1"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_UNSUPPORTED);
    EXPECT_TRUE(failure.says("'loop'") && failure.says("mode, pace")) << failure.message;
}

TEST_F(SourceOpen, APluginWithoutAddressesGetsOptionsFromTheColonOn) {
    fake_.plugin.table.caps = VFIT_PLUGIN_NO_ADDRESS;
    fake_.plugin.table.schemes = "virtual";
    fake_.attach();
    for (const char* uri : {"virtual:motion=demo&sex=f", "virtual:?motion=demo&sex=f"}) {
        EXPECT_EQ(device_of(uri), "virtual:");
        EXPECT_EQ(fake_.plugin.set, (Pairs{{"motion", "demo"}, {"sex", "f"}}));
    }
}

TEST_F(SourceOpen, APlainPathMayHaveOptions) {
    fake_.attach();
    const std::string rec = make_folder("rec");
    const std::string file = (folder_ / "walk.oni").string();
    std::ofstream(file) << "x";
    EXPECT_EQ(device_of(rec + "?start=5&loop=1"), "recording:" + rec);
    EXPECT_EQ(fake_.plugin.set, (Pairs{{"start", "5"}, {"loop", "1"}}));
    EXPECT_EQ(device_of(file + "?count=3"), "oni:" + file);
    EXPECT_EQ(fake_.plugin.set, (Pairs{{"count", "3"}}));
    EXPECT_EQ(device_of(rec + "?"), "recording:" + rec);
    EXPECT_TRUE(fake_.plugin.set.empty());
    const Failure failure = failure_of([&] { fake_.host.open(rec + "_?start=5"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_UNSUPPORTED);
    EXPECT_TRUE(failure.says("rec_?start=5") && failure.says("neither an existing folder"))
        << failure.message;
    EXPECT_EQ(failure_of([&] { fake_.host.open("?start=5"); }).code, VFIT_ERROR_UNSUPPORTED);
}

TEST_F(SourceOpen, APlainPathThatExistsIsTakenLiterally) {
    fake_.attach();
    make_folder("rec");
    const std::string marked = make_folder("rec?start=5"), coded = make_folder("rec%3F");
    EXPECT_EQ(device_of(marked), "recording:" + marked);
    EXPECT_TRUE(fake_.plugin.set.empty());
    EXPECT_EQ(device_of(marked + "?start=7"), "recording:" + marked) << "the longest existing path";
    EXPECT_EQ(fake_.plugin.set, (Pairs{{"start", "7"}}));
    EXPECT_EQ(device_of(coded), "recording:" + coded) << "not decoded";
    EXPECT_EQ(device_of(coded + "?start=1"), "recording:" + coded);
}

TEST_F(SourceOpen, AQuestionMarkOfAPathIsEncodedInAUri) {
    fake_.attach();
    const std::string marked = make_folder("what?");
    EXPECT_EQ(device_of("recording:" + (folder_ / "what%3F").string() + "?start=1"), "recording:" + marked);
    const Failure failure = failure_of([&] { fake_.host.open("recording:" + marked + "/rec"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(failure.says("'/rec'") && failure.says("%3F")) << failure.message;
}

TEST_F(SourceOpen, AListedSensorOpensByItsUri) {
    fake_.plugin.table.schemes = "fake";
    fake_.attach();
    const std::string device = "fake:\\\\?\\usb#1%20", too_long = "fake:" + std::string(100, '?');
    fake_.plugin.on_discover = [&] {
        for (const std::string& uri : {device, too_long}) {
            vfit_sensor_info info = vfit_sensor_info_init();
            uri.copy(info.uri, sizeof info.uri - 1);
            fake_.plugin.host->sensor_added(fake_.plugin.host->self, &info);
        }
    };
    const auto listed = fake_.host.discover();
    ASSERT_EQ(listed.size(), 1u) << "one that does not fit is not listed";
    EXPECT_EQ(device_of(listed[0].uri), device);
    EXPECT_EQ(fake_.lines_with("is not listed"), 1u);
    fake_.plugin.on_discover = [&] {
        fake_.plugin.host->sensor_removed(fake_.plugin.host->self, device.c_str());
    };
    EXPECT_TRUE(fake_.host.discover().empty());
}

TEST_F(SourceOpen, RandomUrisOpenOrAreRefused) {
    fake_.attach();
    make_folder("rec");
    fs::current_path(folder_);
    const std::vector<std::string> parts = {"recording:", "oni:", "rec",  "?",     "&",   "=",    "%",
                                            "%3F",        "%00",  "%f",   "start", "bad", "pace", "none",
                                            "mode",       "\n",   "\xff", ":",     "/",   "5"};
    std::mt19937 random(11);
    int opened = 0, refused = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string uri = round % 2 ? "recording:" : "rec";
        for (size_t n = random() % 12; n > 0; --n) uri += parts[random() % parts.size()];
        try {
            fake_.host.open(uri)->close();
            ++opened;
        } catch (const Error& error) {
            EXPECT_TRUE(error.code() == VFIT_ERROR_ARGUMENT || error.code() == VFIT_ERROR_UNSUPPORTED) << uri;
            EXPECT_STRNE(error.what(), "");
            ++refused;
        }
    }
    EXPECT_GT(opened, 1000);
    EXPECT_GT(refused, 1000);
    fs::current_path(fs::temp_directory_path());
}

}  // namespace
}  // namespace vfit::test
