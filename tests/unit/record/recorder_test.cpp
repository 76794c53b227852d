// What the recorder puts on disk.
#include "record/recorder.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "frame/floor.h"

namespace vfit {
namespace {

namespace fs = std::filesystem;

class RecorderTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / ("vfit_recorder_" + std::string(test->name()));
        fs::remove_all(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path() const { return folder_.string(); }
    std::string text(const std::string& name) const {
        std::ifstream file(folder_ / name);
        std::stringstream out;
        out << file.rdbuf();
        return out.str();
    }
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(text(name)); }

    fs::path folder_;
};

Ref<Frame> frame_of(uint16_t seed, uint32_t width = 5, uint32_t height = 3) {
    auto frame = make<Frame>();
    auto* depth =
        static_cast<uint16_t*>(frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, width, height));
    for (uint32_t i = 0; i < width * height; ++i) depth[i] = static_cast<uint16_t>(seed * 257u + i * 4099u);
    frame->time_ns = 1000 + seed;
    frame->camera.width = width;
    frame->camera.height = height;
    frame->camera.fx = frame->camera.fy = 285.63f;
    frame->camera.cx = 2.0f;
    frame->camera.cy = 1.0f;
    return frame;
}

Body body_in_camera(uint32_t id) {
    Body body;
    body.id = id;
    body.set(VFIT_JOINT_HEAD, {0.1f, -0.5f, 2.9f}, VFIT_JOINT_MEASURED, 0.75f);
    body.set(VFIT_JOINT_LEFT_FOOT, {0.2f, 1.0f, 3.0f});
    return body;
}

std::vector<std::string> fields_of(const std::string& row) {
    std::vector<std::string> out;
    std::stringstream fields(row);
    for (std::string field; std::getline(fields, field, ',');) out.push_back(field);
    return out;
}

/// Pixels of a PNG file, in the machine's byte order.
struct Picture {
    uint32_t width = 0, height = 0;
    int bit_depth = 0, color_type = 0;
    std::vector<std::vector<uint8_t>> rows;

    explicit Picture(const fs::path& path) {
        FILE* file = std::fopen(path.string().c_str(), "rb");
        if (!file) return;
        png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        png_init_io(png, file);
        png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
        width = png_get_image_width(png, info);
        height = png_get_image_height(png, info);
        bit_depth = png_get_bit_depth(png, info);
        color_type = png_get_color_type(png, info);
        for (uint32_t y = 0; y < height; ++y) {
            const png_bytep row = png_get_rows(png, info)[y];
            rows.emplace_back(row, row + png_get_rowbytes(png, info));
        }
        png_destroy_read_struct(&png, &info, nullptr);
        std::fclose(file);
    }
};

vfit_result code_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.code();
    }
    return VFIT_OK;
}

TEST_F(RecorderTest, DepthIsGrey16AndBitExact) {
    Recorder recorder(path(), {});
    const auto frame = frame_of(200);
    recorder.write(*frame_of(1));
    recorder.write(*frame);
    const Picture picture(folder_ / "depth" / "000001.png");
    ASSERT_EQ(picture.width, 5u);
    ASSERT_EQ(picture.height, 3u);
    EXPECT_EQ(picture.bit_depth, 16);
    EXPECT_EQ(picture.color_type, PNG_COLOR_TYPE_GRAY);
    const auto* depth = frame->find(VFIT_STREAM_DEPTH)->as<uint16_t>();
    for (size_t y = 0; y < 3; ++y) EXPECT_EQ(std::memcmp(picture.rows[y].data(), depth + y * 5, 10), 0);
}

TEST_F(RecorderTest, CameraFileHasEveryFieldOfTheFormatAsShortDecimals) {
    Recorder recorder(path(), {"kinect \"one\"", 25.0f, true});
    const auto frame = frame_of(1);
    set_floor(frame->camera, 1.5f, 0.2f, 0.0f, VFIT_FLOOR_GIVEN);
    frame->camera.distortion[1] = 0.25f;
    recorder.write(*frame);
    const auto camera = json("camera.json");
    EXPECT_EQ(camera["format"], "vfit-recording");
    EXPECT_EQ(camera["version"], 1);
    EXPECT_EQ(camera["sensor"], "kinect \"one\"");
    EXPECT_EQ(camera["width"], 5);
    EXPECT_EQ(camera["height"], 3);
    EXPECT_EQ(camera["fx"], 285.63);
    EXPECT_EQ(camera["fps"], 25);
    EXPECT_EQ(camera["depth_unit_m"], 0.001);
    EXPECT_EQ(camera["segmented"], true);
    EXPECT_EQ(camera["distortion"].size(), 8u);
    EXPECT_NEAR(camera["camera_height_m"].get<double>(), 1.5, 1e-6);
    EXPECT_NEAR(camera["tilt_deg"].get<double>(), 0.2 * 180.0 / 3.14159265358979, 1e-4);
    EXPECT_NEAR(camera["floor"]["normal"][1].get<double>(), -std::cos(0.2), 1e-6);
    EXPECT_NEAR(camera["floor"]["distance_m"].get<double>(), 1.5, 1e-6);
}

