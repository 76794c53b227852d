// Tiles tell of every edge within reach, and spare what is even.
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "edge_tiles.h"

namespace vfit::virtual_person {
namespace {

constexpr int kImageWidth = 150, kImageHeight = 100;  // no whole number of tiles

CleanImage even() {
    CleanImage image;
    image.resize(kImageWidth, kImageHeight);
    std::fill(image.depth_m.begin(), image.depth_m.end(), 2.0f);
    std::fill(image.cosine.begin(), image.cosine.end(), 0.9f);
    return image;
}

size_t at(int x, int y) { return size_t(y) * kImageWidth + size_t(x); }

/// All pixels from which that one is within reach are marked.
void expect_marked_about(const EdgeTiles& tiles, int x, int y) {
    constexpr int kReach = EdgeTiles::kReach;
    for (int v = std::max(0, y - kReach); v <= std::min(kImageHeight - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(kImageWidth - 1, x + kReach); ++u)
            ASSERT_TRUE(tiles.marked(uint32_t(u), uint32_t(v)))
                << u << " " << v << " beside " << x << " " << y;
}

TEST(EdgeTiles, NoEdgeWithinReachIsMissed) {
    std::mt19937 random(1);
    const auto below = [&](int n) { return int(random() % uint32_t(n)); };
    EdgeTiles tiles;
    for (int round = 0; round < 200; ++round) {
        CleanImage image = even();
        const int steep_x = below(kImageWidth), steep_y = below(kImageHeight);
        image.cosine[at(steep_x, steep_y)] = 0.1f;
        // Pixels unlike all others: an edge lies between each and whatever is within its reach.
        std::array<std::array<int, 2>, 3> odd;
        for (auto& [x, y] : odd) {
            x = below(kImageWidth), y = below(kImageHeight);
            image.depth_m[at(x, y)] = below(2) ? 0.0f : 2.03f;
        }
        tiles.find(image, 0.02f, 0.2f);
        EXPECT_TRUE(tiles.marked(uint32_t(steep_x), uint32_t(steep_y)));
        for (const auto& [x, y] : odd) expect_marked_about(tiles, x, y);
    }
}

TEST(EdgeTiles, WhatIsEvenIsSpared) {
    EdgeTiles tiles;
    CleanImage image = even();
    image.depth_m[at(70, 50)] = 1.0f;
    tiles.find(image, 0.02f, 0.2f);
    int marked = 0;
    for (uint32_t y = 0; y < kImageHeight; y += EdgeTiles::kHeight)
        for (uint32_t x = 0; x < kImageWidth; x += EdgeTiles::kWidth) marked += tiles.marked(x, y);
    EXPECT_EQ(marked, 9) << "the tile of the edge and those around it";
    image = even();
    tiles.find(image, 0.02f, 0.2f);
    EXPECT_FALSE(tiles.marked(70, 50)) << "of the image before";
}

}  // namespace
}  // namespace vfit::virtual_person
