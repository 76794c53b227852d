// How much of an outline a sensor loses is told by what is unsure beside it.
#include "scan/outline_loss.h"

#include <gtest/gtest.h>

#include <vector>

namespace vfit {
namespace {

constexpr uint32_t kWidth = 40, kHeight = 40;
constexpr uint16_t kPerson = 2500, kWall = 3500;

/// A square person before a wall.
struct Picture {
    std::vector<uint16_t> depth = std::vector<uint16_t>(kWidth * kHeight, kWall);
    std::vector<uint8_t> users = std::vector<uint8_t>(kWidth * kHeight, 0);

    explicit Picture(uint32_t lost, uint32_t low = 10, uint32_t high = 30) {
        for (uint32_t y = low - lost; y < high + lost; ++y)
            for (uint32_t x = low - lost; x < high + lost; ++x) {
                const bool sure = x >= low + lost && x < high - lost && y >= low + lost && y < high - lost;
                depth[y * kWidth + x] = sure ? kPerson : 0, users[y * kWidth + x] = sure;
            }
    }
    DepthImage image() const {
        Camera camera;
        camera.width = kWidth, camera.height = kHeight, camera.depth_unit_m = 0.001f;
        return {depth.data(), users.data(), camera};
    }
    float loss() const {
        OutlineLoss out;
        out.add(image(), 1);
        return out.pixels();
    }
};

TEST(OutlineLoss, IsHalfOfWhatIsUnsure) {
    EXPECT_EQ(Picture(0).loss(), 0.0f);
    EXPECT_EQ(Picture(1).loss(), 1.0f) << "a pixel of the person and one of the wall";
    EXPECT_EQ(Picture(2).loss(), 2.0f);
    EXPECT_EQ(OutlineLoss().pixels(), 0.0f);
}

TEST(OutlineLoss, AReadingInBetweenIsUnsureToo) {
    Picture picture(1);
    for (uint32_t y = 9; y < 31; ++y)
        for (uint32_t x = 9; x < 31; ++x) {
            const bool outer = x == 9 || x == 30 || y == 9 || y == 30;
            uint16_t& d = picture.depth[y * kWidth + x];
            if (d == 0) d = outer ? 3200 : 2700;
        }
    EXPECT_EQ(picture.loss(), 1.0f);
}

TEST(OutlineLoss, LeavesOutTheShadowOfAProjectorAndWhatStandsBeside) {
    Picture shadow(0);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 30; x < 38; ++x)
            if (!shadow.users[y * kWidth + x]) shadow.depth[y * kWidth + x] = 0;
    EXPECT_EQ(shadow.loss(), 0.0f);
    Picture another(1);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
            if (!another.users[y * kWidth + x]) another.users[y * kWidth + x] = 2;
    EXPECT_EQ(another.loss(), 0.0f) << "no background is seen";
}

}  // namespace
}  // namespace vfit
