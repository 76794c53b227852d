// The body that a pattern was drawn for, and what is made on it.
#include "cook/body/drawn_for.h"

#include <gtest/gtest.h>

#include <cmath>

#include "avatar/avatar_measures.h"
#include "cook/cook_file.h"
#include "cook/garment_writer.h"
#include "core/error.h"
#include "core/files.h"
#include "pattern_support.h"

namespace vfit {
namespace {

/// A tall woman, as GarmentCode's generator writes her.
const char* const kSheet = R"(body:
  arm_length: 56.0  # centimetres
  bust: 104.5
  head_l: 27.0
  height: 178.5
  hips: 112.0
  hips_line: 24.2
  leg_circ: 64.0
  shoulder_w: 36.0
  underbust: 87.0
  waist: 88.0
  waist_line: 38.0
  body_sample: mean_female
)";

std::string without(std::string text, const std::string& line_start) {
    const size_t at = text.find(line_start);
    return text.erase(at, text.find('\n', at) + 1 - at);
}

std::string refusal(const std::string& text) {
    try {
        parse_drawn_for(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

const WantedMeasure& wanted(const DrawnFor& drawn_for, const std::string& key) {
    for (const WantedMeasure& w : drawn_for.wanted)
        if (w.key == key) return w;
    throw std::runtime_error("no " + key);
}

TEST(DrawnFor, ReadsTheMeasuresThatGarmentCodeWritesBesideAPattern) {
    const DrawnFor out = parse_drawn_for(kSheet);
    EXPECT_EQ(out.sex, VFIT_SEX_FEMALE) << "her bust is 17 % larger than the girth below it";
    EXPECT_DOUBLE_EQ(wanted(out, "stature_m").value_m, 1.785);
    EXPECT_DOUBLE_EQ(wanted(out, "chest_girth_m").value_m, 1.045);
    EXPECT_DOUBLE_EQ(wanted(out, "hip_girth_m").value_m, 1.12);
    EXPECT_NEAR(wanted(out, kNapeLevel).value_m, 1.515, 1e-9);
    EXPECT_NEAR(wanted(out, kWaistLevel).value_m, 1.135, 1e-9);
    EXPECT_NEAR(wanted(out, kHipLevel).value_m, 0.893, 1e-9);
    EXPECT_EQ(parse_drawn_for(without(kSheet, "  underbust")).sex, VFIT_SEX_UNKNOWN);
}

TEST(DrawnFor, ReadsAProfile) {
    const DrawnFor out = parse_drawn_for(R"( {"stature_m": 1.7, "hip_girth_m": 1.02, "body_mass_kg": 65})");
    EXPECT_EQ(out.wanted.size(), 2u) << "a tape tells no mass";
    EXPECT_NEAR(wanted(out, "hip_girth_m").value_m, 1.02, 1e-6);
}

TEST(DrawnFor, NamesWhatIsWrong) {
    EXPECT_EQ(refusal("body:\n  bust: wide\n"), "measures: line 2 is not \"name: number\"");
    EXPECT_EQ(refusal("bust"), "measures: line 1 is not \"name: number\"");
    EXPECT_EQ(refusal("bust: nan\n"), "measures: line 1 is not \"name: number\"");
    EXPECT_EQ(refusal(""), "measures: \"height\", \"waist\" and \"hips\" have to be told");
    EXPECT_EQ(refusal(without(kSheet, "  hips:")),
              "measures: \"height\", \"waist\" and \"hips\" have to be told");
    EXPECT_EQ(refusal("height: 1.78\nwaist: 0.8\nhips: 1\n"),
              "measures: height: 1.78 is no person's in centimetres");
    EXPECT_NE(refusal("{\"stature_m\": 170}"), "accepted");
    EXPECT_EQ(refusal("{\"body_mass_kg\": 70}"), "measures: none of a tape is among them");
}

class DrawnForBody : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        fabrics = FabricLibrary::parse(read_file(VFIT_SOURCE_DIR "/assets/fabrics.json"));
        jobs = Jobs::own(1);
        her = body_drawn_for(*model, parse_drawn_for(kSheet));
    }
    static inline std::shared_ptr<const BodyModel> model;
    static inline FabricLibrary fabrics;
    static inline std::unique_ptr<Jobs> jobs;
    static inline BodyDrawnFor her;
};

TEST_F(DrawnForBody, HasTheMeasures) {
    const Avatar avatar(model, {her.sex}, shape_of(*model, her.sex, her.shape), Vec2(1.0f));
    const auto measures = measure_avatar(avatar, her.sex);
    EXPECT_EQ(her.sex, VFIT_SEX_FEMALE);
    EXPECT_NEAR(find(measures, "stature_m")->value, 1.785f, 0.01f);
    EXPECT_NEAR(find(measures, "chest_girth_m")->value, 1.045f, 0.015f);
    EXPECT_NEAR(find(measures, "waist_minimum_girth_m")->value, 0.88f, 0.015f);
    EXPECT_NEAR(find(measures, "hip_girth_m")->value, 1.12f, 0.015f);
    EXPECT_NEAR(find(measures, "arm_length_m")->value, 0.56f, 0.015f);
}

TEST_F(DrawnForBody, SaysWhichMeasuresItCannotHave) {
    const BodyDrawnFor body = body_drawn_for(
        *model,
        parse_drawn_for(R"({"sex": "f", "stature_m": 1.6, "waist_girth_m": 0.6, "hip_girth_m": 1.5})"));
    ASSERT_FALSE(body.notes.empty());
    EXPECT_NE(body.notes[0].find(" of the body that it is made on is "), std::string::npos) << body.notes[0];
}

TEST_F(DrawnForBody, IsKeptInTheGarment) {
    CookOptions options;
    options.sex = her.sex, options.shape = her.shape;
    const CookedGarment cooked =
        cook_pattern(*model, {{"", {}, tube(0.3f, 0.5f, 1.2f)}}, 0, fabrics, options, *jobs);
    EXPECT_EQ(cooked.report.crossings(), 0u);
    const Garment read = parse_garment(bytes_of_text(write_garment(cooked.garment)), fabrics);
    ASSERT_EQ(read.body_shape.size(), her.shape.size());
    for (const ShapeSetting& setting : her.shape) {
        const auto it = std::find_if(read.body_shape.begin(), read.body_shape.end(),
                                     [&](const ShapeSetting& s) { return s.key == setting.key; });
        ASSERT_NE(it, read.body_shape.end()) << setting.key;
        EXPECT_NEAR(it->value, setting.value, 1e-5f);
    }
}

TEST(ShapeSettings, AreWhatDiffersFromTheDefaultBody) {
    const auto model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    EXPECT_TRUE(settings_of(*model, VFIT_SEX_MALE, model->default_shape(VFIT_SEX_MALE)).empty());
    const std::vector<ShapeSetting> settings = {{"weight", 0.8f}, {"measure-hips-circ", -0.25f}};
    const std::vector<float> shape = shape_of(*model, VFIT_SEX_MALE, settings);
    EXPECT_EQ(settings_of(*model, VFIT_SEX_MALE, shape).size(), 2u);
    for (const ShapeSetting& bad :
         {ShapeSetting{"wing-span", 0.0f}, ShapeSetting{"weight", 7.0f}, ShapeSetting{"weight", NAN}})
        EXPECT_THROW(shape_of(*model, VFIT_SEX_MALE, std::vector{bad}), Error) << bad.key;
}

}  // namespace
}  // namespace vfit
