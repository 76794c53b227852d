// Programs that are run to their end, and files that are whole or not there.
#include "client/child.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "client/client.h"
#include "client/files.h"

namespace vfit::tools {
namespace {

ChildResult shell(const std::string& script, double limit_s = 20.0) {
    return run_child({"/bin/sh", "-c", script}, limit_s);
}

TEST(Child, TellsWhatItPrintedAndHowItEnded) {
    const ChildResult done = shell("echo out; echo wrong >&2; cat; exit 3");
    EXPECT_EQ(done.end, ChildResult::End::exited);
    EXPECT_EQ(done.code, 3);
    EXPECT_EQ(done.out, "out\n");
    EXPECT_EQ(done.error, "wrong\n");
    EXPECT_EQ(shell("exit 0").code, 0);
}

TEST(Child, MuchOnBothOutputsStopsNeither) {
    const ChildResult done =
        shell("i=0; while [ $i -lt 20000 ]; do echo 0123456789; echo 0123456789 >&2; i=$((i+1)); done");
    EXPECT_EQ(done.out.size(), 220000u);
    EXPECT_EQ(done.error.size(), 220000u);
}

TEST(Child, ASignalIsACrash) {
    const ChildResult done = shell("kill -SEGV $$");
    EXPECT_EQ(done.end, ChildResult::End::crashed);
    EXPECT_EQ(done.code, 11);
}

TEST(Child, IsEndedAfterItsLimit) {
    const ChildResult done = shell("echo begun; exec sleep 60", 0.3);
    EXPECT_EQ(done.end, ChildResult::End::over_time);
    EXPECT_EQ(done.out, "begun\n");
    EXPECT_GE(done.seconds, 0.3);
    EXPECT_LT(done.seconds, 20.0);
}

TEST(Child, AProgramThatIsNotThereIsAFailure) { EXPECT_THROW(run_child({"/no/such/program"}, 1.0), Failure); }

TEST(Child, ManyAtOnceKeepTheirOutputsApart) {
    std::vector<std::thread> threads;
    std::vector<std::string> out(8);
    for (size_t i = 0; i < out.size(); ++i)
        threads.emplace_back([&, i] { out[i] = shell("echo " + std::to_string(i)).out; });
    for (std::thread& thread : threads) thread.join();
    for (size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], std::to_string(i) + "\n");
}

TEST(ReplaceText, LeavesTheOldTextOrTheNew) {
    const std::string folder = (std::filesystem::temp_directory_path() / "vfit_replace_text").string();
    create_folder(folder);
    const std::string path = folder + "/a.txt", link = folder + "/link.txt";
    replace_text(path, "old");
    std::filesystem::create_symlink(path, link);
    replace_text(link, "new");
    EXPECT_EQ(read_text(path), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_FALSE(std::filesystem::exists(path + ".part"));
    EXPECT_THROW(replace_text(folder + "/none/a.txt", "x"), Failure);
    EXPECT_NO_THROW(replace_text("/dev/null", "x"));
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace vfit::tools
