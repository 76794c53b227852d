// Places of cameras: relative to each other, and as a file.
#include "client/cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace vfit::tools {
namespace {

constexpr float kQuarter_rad = 1.5707963f;

TEST(CameraPlace, IsRelativeToAnotherOne) {
    // This camera stands 3 m to the first one's right and is turned to its left by 90 degrees.
    const CameraPlace here{kQuarter_rad, {3.0f, 0.0f, 0.0f}}, there{0.0f, {1.0f, 0.5f, -2.0f}};
    const CameraPlace relative = here.of(there);
    EXPECT_NEAR(relative.turned_rad, -kQuarter_rad, 1e-6f);
    // Its Z axis is the first one's X axis, its X axis the first one's Z axis reversed.
    EXPECT_NEAR(relative.position[0], 2.0f, 1e-5f);
    EXPECT_NEAR(relative.position[1], 0.5f, 1e-5f);
    EXPECT_NEAR(relative.position[2], -2.0f, 1e-5f);
    const CameraPlace itself = there.of(there);
    EXPECT_EQ(itself.turned_rad, 0.0f);
    for (const float p : itself.position) EXPECT_EQ(p, 0.0f);
    const std::array<float, 4> rotation = here.rotation();
    EXPECT_NEAR(rotation[1], std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(rotation[3], std::sqrt(0.5f), 1e-6f);
}

class PlacesFile : public testing::Test {
protected:
    const std::string path_ = testing::TempDir() + "vfit_places_test.json";

    void write(const std::string& text) { std::ofstream(path_) << text; }
    std::string fault(const std::string& text, size_t cameras = 1) {
        write(text);
        try {
            read_places(path_, cameras);
        } catch (const Failure& failure) {
            EXPECT_NE(std::string(failure.what()).find(path_), std::string::npos) << failure.what();
            return failure.what();
        }
        return "";
    }
    static std::string of(const std::string& cameras) {
        return R"({"format": "vfit-cameras", "version": 1, "cameras": )" + cameras + "}";
    }
    void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(PlacesFile, IsReadAsItWasWritten) {
    const std::vector<CameraPlace> places = {{0.0f, {0.0f, 0.0f, 0.0f}}, {-2.5f, {1.25f, -0.5f, 3.0f}}};
    write(places_text(places));
    const std::vector<CameraPlace> read = read_places(path_, 2);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_NEAR(read[1].turned_rad, -2.5f, 1e-5f);
    EXPECT_EQ(read[1].position, places[1].position);
}

TEST_F(PlacesFile, FaultsAreNamed) {
    EXPECT_NE(fault("{").find("parse"), std::string::npos);
    EXPECT_NE(fault(R"({"format": "x", "version": 1})").find("not of vfit cameras"), std::string::npos);
    EXPECT_NE(fault(R"({"format": "vfit-cameras", "version": 2})").find("version"), std::string::npos);
    EXPECT_NE(fault(of("{}")).find("no list"), std::string::npos);
    EXPECT_NE(fault(of("[]")).find("0 cameras, not 1"), std::string::npos);
    EXPECT_NE(fault(of(R"([{"position": [0, 0, 0]}])")).find("turned_deg"), std::string::npos);
    for (const char* turned : {"1e38", "true", "\"left\"", "null"})
        EXPECT_NE(fault(of(std::string(R"([{"turned_deg": )") + turned + R"(, "position": [0, 0, 0]}])"))
                      .find("not a number within 360"),
                  std::string::npos)
            << turned;
    EXPECT_NE(fault(of(R"([{"turned_deg": 1, "position": [0, 0, 1e9]}])")).find("within 100"),
              std::string::npos);
    EXPECT_NE(fault(of(R"([{"turned_deg": 1, "position": [0, 0]}])")).find("three"), std::string::npos);
}

}  // namespace
}  // namespace vfit::tools
