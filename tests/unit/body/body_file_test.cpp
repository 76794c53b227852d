// Body files that are missing, cut, damaged or of another version are refused with the cause.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <tuple>

#include "core/error.h"
#include "core/files.h"
#include "unit/body/body_fixture.h"

namespace vfit::test {
namespace {

class BodyFile : public testing::Test {
protected:
    BodyFile() : bytes_(read_file(kBodyPath)) {
        const std::string name = "vfit_body_file_" + std::to_string(std::random_device{}());
        path_ = (std::filesystem::temp_directory_path() / name).string();
    }
    ~BodyFile() override { std::filesystem::remove(path_); }

    /// Code and text of the error that the altered file gives; VFIT_OK where it loads.
    vfit_result load(std::string* message = nullptr) {
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
        try {
            BodyModel::load(path_);
            return VFIT_OK;
        } catch (const Error& error) {
            if (message) *message = error.what();
            return error.code();
        }
    }

    /// Makes the checksum right again, so that the checks behind it are reached.
    void seal() {
        uint32_t crc = ~0u;
        for (size_t i = 32; i < bytes_.size(); ++i) {
            crc ^= static_cast<uint8_t>(bytes_[i]);
            for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
        }
        crc = ~crc;
        std::memcpy(bytes_.data() + 24, &crc, 4);
    }

    /// Where the content of a section starts.
    size_t section(const char* name) const {
        uint32_t count;
        std::memcpy(&count, bytes_.data() + 12, 4);
        for (uint32_t i = 0; i < count; ++i) {
            const std::byte* entry = bytes_.data() + 32 + 24 * i;
            uint64_t offset;
            std::memcpy(&offset, entry + 8, 8);
            if (std::strncmp(reinterpret_cast<const char*>(entry), name, 8) == 0) return offset;
        }
        ADD_FAILURE() << "no section " << name;
        return 0;
    }

    std::vector<std::byte> bytes_;
    std::string path_;
};

TEST_F(BodyFile, ThatIsWholeLoads) { EXPECT_EQ(load(), VFIT_OK); }

TEST_F(BodyFile, ThatIsMissingIsAnIoError) {
    try {
        BodyModel::load("no/such/body.bin");
        FAIL() << "loaded a file that does not exist";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_IO);
        EXPECT_NE(std::string(error.what()).find("no/such/body.bin"), std::string::npos);
    }
}

TEST_F(BodyFile, ThatIsCutIsRefused) {
    for (size_t size : {size_t(0), size_t(31), size_t(32), bytes_.size() / 2, bytes_.size() - 1}) {
        bytes_.resize(size);
        EXPECT_EQ(load(), VFIT_ERROR_DATA) << size << " bytes";
        bytes_ = read_file(kBodyPath);
    }
}

TEST_F(BodyFile, WithAFlippedBitIsRefused) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 10; ++i) {
        const size_t at = 32 + random() % (bytes_.size() - 32);
        bytes_[at] ^= std::byte{1} << (random() % 8);
        std::string message;
        EXPECT_EQ(load(&message), VFIT_ERROR_DATA) << "byte " << at;
        EXPECT_NE(message.find("checksum"), std::string::npos) << message;
        bytes_ = read_file(kBodyPath);
    }
}

TEST_F(BodyFile, OfAnotherKindOrVersionIsRefused) {
    bytes_[0] = std::byte{'X'};
    EXPECT_EQ(load(), VFIT_ERROR_DATA);
    bytes_[0] = std::byte{'V'};
    bytes_[8] = std::byte{99};
    EXPECT_EQ(load(), VFIT_ERROR_VERSION);
}

TEST_F(BodyFile, WithSealedNonsenseIsRefused) {
    const std::pair<const char*, size_t> spots[] = {
        {"COUNTS", 0},   {"COUNTS", 16}, {"COUNTS", 28}, {"QUADS", 0}, {"QUADUVS", 8},
        {"SKINBONE", 0}, {"SKINWGT", 2}, {"TERMS", 0},   {"TERMS", 4}, {"OFFSETS", 0},
        {"SCALES", 0},   {"BASE", 0},    {"UVS", 4}};
    for (const auto& [name, offset] : spots) {
        std::memset(bytes_.data() + section(name) + offset, 0xFF, 4);
        seal();
        EXPECT_EQ(load(), VFIT_ERROR_DATA) << name << " + " << offset;
        bytes_ = read_file(kBodyPath);
    }
}

TEST_F(BodyFile, WithNumbersThatNoBodyHasIsRefused) {
    // Of PARAMS: the end of the first parameter's range, and its second anchor brought up to the first.
    const std::tuple<const char*, size_t, float> spots[] = {
        {"BASE", 0, 1e6f}, {"SCALES", 0, 1e30f}, {"PARAMS", 52, 1e30f}, {"PARAMS", 72, 1e-30f}};
    for (const auto& [name, offset, value] : spots) {
        std::memcpy(bytes_.data() + section(name) + offset, &value, 4);
        seal();
        EXPECT_EQ(load(), VFIT_ERROR_DATA) << name << " + " << offset;
        bytes_ = read_file(kBodyPath);
    }
}

TEST_F(BodyFile, WithSealedNoiseInItsTablesNeverCrashes) {
    std::mt19937_64 random(5);
    const size_t tables = section("BASE");
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 4; ++k) bytes_[32 + random() % (tables - 32)] = std::byte(random() & 0xFF);
        seal();
        const vfit_result result = load();
        EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_DATA) << result;
        bytes_ = read_file(kBodyPath);
    }
}

}  // namespace
}  // namespace vfit::test
