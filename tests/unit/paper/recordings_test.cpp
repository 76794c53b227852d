// Real people before a Kinect v1: the scan completes on every recording, and one person's stature is the same
// in all of theirs. The heights themselves are not known.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "paper/paper_scan.h"

namespace vfit {
namespace {

namespace fs = std::filesystem;

fs::path recordings() {
    const char* shared = std::getenv("VFIT_SHARED");
    return (shared ? fs::path(shared) : fs::path(VFIT_SOURCE_DIR) / ".." / "shared") / "data" / "recordings";
}

struct Recording {
    Camera camera;
    std::vector<std::vector<uint16_t>> depth;
    std::vector<std::vector<uint8_t>> users;
    std::vector<Body> bodies;
};

std::vector<uint16_t> read_png(const fs::path& path, uint32_t width, uint32_t height) {
    std::vector<uint16_t> pixels(size_t(width) * height);
    std::FILE* file = std::fopen(path.string().c_str(), "rb");
    EXPECT_TRUE(file) << path;
    if (!file) return pixels;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    EXPECT_EQ(png_get_image_width(png, info), width);
    EXPECT_EQ(png_get_bit_depth(png, info), 16);
    png_set_swap(png);  // PNG is big-endian
    for (uint32_t y = 0; y < height; ++y)
        png_read_row(png, reinterpret_cast<png_bytep>(&pixels[size_t(y) * width]), nullptr);
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return pixels;
}

Recording read(const fs::path& folder) {
    Recording r;
    r.camera.width = 320;  // camera.json of all of them
    r.camera.height = 240;
    r.camera.fx = r.camera.fy = 285.63f;
    r.camera.cx = 159.0f;
    r.camera.cy = 120.0f;
    std::ifstream in(folder / "joints.csv");
    std::string line, cell;
    std::getline(in, line);
    std::vector<std::string> columns;
    for (std::stringstream head(line); std::getline(head, cell, ',');) columns.push_back(cell);
    while (std::getline(in, line)) {
        Body body;
        body.id = 1;
        size_t column = 0;
        for (std::stringstream row(line); std::getline(row, cell, ','); ++column) {
            if (column == 0) {
                body.time_ns = std::stoll(cell) * 33'333'333;
                continue;
            }
            const std::string& name = columns[column];
            Joint& j = body.joints[size_t(joint_from_name(name.substr(0, name.size() - 2).c_str()))];
            j.state = VFIT_JOINT_MEASURED;
            j.position[name.back() - 'x'] = std::stof(cell);
        }
        char file[32];
        std::snprintf(file, sizeof(file), "%06zu.png", r.bodies.size());
        r.depth.push_back(read_png(folder / "depth" / file, 320, 240));
        r.users.emplace_back();
        for (const uint16_t d : r.depth.back()) r.users.back().push_back(d > 0);  // segmented
        r.bodies.push_back(body);
    }
    return r;
}

TEST(Recordings, GiveOnePersonOneStature) {
    if (!fs::exists(recordings())) GTEST_SKIP() << "no shared recordings at " << recordings();
    std::map<std::string, std::vector<float>> statures, shoulders;
    for (const fs::directory_entry& folder : fs::directory_iterator(recordings())) {
        const std::string name = folder.path().filename().string();
        SCOPED_TRACE(name);
        const Recording r = read(folder.path());
        PaperScan scan{ScanDesc{}};
        for (size_t i = 0; i < r.bodies.size() && !scan.complete(); ++i)
            scan.add({{r.depth[i].data(), r.users[i].data(), r.camera}, &r.bodies[i], 1});
        EXPECT_TRUE(scan.complete()) << scan.frames_taken() << " frames taken";
        const auto list = scan.measurements();
        const std::string person = name.substr(8, 2);
        statures[person].push_back(find(list, "stature_m")->value);
        shoulders[person].push_back(find(list, "shoulder_breadth_m")->value);
    }
    ASSERT_EQ(statures.size(), 4u);
    const auto range = [](const std::vector<float>& v) {
        const auto [low, high] = std::minmax_element(v.begin(), v.end());
        return *high - *low;
    };
    for (const auto& [person, values] : statures) {
        EXPECT_LT(range(values), 0.045f) << person << ": standing, walking, jogging and squatting";
        EXPECT_LT(range(shoulders[person]), 0.035f) << person;
    }
    // Four people of plainly different heights stay in order, whatever they do.
    const std::string order[] = {"s2", "s1", "s5", "s6"};
    for (int i = 0; i + 1 < 4; ++i)
        EXPECT_LT(*std::max_element(statures[order[i]].begin(), statures[order[i]].end()) + 0.03f,
                  *std::min_element(statures[order[i + 1]].begin(), statures[order[i + 1]].end()));
}

}  // namespace
}  // namespace vfit
