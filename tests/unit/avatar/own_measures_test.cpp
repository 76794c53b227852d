// Measures that a user adds, on the body model's mesh.
#include "anthropometry/own_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "avatar/avatar_measures.h"
#include "body_fixture.h"
#include "core/error.h"

namespace vfit {
namespace {

class OwnMeasuresTest : public ::testing::Test {
protected:
    OwnMeasuresTest() : avatar_(body_model(), {VFIT_SEX_FEMALE}, {}, Vec2(1.0f)) {
        mesh_ = avatar_.measuring_mesh({}, &tape_.joints);
        tape_.positions = mesh_.positions, tape_.indices = mesh_.indices;
        tape_.parts = avatar_.parts().first(mesh_.positions.size());
        tape_.sex = VFIT_SEX_FEMALE;
    }
    static std::string list(const std::string& measures) {
        return R"({"format": "vfit-own-measures", "version": 1, "measures": [)" + measures + "]}";
    }
    float of(const std::string& definition) const {
        return OwnMeasures::parse(list(R"({"key": "x_one_m", )" + definition + "}"))
            .measure(tape_)
            .at(0)
            .value;
    }
    float told(const char* key) const { return find(known_, key)->value; }

    Avatar avatar_;
    Mesh mesh_;
    TapeBody tape_;
    const std::vector<Measurement> known_ = measure_avatar(avatar_, VFIT_SEX_FEMALE);
};

void expect_refused(const std::string& json, const char* word) {
    try {
        OwnMeasures::parse(json);
        FAIL() << "taken: " << json;
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

TEST_F(OwnMeasuresTest, SayWhatTheTapeSaysOfKnownMeasures) {
    EXPECT_NEAR(of(R"("girth": {"at": "waist", "of": "trunk"})"), told("waist_girth_m"), 1e-4f);
    EXPECT_NEAR(of(R"("breadth": {"at": "hips", "of": "trunk"})"), told("hip_breadth_m"), 1e-3f);
    EXPECT_NEAR(of(R"("depth": {"at": "chest", "of": "trunk"})"), told("chest_depth_m"), 1e-3f);
    EXPECT_NEAR(of(R"("height": "crotch")"), told("inside_leg_m"), 1e-3f);
    EXPECT_NEAR(of(R"("path": {"points": ["NECK", "PELVIS"]})"), told("torso_height_m"), 1e-4f);
    const float left = of(R"("height": "left bust point")"), right = of(R"("height": "right bust point")");
    EXPECT_NEAR(0.5f * (left + right), of(R"("height": "chest")"), 1e-4f);
    EXPECT_NEAR(left, right, 0.01f);
    // The thigh is taped just below the crotch, from where it narrows.
    const auto thigh = [&](const char* place) {
        return of(R"("girth": {"at": ["LEFT_HIP", "LEFT_KNEE", )" + std::string(place) +
                  R"(], "square_to": ["LEFT_HIP", "LEFT_KNEE"]})");
    };
    EXPECT_LT(told("thigh_girth_m"), thigh("0.2"));
    EXPECT_GT(told("thigh_girth_m"), thigh("0.25"));
    EXPECT_GT(thigh("0.25"), thigh("0.35"));
}

TEST_F(OwnMeasuresTest, FollowPathsOverTheSkin) {
    const char* points = R"("points": [{"skin": "NECK", "way": "back"}, {"skin": "waist", "way": "back"}])";
    const float air = of("\"path\": {" + std::string(points) + "}"),
                skin = of("\"path\": {" + std::string(points) + R"(, "over": "skin"})");
    EXPECT_NEAR(air, 0.36f, 0.02f) << "of a woman of 1.69 m";
    EXPECT_GE(skin, air);
    EXPECT_LT(skin, 1.15f * air) << "down the back a tape is hardly longer than the way through the air";
    // From side to side over the belly and over the back is once around.
    const auto half = [&](const char* way) {
        return of(R"("path": {"points": [{"skin": "waist", "way": "left"}, {"skin": "waist", "way": ")" +
                  std::string(way) + R"("}, {"skin": "waist", "way": "right"}], "over": "skin"})");
    };
    EXPECT_NEAR(half("front") + half("back"), told("waist_girth_m"), 0.01f);
    EXPECT_GT(std::min(half("front"), half("back")), told("waist_breadth_m"));
}

TEST_F(OwnMeasuresTest, AreRefusedWithTheNameOfWhatIsWrong) {
    expect_refused("{", "JSON");
    expect_refused("{}", "format");
    expect_refused(R"({"format": "vfit-own-measures", "version": 2, "measures": []})", "version");
    expect_refused(list(""), "measures");
    expect_refused(list(R"({"key": "calf_girth_m", "height": "waist"})"), "calf_girth_m");
    expect_refused(list(R"({"key": "x_Calf_m", "height": "waist"})"), "x_Calf_m");
    expect_refused(list(R"({"key": "x_a_m"})"), "x_a_m");
    expect_refused(list(R"({"key": "x_a_m", "height": "waist", "girth": {"at": "waist"}})"), "exactly one");
    expect_refused(list(R"({"key": "x_a_m", "height": "elbow"})"), "elbow");
    expect_refused(list(R"({"key": "x_a_m", "height": ["waist", "hips"]})"), "share");
    expect_refused(list(R"({"key": "x_a_m", "height": ["waist", "hips", 1e9]})"), "share");
    expect_refused(list(R"({"key": "x_a_m", "height": {"skin": "waist", "way": "north"}})"), "way");
    expect_refused(list(R"({"key": "x_a_m", "girth": {"at": "waist", "of": "head"}})"), "trunk");
    expect_refused(list(R"({"key": "x_a_m", "girth": {"at": "waist", "square_to": ["waist"]}})"),
                   "square_to");
    expect_refused(list(R"({"key": "x_a_m", "path": {"points": ["waist"]}})"), "points");
    expect_refused(list(R"({"key": "x_a_m", "path": {"points": ["waist", "hips"], "over": "water"}})"),
                   "over");
    expect_refused(list(R"({"key": "x_a_m", "height": "waist"}, {"key": "x_a_m", "height": "waist"})"),
                   "twice");
    std::string deep = "\"waist\"";
    for (int i = 0; i < 20; ++i) deep = "[" + deep + ", \"hips\", 0.5]";
    expect_refused(list(R"({"key": "x_a_m", "height": )" + deep + "}"), "nested");
}

TEST_F(OwnMeasuresTest, NameTheMeasureThatABodyHasNot) {
    const auto fails = [&](const std::string& definition) {
        try {
            of(definition);
            ADD_FAILURE() << definition;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("x_one_m"), std::string::npos) << e.what();
        }
    };
    fails(R"("girth": {"at": ["HEAD", "NECK", -5.0]})");
    fails(R"("girth": {"at": ["HEAD", "NECK", -5.0], "of": "trunk"})");
    fails(R"("girth": {"at": "waist", "square_to": ["waist", "waist"]})");
    fails(R"("height": {"skin": ["HEAD", "NECK", -9.0], "way": "up"})");
    fails(R"("path": {"points": ["waist", "waist"]})");
}

}  // namespace
}  // namespace vfit
