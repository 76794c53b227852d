// The coarse grid: what a cell says about its pixels.
#include "track/depth_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "track/components.h"
#include "track/user_map.h"

namespace vfit {
namespace {

struct Picture {
    Picture(uint32_t width, uint32_t height, uint16_t value) : depth(size_t(width) * height, value) {
        camera.width = width;
        camera.height = height;
        camera.fx = camera.fy = 500.0f;
        camera.cx = 0.5f * float(width - 1);
        camera.cy = 0.5f * float(height - 1);
    }
    uint16_t& at(uint32_t x, uint32_t y) { return depth[size_t(y) * camera.width + x]; }
    DepthImage view() const { return {depth.data(), nullptr, camera}; }
    std::vector<uint16_t> depth;
    Camera camera;
};

TEST(DepthGrid, IsAsFineAsTheImageAllowsAndNoWiderThanItsLimit) {
    DepthGrid grid;
    for (const uint32_t width : {320u, 512u, 640u, 1280u}) {
        const Picture picture(width, 240, 2000);
        grid.run(picture.view());
        EXPECT_LE(grid.width(), DepthGrid::kMostColumns);
        EXPECT_GE(grid.width(), 240u);
        EXPECT_EQ(grid.width(), width / grid.stride());
        EXPECT_NEAR(grid.depth()[5], 2.0f, 1e-4f);
        const Vec3 p = grid.point(0, 0);
        EXPECT_NEAR(picture.camera.project(p).x, 0.5f * float(grid.stride() - 1), 1e-3f);
    }
}

TEST(DepthGrid, MeasuresTheNoiseOfItsSensor) {
    DepthGrid grid;
    std::mt19937 random(1);
    for (const float sigma_mm : {4.0f, 12.0f, 200.0f}) {
        Picture picture(320, 240, 0);
        std::normal_distribution<float> noise(3500.0f, sigma_mm);
        for (uint16_t& depth : picture.depth) depth = uint16_t(noise(random));
        for (uint32_t y = 0; y < 240; ++y)  // an edge is no noise
            for (uint32_t x = 100; x < 140; ++x) picture.at(x, y) = uint16_t(picture.at(x, y) - 1500);
        grid.run(picture.view());
        const float wanted_m = std::min(0.001f * sigma_mm, depth_sigma_m(3.5f));
        EXPECT_NEAR(grid.sigma_m(3.5f), wanted_m, 0.25f * wanted_m) << sigma_mm;
    }
    grid.run(Picture(320, 240, 0).view());  // without readings nothing is known
    EXPECT_EQ(grid.sigma_m(3.5f), depth_sigma_m(3.5f));
}

TEST(DepthGrid, JoinsSurfacesByTheNoiseThatItSees) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0f, 2.0f);  // mm: a time-of-flight camera
    Picture fine(320, 240, 0), stepped(320, 240, 3000);
    for (uint16_t& d : fine.depth) d = uint16_t(std::lround(3000.0f + noise(random)));
    DepthGrid grid;
    grid.run(fine.view());
    EXPECT_LT(grid.same_surface_m(3.0f), 0.045f);
    // Steps hide the noise: it may be as large as that of the worst sensor.
    grid.run(stepped.view());
    EXPECT_GT(grid.same_surface_m(3.0f), 0.08f);
}

TEST(Components, AWallThatSlantsAwayIsOne) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0f, 2.0f);
    Picture picture(320, 240, 0);
    for (uint32_t y = 0; y < 240; ++y)
        for (uint32_t x = 0; x < 320; ++x) {
            // From 2.5 m on every cell is 6 cm behind the last.
            const float z = 2500.0f + (x < 40 ? 60.0f * float(x) : 2400.0f);
            picture.at(x, y) = uint16_t(std::lround(z + noise(random)));
        }
    DepthGrid grid;
    grid.run(picture.view());
    ASSERT_LT(grid.same_surface_m(3.0f), 0.05f);
    const std::vector<uint8_t> wanted(grid.cells(), 1);
    Components components;
    components.run(grid, wanted.data(), 240);
    size_t most = 0;
    for (size_t i = 0; i < components.size(); ++i) most = std::max(most, components.cells(i).size());
    EXPECT_GT(most, 300u * 240u);
}

TEST(DepthGrid, IsNeverEmptyHoweverThinTheImage) {
    for (const auto& [width, height] :
         {std::pair{16384u, 1u}, {16384u, 2u}, {1000u, 2u}, {1u, 1u}, {1u, 3000u}, {721u, 5u}}) {
        Picture picture(width, height, 2000);
        DepthGrid grid;
        grid.run(picture.view());
        ASSERT_GE(grid.width(), 1u) << width << " x " << height;
        ASSERT_GE(grid.height(), 1u) << width << " x " << height;
        ASSERT_LE(grid.width() * grid.stride(), width);
        ASSERT_LE(grid.height() * grid.stride(), height);
        EXPECT_NEAR(grid.depth()[grid.cells() - 1], 2.0f, 1e-4f);
    }
}

TEST(DepthGrid, ACellIsTheMeanOfItsNearestSurface) {
    Picture picture(640, 480, 3000);
    picture.at(10, 10) = 2000;
    picture.at(11, 10) = 2020;
    picture.at(10, 11) = 0;
    DepthGrid grid;
    grid.run(picture.view());
    EXPECT_NEAR(grid.depth()[5 * 320 + 5], 2.010f, 1e-4f)
        << "without the wall behind and the missing reading";
    for (const uint32_t y : {20u, 21u})
        for (const uint32_t x : {20u, 21u}) picture.at(x, y) = 0;
    grid.run(picture.view());
    EXPECT_EQ(grid.depth()[10 * 320 + 10], 0.0f);
}

TEST(Components, AreSplitByDepthAndJoinedOverAMissingReading) {
    Picture picture(320, 240, 0);
    for (uint32_t y = 20; y < 40; ++y)
        for (uint32_t x = 20; x < 60; ++x)
            if (x != 30) picture.at(x, y) = x < 40 ? 2000 : 2300;
    DepthGrid grid;
    grid.run(picture.view());
    std::vector<uint8_t> wanted(grid.cells());
    for (size_t i = 0; i < wanted.size(); ++i) wanted[i] = grid.depth()[i] > 0.0f;
    Components components;
    components.run(grid, wanted.data(), 1);
    ASSERT_EQ(components.size(), 2u);
    EXPECT_EQ(components.cells(0).size(), 19u * 20u);
    EXPECT_EQ(components.cells(1).size(), 20u * 20u);
    components.run(grid, wanted.data(), 390);
    EXPECT_EQ(components.size(), 1u) << "small ones are dropped";
}

TEST(UserMap, LabelsOnlyThePixelsOnTheCellsSurface) {
    Picture picture(640, 480, 3000);
    picture.at(10, 10) = 2000;
    picture.at(11, 10) = 2010;
    picture.at(10, 11) = 0;
    DepthGrid grid;
    grid.run(picture.view());
    std::vector<uint8_t> labels(grid.cells(), 0), users(picture.depth.size(), 9);
    labels[5 * 320 + 5] = 3;
    write_user_map(picture.view(), grid, labels.data(), users.data());
    EXPECT_EQ(users[10 * 640 + 10], 3);
    EXPECT_EQ(users[10 * 640 + 11], 3);
    EXPECT_EQ(users[11 * 640 + 10], 0);
    EXPECT_EQ(users[11 * 640 + 11], 0);
    EXPECT_EQ(users[0], 0);
}

}  // namespace
}  // namespace vfit
