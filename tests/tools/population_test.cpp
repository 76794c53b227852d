// People drawn from the survey: the same for the same number, and with the measures that were drawn.
#include "population/population.h"

#include <gtest/gtest.h>

#include <cmath>

#include "population/scan_scene.h"

namespace vfit::tools {
namespace {

std::shared_ptr<const BodyModel> model() { return BodyModel::load(VFIT_DATA_DIR "/body.bin"); }

TEST(Anthropometry, DrawsPeopleWithTheSurveysMeansAndDeviations) {
    const Anthropometry survey(VFIT_SURVEY);
    Random random(5);
    double sum = 0.0, squares = 0.0, chest_by_waist = 0.0, chest = 0.0, waist = 0.0, chest2 = 0.0,
           waist2 = 0.0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
        const SurveyMeasures m = survey.draw(VFIT_SEX_MALE, random);
        sum += m["stature"], squares += m["stature"] * m["stature"];
        const double c = m["chestcircumference"], w = m["waistcircumference"];
        chest += c, waist += w, chest2 += c * c, waist2 += w * w, chest_by_waist += c * w;
    }
    EXPECT_NEAR(sum / n, 1756.2, 4.0);
    EXPECT_NEAR(std::sqrt(squares / n - sum * sum / n / n), 68.6, 3.0);
    const double covariance = chest_by_waist / n - chest * waist / n / n;
    EXPECT_NEAR(
        covariance / std::sqrt((chest2 / n - chest * chest / n / n) * (waist2 / n - waist * waist / n / n)),
        0.89, 0.02);
    EXPECT_THROW(survey.draw(VFIT_SEX_MALE, random)["nose"], Failure);
}

TEST(Anthropometry, ExpectsWhatOthersOfThoseMeasuresHave) {
    const Anthropometry survey(VFIT_SURVEY);
    Random random(6);
    // The mean of what is not explained is nothing, and its spread far below that of people.
    double sum = 0.0, squares = 0.0;
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
        const SurveyMeasures m = survey.draw(VFIT_SEX_FEMALE, random);
        const double left =
            m["stature"] - survey.expected(VFIT_SEX_FEMALE, "stature", m, {"cervicaleheight"});
        sum += left, squares += left * left;
    }
    EXPECT_NEAR(sum / n, 0.0, 1.5);
    EXPECT_NEAR(std::sqrt(squares / n), 11.4, 1.0) << "regression of stature on cervicale height, women";
}

TEST(Anthropometry, MovesEveryMeasureWithTheMass) {
    const Anthropometry survey(VFIT_SURVEY);
    Random random(7);
    const SurveyMeasures m = survey.draw(VFIT_SEX_MALE, random);
    const SurveyMeasures heavier = survey.with_mass(VFIT_SEX_MALE, m, m["weightkg"] + 10.0);
    EXPECT_NEAR(heavier["weightkg"], m["weightkg"] + 10.0, 1e-6);
    EXPECT_NEAR(heavier["stature"], m["stature"], 1e-6);
    // Regression of the survey's 4,082 men on mass and stature.
    EXPECT_NEAR(heavier["waistcircumference"] - m["waistcircumference"], 82.0, 8.0);
    EXPECT_NEAR(heavier["headbreadth"] - m["headbreadth"], 1.4, 0.7);
}

TEST(Anthropometry, KnowsHowGirthsScatterAboutBreadthAndDepth) {
    const Anthropometry survey(VFIT_SURVEY);
    // Of the survey's rows (BMI 18 to 35): 15.3 and 17.0, 17.6 and 14.7 mm.
    EXPECT_NEAR(survey.scatter(VFIT_SEX_MALE, "waistcircumference", {"waistbreadth", "waistdepth"}), 15.3,
                0.5);
    EXPECT_NEAR(survey.scatter(VFIT_SEX_MALE, "buttockcircumference", {"hipbreadth", "buttockdepth"}), 17.0,
                0.5);
    EXPECT_NEAR(survey.scatter(VFIT_SEX_FEMALE, "waistcircumference", {"waistbreadth", "waistdepth"}), 17.6,
                0.5);
}