TEST_F(RecorderTest, AnEstimatedFloorIsLeftToTheReader) {
    Recorder recorder(path(), {});
    const auto frame = frame_of(1);
    set_floor(frame->camera, 1.1f, 0.0f, 0.0f, VFIT_FLOOR_ESTIMATED);
    recorder.write(*frame);
    EXPECT_FALSE(json("camera.json").contains("floor"));
    EXPECT_FALSE(json("camera.json").contains("segmented"));
}

TEST_F(RecorderTest, JointsAreInCameraSpaceWithConfidenceAndId) {
    Recorder recorder(path(), {});
    const auto frame = frame_of(1);
    set_floor(frame->camera, 1.3f, 0.1f, 0.05f, VFIT_FLOOR_GIVEN);
    frame->bodies = {to_world(body_in_camera(3), frame->camera)};
    recorder.write(*frame);
    Body next_body = body_in_camera(3);
    next_body.joints[VFIT_JOINT_LEFT_FOOT].state = VFIT_JOINT_NOT_SEEN;
    next_body.set(VFIT_JOINT_RIGHT_TOES,
                  {-0.2f, 1.1f, 2.8f});  // of a joint that the first frame does not show
    const auto next = frame_of(2);
    next->bodies = {to_world(next_body, next->camera)};
    recorder.write(*next);
    std::stringstream rows(text("joints.csv"));
    std::string header, first, second;
    std::getline(rows, header);
    std::getline(rows, first);
    std::getline(rows, second);
    const auto columns = fields_of(header), one = fields_of(first), two = fields_of(second);
    ASSERT_EQ(columns.size(), 2u + 4u * VFIT_JOINT_COUNT);
    ASSERT_EQ(one.size(), columns.size());
    ASSERT_EQ(two.size(), columns.size());
    const auto number = [&](const std::vector<std::string>& row, const std::string& column) {
        const auto at = std::find(columns.begin(), columns.end(), column);
        EXPECT_NE(at, columns.end()) << column;
        return std::stof(row.at(static_cast<size_t>(at - columns.begin())));
    };
    EXPECT_EQ(number(one, "id"), 3.0f);
    EXPECT_NEAR(number(one, "HEAD_x"), 0.1f, 2e-6f);
    EXPECT_NEAR(number(one, "HEAD_y"), -0.5f, 2e-6f);
    EXPECT_NEAR(number(one, "HEAD_z"), 2.9f, 2e-6f);
    EXPECT_NEAR(number(one, "HEAD_c"), 0.75f, 2e-6f);
    EXPECT_NEAR(number(one, "LEFT_FOOT_y"), 1.0f, 2e-6f);
    EXPECT_EQ(number(one, "RIGHT_TOES_z"), 0.0f);
    EXPECT_EQ(number(two, "frame"), 1.0f);
    EXPECT_EQ(number(two, "LEFT_FOOT_z"), 0.0f) << "not seen";
    EXPECT_EQ(number(two, "LEFT_FOOT_c"), 0.0f);
    EXPECT_NEAR(number(two, "RIGHT_TOES_z"), 2.8f, 2e-6f);
}

TEST_F(RecorderTest, ASourceThatTellsItsBodiesHasATableAlsoWhereNobodyIs) {
    Recorder recorder(path(), {});
    recorder.write(*frame_of(1));
    EXPECT_FALSE(fs::exists(folder_ / "joints.csv"));
    const auto frame = frame_of(2);
    frame->set_meta("bodies", "true");
    recorder.write(*frame);
    recorder.write(*frame);
    EXPECT_EQ(text("joints.csv").find("frame,id,HEAD_x"), 0u);
    const std::string rows = text("joints.csv");
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1);
}

TEST_F(RecorderTest, APictureThatCannotBeWrittenLeavesNothingBehind) {
    Recorder recorder(path(), {});
    recorder.write(*frame_of(1));
    const fs::path taken = folder_ / "depth" / "000001.png";
    fs::create_directories(taken / "in the way");
    EXPECT_EQ(code_of([&] { recorder.write(*frame_of(2)); }), VFIT_ERROR_IO);
    EXPECT_FALSE(fs::exists(taken.string() + ".part"));
    fs::remove_all(taken);
    recorder.write(*frame_of(2));
    EXPECT_EQ(recorder.frame_count(), 2u);
}

