// The virtual sensor's noise against the published formulas that it claims to follow.
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "random.h"
#include "sensor_noise.h"
#include "types.h"

namespace vfit::virtual_person {
namespace {

constexpr uint32_t kWidth = 640, kHeight = 480;

CleanImage flat(float z, float theta_deg, uint32_t width = kWidth, uint32_t height = kHeight) {
    CleanImage image;
    image.resize(width, height);
    std::fill(image.depth_m.begin(), image.depth_m.end(), z);
    std::fill(image.cosine.begin(), image.cosine.end(), std::cos(glm::radians(theta_deg)));
    return image;
}

std::vector<uint16_t> sense(const char* sensor, const CleanImage& image, const NoiseSettings& settings,
                            uint64_t frame = 0) {
    SensorNoise noise(*find_sensor_model(sensor), settings);
    std::vector<uint16_t> depth(image.pixel_count());
    noise.apply(image, frame, depth.data(), image.width * 2);
    return depth;
}

struct Statistics {
    double mean_m = 0, sd_m = 0;
    size_t count = 0;
};
Statistics statistics(const std::vector<uint16_t>& depth) {
    double sum = 0, squares = 0;
    size_t n = 0;
    for (const uint16_t d : depth) {
        if (d == 0) continue;
        const double z = d * 0.001;
        sum += z, squares += z * z, ++n;
    }
    return {sum / double(n), std::sqrt(squares / double(n) - sum / double(n) * (sum / double(n))), n};
}

struct Case {
    float z_m, theta_deg;
};

TEST(NormalQuantiles, HaveMeanZeroAndUnitVariance) {
    double sum = 0, squares = 0, fourth = 0;
    for (uint32_t i = 0; i < kQuantileCount; ++i) {
        const double x = normal_quantiles()[i];
        sum += x, squares += x * x, fourth += x * x * x * x;
    }
    EXPECT_NEAR(sum / kQuantileCount, 0.0, 1e-6);
    EXPECT_NEAR(squares / kQuantileCount, 1.0, 1e-3);
    EXPECT_NEAR(fourth / kQuantileCount, 3.0, 3e-2);
    // Tabulated values of the normal distribution: 97.5 % and 99.865 %.
    EXPECT_NEAR(normal_quantiles()[static_cast<int>(0.975 * kQuantileCount)], 1.95996, 2e-4);
    EXPECT_NEAR(normal_quantiles()[static_cast<int>(0.998650 * kQuantileCount)], 3.0, 0.015)
        << "one step of the table";
}

TEST(StructuredLight, SdOfDepthFollowsNguyenWhereNothingIsQuantised) {
    for (const Case c : {Case{1, 0}, Case{2, 0}, Case{3, 0}, Case{1, 45}, Case{2, 45}, Case{3, 45},
                         Case{2, 70}, Case{3, 70}}) {
        NoiseSettings settings;
        settings.quantise = false;
        const Statistics s = statistics(sense("kinect_v1", flat(c.z_m, c.theta_deg), settings));
        const double theta = c.theta_deg * kPi / 180, slant = theta / (kPi / 2 - theta);
        double expected = 0.0012 + 0.0019 * (c.z_m - 0.4) * (c.z_m - 0.4);
        if (c.theta_deg >= 60) expected += 0.0001 / std::sqrt(c.z_m) * slant * slant;
        ASSERT_GE(s.count, 100000u);
        EXPECT_NEAR(s.sd_m / expected, 1.0, 0.05) << c.z_m << " m, " << c.theta_deg << " deg";
        EXPECT_NEAR(s.mean_m, c.z_m, 0.0005);
    }
}

TEST(StructuredLight, SdStaysThatOfTheMeasuredModelWithQuantisation) {
    for (const float z : {1.0f, 2.0f, 3.0f}) {
        const Statistics s = statistics(sense("kinect_v1", flat(z, 0), {}));
        EXPECT_NEAR(s.sd_m / axial_sigma_m(DepthPrinciple::kStructuredLight, z, 0), 1.0, 0.10) << z;
    }
}

TEST(StructuredLight, DepthComesInStepsOfAnEighthPixelOfDisparity) {
    for (const float z : {1.0f, 2.0f, 3.0f}) {
        std::set<uint16_t> levels;
        for (const uint16_t d : sense("kinect_v1", flat(z, 0), {}))
            if (d && std::abs(d * 0.001f - z) < 0.03f) levels.insert(d);
        ASSERT_GE(levels.size(), 2u);
        const double step_mm = double(*levels.rbegin() - *levels.begin()) / double(levels.size() - 1);
        const double expected_mm = 2.85e-6 * (z * 1000.0) * (z * 1000.0);  // Khoshelham and Elberink 2012
        EXPECT_NEAR(step_mm / expected_mm, 1.0, 0.06) << z;
    }
}

TEST(StructuredLight, NoiseScaleZeroLeavesTheNearestStep) {
    NoiseSettings settings;
    settings.scale = 0;
    for (const uint16_t d : sense("kinect_v1", flat(2.0f, 0), settings)) ASSERT_NEAR(d, 2000, 0.5 * 11.4 + 1);
    settings.quantise = false;
    for (const uint16_t d : sense("kinect_v1", flat(2.0f, 0), settings)) ASSERT_EQ(d, 2000);
}

TEST(StructuredLight, NoiseScaleTwoDoublesTheSd) {
    NoiseSettings settings;
    settings.quantise = false, settings.scale = 2;
    const Statistics s = statistics(sense("kinect_v1", flat(2, 0), settings));
    EXPECT_NEAR(s.sd_m / (2 * axial_sigma_m(DepthPrinciple::kStructuredLight, 2, 0)), 1.0, 0.02);
}

TEST(StructuredLight, DropOutGrowsFrom75To85Degrees) {
    const std::map<float, double> expected = {{0, 0},    {60, 0},   {74, 0}, {77.5f, 0.25},
                                              {80, 0.5}, {83, 0.8}, {86, 1}};
    for (const auto& [theta, share] : expected) {
        const Statistics s = statistics(sense("kinect_v1", flat(2, theta), {}));
        EXPECT_NEAR(1.0 - double(s.count) / (kWidth * kHeight), share, 0.01) << theta;
    }
}

TEST(StructuredLight, NothingIsReportedOutOfRange) {
    for (const float z : {0.5f, 0.7f, 4.6f, 8.0f})
        for (const uint16_t d : sense("kinect_v1", flat(z, 0), {}))
            ASSERT_TRUE(d == 0 || (d >= 800 && d <= 4000)) << z;
    EXPECT_EQ(statistics(sense("kinect_v1", flat(0.5f, 0), {})).count, 0u);
}

// A board at z1 before a wall at z2: the strip on its left that the projector, 75 mm to the right, cannot
// reach is f b (1/z1 - 1/z2) wide.
TEST(StructuredLight, ProjectorShadowHasTheWidthOfTheDisparityDifference) {
    const float z1 = 1.5f, z2 = 3.0f;
    CleanImage image = flat(z2, 0);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 300; x < 400; ++x) image.depth_m[size_t{y} * kWidth + x] = z1;
    NoiseSettings settings;
    settings.scale = 0;
    const auto depth = sense("kinect_v1", image, settings);
    int left = 0, right = 0;
    for (uint32_t x = 0; x < 300; ++x) left += depth[240 * kWidth + x] == 0;
    for (uint32_t x = 300; x < kWidth; ++x) right += depth[240 * kWidth + x] == 0;
    const float expected = 594.2f * 0.075f * (1 / z1 - 1 / z2);
    EXPECT_NEAR(left, expected, 1.0f);
    EXPECT_EQ(right, 0);
    EXPECT_EQ(depth[240 * kWidth + 299], 0) << "the strip touches the board";

