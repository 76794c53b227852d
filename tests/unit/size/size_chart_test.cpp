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
    expect_refused(with("[99, 106.5]", "[80, 86]"),
                   {"trousers", "label M", "hip_girth_m", "ascending", "label S"});
    expect_refused(with("[99, 106.5]", "[90, 98]"),
                   {"trousers", "label M", "hip_girth_m", "ascending", "label S"});
    expect_refused(with("[99, 106.5]", "[89, 106.5]"),
                   {"trousers", "label M", "hip_girth_m", "ascending", "label S"});
    expect_refused(with("[99, 106.5]", "97"), {"trousers", "label M", "hip_girth_m", "ascending", "label S"});
    expect_refused(with("[99, 106.5]", "98"),
                   {"trousers", "label M", "hip_girth_m", "single value", "no room"});
    expect_refused(with("[99, 106.5]", "[-5, 106.5]"), place);
    expect_refused(with("[99, 106.5]", "[99, 10650]"), place);
    expect_refused(with("[99, 106.5]", "10650"), place);
    expect_refused(with("[99, 106.5]", "[99]"), place);
    expect_refused(with("[99, 106.5]", "[99, 106, 107]"), place);
    expect_refused(with("[99, 106.5]", "[99, \"106\"]"), place);
    expect_refused(with("[99, 106.5]", "\"99-106\""), place);
    expect_refused(with("[99, 106.5]", "null"), place);
    expect_refused(with("[99, 106.5]", "[99, 1e999]"), {"not JSON"});
    expect_refused(with("[99, 106.5]", "[null, null]"), place);
    expect_refused(with("[99, 106.5]", "[null, 106.5]"),
                   {"trousers", "label M", "hip_girth_m", "open", "first label"});
    expect_refused(with("[90, 98]", "[90, null]"),
                   {"trousers", "label S", "hip_girth_m", "open", "last label"});
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
    return R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm",
        "garments": [{"kind": "g", )" +
           garment + "}]}";
}

std::string labels_of(const std::string& sizes) {
    return chart_of(R"("measures": ["waist_girth_m"], "sizes": )" + sizes);
}

TEST(SizeChart, ReadsSingleValuesAsTheMiddlesOfSizes) {
    const auto ranges = [](const std::string& s, const std::string& m, const std::string& l) {
        std::vector<MeasureRange> out;
        const SizeChart chart =
            SizeChart::parse(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": )" + s +
                                       R"(}}, {"label": "M", "ranges": {"waist_girth_m": )" + m +
                                       R"(}}, {"label": "L", "ranges": {"waist_girth_m": )" + l + "}}]"));
        for (const SizeRow& row : chart.garments()[0].sizes) out.push_back(row.ranges[0]);
        return out;
    };
    for (const auto& values : {ranges("70", "80", "86"), ranges("[70, 70]", "[80, 80]", "[86, 86]")}) {
        EXPECT_FLOAT_EQ(values[0].low, 0.65f) << "outwards as far as inwards";
        EXPECT_FLOAT_EQ(values[0].high, 0.75f) << "halfway to the next";
        EXPECT_FLOAT_EQ(values[1].low, 0.75f);
        EXPECT_FLOAT_EQ(values[1].high, 0.83f);
        EXPECT_FLOAT_EQ(values[2].low, 0.83f);
        EXPECT_FLOAT_EQ(values[2].high, 0.89f);
    }
    const auto between = ranges("[70, 76]", "80", "[86, 90]");
    EXPECT_FLOAT_EQ(between[0].high, 0.76f) << "a range stays as it is printed";
    EXPECT_FLOAT_EQ(between[1].low, 0.78f) << "halfway to the neighbour's end";
    EXPECT_FLOAT_EQ(between[1].high, 0.83f);
    EXPECT_FLOAT_EQ(ranges("3", "10", "86")[0].low, 0.0f) << "no length is below 0";
}

