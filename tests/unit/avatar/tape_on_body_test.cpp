// Tape measures of the parametric body: near those of people, and each following the slider that is named
// after it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "anthropometry/tape_landmarks.h"
#include "avatar/avatar_measures.h"
#include "unit/avatar/body_fixture.h"

namespace vfit {
namespace {

struct Slider {
    const char* key;
    float value;
};

std::vector<Measurement> measures(vfit_sex sex, const std::vector<Slider>& sliders = {}) {
    std::vector<float> shape = body_model()->default_shape(sex);
    for (const Slider& slider : sliders) {
        const int index = body_model()->parameter(slider.key);
        EXPECT_GE(index, 0) << slider.key;
        if (index >= 0) shape[size_t(index)] = slider.value;
    }
    AvatarDesc desc;
    desc.sex = sex;
    return measure_avatar(Avatar(body_model(), desc, shape, Vec2(1.0f)), sex);
}

float value(const std::vector<Measurement>& list, const std::string& key) {
    const Measurement* m = find(list, key);
    EXPECT_NE(m, nullptr) << key;
    return m ? m->value : 0.0f;
}

constexpr vfit_sex kSexes[] = {VFIT_SEX_FEMALE, VFIT_SEX_MALE};

struct Range {
    const char* key;
    float women_low, women_high, men_low, men_high;
};

TEST(TapeOnBody, DefaultBodiesLieWithinTheAdultRange) {
    // Mean -+ 3 standard deviations of ANSUR II where it has the measure, lengths by its share of stature -+
    // 10 %. The default bodies are slim: the lower ends of waist and hip are those of EN 13402-3's smallest
    // sizes.
    const Range ranges[] = {{"stature_m", 1.44f, 1.82f, 1.55f, 1.96f},
                            {"chest_girth_m", 0.80f, 1.05f, 0.80f, 1.32f},
                            {"underbust_girth_m", 0.60f, 0.90f, 0.0f, 0.0f},
                            {"waist_girth_m", 0.60f, 1.00f, 0.68f, 1.10f},
                            {"hip_girth_m", 0.84f, 1.10f, 0.82f, 1.15f},
                            {"neck_girth_m", 0.27f, 0.39f, 0.32f, 0.48f},
                            {"thigh_girth_m", 0.47f, 0.75f, 0.47f, 0.75f},
                            {"upper_arm_girth_m", 0.22f, 0.38f, 0.25f, 0.42f},
                            {"inside_leg_m", 0.65f, 0.92f, 0.71f, 0.98f},
                            {"shoulder_breadth_m", 0.37f, 0.53f, 0.42f, 0.60f},
                            {"biacromial_breadth_m", 0.31f, 0.42f, 0.36f, 0.47f},
                            {"hip_breadth_m", 0.30f, 0.42f, 0.28f, 0.41f},
                            {"head_height_m", 0.19f, 0.25f, 0.20f, 0.26f},
                            {"head_width_m", 0.12f, 0.16f, 0.13f, 0.17f},
                            {"arm_length_m", 0.45f, 0.62f, 0.50f, 0.68f},
                            {"hand_length_m", 0.15f, 0.21f, 0.16f, 0.22f}};
    for (const vfit_sex sex : kSexes) {
        const auto m = measures(sex);
        for (const Range& r : ranges) {
            const bool woman = sex == VFIT_SEX_FEMALE;
            if (!woman && r.men_high == 0.0f) continue;
            EXPECT_GT(value(m, r.key), woman ? r.women_low : r.men_low) << r.key;
            EXPECT_LT(value(m, r.key), woman ? r.women_high : r.men_high) << r.key;
        }
    }
}

TEST(TapeOnBody, LevelsAreInTheOrderOfTheBody) {
    for (const vfit_sex sex : kSexes) {
        const auto m = measures(sex);
        EXPECT_LT(value(m, "inside_leg_m"), value(m, "hip_height_m"));
        EXPECT_LT(value(m, "waist_girth_m"), value(m, "chest_girth_m"));
        EXPECT_LT(value(m, "waist_girth_m"), value(m, "hip_girth_m"));
        EXPECT_LT(value(m, "biacromial_breadth_m"), value(m, "shoulder_breadth_m"));
        EXPECT_LT(value(m, "waist_breadth_m") + value(m, "waist_depth_m"), value(m, "waist_girth_m"));
    }
}

TEST(TapeOnBody, ThreeWaistsLieWhereTheirDefinitionsSay) {
    for (const vfit_sex sex : kSexes) {
        const auto m = measures(sex);
        EXPECT_LE(value(m, "waist_minimum_girth_m"), value(m, "waist_girth_m") + 1e-4f);
        EXPECT_LE(value(m, "waist_minimum_girth_m"), value(m, "waist_navel_girth_m") + 1e-4f);
        // The navel at 0.602 of stature: between the hip joint and the foot of the neck by the survey's
        // heights.
        const bool woman = sex == VFIT_SEX_FEMALE;
        const float hip = woman ? 0.519f : 0.513f, neck = woman ? 0.857f : 0.864f;
        AvatarDesc desc;
        desc.sex = sex;
        const Avatar avatar(body_model(), desc, body_model()->default_shape(sex), Vec2(1.0f));
        Body joints;
        const Mesh mesh = avatar.measuring_mesh(MeasuringPosture{}, &joints);
        const TapeMesh body(
            {mesh.positions, mesh.indices, avatar.parts().first(mesh.positions.size()), joints, sex});
        const float from = 0.5f * (body.joint(VFIT_JOINT_LEFT_HIP).y + body.joint(VFIT_JOINT_RIGHT_HIP).y),
                    to = body.joint(VFIT_JOINT_NECK).y;
        const float level = glm::mix(from, to, (0.602f - hip) / (neck - hip));
        EXPECT_NEAR(value(m, "waist_navel_girth_m"), hull_perimeter(body.trunk(level).points()), 2e-3f);
        // No level in between is narrower.
        const float arch = glm::mix(waist_height(body), to, 0.2f);
        for (float y = level; y < arch; y += 0.005f)
            EXPECT_GE(hull_perimeter(body.trunk(y).points()), value(m, "waist_minimum_girth_m") - 5e-4f) << y;
    }
}

struct Follower {
    const char* slider;
    const char* key;
    std::vector<const char*> unmoved;  // by more than 2 mm
};

TEST(TapeOnBody, EachMeasureRisesWithItsSliderAndLeavesTheOthers) {
    const Follower followers[] = {
        {"measure-waist-circ",
         "waist_girth_m",
         {"hip_girth_m", "neck_girth_m", "thigh_girth_m", "inside_leg_m"}},
        {"measure-hips-circ", "hip_girth_m", {"waist_girth_m", "chest_girth_m", "neck_girth_m"}},
        {"measure-bust-circ", "chest_girth_m", {"hip_girth_m", "neck_girth_m", "inside_leg_m"}},
        {"measure-neck-circ", "neck_girth_m", {"chest_girth_m", "waist_girth_m", "hip_girth_m"}},
        {"measure-thigh-circ", "thigh_girth_m", {"chest_girth_m", "waist_girth_m", "inside_leg_m"}},
        {"measure-upperarm-circ", "upper_arm_girth_m", {"waist_girth_m", "hip_girth_m", "neck_girth_m"}},
        {"measure-shoulder-dist", "shoulder_breadth_m", {"waist_girth_m", "hip_girth_m", "stature_m"}},
        {"measure-upperleg-height", "inside_leg_m", {"chest_girth_m", "waist_girth_m", "arm_length_m"}}};
    for (const vfit_sex sex : kSexes)
        for (const Follower& follower : followers) {
            const auto middle = measures(sex);
            float before = 0.0f;
            for (const float s : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f}) {
                const auto m = measures(sex, {{follower.slider, s}});
                EXPECT_GT(value(m, follower.key), before + 0.002f)
                    << follower.slider << " at " << s << " sex " << sex;
                before = value(m, follower.key);
                for (const char* key : follower.unmoved)
                    EXPECT_NEAR(value(m, key), value(middle, key), 0.002f)
                        << key << " by " << follower.slider << " at " << s << " sex " << sex;
            }
        }
}

TEST(TapeOnBody, MeasuresChangeWithoutJumps) {
    // A step of 1 % of the weight slider's range moves no girth by more than 1 cm, far less than a size step.
    for (const vfit_sex sex : kSexes) {
        auto before = measures(sex, {{"weight", 0.7f}});
        for (int i = 1; i <= 10; ++i) {
            const auto m = measures(sex, {{"weight", 0.7f + 0.01f * float(i)}});
            for (const Measurement& measure : m)
                EXPECT_NEAR(measure.value, value(before, measure.key), 0.01f) << measure.key << " step " << i;
            before = m;
        }
    }
}

TEST(TapeOnBody, StoutBodiesCanBeMeasured) {
    for (const vfit_sex sex : kSexes) {
        const auto slim = measures(sex, {{"weight", 0.2f}}), stout = measures(sex, {{"weight", 1.15f}});
        for (const char* key :
             {"chest_girth_m", "waist_girth_m", "hip_girth_m", "thigh_girth_m", "upper_arm_girth_m"})
            EXPECT_GT(value(stout, key), value(slim, key) + 0.02f) << key;
    }
}

TEST(TapeOnBody, ABellyIsNotTakenForTheBust) {
    const auto middle = measures(VFIT_SEX_FEMALE),
               belly = measures(VFIT_SEX_FEMALE, {{"measure-waist-circ", 1.0f}});
    EXPECT_GT(value(belly, "waist_girth_m"), value(middle, "waist_girth_m") + 0.05f);
    EXPECT_NEAR(value(belly, "chest_girth_m"), value(middle, "chest_girth_m"), 0.005f);
}

TEST(TapeOnBody, NorIsAnUpperBellyOverASmallBust) {
    const auto woman = [](float stomach, float waist) {
        return measures(VFIT_SEX_FEMALE, {{"weight", 0.9f},
                                          {"measure-bust-circ", -1.0f},
                                          {"stomach-pregnant", stomach},
                                          {"measure-waist-circ", waist}});
    };
    const auto flat = woman(0.0f, 0.0f);
    for (const float stomach : {0.0f, 0.5f, 1.0f}) {
        const auto round = woman(stomach, 1.0f);
        EXPECT_GT(value(round, "waist_girth_m"), value(flat, "waist_girth_m") + 0.08f);
        EXPECT_NEAR(value(round, "chest_girth_m"), value(flat, "chest_girth_m"), 0.01f) << stomach;
        EXPECT_LT(value(round, "underbust_girth_m"), value(round, "chest_girth_m") - 0.02f) << stomach;
    }
}

TEST(TapeOnBody, TheBustDoesNotLeapFromOneVertexToTheNext) {
    // Vertices are a centimetre apart. The bust moves down its own slider and up with the waist's.
    const auto height = [](const char* slider, float value) {
        std::vector<float> shape = body_model()->default_shape(VFIT_SEX_FEMALE);
        shape[size_t(body_model()->parameter(slider))] = value;
        const Avatar avatar(body_model(), {VFIT_SEX_FEMALE}, shape, Vec2(1.0f));
        Body joints;
        const Mesh mesh = avatar.measuring_mesh({}, &joints);
        const TapeMesh tape({mesh.positions, mesh.indices, avatar.parts().first(mesh.positions.size()),
                             joints, VFIT_SEX_FEMALE});
        return chest_height(tape, armpit_height(tape));
    };
    for (const char* slider : {"measure-waist-circ", "measure-bust-circ", "weight"}) {
        float before = height(slider, 0.3f);
        for (int i = 1; i <= 15; ++i) {
            const float here = height(slider, 0.3f + 0.02f * float(i));
            EXPECT_NEAR(here, before, 0.002f) << slider << " " << i;
            before = here;
        }
    }
}

TEST(TapeOnBody, FinerMeshesHaveTheSameMeasures) {
    for (const vfit_sex sex : kSexes) {
        AvatarDesc fine;
        fine.sex = sex;
        fine.detail = 1;
        const auto coarse = measures(sex),
                   m = measure_avatar(Avatar(body_model(), fine, {}, Vec2(1.0f)), sex);
        // Subdivision rounds the faces: a few millimetres.
        for (const Measurement& measure : m)
            EXPECT_NEAR(measure.value, value(coarse, measure.key), 0.012f) << measure.key << " sex " << sex;
    }
}

}  // namespace
}  // namespace vfit
