// Options of the virtual person.
#include <functional>

#include <gtest/gtest.h>

#include "error.h"
#include "options.h"

namespace vfit::virtual_person {
namespace {

std::string message_of(const std::function<void()>& call, vfit_result expected) {
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), expected) << e.what();
        return e.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

TEST(VirtualOptions, HaveDefaultsAndTexts) {
    const Options options;
    EXPECT_EQ(options.text("sensor"), "kinect_v1");
    EXPECT_EQ(options.number("distance"), 2.7);
    EXPECT_EQ(options.whole("frames"), 0u);
    ASSERT_GE(options.count(), 15u);
    for (uint32_t i = 0; i < options.count(); ++i) {
        vfit_sensor_option o = vfit_sensor_option_init();
        options.describe(i, o);
        EXPECT_GT(std::string(o.key).size(), 2u);
        EXPECT_GT(std::string(o.text).size(), 10u) << o.key;
        EXPECT_LT(std::string(o.text).size(), sizeof o.text - 1) << o.key << " is cut";
    }
}

TEST(VirtualOptions, EveryDefaultIsAValueThatIsAccepted) {
    Options options;
    for (uint32_t i = 0; i < options.count(); ++i) {
        vfit_sensor_option o = vfit_sensor_option_init();
        options.describe(i, o);
        EXPECT_NO_THROW(options.set(o.key, o.value)) << o.key;
    }
}

TEST(VirtualOptions, ModeAndSensorAreOne) {
    Options options;
    options.set("mode", "azure");
    EXPECT_EQ(options.text("sensor"), "azure");
    options.set("sensor", "tof");
    EXPECT_EQ(options.text("mode"), "tof");
}

TEST(VirtualOptions, ABadValueNamesTheOptionAndWhatItTakes) {
    Options options;
    const auto set = [&](const char* key, const char* value) {
        return message_of([&] { options.set(key, value); }, VFIT_ERROR_ARGUMENT);
    };
    const std::string sensor = set("sensor", "lidar");
    EXPECT_NE(sensor.find("sensor"), std::string::npos);
    EXPECT_NE(sensor.find("lidar"), std::string::npos);
    EXPECT_NE(sensor.find("kinect_v1_320"), std::string::npos);
    EXPECT_NE(set("motion", "fly").find("squat"), std::string::npos);
    EXPECT_NE(set("sex", "x").find("f, m"), std::string::npos);
    EXPECT_NE(set("pace", "slow").find("realtime"), std::string::npos);
    EXPECT_NE(set("distance", "nan").find("0.5 to 10"), std::string::npos);
    EXPECT_NE(set("distance", "2.4m").find("2.4m"), std::string::npos);
    EXPECT_NE(set("clothing", "0.5").find("0 to 0.1"), std::string::npos);
    EXPECT_NE(set("clothing", "-0.01").find("clothing"), std::string::npos);
    EXPECT_NE(set("people", "4").find("0 to 3"), std::string::npos);
    EXPECT_NE(set("furniture", "chair,sofa").find("known are chair, rack, stool"), std::string::npos);
    EXPECT_NE(set("occluder", "soon").find("soon"), std::string::npos);
    EXPECT_NE(set("floor", "0").find("given, unknown"), std::string::npos);
    EXPECT_NE(set("body", "-3").find("body"), std::string::npos);
    EXPECT_NE(set("seed", "1.5").find("whole"), std::string::npos);
    EXPECT_NE(set("seed", "-1").find("seed"), std::string::npos);
    EXPECT_NE(set("frames", "").find("frames"), std::string::npos);
    EXPECT_EQ(options.number("distance"), 2.7) << "a refused value changes nothing";
}

TEST(VirtualOptions, KeysOutsideTheTableAreLeftToTheCaller) {
    Options options;
    EXPECT_FALSE(options.set("weight", "0.6"));
    EXPECT_FALSE(options.set("colour", "red"));
}

}  // namespace
}  // namespace vfit::virtual_person