    settings.shadow = false;
    for (const uint16_t d : sense("kinect_v1", image, settings)) ASSERT_NE(d, 0);
}

TEST(StructuredLight, EdgesJitterByTheLateralSigma) {
    const float z1 = 1.5f, z2 = 3.0f;
    CleanImage image = flat(z2, 0);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < 320; ++x) image.depth_m[size_t{y} * kWidth + x] = z1;
    NoiseSettings settings;
    settings.quantise = false, settings.shadow = false;
    // A pixel k from the edge shows the other surface where the look-up's rounded offset is k or more.
    std::array<double, 4> flips{};
    for (uint64_t frame = 0; frame < 40; ++frame) {
        const auto depth = sense("kinect_v1", image, settings, frame);
        for (uint32_t y = 0; y < kHeight; ++y)
            for (size_t k = 0; k < flips.size(); ++k) flips[k] += depth[size_t{y} * kWidth + 319 - k] > 2200;
    }
    for (size_t k = 0; k < flips.size(); ++k) {
        const double share = flips[k] / (40.0 * kHeight);
        const double expected = 0.5 * std::erfc((double(k) + 0.5) / 0.8 / std::sqrt(2.0));
        EXPECT_NEAR(share, expected, 0.01) << k;
    }
}

TEST(StructuredLight, SlantedSurfacesAreNotTakenForEdges) {
    // A plane at 65 degrees: depth grows by z tan(theta) / f a column.
    CleanImage image = flat(2, 65);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
            image.depth_m[size_t{y} * kWidth + x] =
                2.0f / (1.0f - (float(x) - 320.0f) / 594.2f * std::tan(glm::radians(65.0f)) * 0.4f);
    NoiseSettings settings;
    settings.quantise = false;
    const auto depth = sense("kinect_v1", image, settings);
    double squares = 0;
    size_t n = 0;
    for (size_t i = 0; i < depth.size(); ++i) {
        const float z = image.depth_m[i];
        if (!depth[i] || z < 1.8f || z > 2.2f) continue;
        const double error =
            (depth[i] * 0.001 - z) / axial_sigma_m(DepthPrinciple::kStructuredLight, z, glm::radians(65.0f));
        squares += error * error, ++n;
    }
    ASSERT_GT(n, 10000u);
    EXPECT_NEAR(std::sqrt(squares / double(n)), 1.0, 0.05);
}

