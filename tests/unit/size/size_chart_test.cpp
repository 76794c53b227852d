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
    EXPECT_FLOAT_EQ(trousers.sizes[1].ranges[1].low, 0.99f);
    EXPECT_FLOAT_EQ(trousers.sizes[1].ranges[1].high, 1.065f);
    const SizeChart inches = SizeChart::parse(with("\"cm\"", "\"in\""));
    EXPECT_FLOAT_EQ(inches.garments()[0].sizes[0].ranges[0].low, 74 * 0.0254f);
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

std::string chart_of(const std::string& garment) {
    return R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm", "garments": [{"kind": "g", )" +
           garment + "}]}";
}

TEST(SizeChart, NamesWhatIsWrongWithAxes) {
    const std::string good =
        R"("axes": [{"measure": "waist_girth_m", "sizes": [{"label": "a", "range": [70, 80]},
        {"label": "b", "range": [80, 90]}]}, {"measure": "inside_leg_m", "sizes": [{"label": "c", "range": [70, 80]}]}])";
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return chart_of(text.replace(at, from.size(), to));
    };
    EXPECT_EQ(SizeChart::parse(chart_of(good)).garment("g").labels, (std::vector<std::string>{"ac", "bc"}));
    expect_refused(with("waist_girth_m", "waist_m"), {"garment g", "waist_m"});
    expect_refused(with("inside_leg_m", "waist_girth_m"), {"garment g", "waist_girth_m", "twice"});
    expect_refused(with("[80, 90]", "[60, 70]"), {"garment g", "waist_girth_m", "label b", "ascending"});
    expect_refused(with("\"b\"", "\"a\""), {"label a", "twice"});
    expect_refused(with("[80, 90]", "7"), {"range", "label b"});
    expect_refused(with("\"c\"", "\"a label of thirty-one bytes, alone\""), {"label"});
    expect_refused(chart_of(good + R"(, "sizes": [])"), {"more than one of"});
    expect_refused(chart_of(R"("axes": [])"), {"axes", "empty"});
    std::string many = R"("axes": [)";
    for (const char* key : {"waist_girth_m", "inside_leg_m", "hip_girth_m", "chest_girth_m"}) {
        many += std::string(many.back() == '[' ? "" : ",") + R"({"measure": ")" + key + R"(", "sizes": [)";
        for (int i = 0; i < 9; ++i)
            many += (i ? "," : "") + std::string(R"({"label": ")") + char('a' + i) + R"(", "range": [)" +
                    std::to_string(50 + i) + "," + std::to_string(51 + i) + "]}";
        many += "]}";
    }
    expect_refused(chart_of(many + "]"), {"garment g", "4096"});
}

TEST(SizeChart, NamesWhatIsWrongWithATable) {
    const std::string good = R"("table": {"rows": {"measure": "body_mass_kg", "values": [60, 80]},
        "columns": {"measure": "stature_m", "values": [160, 180]}, "labels": [["S", "S"], ["L", "M"]]})";
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return chart_of(text.replace(at, from.size(), to));
    };
    const SizeChart chart = SizeChart::parse(chart_of(good));
    EXPECT_EQ(chart.garment("g").labels, (std::vector<std::string>{"S", "L", "M"}));
    EXPECT_FLOAT_EQ(chart.garment("g").sizes[3].ranges[0].low, 70.0f) << "halfway to the next";
    EXPECT_FLOAT_EQ(chart.garment("g").sizes[3].ranges[1].high, 1.9f);
    expect_refused(with("body_mass_kg", "weight"), {"garment g", "weight"});
    expect_refused(with("[60, 80]", "[80, 60]"), {"rows", "ascend"});
    expect_refused(with("[60, 80]", "[60]"), {"rows", "fewer than two"});
    expect_refused(with("[60, 80]", "[60, \"80\"]"), {"rows", "not a number"});
    expect_refused(with("[60, 80]", "[60, 8000]"), {"body_mass_kg", "kg"});
    expect_refused(with(", [\"L\", \"M\"]", ""), {"labels", "1 rows"});
    expect_refused(with("[\"L\", \"M\"]", "[\"L\"]"), {"row 2", "labels"});
    expect_refused(with("\"M\"", "5"), {"row 2", "label"});
    expect_refused(chart_of(good + R"(, "weights": {"hip_girth_m": 1})"), {"weights", "hip_girth_m"});
    expect_refused(chart_of(good + R"(, "weights": {"stature_m": 0})"), {"weight", "stature_m"});
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
        const std::string name = file.path().stem().string();
        if (name == "paper" || name.rfind("en13402", 0) == 0) {
            for (const char* kind : {"short_sleeves", "long_sleeves", "trousers"})
                EXPECT_NO_THROW(chart.garment(kind));
        }
        ++charts;
    }
    EXPECT_GE(charts, 9);
}

}  // namespace
}  // namespace vfit
