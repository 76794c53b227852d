// A writer that is killed leaves a recording that plays.
#if !defined(_WIN32)
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <random>

#include "recording_support.h"

namespace vfit::test {
namespace {

using RecordingCrash = RecordingTest;

TEST_F(RecordingCrash, AKilledWriterLeavesEveryCompleteFrame) {
    constexpr int kRounds = 12;
    std::mt19937 random(11);
    size_t most = 0;
    for (int round = 0; round < kRounds; ++round) {
        fs::remove_all(folder_);
        const pid_t writer = fork();
        ASSERT_GE(writer, 0);
        if (writer == 0) {
            Recorder recorder(folder_.string(), {});
            for (uint32_t i = 0;; ++i) recorder.write(*synthetic_frame(i));
        }
        // Not before there is something to lose; then at any moment.
        while (!fs::exists(folder_ / "depth/000003.png")) usleep(500);
        usleep(random() % 60'000);
        kill(writer, SIGKILL);
        ASSERT_EQ(waitpid(writer, nullptr, 0), writer);

        uint32_t number = 0;
        uint32_t without_body = 0;
        const Replay replay = play({}, [&](const Frame& frame) {
            EXPECT_TRUE(depth_is_synthetic(frame, number)) << number;
            if (frame.bodies.empty())
                ++without_body;
            else
                EXPECT_NEAR(frame.bodies[0].at(VFIT_JOINT_HEAD).x,
                            synthetic_frame(number)->bodies[0].at(VFIT_JOINT_HEAD).x, 1e-4f);
            ++number;
        });
        ASSERT_EQ(replay.end, VFIT_END_OF_STREAM) << replay.message;
        EXPECT_GE(replay.count, 4u);
        EXPECT_LE(without_body, 1u) << "only the last frame's rows may be missing";
        most = std::max(most, replay.count);
    }
    EXPECT_GT(most, 10u);
}

}  // namespace
}  // namespace vfit::test
#endif