TEST(TimeOfFlight, SdOfDepthFollowsFankhauser) {
    for (const Case c : {Case{1, 0}, Case{2, 0}, Case{3, 0}, Case{1, 45}, Case{2, 45}, Case{3, 45},
                         Case{2, 70}, Case{3, 70}}) {
        const Statistics s = statistics(sense("tof", flat(c.z_m, c.theta_deg, 512, 424), {}));
        const double theta = c.theta_deg * kPi / 180, slant = theta / (kPi / 2 - theta), z = c.z_m;
        const double expected =
            0.001 * (1.5 - 0.5 * z + 0.3 * z * z + 0.1 * std::pow(z, 1.5) * slant * slant);
        ASSERT_GE(s.count, 100000u);
        // Whole millimetres add 1/12 mm^2.
        EXPECT_NEAR(s.sd_m / std::sqrt(expected * expected + 1e-6 / 12), 1.0, 0.05)
            << z << " m, " << c.theta_deg;
    }
}

TEST(TimeOfFlight, PixelsFlyBetweenTheTwoSurfacesOfAnEdge) {
    CleanImage image = flat(3.0f, 0, 512, 424);
    for (uint32_t y = 0; y < 424; ++y)
        for (uint32_t x = 0; x < 256; ++x) image.depth_m[size_t{y} * 512 + x] = 1.5f;
    const auto depth = sense("tof", image, {});
    const auto flying = [&](uint32_t x) {
        int n = 0;
        for (uint32_t y = 1; y < 423; ++y) n += depth[y * 512 + x] > 1550 && depth[y * 512 + x] < 2950;
        return n;
    };
    EXPECT_GT(flying(256), 400) << "first column of the wall";
    EXPECT_EQ(flying(250), 0);
    EXPECT_EQ(flying(262), 0);
}

TEST(Seed, EqualSeedsGiveEqualBitsAndOthersDiffer) {
    for (const char* sensor : {"kinect_v1", "tof"}) {
        const SensorModel& m = *find_sensor_model(sensor);
        const CleanImage image = flat(2.5f, 20, m.width, m.height);
        NoiseSettings seven, eight;
        seven.seed = 7, eight.seed = 8;
        EXPECT_EQ(sense(sensor, image, seven, 3), sense(sensor, image, seven, 3));
        EXPECT_NE(sense(sensor, image, seven, 3), sense(sensor, image, seven, 4));
        EXPECT_NE(sense(sensor, image, seven, 3), sense(sensor, image, eight, 3));
    }
}

TEST(Seed, NoiseOfNeighboursAndOfFramesIsIndependent) {
    NoiseSettings settings;
    settings.quantise = false;
    const CleanImage image = flat(2.5f, 0);
    const auto a = sense("kinect_v1", image, settings, 0), b = sense("kinect_v1", image, settings, 1);
    double neighbours = 0, frames = 0, variance = 0;
    for (size_t i = 0; i + 1 < a.size(); ++i) {
        const double x = a[i] - 2500.0;
        neighbours += x * (a[i + 1] - 2500.0), frames += x * (b[i] - 2500.0), variance += x * x;
    }
    EXPECT_NEAR(neighbours / variance, 0, 0.01);
    EXPECT_NEAR(frames / variance, 0, 0.01);
}

TEST(Ideal, DepthIsExactToHalfAMillimetre) {
    for (const uint16_t d : sense("ideal", flat(2.3456f, 85), {})) ASSERT_EQ(d, 2346);
}

}  // namespace
}  // namespace vfit::virtual_person
