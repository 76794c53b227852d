// Damaged files give an error or frames, never a crash. Run it with an address sanitizer, too.
#include <cmath>
#include <random>

#include "recording_support.h"

namespace vfit::test {
namespace {

using RecordingFuzz = RecordingTest;

std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](size_t n) { return n == 0 ? 0 : random() % n; };
    if (below(4) == 0) return bytes.substr(0, below(bytes.size()));
    for (size_t flips = 1 + below(4); flips > 0; --flips) bytes[below(bytes.size())] ^= char(1u << below(8));
    return bytes;
}

TEST_F(RecordingFuzz, DamagedFilesGiveAnErrorOrFrames) {
    constexpr int kRounds = 200;
    const char* const files[] = {"depth/000001.png", "mask/000001.png", "color/000000.png", "camera.json",
                                 "joints.csv",       "timestamps.csv",  "contacts.csv",     "measures.json"};
    const auto frame_with_all = [](uint32_t i) {
        auto frame = synthetic_frame(i);
        auto* users =
            static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, kWidth, kHeight));
        auto* color =
            static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_COLOR, VFIT_FORMAT_RGBA8, kWidth, kHeight));
        for (uint32_t p = 0; p < kWidth * kHeight; ++p) users[p] = p % 3 == 0;
        for (uint32_t p = 0; p < 4 * kWidth * kHeight; ++p) color[p] = static_cast<uint8_t>(p);
        return frame;
    };
    {
        Recorder recorder(folder_.string(), {});
        for (uint32_t i = 0; i < 3; ++i) recorder.write(*frame_with_all(i));
    }
    for (const char* file : files) {
        const std::string sound = read(file);
        ASSERT_FALSE(sound.empty()) << file;
        std::mt19937 random(7);
        int errors = 0;
        for (int round = 0; round < kRounds; ++round) {
            write(file, damaged(sound, random));
            const Replay replay = play();
            ASSERT_TRUE(replay.failed() || (replay.end == VFIT_END_OF_STREAM && replay.count == 3))
                << file << ", round " << round << ": " << replay.end << ", " << replay.count << " frames";
            if (replay.failed()) {
                EXPECT_TRUE(replay.says(folder_.filename().string()) || replay.says("frame "))
                    << replay.message;
            }
            errors += replay.failed();
            for (const Ref<Frame>& frame : replay.frames)
                for (const Body& body : frame->bodies)
                    for (const Joint& joint : body.joints)
                        ASSERT_TRUE(std::isfinite(joint.position.x + joint.position.y + joint.position.z));
        }
        EXPECT_GT(errors, 0) << file << ": no damage was seen in " << kRounds << " rounds";
        write(file, sound);
    }
    EXPECT_EQ(play().count, 3u) << "the sound files are sound";
}

}  // namespace
}  // namespace vfit::test
