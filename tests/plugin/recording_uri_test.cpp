// Options of a recording in its URI.
#include <random>

#include "recording_support.h"

namespace vfit::test {
namespace {

class RecordingUri : public RecordingTest {
protected:
    /// Indices of the frames that come, at most `most`; time stamps rise.
    std::vector<uint32_t> indices(const std::string& query, size_t most = SIZE_MAX) {
        query_ = query;
        std::vector<uint32_t> out;
        int64_t last_ns = 0;
        const Replay replay = play(
            {},
            [&](const Frame& frame) {
                out.push_back(uint32_t(std::stoul(*frame.meta("index"))));
                EXPECT_TRUE(depth_is_synthetic(frame, out.back()));
                EXPECT_GT(frame.time_ns, last_ns) << out.size();
                last_ns = frame.time_ns;
            },
            most);
        EXPECT_FALSE(replay.failed()) << replay.message;
        return out;
    }
    /// The same options, one after the other, by set_option.
    Error error_of_set_option(const std::string& key, const std::string& value) {
        query_.clear();
        const Ref<Sensor> sensor = open();
        try {
            sensor->set_option(key, value);
        } catch (const Error& error) {
            return error;
        }
        return Error(VFIT_OK, "");
    }
    Error error_of_open(const std::string& uri) {
        try {
            host_.open(uri);
        } catch (const Error& error) {
            return error;
        }
        return Error(VFIT_OK, "");
    }
};

using Indices = std::vector<uint32_t>;

TEST_F(RecordingUri, StartAndCountChooseFrames) {
    record(9);
    EXPECT_EQ(indices("?start=6"), (Indices{6, 7, 8}));
    EXPECT_EQ(indices("?start=3&count=4"), (Indices{3, 4, 5, 6}));
    EXPECT_EQ(indices("?count=2&loop=0&pace=none&mode=32x24@30"), (Indices{0, 1}));
    EXPECT_EQ(indices("?start=8&count=7"), (Indices{8})) << "as many as there are";
}

TEST_F(RecordingUri, ALoopPlaysTheChosenFramesAgainAndAgain) {
    record(6);
    EXPECT_EQ(indices("?loop=1&start=2&count=3", 11), (Indices{2, 3, 4, 2, 3, 4, 2, 3, 4, 2, 3}));
    EXPECT_EQ(indices("?loop=1&start=4", 5), (Indices{4, 5, 4, 5, 4}));
    EXPECT_EQ(indices("?loop=1&start=5", 4), (Indices{5, 5, 5, 5}));
    EXPECT_EQ(indices("?loop=0&start=4", 5), (Indices{4, 5}));
}

TEST_F(RecordingUri, APlainPathTakesOptions) {
    record(4);
    const Ref<Sensor> sensor = host_.open(folder_.string() + "?start=2&pace=realtime");
    std::string options;
    for (const vfit_sensor_option& option : sensor->options())
        options += std::string(option.key) + "=" + option.value + " ";
    EXPECT_EQ(options, "pace=realtime loop=0 start=2 count=0 mode=32x24@30 ");
    sensor->close();
}

TEST_F(RecordingUri, AFolderWithAQuestionMarkIsOpenedByItsPathOrEncoded) {
    record(3);
    const fs::path marked = folder_.parent_path() / (folder_.filename().string() + "?start=2");
    fs::remove_all(marked);
    fs::copy(folder_, marked, fs::copy_options::recursive);
    const auto start_of = [&](const std::string& uri) {
        const Ref<Sensor> sensor = host_.open(uri);
        std::string start;
        for (const vfit_sensor_option& option : sensor->options())
            if (std::string(option.key) == "start") start = option.value;
        sensor->close();
        return start;
    };
    EXPECT_EQ(start_of(marked.string()), "0") << "the folder, not the option";
    EXPECT_EQ(start_of(marked.string() + "?start=1"), "1");
    EXPECT_EQ(start_of("recording:" + folder_.string() + "%3Fstart=2?start=1"), "1");
    EXPECT_EQ(start_of("recording:" + folder_.string() + "?start=2"), "2");
    fs::remove_all(folder_);
    EXPECT_EQ(start_of("recording:" + folder_.string() + "%3Fstart%3d2"), "0");
    EXPECT_EQ(error_of_open("recording:" + folder_.string() + "?start=2").code(), VFIT_ERROR_IO);
    fs::remove_all(marked);
}

TEST_F(RecordingUri, AWrongValueFailsAsSetOptionDoesAndNamesKeyValueAndRange) {
    record(3);
    struct Wrong {
        const char *key, *value;
        vfit_result code;
        const char* allowed;
    };
    for (const Wrong& wrong : {Wrong{"start", "-1", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"start", "abc", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"start", "99999", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"start", "3", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"start", "", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"start", " 1", VFIT_ERROR_ARGUMENT, "0..2"},
                               {"count", "4294967296", VFIT_ERROR_ARGUMENT, "0..4294967295"},
                               {"loop", "true", VFIT_ERROR_ARGUMENT, "0..1"},
                               {"pace", "fast", VFIT_ERROR_ARGUMENT, "'realtime' nor 'none'"},
                               {"mode", "1x1@1", VFIT_ERROR_ARGUMENT, "32x24@30"}}) {
        const Error error =
            error_of_open("recording:" + folder_.string() + "?" + wrong.key + "=" + wrong.value);
        EXPECT_EQ(error.code(), wrong.code) << wrong.key << " " << wrong.value;
        const std::string says = error.what();
        for (const std::string& word :
             {std::string(wrong.key), "'" + std::string(wrong.value) + "'", std::string(wrong.allowed)})
            EXPECT_NE(says.find(word), std::string::npos) << says << " lacks " << word;
        EXPECT_EQ(says, error_of_set_option(wrong.key, wrong.value).what());
    }
    const Error unknown = error_of_open("recording:" + folder_.string() + "?volume=1");
    EXPECT_EQ(unknown.code(), VFIT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(unknown.what(), error_of_set_option("volume", "1").what());
    for (const char* word : {"'volume'", "mode", "pace", "loop", "start", "count"})
        EXPECT_NE(std::string(unknown.what()).find(word), std::string::npos) << unknown.what();
}

TEST_F(RecordingUri, RandomQueriesOpenOrAreRefused) {
    record(3);
    const std::vector<std::string> parts = {
        "start", "loop", "count", "pace", "mode", "=", "=",  "=",  "&",        "&",        "?",
        "0",     "1",    "2",     "-1",   "none", "%", "%3", "%0", "\xc3\xa9", "32x24@30", "999999999999"};
    std::mt19937 random(3);
    const auto any = [&] { return parts[random() % parts.size()]; };
    int opened = 0, refused = 0;
    for (int round = 0; round < 600; ++round) {
        query_ = "?";
        if (round % 2)  // nearly right
            for (size_t n = 1 + random() % 2; n > 0; --n)
                query_ += parts[random() % 5] + "=" + std::to_string(random() % 4) + (n > 1 ? "&" : "");
        else
            for (size_t n = random() % 8; n > 0; --n) query_ += any();
        const Replay replay = play({}, {}, 4);
        if (replay.failed()) {
            EXPECT_TRUE(replay.end == VFIT_ERROR_ARGUMENT || replay.end == VFIT_ERROR_UNSUPPORTED)
                << query_ << ": " << replay.message;
            EXPECT_TRUE(replay.says("option")) << query_ << ": " << replay.message;
            ++refused;
        } else {
            EXPECT_GT(replay.count, 0u) << query_;
            ++opened;
        }
    }
    EXPECT_GT(opened, 50);
    EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace vfit::test
