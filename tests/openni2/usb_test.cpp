// A USB camera that comes and goes: umockdev's, seen by the library's own watch and, through libusb as well,
// by the OpenNI2 driver in the reader's process. To be run under umockdev-wrapper.
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <umockdev.h>

#include "contract/support.h"
#include "openni2/left_open.h"

namespace {

using contract::last_error;

constexpr char kPath[] = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-1";

/// A PrimeSense camera with one configuration of one interface.
constexpr char kCamera[] =
    "P: /devices/pci0000:00/0000:00:14.0/usb1/1-1\n"
    "N: bus/usb/001/005\n"
    "E: BUSNUM=001\nE: DEVNUM=005\nE: DEVNAME=/dev/bus/usb/001/005\nE: DEVTYPE=usb_device\nE: MAJOR=189\nE: "
    "MINOR=4\n"
    "E: PRODUCT=1d27/609/100\nE: SUBSYSTEM=usb\n"
    "A: busnum=1\\n\nA: devnum=5\\n\nA: speed=480\\n\nA: bConfigurationValue=1\\n\nA: idVendor=1d27\\n\nA: "
    "idProduct=0609\\n\n"
    "H: descriptors=";

class UsbTest : public contract::ContextTest {
protected:
    void SetUp() override {
        bed_ = umockdev_testbed_new();
        ::setenv("VFIT_OPENNI2_LIBRARY",
                 (std::filesystem::path(VFIT_OPENNI2_FOLDER) / "libOpenNI2.so.0").c_str(), 1);
        ::setenv("VFIT_TEST_USB", "1d27:0609", 1);
        ContextTest::SetUp();
    }
    void TearDown() override {
        ContextTest::TearDown();
        g_object_unref(bed_);
    }
    void plug() {
        const std::string text = kCamera + descriptors() + "\n";
        GError* error = nullptr;
        ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, text.c_str(), &error))
            << (error ? error->message : "");
        umockdev_testbed_uevent(bed_, kPath, "add");
    }
    void unplug() {
        umockdev_testbed_uevent(bed_, kPath, "remove");
        umockdev_testbed_remove_device(bed_, kPath);
    }
    static std::string descriptors() {
        const std::vector<uint8_t> bytes = {
            18,   1,    0x00, 0x02, 0,    0,    0, 64,   0x27,
            0x1d, 0x09, 0x06, 0x00, 0x01, 0,    0, 0,    1,    // the device
            9,    2,    18,   0,    1,    1,    0, 0x80, 250,  // its configuration
            9,    4,    0,    0,    0,    0xff, 0, 0,    0};   // its interface
        std::string out;
        char hex[3];
        for (const uint8_t byte : bytes) std::snprintf(hex, sizeof hex, "%02X", byte), out += hex;
        return out;
    }
    uint64_t changes() {
        uint64_t count = 0;
        EXPECT_EQ(vfit_sensor_changes(context, &count), VFIT_OK) << last_error();
        return count;
    }
    bool changes_from(uint64_t before) {
        return within([&] { return changes() != before; });
    }
    template <typename What>
    static bool within(What&& what) {
        for (int i = 0; i < 4000; ++i) {
            if (what()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
    bool is_listed() {
        std::vector<vfit_sensor_info> list(8, vfit_sensor_info_init());
        uint32_t count = 8;
        EXPECT_EQ(vfit_sensor_list(context, list.data(), sizeof list[0], &count), VFIT_OK) << last_error();
        for (uint32_t i = 0; i < count; ++i)
            if (std::string(list[i].uri) == "openni2:virtual-person") return true;
        return false;
    }
    vfit_result state(vfit_sensor sensor) {
        vfit_sensor_stats stats = vfit_sensor_stats_init();
        EXPECT_EQ(vfit_sensor_describe(sensor, &stats), VFIT_OK);
        return stats.state;
    }
    UMockdevTestbed* bed_ = nullptr;
};

size_t resident_kb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "VmRSS:") {
            size_t kb = 0;
            status >> kb;
            return kb;
        }
    return 0;
}

TEST_F(UsbTest, ACameraThatIsPluggedInIsNoticedAndListed) {
    const uint64_t before = changes();
    EXPECT_FALSE(is_listed());
    plug();
    EXPECT_TRUE(changes_from(before));
    EXPECT_TRUE(is_listed());
    const uint64_t there = changes();
    unplug();
    EXPECT_TRUE(changes_from(there));
    EXPECT_FALSE(is_listed());
}

TEST_F(UsbTest, UnpluggedAHundredTimesItComesBackAndNothingIsLeft) {
    plug();
    ASSERT_TRUE(within([&] { return is_listed(); }));
    vfit_sensor sensor{};
    ASSERT_EQ(vfit_sensor_open(context, "openni2:virtual-person", &sensor), VFIT_OK) << last_error();
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK) << last_error();
    size_t open_before = 0, kb_before = 0;
    constexpr int kRounds = 100, kWarm = 5;
    for (int round = 0; round < kRounds; ++round) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK)
            << round << " " << last_error();
        vfit_frame_release(frame);
        if (round == kWarm) open_before = left_open(), kb_before = resident_kb();
        const uint64_t before = changes();
        unplug();
        ASSERT_TRUE(within([&] { return state(sensor) == VFIT_ERROR_DEVICE_LOST; })) << round;
        ASSERT_TRUE(changes_from(before)) << round;
        plug();
        ASSERT_TRUE(within([&] { return state(sensor) == VFIT_OK; })) << round;
    }
    vfit_frame frame{};
    ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK) << last_error();
    vfit_frame_release(frame);
    EXPECT_EQ(left_open(), open_before);
    EXPECT_LT(resident_kb(), kb_before + 3000);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

}  // namespace
