// The picture that the skeleton network reads, of a person whose place is known.
#include "track/crop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vfit {
namespace {

constexpr int kPixels = CropView::kPixels;

/// A flat person of 0.6 by 1.6 m, 3 m away, in the middle of what the camera sees.
struct CropImage {
    CropImage() : depth(320 * 240, 4000), users(320 * 240, 0) {
        camera.width = 320;
        camera.height = 240;
        camera.fx = camera.fy = 300.0f;
        camera.cx = 159.5f;
        camera.cy = 119.5f;
        for (uint32_t y = 40; y < 200; ++y)
            for (uint32_t x = 130; x < 190; ++x) depth[y * 320 + x] = 3000, users[y * 320 + x] = 1;
    }
    DepthImage view() const { return {depth.data(), users.data(), camera}; }

    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    Camera camera;
};

struct Crop {
    Crop(const DepthImage& image, const Vec2& up, const PixelBox& box = {}) : values(kPixels * kPixels) {
        made = Cropper().run(image, 1, box, up, view, values.data());
    }
    float at(float x, float y) const {
        const auto pixel = [](float c) { return int(0.5f * (c + 1.0f) * float(kPixels)); };
        return values[size_t(pixel(y) * kPixels + pixel(x))];
    }
    bool made = false;
    CropView view;
    std::vector<float> values;
};

TEST(Crop, ShowsThePersonInTheMiddleAndNothingElse) {
    const CropImage image;
    const Crop crop(image.view(), {0, -1});
    ASSERT_TRUE(crop.made);
    EXPECT_NEAR(crop.view.depth_m, 3.0f, 0.01f);
    EXPECT_NEAR(crop.view.centre.x, 159.5f, 1.0f);
    EXPECT_NEAR(crop.view.centre.y, 119.5f, 1.0f);
    EXPECT_NEAR(crop.at(0.0f, 0.0f), 0.0f, 0.01f);
    EXPECT_NEAR(crop.at(0.0f, 0.65f), 0.0f, 0.01f);
    EXPECT_EQ(crop.at(0.65f, 0.0f), 1.0f) << "the wall";
}

TEST(Crop, OfATallPersonIsLookedForInAQuarterOfThePixels) {
    // 0.6 by 1.6 m at 2 m, larger than the rows that are looked at one by one.
    std::vector<uint16_t> depth(640 * 480, 4000);
    std::vector<uint8_t> users(640 * 480, 0);
    for (uint32_t y = 31; y < 450; ++y)
        for (uint32_t x = 251; x < 408; ++x) depth[y * 640 + x] = 2000, users[y * 640 + x] = 1;
    Camera camera;
    camera.width = 640, camera.height = 480;
    camera.fx = camera.fy = 525.0f;
    camera.cx = 319.5f, camera.cy = 239.5f;
    const Crop crop({depth.data(), users.data(), camera}, {0, -1}, {251, 31, 408, 450});
    ASSERT_TRUE(crop.made);
    EXPECT_NEAR(crop.view.depth_m, 2.0f, 0.01f);
    EXPECT_NEAR(crop.view.centre.x, 329.0f, 1.5f);
    EXPECT_NEAR(crop.view.centre.y, 240.0f, 1.5f);
    // 157 x 419 pixels of 3.8 mm are 33 x 89 of 18 mm.
    const auto seen = kPixels * kPixels - std::count(crop.values.begin(), crop.values.end(), 1.0f);
    EXPECT_NEAR(float(seen), 33.3f * 88.8f, 130.0f);
    EXPECT_EQ(crop.at(0.35f, 0.0f), 1.0f) << "the wall";
}

TEST(Crop, TurnsThePictureUpright) {
    const CropImage image;
    const Crop crop(image.view(), {1, 0});  // a camera on its side
    ASSERT_TRUE(crop.made);
    EXPECT_EQ(crop.at(0.0f, 0.65f), 1.0f);
    EXPECT_NEAR(crop.at(0.65f, 0.0f), 0.0f, 0.01f);
}

TEST(Crop, SeesAllOfThePersonHoweverTheCameraIsTurned) {
    const CropImage image;
    const auto seen = [&](const Vec2& up) {
        const Crop crop(image.view(), up, {130, 40, 190, 200});
        EXPECT_TRUE(crop.made);
        return kPixels * kPixels - std::count(crop.values.begin(), crop.values.end(), 1.0f);
    };
    // 60 x 160 pixels of 10 mm are 33 x 89 of 18 mm.
    for (int degrees = 0; degrees < 360; degrees += 15) {
        const float a = glm::radians(float(degrees));
        EXPECT_NEAR(double(seen({std::sin(a), -std::cos(a)})), 2971.0, 300.0) << degrees << " degrees";
    }
}

TEST(Crop, LeadsToCameraSpaceAndBack) {
    const CropImage image;
    for (const Vec2& up : {Vec2(0, -1), Vec2(0.6f, -0.8f)}) {
        const Crop crop(image.view(), up);
        const Vec3 place(-0.2f, 0.4f, 2.9f);
        const Vec3 there = crop.view.from_camera(image.camera, place);
        EXPECT_LT(glm::distance(crop.view.to_camera(image.camera, there), place), 1e-4f);
    }
}

TEST(Crop, LooksOnlyAtWhatOfTheBoxLiesInTheImage) {
    const CropImage image;
    const Crop beyond(image.view(), {0, -1}, {-50, -50, 1000, 1000});
    ASSERT_TRUE(beyond.made);
    EXPECT_EQ(beyond.values, Crop(image.view(), {0, -1}).values);
    EXPECT_FALSE(Crop(image.view(), {0, -1}, {400, 0, 500, 100}).made);
}

TEST(Crop, NeedsAPersonWithReadings) {
    CropImage image;
    DepthImage view = image.view();
    view.users = nullptr;
    EXPECT_FALSE(Crop(view, {0, -1}).made);
    EXPECT_FALSE(Crop(image.view(), {0, -1}, {130, 40, 137, 49}).made) << "63 pixels";
    std::fill(image.depth.begin(), image.depth.end(), uint16_t(0));
    EXPECT_FALSE(Crop(image.view(), {0, -1}).made);
}

}  // namespace
}  // namespace vfit
