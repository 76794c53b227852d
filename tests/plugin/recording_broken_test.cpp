// Broken recordings are refused with a sentence that names the file.
#include "record/png_writer.h"
#include "recording_support.h"

namespace vfit::test {
namespace {

using RecordingBroken = RecordingTest;

TEST_F(RecordingBroken, MissingFoldersAndFiles) {
    Replay replay = play();
    EXPECT_EQ(replay.end, VFIT_ERROR_IO);
    EXPECT_TRUE(replay.says("no such folder")) << replay.message;
    fs::create_directories(folder_);
    EXPECT_TRUE(play().says("camera.json is missing"));
    record(2);
    fs::remove_all(folder_ / "depth");
    EXPECT_TRUE(play().says("depth: holds no depth images"));
    record(2);
    fs::remove(folder_ / "depth/000001.png");
    fs::remove(folder_ / "depth/000000.png");
    EXPECT_TRUE(play().says("depth: holds no depth images"));
}

TEST_F(RecordingBroken, ASkippedNumberIsNamed) {
    record(4);
    fs::remove(folder_ / "depth/000002.png");
    Replay replay = play();
    EXPECT_EQ(replay.end, VFIT_ERROR_DATA);
    EXPECT_TRUE(replay.says("depth/000002.png: is missing")) << replay.message;
    record(3);
    write("mask/000000.png", "x");
    EXPECT_TRUE(play().says("mask/000001.png: is missing"));
}

TEST_F(RecordingBroken, EachFieldOfTheCameraFileIsCheckedByName) {
    const auto broken = [&](const std::string& from, const std::string& to) {
        record(1);
        edit("camera.json", from, to);
        const Replay replay = play();
        EXPECT_TRUE(replay.end == VFIT_ERROR_DATA || replay.end == VFIT_ERROR_VERSION)
            << from << " -> " << to;
        EXPECT_TRUE(replay.says("camera.json")) << replay.message;
        return replay;
    };
    for (const char* field :
         {"format", "version", "width", "height", "fx", "fy", "cx", "cy", "fps", "depth_unit_m"}) {
        const Replay missing = broken("\"" + std::string(field) + "\"", "\"absent\"");
        EXPECT_TRUE(missing.says("\"" + std::string(field) + "\" is missing")) << missing.message;
    }
    EXPECT_TRUE(broken("vfit-recording", "avi").says("\"format\""));
    EXPECT_EQ(broken("\"version\": 1", "\"version\": 2").end, VFIT_ERROR_VERSION);
    EXPECT_TRUE(broken("\"width\": 32", "\"width\": 32.5").says("\"width\""));
    EXPECT_TRUE(broken("\"width\": 32", "\"width\": 0").says("\"width\""));
    EXPECT_TRUE(broken("\"width\": 32", "\"width\": 20000").says("\"width\""));
    EXPECT_TRUE(broken("\"width\": 32", "\"width\": \"32\"").says("\"width\""));
    EXPECT_TRUE(broken("\"fx\": 28.5", "\"fx\": -1").says("\"fx\""));
    EXPECT_TRUE(broken("\"fx\": 28.5", "\"fx\": NaN").says("no valid JSON"));
    EXPECT_TRUE(broken("\"fx\": 28.5", "\"fx\": 1e999").says("camera.json"));
    EXPECT_TRUE(broken("\"fps\": 30", "\"fps\": 0").says("\"fps\""));
    EXPECT_TRUE(broken("\"fps\": 30", "\"fps\": 1e-300").says("\"fps\"")) << "its period is no number";
    EXPECT_TRUE(broken("\"distance_m\": 1.2", "\"distance_m\": -1.2").says("\"floor.distance_m\""));
    EXPECT_TRUE(broken("\"normal\"", "\"other\"").says("\"floor.normal\" is missing"));
    EXPECT_TRUE(broken("{", "[").says("no valid JSON"));
    record(1);
    write("camera.json", read("camera.json").substr(0, 60));
    EXPECT_TRUE(play().says("no valid JSON"));
    write("camera.json", "");
    EXPECT_TRUE(play().says("camera.json"));
    write("camera.json", std::string(2'000'000, ' '));
    EXPECT_TRUE(play().says("is longer than"));
}

TEST_F(RecordingBroken, TablesAreCheckedOnOpening) {
    const auto broken = [&](const char* file, const std::string& text) {
        record(3);
        write(file, text);
        const Replay replay = play();
        EXPECT_EQ(replay.end, VFIT_ERROR_DATA) << text;
        EXPECT_EQ(replay.count, 0u);
        EXPECT_TRUE(replay.says(file)) << replay.message;
        return replay;
    };
    EXPECT_TRUE(broken("joints.csv", "frame,NOSE_x,NOSE_y,NOSE_z\n").says("NOSE_x"));
    EXPECT_TRUE(broken("joints.csv", "frame,HEAD_x,HEAD_y\n").says("HEAD lacks"));
    EXPECT_TRUE(broken("joints.csv", "frame,HEAD_x,HEAD_x,HEAD_z\n").says("twice"));
    EXPECT_TRUE(broken("joints.csv", "frame,HEAD_q\n").says("HEAD_q"));
    EXPECT_TRUE(broken("joints.csv", "time,HEAD_x\n").says("not 'frame'"));
    EXPECT_TRUE(broken("joints.csv", "frame\n").says("names no joint"));
    broken("joints.csv", "");
    const std::string head = "frame,id,HEAD_x,HEAD_y,HEAD_z,HEAD_c\n";
    EXPECT_TRUE(broken("joints.csv", head + "0,1,nan,0,2,1\n").says("line 2: column HEAD_x"));
    EXPECT_TRUE(broken("joints.csv", head + "0,1,0,inf,2,1\n").says("HEAD_y"));
    EXPECT_TRUE(broken("joints.csv", head + "0,1,0,1e300,2,1\n").says("HEAD_y"));
    EXPECT_TRUE(broken("joints.csv", head + "0,1,0,0,2,1.5\n").says("confidence"));
    EXPECT_TRUE(broken("joints.csv", head + "0,1,0,0,2,1\n0,1,0,0,2,1\n").says("line 3"));
    EXPECT_TRUE(broken("joints.csv", head + "1,1,0,0,2,1\n0,1,0,0,2,1\n").says("must rise"));
    EXPECT_TRUE(broken("joints.csv", head + "0,0,0,0,2,1\n").says("column id"));
    EXPECT_TRUE(broken("joints.csv", head + "0,999,0,0,2,1\n").says("999"));
    EXPECT_TRUE(broken("joints.csv", head + "0,1,0,0\n1,1,0,0,2,1\n").says("4 fields"));
    EXPECT_TRUE(broken("joints.csv", head + "-1,1,0,0,2,1\n").says("column frame"));
    EXPECT_TRUE(broken("joints.csv", head + std::string(40000, '1') + "\n").says("longer than"));
    EXPECT_TRUE(broken("timestamps.csv", "frame,time\n").says("header"));
    EXPECT_TRUE(broken("timestamps.csv", "frame,time_ns\n0,5\n1,4\n").says("comes after"));
    EXPECT_TRUE(broken("timestamps.csv", "frame,time_ns\n0,5.5\n").says("whole number"));
    EXPECT_TRUE(broken("timestamps.csv", "frame,time_ns\n0,9223372036854775807\n").says("out of range"));
    EXPECT_TRUE(broken("contacts.csv", "frame,left,right\n0,1,3\n").says("0, 1 or 2"));
    EXPECT_TRUE(broken("contacts.csv", "frame,left,right\n0,1,1\n0,1,1\n").says("must rise"));
    EXPECT_TRUE(broken("measures.json", "{\"stature_m\": \"tall\"}").says("stature_m"));
    EXPECT_TRUE(broken("measures.json", "{\"stature_m\": ").says("no valid JSON"));
}

TEST_F(RecordingBroken, ABrokenPictureEndsTheStreamAfterTheFramesBeforeIt) {
    const auto broken = [&](const char* file) {
        const Replay replay = play();
        EXPECT_EQ(replay.end, VFIT_ERROR_DATA) << file;
        EXPECT_EQ(replay.count, 2u) << file;
        EXPECT_TRUE(replay.says(file)) << replay.message;
        return replay.message;
    };
    record(4);
    const std::string sound = read("depth/000002.png");
    write("depth/000002.png", sound.substr(0, sound.size() / 2));
    broken("depth/000002.png");
    write("depth/000002.png", "");
    broken("depth/000002.png");
    write("depth/000002.png", "no picture at all");
    broken("depth/000002.png");
    PngWriter png;
    const std::vector<uint16_t> pixels(64 * 64);
    png.write_grey8((folder_ / "depth/000002.png").string(), pixels.data(), kWidth, kHeight, kWidth);
    EXPECT_NE(broken("depth/000002.png").find("16-bit grey"), std::string::npos);
    png.write_grey16((folder_ / "depth/000002.png").string(), pixels.data(), 16, kHeight, 32);
    EXPECT_NE(broken("depth/000002.png").find("has 16 x 24 pixels"), std::string::npos);
    png.write_grey16((folder_ / "depth/000002.png").string(), pixels.data(), 48, kHeight, 96);
    EXPECT_NE(broken("depth/000002.png").find("has 48 x 24 pixels"), std::string::npos);
}

TEST_F(RecordingBroken, AMaskOfAnotherSizeEndsTheStream) {
    record(2);
    fs::create_directories(folder_ / "mask");
    PngWriter png;
    const std::vector<uint8_t> pixels(64 * 64);
    png.write_grey8((folder_ / "mask/000000.png").string(), pixels.data(), kWidth, kHeight, kWidth);
    png.write_grey8((folder_ / "mask/000001.png").string(), pixels.data(), 8, kHeight, kWidth);
    const Replay replay = play();
    EXPECT_EQ(replay.end, VFIT_ERROR_DATA);
    EXPECT_EQ(replay.count, 1u);
    EXPECT_TRUE(replay.says("mask/000001.png")) << replay.message;
}

}  // namespace
}  // namespace vfit::test