TEST(SizeChart, ReadsRangesThatOverlapOrAreOpen) {
    const auto waists = [](const std::string& json) {
        std::vector<MeasureRange> out;
        const SizeChart chart = SizeChart::parse(json);
        for (const SizeRow& row : chart.garments()[0].sizes) out.push_back(row.ranges[0]);
        return out;
    };
    const auto overlapping = waists(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": [70, 80]}},
        {"label": "M", "ranges": {"waist_girth_m": [70, 84]}},
          {"label": "L", "ranges": {"waist_girth_m": [82, 84]}}])"));
    EXPECT_FLOAT_EQ(overlapping[0].high, 0.80f);
    EXPECT_FLOAT_EQ(overlapping[1].low, 0.70f);
    const auto open = waists(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": [null, 70]}},
        {"label": "M", "ranges": {"waist_girth_m": [70, 78]}},
          {"label": "L", "ranges": {"waist_girth_m": [78, null]}}])"));
    EXPECT_TRUE(open[0].open_low && open[2].open_high && !open[0].open_high && !open[2].open_low);
    EXPECT_FLOAT_EQ(open[0].low, 0.62f) << "as wide as its neighbour";
    EXPECT_FLOAT_EQ(open[2].high, 0.86f);
    EXPECT_EQ(open[2].missed(2.0), 0.0);
    EXPECT_NEAR(open[2].missed(0.77), 0.01, 1e-6);
    EXPECT_EQ(open[2].ease(2.0), 0.0) << "the open side has no middle";
    EXPECT_NEAR(open[2].ease(0.80), 0.02, 1e-6);
    EXPECT_NO_THROW(waists(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": [null, 80]}},
        {"label": "L", "ranges": {"waist_girth_m": [80, null]}}])")));
    expect_refused(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": [null, 81]}},
        {"label": "L", "ranges": {"waist_girth_m": [80, null]}}])"),
                   {"label L", "waist_girth_m", "ascending"});
    expect_refused(labels_of(R"([{"label": "S", "ranges": {"waist_girth_m": [70, 80]}},
        {"label": "L", "ranges": {"waist_girth_m": [70, null]}}])"),
                   {"label L", "waist_girth_m", "ascending"});
}

TEST(SizeChart, ReadsOneSize) {
    const SizeChart cap = SizeChart::parse(chart_of(R"("sizes": [{"label": "one size"}])"));
    EXPECT_EQ(cap.garments()[0].labels, std::vector<std::string>{"one size"});
    EXPECT_TRUE(cap.garments()[0].measures.empty());
    EXPECT_NO_THROW(SizeChart::parse(labels_of(R"([{"label": "one size"}])")));
    EXPECT_NO_THROW(SizeChart::parse(labels_of(R"([{"label": "one size", "ranges": {}}])")));
    EXPECT_NO_THROW(
        SizeChart::parse(labels_of(R"([{"label": "one size", "ranges": {"waist_girth_m": [60, null]}}])")));
    expect_refused(labels_of(R"([{"label": "one size", "ranges": {"waist_girth_m": 60}}])"),
                   {"garment g", "label one size", "waist_girth_m", "single value"});
    expect_refused(labels_of(R"([{"label": "one size", "ranges": {"waist_girth_m": [null, null]}}])"),
                   {"garment g", "label one size", "waist_girth_m", "open at both ends"});
    expect_refused(chart_of(R"("sizes": [{"label": "one size", "ranges": {"waist_girth_m": [60, 70]}}])"),
                   {"label one size", "waist_girth_m", "do not name"});
    expect_refused(chart_of(R"("sizes": [{"label": "S"}, {"label": "L"}])"), {"garment g", "measures"});
    expect_refused(labels_of(R"([{"label": "S"}, {"label": "L"}])"), {"garment g", "label S", "ranges"});
}

TEST(SizeChart, RefusesMoreLabelsThanItHolds) {
    std::string sizes = "[";
    for (int i = 0; i <= 4096; ++i)
        sizes += text(i ? "," : "", R"({"label": ")", i, R"(", "ranges": {"waist_girth_m": )", 50 + 0.01 * i,
                      "}}");
    expect_refused(labels_of(sizes + "]"), {"garment g", "4096"});
}

TEST(SizeChart, NamesWhatIsWrongWithAxes) {
    const std::string good =
        R"("axes": [{"measure": "waist_girth_m", "sizes": [{"label": "a", "range": [70, 80]},
        {"label": "b", "range": [80, 90]}]}, {"measure": "inside_leg_m",
          "sizes": [{"label": "c", "range": [70, 80]}]}])";
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
    expect_refused(with("[80, 90]", "\"80-90\""), {"range", "label b"});
    expect_refused(with(R"({"label": "b", "range": [80, 90]})", R"({"label": "b"})"),
                   {"label b", "no range"});
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

TEST(SizeChart, ReadsTheExampleOfItsPage) {
    std::ifstream in(VFIT_SOURCE_DIR "/docs/size-charts.md");
    std::stringstream page;
    page << in.rdbuf();
    const std::string fence = "```json\n", text = page.str();
    const size_t begin = text.find(fence) + fence.size();
    ASSERT_LT(begin, text.size());
    const SizeChart chart = SizeChart::parse(text.substr(begin, text.find("```", begin) - begin));
    for (const char* kind : {"trousers", "jeans", "wetsuit", "cap"}) EXPECT_NO_THROW(chart.garment(kind));
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
