// An open device as the host sees it.
#include "sensor/sensor.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include "fake_plugin.h"

namespace vfit::test {
namespace {

using Calls = std::vector<std::string>;

TEST(SensorOpen, UnknownSchemeListsTheKnownOnes) {
    FakeHost fake;
    EXPECT_TRUE(failure_of([&] { fake.host.open("fake:1"); }).says("known schemes: none"));
    fake.attach();
    const Failure failure = failure_of([&] { fake.host.open("kinect:0"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_UNSUPPORTED);
    EXPECT_TRUE(failure.says("'kinect'") && failure.says("fake,spare")) << failure.message;
    EXPECT_EQ(failure_of([&] { fake.host.open("no such thing"); }).code, VFIT_ERROR_UNSUPPORTED);
    EXPECT_EQ(failure_of([&] { fake.host.open(""); }).code, VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(failure_of([&] { fake.host.open(std::string(5000, 'x')); }).code, VFIT_ERROR_ARGUMENT);
}

TEST(SensorOpen, AnExistingFolderIsARecordingAndAFileGoesByItsExtension) {
    FakeHost fake;
    fake.plugin.table.schemes = "recording,oni";
    fake.attach();
    const auto folder = std::filesystem::temp_directory_path() / "vfit_sensor_open_test";
    std::filesystem::create_directories(folder);
    const std::string file = (folder / "walk.oni").string();
    std::ofstream(file) << "x";
    EXPECT_EQ(fake.host.open(folder.string())->uri(), "recording:" + folder.string());
    EXPECT_EQ(fake.host.open(file)->uri(), "oni:" + file);
    std::filesystem::remove_all(folder);
}

TEST(SensorOpen, ThePluginsOwnWordsComeThrough) {
    FakeHost fake;
    fake.attach();
    fake.plugin.open_result = VFIT_ERROR_IO;
    const Failure failure = failure_of([&] { fake.host.open("fake:1"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_IO);
    EXPECT_EQ(failure.message, "the fake device is unplugged");
    fake.plugin.open_result = -4711;  // no result that anyone knows
    EXPECT_EQ(failure_of([&] { fake.host.open("fake:1"); }).code, VFIT_ERROR_PLUGIN);
}

TEST(SensorOpen, AFailedOpenLeavesNothingToClose) {
    FakeHost fake;
    fake.plugin.table.open = [](void* self, const char*, void*, void** device) -> vfit_result {
        *device = self;  // of a device that was taken down again
        return VFIT_ERROR_IO;
    };
    fake.attach();
    EXPECT_EQ(failure_of([&] { fake.host.open("fake:1"); }).code, VFIT_ERROR_IO);
    EXPECT_TRUE(fake.plugin.calls.empty());
}

TEST(Sensor, ClosingBesideAStartEndsThePushThatWaits) {
    // A device whose stop waits for its thread, as devices do; its second push waits for the host.
    static FakePlugin* device = nullptr;
    static std::thread pusher;
    for (int round = 0; round < 200; ++round) {
        FakeHost fake;
        device = &fake.plugin;
        fake.plugin.table.start = [](void*) -> vfit_result {
            pusher = std::thread([] {
                while (device->push_frame(1) == VFIT_OK) {
                }
            });
            return VFIT_OK;
        };
        fake.plugin.table.stop = [](void*) -> vfit_result {
            pusher.join();
            return VFIT_OK;
        };
        fake.attach();
        const Ref<Sensor> sensor = fake.host.open("fake:1");
        std::thread starts([&] { failure_of([&] { sensor->start(); }); });
        sensor->close();
        starts.join();
        sensor->close();
    }
}

TEST(Sensor, AcquireBeforeStartAndAfterStopIsAStateError) {
    FakeHost fake;
    fake.attach();
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    Ref<Frame> frame;
    EXPECT_EQ(failure_of([&] { sensor->acquire(0, frame); }).code, VFIT_ERROR_STATE);
    sensor->start();
    EXPECT_EQ(sensor->acquire(0, frame), VFIT_NOT_READY);
    EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_STATE);
    fake.plugin.push_frame(1);
    sensor->stop();
    EXPECT_EQ(failure_of([&] { sensor->acquire(-1, frame); }).code, VFIT_ERROR_STATE);
    sensor->stop();  // once more is harmless
    sensor->start();
    EXPECT_EQ(sensor->acquire(0, frame), VFIT_NOT_READY) << "frames of the round before are gone";
}

TEST(Sensor, AFailedStartCanBeTriedAgain) {
    FakeHost fake;
    fake.attach();
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    fake.plugin.start_result = VFIT_ERROR_DEVICE_LOST;
    EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_DEVICE_LOST);
    EXPECT_EQ(sensor->describe().running, 0u);
    fake.plugin.start_result = VFIT_OK;
    sensor->start();
    EXPECT_EQ(sensor->describe().running, 1u);
}

TEST(Sensor, StopWakesAWaitingAcquireAndAWaitingPush) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    auto acquired = std::async(std::launch::async, [&] {
        Ref<Frame> frame;
        return failure_of([&] {
                   while (sensor->acquire(-1, frame) == VFIT_OK) {
                   }
               })
            .code;
    });
    auto pushed = std::async(std::launch::async, [&] {
        vfit_result result = VFIT_OK;
        while (result == VFIT_OK) result = fake.plugin.push_frame(1);
        return result;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    sensor->stop();
    EXPECT_EQ(acquired.get(), VFIT_ERROR_STATE);
    EXPECT_EQ(pushed.get(), VFIT_ERROR_STATE);
}

TEST(Sensor, CloseStopsLetsGoOfTheDeviceAndRefusesWhatFollows) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    sensor->close();
    sensor->close();
    EXPECT_EQ(fake.plugin.calls, (Calls{"open fake:1", "start", "stop", "close"}));
    EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_STATE);
    EXPECT_EQ(failure_of([&] { sensor->stop(); }).code, VFIT_ERROR_STATE);
    EXPECT_EQ(failure_of([&] { sensor->modes(); }).code, VFIT_ERROR_STATE);
    EXPECT_EQ(failure_of([&] { sensor->set_option("gain", "1"); }).code, VFIT_ERROR_STATE);
    EXPECT_NE(fake.plugin.push_frame(1), VFIT_OK);
}

TEST(Sensor, NothingOfThePluginIsCalledAfterItsShutdown) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    fake.host.shutdown();
    const Calls all = {"open fake:1", "start", "stop", "close", "shutdown"};
    EXPECT_EQ(fake.plugin.calls, all);
    sensor->close();
    EXPECT_EQ(failure_of([&] { sensor->start(); }).code, VFIT_ERROR_STATE);
    EXPECT_EQ(failure_of([&] { fake.host.open("fake:2"); }).code, VFIT_ERROR_STATE);
    EXPECT_TRUE(fake.host.discover().empty());
    fake.host.shutdown();
    EXPECT_EQ(fake.plugin.calls, all);
}

TEST(Sensor, PaceComesFromThePluginAndCanBeChanged) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();  // its list says pace none
    fake.plugin.push_frame(1);
    auto second = std::async(std::launch::async, [&] { return fake.plugin.push_frame(2); });
    EXPECT_EQ(second.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
    sensor->set_option("pace", "realtime");
    EXPECT_EQ(second.get(), VFIT_OK);
    EXPECT_EQ(sensor->describe().dropped, 1u);
    EXPECT_EQ(fake.plugin.set.back(), (std::pair<std::string, std::string>("pace", "realtime")));
    EXPECT_EQ(failure_of([&] { sensor->set_option("pace", "fast"); }).code, VFIT_ERROR_ARGUMENT);
}

TEST(Sensor, WithoutAPaceOfItsOwnADeviceIsRealtime) {
    FakeHost fake;
    fake.plugin.pace.clear();
    const Ref<Sensor> sensor = fake.open_and_start();
    EXPECT_EQ(fake.plugin.push_frame(1), VFIT_OK);
    EXPECT_EQ(fake.plugin.push_frame(2), VFIT_OK);
    Ref<Frame> frame;
    ASSERT_EQ(sensor->acquire(0, frame), VFIT_OK);
    EXPECT_EQ(frame->find(VFIT_STREAM_DEPTH)->as<uint16_t>()[0], 2);
    sensor->set_option("pace", "none");  // the host's alone: not forwarded
    EXPECT_TRUE(fake.plugin.set.empty());
}

TEST(Sensor, ModeMustBeOneOfTheList) {
    FakeHost fake;
    fake.attach();
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    sensor->set_option("mode", "small");
    const Failure failure = failure_of([&] { sensor->set_option("mode", "huge"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(failure.says("small")) << failure.message;
    sensor->set_option("gain", "3");
    EXPECT_EQ(fake.plugin.set.back().second, "3");
    EXPECT_EQ(failure_of([&] { sensor->set_option("taste", "3"); }).code, VFIT_ERROR_UNSUPPORTED);
}

TEST(Sensor, ASensorWithoutModesSaysSo) {
    FakeHost fake;
    fake.plugin.table.mode = nullptr;
    fake.attach();
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    const Failure failure = failure_of([&] { sensor->set_option("mode", "small"); });
    EXPECT_EQ(failure.code, VFIT_ERROR_ARGUMENT);
    EXPECT_TRUE(failure.says("fake:1") && failure.says("no modes")) << failure.message;
}

TEST(Sensor, AKeyHasALengthAndAValueABound) {
    FakeHost fake;
    fake.attach();
    const Ref<Sensor> sensor = fake.host.open("fake:1");
    const std::string longest(4096, 'x');
    for (const auto& [key, value] :
         {std::pair<std::string, std::string>("", "1"), {longest + "x", "1"}, {"gain", longest + "x"}}) {
        const Failure failure = failure_of([&] { sensor->set_option(key, value); });
        EXPECT_EQ(failure.code, VFIT_ERROR_ARGUMENT);
        EXPECT_TRUE(failure.says("'" + key.substr(0, 64) + "'") && failure.says("4096")) << failure.message;
    }
    sensor->set_option("gain", longest);
    sensor->set_option("gain", "");
    EXPECT_EQ(fake.plugin.set.size(), 2u);
}

TEST(Sensor, DiscoveryFollowsWhatThePluginReports) {
    FakeHost fake;
    fake.attach();
    const auto add = [&](const char* uri) {
        vfit_sensor_info info = vfit_sensor_info_init();
        std::string(uri).copy(info.uri, sizeof info.uri);
        fake.plugin.host->sensor_added(fake.plugin.host->self, &info);
    };
    fake.plugin.on_discover = [&] { add("fake:a"), add("fake:b"), add("fake:a"); };
    ASSERT_EQ(fake.host.discover().size(), 2u);
    EXPECT_STREQ(fake.host.discover()[0].plugin, "fake");
    fake.plugin.on_discover = [&] { add("fake:b"); };
    ASSERT_EQ(fake.host.discover().size(), 1u) << "one that is not found again has gone";
    EXPECT_STREQ(fake.host.discover()[0].uri, "fake:b");
    fake.plugin.on_discover = [&] { fake.plugin.host->sensor_removed(fake.plugin.host->self, "fake:b"); };
    EXPECT_TRUE(fake.host.discover().empty());
}

TEST(Sensor, BodiesAreCarriedToTheWorldOfAFloorThatIsEstimatedOnceAndHeld) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const auto push = [&](float foot_y) {
        vfit_frame frame{};
        fake.plugin.begin(frame);
        fake.plugin.set_intrinsics(frame);
        fake.plugin.add_joint(frame, VFIT_JOINT_LEFT_FOOT, 0.2f, foot_y, 3.0f);
        fake.plugin.push(frame);
        Ref<Frame> out;
        EXPECT_EQ(sensor->acquire(0, out), VFIT_OK);
        return out;
    };
    const Ref<Frame> first = push(1.0f);
    EXPECT_EQ(first->camera.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_NEAR(first->camera.camera_height_m(), 1.08f, 1e-6f);
    const Vec3 foot = first->bodies.at(0).at(VFIT_JOINT_LEFT_FOOT);
    EXPECT_NEAR(foot.y, 0.08f, 1e-6f);
    EXPECT_NEAR(foot.z, -3.0f, 1e-6f);
    EXPECT_EQ(first->bodies[0].time_ns, first->time_ns);
    EXPECT_NEAR(push(0.7f)->camera.camera_height_m(), 1.08f, 1e-6f) << "a lifted foot moves no floor";
    sensor->stop();
    sensor->start();
    EXPECT_NEAR(push(0.7f)->camera.camera_height_m(), 0.78f, 1e-6f) << "a new stream looks anew";
}

TEST(Sensor, AFloorThatTheSensorGivesIsKept) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    vfit_frame handle{};
    fake.plugin.begin(handle);
    fake.plugin.set_intrinsics(handle);
    vfit_camera camera = vfit_camera_init();
    camera.floor_state = VFIT_FLOOR_GIVEN;
    camera.floor_normal[1] = -1.0f;
    camera.floor_distance_m = 2.0f;
    EXPECT_EQ(fake.plugin.host->frame_camera(fake.plugin.host->self, handle, &camera), VFIT_OK);
    fake.plugin.add_joint(handle, VFIT_JOINT_LEFT_FOOT, 0.0f, 1.0f, 3.0f);
    fake.plugin.push(handle);
    Ref<Frame> frame;
    ASSERT_EQ(sensor->acquire(0, frame), VFIT_OK);
    EXPECT_EQ(frame->camera.floor_state, VFIT_FLOOR_GIVEN);
    EXPECT_FLOAT_EQ(frame->camera.depth_unit_m, 0.001f);
    EXPECT_NEAR(frame->bodies.at(0).at(VFIT_JOINT_LEFT_FOOT).y, 1.0f, 1e-6f);
}

}  // namespace
}  // namespace vfit::test
