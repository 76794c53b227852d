#include "core/files.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#if defined(__linux__)
#include <sched.h>
#endif

#include "core/error.h"
#include "core/platform.h"

namespace vfit {
namespace {

TEST(Files, AMissingFileOrAFolderIsNamedInTheError) {
    try {
        read_file("/no/such/file");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_IO);
        EXPECT_NE(std::string(error.what()).find("/no/such/file"), std::string::npos);
    }
    EXPECT_THROW(read_file(std::filesystem::temp_directory_path().string()), Error);
}

TEST(Files, AFileThatIsTooLargeIsRefused) {
    const auto path = std::filesystem::temp_directory_path() / "vfit_files_test";
    std::ofstream(path) << "0123456789";
    EXPECT_EQ(read_file(path.string()).size(), 10u);
    EXPECT_THROW(read_file(path.string(), 9), Error);
    std::filesystem::remove(path);
}

TEST(Files, NamesOfDataCannotLeaveTheirFolder) {
    for (const char* name : {"", "../body", "a/b", "..", "c:\\x", ".hidden"})
        EXPECT_THROW(data_file("/data", "charts", name), Error) << name;
}

TEST(Platform, ALibraryThatIsNotThereIsAPluginError) {
    try {
        DynamicLibrary library("/no/such/library.so");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_PLUGIN);
    }
    EXPECT_GE(physical_cores(), 1u);
    EXPECT_TRUE(std::filesystem::is_directory(library_folder()));
}

#if defined(__linux__)
TEST(Platform, CoresOutOfReachAreNotCounted) {
    unsigned cores = 0;
    std::thread([&] {
        cpu_set_t allowed, one;
        CPU_ZERO(&one);
        ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
        for (unsigned i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
            if (CPU_ISSET(i, &allowed)) CPU_SET(i, &one);
        ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
        cores = physical_cores();
    }).join();
    EXPECT_EQ(cores, 1u);
}
#endif

}  // namespace
}  // namespace vfit