TEST(BodyModel, HasSectionsOfOtherFormsAtTheSameBreadthAndDepth) {
    const auto body = model();
    std::vector<float> shape = body->default_shape(VFIT_SEX_MALE);
    const auto measures = [&](const char* key, float value) {
        shape[size_t(body->parameter(key))] = value;
        const BodyMeasures out = measures_of(body, VFIT_SEX_MALE, shape, 0.601);
        shape[size_t(body->parameter(key))] = 0.0f;
        return out;
    };
    const BodyMeasures round = measures("section-belly-square", -1.0f),
                       square = measures("section-belly-square", 1.0f),
                       full = measures("section-belly-full", 1.0f);
    EXPECT_GT(square.at("navel_girth_m") - round.at("navel_girth_m"), 0.03);
    EXPECT_LT(std::abs(square.at("navel_breadth_m") - round.at("navel_breadth_m")), 0.01);
    EXPECT_LT(std::abs(square.at("navel_depth_m") - round.at("navel_depth_m")), 0.01);
    EXPECT_NEAR(square.at("stature_m"), round.at("stature_m"), 1e-6);
    EXPECT_NEAR(square.at("neck_girth_m"), round.at("neck_girth_m"), 1e-6);
    EXPECT_GT(full.at("navel_girth_m") - round.at("navel_girth_m"), 0.2);
}

TEST(BodyWithMeasures, ReachesAnotherGirthAtTheSameBreadthAndDepth) {
    constexpr double navel = 0.601;
    const auto measure = [&](const std::vector<float>& shape) {
        return measures_of(model(), VFIT_SEX_MALE, shape, navel);
    };
    BodyWithMeasures solver(model(), VFIT_SEX_MALE,
                            {{"section-belly-full", 0.0, 0.3},
                             {"section-belly-front", 0.0, 0.3},
                             {"section-belly-square", 0.0, 1.0},
                             {"stomach-pregnant", 0.0, 0.3},
                             {"hip-scale-horiz", 0.0, 0.3}},
                            {"navel_girth_m", "navel_breadth_m", "navel_depth_m"}, measure);
    std::vector<float> usual = model()->default_shape(VFIT_SEX_MALE);
    const BodyMeasures body = measures_of(model(), VFIT_SEX_MALE, usual, navel);
    for (const double more_m : {-0.015, 0.015}) {  // one standard deviation of the survey's men
        std::vector<float> shape = usual;
        const BodyMeasures there = solver.solve({{"navel_girth_m", body.at("navel_girth_m") + more_m, 0.001},
                                                 {"navel_breadth_m", body.at("navel_breadth_m"), 0.001},
                                                 {"navel_depth_m", body.at("navel_depth_m"), 0.001}},
                                                measure, shape);
        EXPECT_NEAR(there.at("navel_girth_m") - body.at("navel_girth_m"), more_m, 0.003);
        EXPECT_NEAR(there.at("navel_breadth_m"), body.at("navel_breadth_m"), 0.003);
        EXPECT_NEAR(there.at("navel_depth_m"), body.at("navel_depth_m"), 0.003);
    }
}

TEST(VirtualPeople, HasVeryHeavyPeopleAndHipsAsDeepAsTheSurveys) {
    VirtualPeople population(model(), BodySpace::kVaried, 9);
    const PersonOfPopulation person = population.draw(21);
    EXPECT_GT(person.bmi, 38.0);
    EXPECT_GT(person.measures.at("navel_girth_m"), 1.15);
    // The model's own women have hips 0.56 times as deep as broad, the survey's 0.66.
    double depth = 0.0;
    for (const uint32_t woman : {0u, 2u, 4u}) {
        const BodyMeasures measures = population.draw(woman).measures;
        depth += measures.at("hip_depth_m") / measures.at("hip_breadth_m") / 3.0;
    }
    EXPECT_NEAR(depth, 0.66, 0.04);
}

TEST(VirtualPeople, GivesTheSamePersonForTheSameNumber) {
    VirtualPeople population(model(), BodySpace::kInside, 3);
    const PersonOfPopulation one = population.draw(4), other = population.draw(6), again = population.draw(4);
    EXPECT_EQ(one.options(), again.options()) << "whoever is drawn between";
    EXPECT_NE(one.options(), other.options());
    EXPECT_EQ(one.sex, VFIT_SEX_FEMALE);
    EXPECT_GE(one.bmi, 18.0);
    EXPECT_LE(one.bmi, 35.0);
    EXPECT_GT(one.measures.at("stature_m"), 1.45);
    EXPECT_EQ(one.measures, again.measures);
}

TEST(ScanScene, ClothesAreThoseThatWereAskedFor) {
    bool thick = false, tight = false;
    for (uint32_t seed = 0; seed < 40; ++seed) {
        EXPECT_EQ(ScanScene::draw(Dress::kTight, seed).top_m, 0.0f);
        const ScanScene clothed = ScanScene::draw(Dress::kClothed, seed),
                        training = ScanScene::draw(Dress::kTraining, seed);
        for (const float m : {clothed.top_m, clothed.sleeves_m, clothed.trousers_m}) {
            EXPECT_GE(m, 0.0f);
            EXPECT_LE(m, 0.03f);
        }
        thick = thick || training.top_m > 0.02f;
        tight = tight || training.top_m == 0.0f;
    }
    EXPECT_TRUE(thick && tight);
}

}  // namespace
}  // namespace vfit::tools
