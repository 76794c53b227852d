// Size charts: what is read, and which sentence answers each broken rule.
#include "size/size_chart.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace vfit {
namespace {

const std::string kGood =
    R"({"format": "vfit-size-chart", "version": 1, "name": "test", "unit": "cm", "garments": [
  {"kind": "trousers", "measures": ["waist_girth_m", "hip_girth_m"], "sizes": [
    {"label": "S", "ranges": {"waist_girth_m": [74, 82], "hip_girth_m": [90, 98]}},
    {"label": "M", "ranges": {"waist_girth_m": [82, 90], "hip_girth_m": [99, 106.5]}}]}]})";

std::string with(const std::string& from, const std::string& to) {
    std::string chart = kGood;
    const size_t at = chart.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return chart.replace(at, from.size(), to);
}

void expect_refused(const std::string& json, std::initializer_list<const char*> words,
                    vfit_result code = VFIT_ERROR_DATA) {
    try {
        SizeChart::parse(json);
        FAIL() << "taken: " << json;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), code) << e.what();
        for (const char* word : words)
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

TEST(SizeChart, IsReadInMetres) {
    const SizeChart chart = SizeChart::parse(kGood);
    EXPECT_EQ(chart.name(), "test");
    const GarmentSizes& trousers = chart.garment("trousers");
    ASSERT_EQ(trousers.sizes.size(), 2u);
    EXPECT_EQ(trousers.sizes[1].label, "M");
    EXPECT_EQ(trousers.sizes[1].ranges[1].key, "hip_girth_m");
    EXPECT_FLOAT_EQ(trousers.sizes[1].ranges[1].low_m, 0.99f);
    EXPECT_FLOAT_EQ(trousers.sizes[1].ranges[1].high_m, 1.065f);
    const SizeChart inches = SizeChart::parse(with("\"cm\"", "\"in\""));
    EXPECT_FLOAT_EQ(inches.garments()[0].sizes[0].ranges[0].low_m, 74 * 0.0254f);
}

TEST(SizeChart, RefusesWhatIsNoChart) {
    expect_refused("", {"not JSON"});
    expect_refused("{\"format\":", {"not JSON"});
    expect_refused("\xff\xfe", {"not JSON"});
    expect_refused("[1]", {"not an object"});
    expect_refused(with("vfit-size-chart", "shoe-chart"), {"shoe-chart"});
    expect_refused(with("\"version\": 1", "\"version\": 2"), {"version 2"}, VFIT_ERROR_VERSION);
    expect_refused(with("\"version\": 1", "\"version\": \"1\""), {"version"});
    expect_refused(with("\"cm\"", "\"mm\""), {"unit", "mm"});
    expect_refused(with("\"name\": \"test\", ", ""), {"name"});
    expect_refused(with("[\n  {\"kind\"", "[7, {\"kind\""), {"garment", "not an object"});
    expect_refused(
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm", "garments": []})",
        {"garments", "empty"});
}

TEST(SizeChart, RefusesEndlessNestingAtOnce) {
    expect_refused(std::string(1u << 22, '['), {"nested"});
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    expect_refused(objects, {"nested"});
}

TEST(SizeChart, RefusesNamesThatNoReaderInCCanTell) {
    expect_refused(with("\"label\": \"M\"", "\"label\": \"S\\u0000M\""), {"label", "control"});
    expect_refused(with("\"kind\": \"trousers\"", "\"kind\": \"trousers\\n\""), {"kind", "control"});
}

TEST(SizeChart, NamesGarmentLabelAndMeasureOfABrokenRange) {
    const std::initializer_list<const char*> place = {"trousers", "label M", "hip_girth_m"};
    expect_refused(with("[99, 106.5]", "[106.5, 99]"), place);
    expect_refused(with("[99, 106.5]", "[99, 99]"), place);
    expect_refused(with("[99, 106.5]", "[97, 106.5]"),
                   {"trousers", "label M", "hip_girth_m", "overlaps", "label S"});
    expect_refused(with("[99, 106.5]", "[80, 86]"), {"trousers", "label M", "hip_girth_m", "ascending"});
    expect_refused(with("[99, 106.5]", "[-5, 106.5]"), place);
    expect_refused(with("[99, 106.5]", "[99, 10650]"), place);
    expect_refused(with("[99, 106.5]", "[99]"), place);
    expect_refused(with("[99, 106.5]", "[99, \"106\"]"), place);
    expect_refused(with("[99, 106.5]", "[99, 1e999]"), {"not JSON"});
    expect_refused(with("[99, 106.5]", "[99, null]"), place);
    expect_refused(with(", \"hip_girth_m\": [99, 106.5]", ""), place);
}

TEST(SizeChart, RefusesUnknownDoubleAndEmptyEntries) {
    expect_refused(with("\"measures\": [\"waist_girth_m\"", "\"measures\": [\"waist_m\""),
                   {"trousers", "waist_m"});
    expect_refused(with("[\"waist_girth_m\", \"hip", "[\"hip_girth_m\", \"hip"),
                   {"trousers", "hip_girth_m", "twice"});
    expect_refused(with("[\"waist_girth_m\", \"hip_girth_m\"]", "[]"), {"trousers", "measures", "empty"});
    expect_refused(with("[\"waist_girth_m\", \"hip_girth_m\"]", "[\"waist_girth_m\"]"),
                   {"label S", "hip_girth_m"});
    expect_refused(with("\"label\": \"M\"", "\"label\": \"S\""), {"trousers", "label S", "twice"});
    expect_refused(with("\"label\": \"M\"", "\"label\": \"\""), {"trousers", "label"});
    expect_refused(with("\"label\": \"M\"", "\"label\": \"a label of thirty-two bytes length\""), {"label"});
    const std::string garment =
        kGood.substr(kGood.find("{\"kind\""), kGood.rfind("]}") - kGood.find("{\"kind\""));
    expect_refused(with(garment, garment + ", " + garment), {"trousers", "twice"});
}

TEST(SizeChart, NamesTheKindsThatItHas) {
    const SizeChart chart = SizeChart::parse(kGood);
    try {
        chart.garment("dress");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
        EXPECT_NE(std::string(e.what()).find("trousers"), std::string::npos);
    }
}

TEST(SizeChart, ShipsChartsThatFollowTheRules) {
    int charts = 0;
    for (const auto& file : std::filesystem::directory_iterator(VFIT_SOURCE_DIR "/assets/charts")) {
        if (file.path().extension() != ".json") continue;
        SCOPED_TRACE(file.path());
        std::ifstream in(file.path());
        std::stringstream content;
        content << in.rdbuf();
        const SizeChart chart = SizeChart::parse(content.str());
        EXPECT_EQ(chart.name(), file.path().stem().string());
        EXPECT_FALSE(chart.source().empty()) << "says where its numbers come from";
        for (const char* kind : {"short_sleeves", "long_sleeves", "trousers"})
            EXPECT_NO_THROW(chart.garment(kind));
        ++charts;
    }
    EXPECT_GE(charts, 3);
}

}  // namespace
}  // namespace vfit
