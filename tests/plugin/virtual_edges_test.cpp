// Tiles tell of every edge within reach, and spare what is even.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "edge_tiles.h"

namespace vfit::virtual_person {
namespace {

constexpr int kWidth = 150, kHeight = 100;  // no whole number of tiles

CleanImage even() {
    CleanImage image;
    image.resize(kWidth, kHeight);
    std::fill(image.depth_m.begin(), image.depth_m.end(), 2.0f);
    std::fill(image.cosine.begin(), image.cosine.end(), 0.9f);
    return image;
}

size_t at(int x, int y) { return size_t(y) * kWidth + size_t(x); }

bool jumps_within_reach(const CleanImage& image, int x, int y, float jump_m) {
    constexpr int kReach = EdgeTiles::kReach;
    for (int v = std::max(0, y - kReach); v <= std::min(kHeight - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(kWidth - 1, x + kReach); ++u)
            if (std::abs(image.depth_m[at(u, v)] - image.depth_m[at(x, y)]) > jump_m) return true;
    return false;
}

TEST(EdgeTiles, NoEdgeWithinReachIsMissed) {
    std::mt19937 random(1);
    const auto below = [&](int n) { return int(random() % uint32_t(n)); };
    EdgeTiles tiles;
    for (int round = 0; round < 200; ++round) {
        CleanImage image = even();
        for (int i = 0; i < 3; ++i) image.depth_m[at(below(kWidth), below(kHeight))] = below(2) ? 0.0f : 2.03f;
        const int steep_x = below(kWidth), steep_y = below(kHeight);
        image.cosine[at(steep_x, steep_y)] = 0.1f;
        tiles.find(image, 0.02f, 0.2f);
        EXPECT_TRUE(tiles.marked(uint32_t(steep_x), uint32_t(steep_y)));
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                if (jumps_within_reach(image, x, y, 0.02f)) {
                    ASSERT_TRUE(tiles.marked(uint32_t(x), uint32_t(y)));
                }
    }
}

TEST(EdgeTiles, WhatIsEvenIsSpared) {
    EdgeTiles tiles;
    CleanImage image = even();
    image.depth_m[at(70, 50)] = 1.0f;
    tiles.find(image, 0.02f, 0.2f);
    int marked = 0;
    for (uint32_t y = 0; y < kHeight; y += EdgeTiles::kHeight)
        for (uint32_t x = 0; x < kWidth; x += EdgeTiles::kWidth) marked += tiles.marked(x, y);
    EXPECT_EQ(marked, 9) << "the tile of the edge and those around it";
    image = even();
    tiles.find(image, 0.02f, 0.2f);
    EXPECT_FALSE(tiles.marked(70, 50)) << "of the image before";
}

}  // namespace
}  // namespace vfit::virtual_person
