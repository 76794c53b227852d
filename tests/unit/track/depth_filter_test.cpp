// Algorithm 1 and Eq. 2: exact numbers on small images, patched holes, and OpenCV's Gaussian as the judge.
#include "track/depth_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "core/error.h"

namespace vfit {
namespace {

struct SmallImage {
    SmallImage(uint32_t width, uint32_t height) : depth(width * height, 0), users(width * height, 0) {
        camera.width = width;
        camera.height = height;
        camera.fx = camera.fy = 100.0f;
    }
    void set(uint32_t x, uint32_t y, uint16_t mm, uint8_t user) {
        depth[y * camera.width + x] = mm;
        users[y * camera.width + x] = user;
    }
    DepthImage view() const { return {depth.data(), users.data(), camera}; }

    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    Camera camera;
};

TEST(DepthFilter, SetsEverythingButThePersonToTheirMean) {
    SmallImage image(4, 3);
    for (uint32_t i = 0; i < 12; ++i) image.depth[i] = 5000;  // the wall
    image.set(1, 1, 2000, 7);
    image.set(2, 1, 2600, 7);
    image.set(3, 1, 1000, 9);  // another person
    DepthFilter filter(1);     // a kernel of one pixel: Algorithm 1 alone
    const FilteredDepth out = filter.run(image.view(), 7);
    EXPECT_EQ(out.pixels, 2u);
    EXPECT_FLOAT_EQ(out.mean_m, 2.3f);
    EXPECT_FLOAT_EQ(out.at(0, 0), 2.3f);
    EXPECT_FLOAT_EQ(out.at(3, 1), 2.3f);
    EXPECT_FLOAT_EQ(out.at(1, 1), 2.0f);
    EXPECT_FLOAT_EQ(out.at(2, 1), 2.6f);
    EXPECT_FLOAT_EQ(out.correction_m, 0.0f);
    EXPECT_FALSE(out.inside(0, 1));
    EXPECT_TRUE(out.inside(1, 1));
    EXPECT_FALSE(out.inside(3, 1));
    EXPECT_FALSE(out.inside(-1, 1));
}

TEST(DepthFilter, SmoothsByTheBinomialKernelAndReportsTheCorrection) {
    SmallImage image(9, 9);
    image.set(4, 4, 2000, 1);
    image.set(5, 4, 3000, 1);
    DepthFilter filter;
    const FilteredDepth out = filter.run(image.view(), 1);
    // Deviations from the mean of 2.5 m are -0.5 and +0.5; the centre of the 5 x 5 kernel is 6/16 both ways,
    // its neighbour 4/16 by 6/16.
    const float expected = 2.5f - 0.5f * 36.0f / 256.0f + 0.5f * 24.0f / 256.0f;
    EXPECT_NEAR(out.at(4, 4), expected, 1e-6f);
    EXPECT_NEAR(out.at(5, 4), 5.0f - expected, 1e-6f);
    EXPECT_NEAR(out.correction_m, expected - 2.0f, 1e-6f);
    EXPECT_NEAR(out.at(0, 0), 2.5f, 1e-6f);
}

TEST(DepthFilter, AgreesWithOpenCvOnAnyImageAlsoAtItsBorders) {
    std::mt19937 random(3);
    for (const int kernel : {3, 5, 9}) {
        SmallImage image(37, 29);
        cv::Mat expected(29, 37, CV_32F);
        for (uint32_t y = 0; y < 29; ++y)
            for (uint32_t x = 0; x < 37; ++x)
                image.set(x, y, uint16_t(1500 + random() % 1500),
                          uint8_t(x + y < 40 && x * y % 7 != 3 ? 2 : 0));
        DepthFilter filter(kernel), plain(1);
        const FilteredDepth raw = plain.run(image.view(), 2);
        const cv::Mat d1(29, 37, CV_32F, const_cast<float*>(raw.depth_m));
        // Left to itself OpenCV takes a table for some sizes: told the deviation, it computes.
        const double sigma_px = kernel > 5 ? 0.3 * (0.5 * (kernel - 1) - 1.0) + 0.8 : 0.0;
        cv::GaussianBlur(d1, expected, {kernel, kernel}, sigma_px);
        const FilteredDepth out = filter.run(image.view(), 2);
        for (int y = 0; y < 29; ++y)
            for (int x = 0; x < 37; ++x)
                ASSERT_NEAR(out.at(x, y), expected.at<float>(y, x), 1e-5f) << x << ' ' << y;
    }
}

TEST(DepthFilter, PatchesHolesOfThePersonAlongTheRow) {
    SmallImage image(12, 3);
    for (uint32_t y = 0; y < 3; ++y)
        for (uint32_t x = 0; x < 12; ++x) image.set(x, y, uint16_t(2000 + 10 * x), 1);
    image.set(4, 1, 0, 1);
    image.set(5, 1, 0, 0);  // a speckle that the user map does not mark
    image.set(6, 1, 0, 1);
    DepthFilter filter(5), plain(1);
    EXPECT_EQ(filter.run(image.view(), 1).patched, 3u);
    // A kernel of one pixel spans no hole of three that the map does not mark as a whole.
    EXPECT_EQ(plain.run(image.view(), 1).patched, 0u);

    image.users[12 + 5] = 1;
    const FilteredDepth out = plain.run(image.view(), 1);
    EXPECT_EQ(out.patched, 3u);
    EXPECT_EQ(out.pixels, 33u);
    EXPECT_NEAR(out.at(5, 1), 2.05f, 1e-6f);
    EXPECT_EQ(out.mask[12 + 5], FilteredDepth::kPatched);
    EXPECT_NEAR(out.mean_m, 2.0f + 0.01f * (3 * 66.0f - 15.0f) / 33.0f, 1e-6f)
        << "patched pixels are no readings";
}

TEST(DepthFilter, DoesNotPatchTheGapBetweenArmAndTrunk) {
    SmallImage image(20, 20);
    for (uint32_t y = 0; y < 20; ++y)
        for (uint32_t x = 0; x < 20; ++x)
            if (x != 10) image.set(x, y, 2000, 1);
    DepthFilter filter;
    EXPECT_EQ(filter.run(image.view(), 1).patched, 0u) << "as wide as a hole, but through the whole image";
    for (uint32_t y = 0; y < 20; ++y)
        if (y != 7 && y != 8) image.set(10, y, 2000, 1);
    EXPECT_EQ(filter.run(image.view(), 1).patched, 2u);
    for (uint32_t y = 1; y < 9; ++y) image.set(10, y, 0, 0);
    EXPECT_EQ(filter.run(image.view(), 1).patched, 0u) << "eight rows";
}

TEST(DepthFilter, DoesNotPatchBetweenTwoSurfacesNorOverAnotherReading) {
    SmallImage image(9, 3);
    for (uint32_t y = 0; y < 3; ++y)
        for (uint32_t x = 0; x < 9; ++x) image.set(x, y, x < 4 ? 2000 : 2400, 1);
    image.set(4, 1, 0, 0);  // the edge of an arm before the trunk
    DepthFilter filter;
    EXPECT_EQ(filter.run(image.view(), 1).patched, 0u);
    EXPECT_FALSE(filter.run(image.view(), 1).inside(4, 1));
    for (uint32_t x = 0; x < 9; ++x) image.set(x, 1, 2000, 1);
    image.set(4, 1, 0, 0);
    EXPECT_EQ(filter.run(image.view(), 1).patched, 1u);
    image.set(4, 1, 3500, 0);  // the wall seen through
    EXPECT_EQ(filter.run(image.view(), 1).patched, 0u);
}

TEST(DepthFilter, FindsNobodyWithoutAUserMapOrWithAnotherId) {
    SmallImage image(4, 4);
    image.set(1, 1, 2000, 1);
    DepthFilter filter;
    EXPECT_EQ(filter.run(image.view(), 3).pixels, 0u);
    EXPECT_EQ(filter.run(image.view(), 0).pixels, 0u);
    EXPECT_EQ(filter.run(image.view(), 257).pixels, 0u) << "ids beyond a byte do not wrap";
    DepthImage view = image.view();
    view.users = nullptr;
    const FilteredDepth out = filter.run(view, 1);
    EXPECT_EQ(out.pixels, 0u);
    EXPECT_TRUE(out.box.empty());
    EXPECT_FALSE(out.inside(1, 1));
}

TEST(DepthFilter, ForgetsTheFrameBefore) {
    SmallImage large(40, 30), small(10, 10);
    for (uint32_t y = 5; y < 25; ++y)
        for (uint32_t x = 5; x < 35; ++x) large.set(x, y, 1500, 1);
    small.set(5, 5, 2000, 1);
    DepthFilter used, fresh;
    used.run(large.view(), 1);
    const FilteredDepth a = used.run(small.view(), 1), b = fresh.run(small.view(), 1);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x) ASSERT_EQ(a.at(x, y), b.at(x, y));
    used.wipe();
    for (size_t i = 0; i < 100; ++i) {
        ASSERT_EQ(a.depth_m[i], 0.0f);
        ASSERT_EQ(a.mask[i], 0);
    }
}

TEST(DepthFilter, RefusesKernelsThatHaveNoMiddle) {
    for (const int kernel : {0, -3, 4, 33}) {
        try {
            DepthFilter filter(kernel);
            ADD_FAILURE() << kernel;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
            EXPECT_NE(std::string(e.what()).find(std::to_string(kernel)), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace vfit
