// Real depth pictures of the shared folder: the people in them are found, and the floor where it was
// measured.
#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "track/people_map.h"

namespace vfit {
namespace {

namespace fs = std::filesystem;

fs::path shared() {
    const char* given = std::getenv("VFIT_SHARED");
    return (given ? fs::path(given) : fs::path(VFIT_SOURCE_DIR) / ".." / "shared") / "data";
}

/// 16-bit grey; empty where there is no such file.
std::vector<uint16_t> read_png(const fs::path& path) {
    std::vector<uint16_t> pixels;
    std::FILE* file = std::fopen(path.string().c_str(), "rb");
    if (!file) return pixels;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    const size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    png_set_swap(png);  // PNG is big-endian
    pixels.resize(width * height);
    for (size_t y = 0; y < height; ++y)
        png_read_row(png, reinterpret_cast<png_bytep>(&pixels[y * width]), nullptr);
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return pixels;
}

Camera camera(uint32_t width, uint32_t height, float focal_px, float cx, float cy) {
    Camera c;
    c.width = width;
    c.height = height;
    c.fx = c.fy = focal_px;
    c.cx = cx;
    c.cy = cy;
    return c;
}

struct Look {
    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    PeopleMap map;
    std::span<const PersonRegion> people;

    Look(const fs::path& path, const Camera& camera) : depth(read_png(path)), users(depth.size()) {
        if (!depth.empty()) people = map.run({depth.data(), nullptr, camera}, 1, users.data());
    }
};

TEST(RealPictures, FivePeopleInARoomAndItsFloor) {
    Look look(shared() / "scenes/five_people_depth_mm.png", camera(640, 480, 525.0f, 319.5f, 239.5f));
    if (look.depth.empty()) GTEST_SKIP() << "no pictures in " << shared();
    EXPECT_EQ(look.people.size(), 5u);
    const Vec3 normal = glm::normalize(Vec3(0.01036f, -0.99701f, -0.07656f));  // published with the picture
    EXPECT_GT(glm::dot(look.map.camera().floor_normal, normal), std::cos(1.0f * kPi / 180.0f));
    EXPECT_NEAR(look.map.camera().floor_distance_m, 1.26614f, 0.03f);
}

TEST(RealPictures, OnePersonTooCloseToShowTheFeet) {
    Look look(shared() / "scenes/person_depth_mm.png", camera(640, 480, 525.0f, 319.5f, 239.5f));
    if (look.depth.empty()) GTEST_SKIP() << "no pictures in " << shared();
    ASSERT_EQ(look.people.size(), 1u);
    EXPECT_TRUE(look.people[0].out_of_view & kOutOfViewFeet);
    EXPECT_EQ(look.map.camera().floor_state, VFIT_FLOOR_DEFAULT);
}

TEST(RealPictures, SegmentedPeopleAreFoundWhole) {
    size_t pictures = 0;
    std::error_code none;
    for (const auto& recording : fs::directory_iterator(shared() / "recordings", none)) {
        Look look(recording.path() / "depth/000010.png", camera(320, 240, 285.63f, 159.0f, 120.0f));
        if (look.depth.empty()) continue;
        ++pictures;
        EXPECT_EQ(look.people.size(), 1u) << recording.path();
        size_t readings = 0, found = 0;
        for (size_t i = 0; i < look.depth.size(); ++i) {
            readings += look.depth[i] != 0;
            found += look.depth[i] != 0 && look.users[i] != 0;
        }
        EXPECT_GT(double(found), 0.97 * double(readings)) << recording.path();
    }
    if (pictures == 0) GTEST_SKIP() << "no recordings in " << shared();
}

}  // namespace
}  // namespace vfit