TEST_F(RecorderTest, PersonOneIsWhiteInTheMaskAndOtherIdsStay) {
    Recorder recorder(path(), {});
    const auto frame = frame_of(1);
    auto* users = static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 5, 3));
    std::fill(users, users + 15, uint8_t(0));
    users[6] = 1;
    users[7] = 9;
    auto* color = static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_COLOR, VFIT_FORMAT_RGBA8, 5, 3));
    for (int i = 0; i < 60; ++i) color[i] = static_cast<uint8_t>(i * 4);
    recorder.write(*frame);
    const Picture mask(folder_ / "mask" / "000000.png");
    EXPECT_EQ(mask.bit_depth, 8);
    EXPECT_EQ(mask.rows.at(1), (std::vector<uint8_t>{0, 255, 9, 0, 0}));
    const Picture picture(folder_ / "color" / "000000.png");
    EXPECT_EQ(picture.color_type, PNG_COLOR_TYPE_RGB_ALPHA);
    EXPECT_EQ(std::memcmp(picture.rows.at(2).data(), color + 40, 20), 0);
}

TEST_F(RecorderTest, TimeStampsContactsAndMeasuresGoToTheirFiles) {
    Recorder recorder(path(), {});
    for (uint16_t i = 0; i < 2; ++i) {
        const auto frame = frame_of(i);
        const char* const contacts[] = {R"({"left": 1, "right": 2})", R"({"left": false, "right": true})"};
        frame->set_meta("contacts", contacts[i]);
        frame->set_meta("measures", R"({"stature_m": 1.8})");
        recorder.write(*frame);
    }
    EXPECT_EQ(text("timestamps.csv"), "frame,time_ns\n0,1000\n1,1001\n");
    EXPECT_EQ(text("contacts.csv"), "frame,left,right\n0,1,2\n1,0,1\n");
    EXPECT_EQ(json("measures.json")["stature_m"], 1.8);
}

TEST_F(RecorderTest, OnlyANewOrEmptyFolderIsTaken) {
    fs::create_directories(folder_);
    {
        Recorder in_empty(path(), {});
    }
    EXPECT_EQ(code_of([&] { Recorder again(path(), {}); }), VFIT_ERROR_ARGUMENT) << "it holds a folder now";
    const std::string file = path() + "/depth/file";
    std::ofstream(file) << "x";
    EXPECT_EQ(code_of([&] { Recorder on_a_file(file, {}); }), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code_of([&] { Recorder below_a_file(file + "/recording", {}); }), VFIT_ERROR_IO);
    EXPECT_EQ(code_of([&] { Recorder nowhere("", {}); }), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code_of([&] { Recorder rate(path() + "/r", {"s", NAN, false}); }), VFIT_ERROR_ARGUMENT);
}

TEST_F(RecorderTest, AFrameThatDoesNotFitIsRefusedAndTheRecordingGoesOn) {
    Recorder recorder(path(), {});
    recorder.write(*frame_of(1));
    EXPECT_EQ(code_of([&] { recorder.write(*frame_of(2, 6, 3)); }), VFIT_ERROR_DATA);
    EXPECT_EQ(code_of([&] { recorder.write(*make<Frame>()); }), VFIT_ERROR_DATA);
    const auto zoomed = frame_of(2);
    zoomed->camera.fx = 300.0f;
    EXPECT_EQ(code_of([&] { recorder.write(*zoomed); }), VFIT_ERROR_DATA);
    const auto masked = frame_of(2);
    masked->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 5, 3);
    EXPECT_EQ(code_of([&] { recorder.write(*masked); }), VFIT_ERROR_DATA);
    const auto lost = frame_of(2);
    lost->bodies = {body_in_camera(1)};
    lost->bodies[0].set(VFIT_JOINT_NECK, {NAN, 0, 0});
    EXPECT_EQ(code_of([&] { recorder.write(*lost); }), VFIT_ERROR_DATA);
    const auto odd = frame_of(2);
    odd->set_meta("contacts", "{\"left\": ");
    EXPECT_EQ(code_of([&] { recorder.write(*odd); }), VFIT_ERROR_DATA);
    recorder.write(*frame_of(2));
    EXPECT_EQ(recorder.frame_count(), 2u);
    EXPECT_EQ(text("timestamps.csv"), "frame,time_ns\n0,1001\n1,1002\n");
    recorder.close();
    EXPECT_EQ(code_of([&] { recorder.write(*frame_of(3)); }), VFIT_ERROR_STATE);
}

}  // namespace
}  // namespace vfit
