// The scan as a whole: what it takes, what it says to the person, and what it measures.
#include "paper/paper_scan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "figure_scene.h"

namespace vfit {
namespace {

using namespace testing;

const Picture& standing() {
    static const Picture picture = take_picture(standing_figure(), level_camera());
    return picture;
}

ScanFrame frame_of(const Picture& picture) { return {picture.image(), &picture.body, 1}; }

vfit_guidance guidance(const Picture& picture, uint32_t persons = 1) {
    PaperScan scan{ScanDesc{}};
    ScanFrame frame = frame_of(picture);
    frame.person_count = persons;
    const ScanProgress progress = scan.add(frame);
    EXPECT_EQ(progress.taken, progress.guidance == VFIT_GUIDANCE_NONE);
    EXPECT_EQ(scan.frames_taken(), progress.taken ? 1u : 0u);
    return progress.guidance;
}

template <typename Call>
void expect_error(vfit_result code, const char* word, Call&& call) {
    try {
        call();
        FAIL() << "no error about " << word;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), code);
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

TEST(PaperScan, CompletesAfterTheWantedFramesAndIgnoresMore) {
    ScanDesc desc;
    desc.frame_count = 3;
    PaperScan scan(desc);
    for (uint32_t i = 1; i <= 3; ++i) {
        const ScanProgress progress = scan.add(frame_of(standing()));
        EXPECT_TRUE(progress.taken);
        EXPECT_EQ(progress.frames_taken, i);
        EXPECT_GT(progress.compute_ms, 0.0);
        EXPECT_GT(progress.correction_m, 0.0f);
        EXPECT_LT(progress.correction_m, 0.05f);
    }
    EXPECT_TRUE(scan.complete());
    EXPECT_FALSE(scan.add(frame_of(standing())).taken);
    EXPECT_EQ(scan.frames_taken(), 3u);
}

TEST(PaperScan, MeasuresTheFigureAndNamesEveryLine) {
    PaperScan scan{ScanDesc{}};
    for (int i = 0; i < 3; ++i) scan.add(frame_of(standing()));
    const auto list = scan.measurements();
    for (const Measurement& m : list) {
        EXPECT_GE(measure_index(m.key), 0) << m.key;
        EXPECT_GT(m.sigma, 0.0f) << m.key;
    }
    ASSERT_TRUE(find(list, "stature_m"));
    EXPECT_NEAR(find(list, "stature_m")->value, kStature_m, 0.01f);
    EXPECT_TRUE(find(list, "stature_m")->observed);
    EXPECT_NEAR(find(list, "hip_breadth_m")->value, kSeenHipBreadth_m, 0.006f);
    EXPECT_NEAR(find(list, "torso_height_m")->value, kTorso_m, 0.001f);
    EXPECT_NEAR(scan.radii()[VFIT_JOINT_HEAD], kHeadRadius_m, 0.006f);
}

TEST(PaperScan, InfersLinesThatItDidNotSee) {
    Picture picture = standing();
    for (const int joint : {VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND})
        picture.body.joints[size_t(joint)].state = VFIT_JOINT_NOT_SEEN;
    PaperScan scan{ScanDesc{}};
    scan.add(frame_of(picture));
    const auto list = scan.measurements();
    const Measurement* forearm = find(list, "elbow_fingertip_m");
    ASSERT_TRUE(forearm);
    EXPECT_FALSE(forearm->observed);
    EXPECT_NEAR(forearm->value, 0.254f * kStature_m, 0.02f);
    EXPECT_EQ(scan.radii()[VFIT_JOINT_LEFT_HAND], 0.0f);
}

TEST(PaperScan, GivesThePapersMeanWhereAsked) {
    PaperScan paper(ScanDesc::as_printed()), ours{ScanDesc{}};
    paper.add(frame_of(standing()));
    ours.add(frame_of(standing()));
    const auto list = paper.measurements();
    // Every other line takes part with the weight of the direct measure: the canon's bias is in the result.
    double sum = kStature_m + 7.0 / 4 * kHipHeight_m;
    int count = 2;
    for (const auto& [key, factor] :
         {std::pair{"elbow_fingertip_m", 7.0 / 2}, {"hand_length_m", 7.0}, {"head_height_m", 7.0}})
        if (const Measurement* m = find(list, key); m && m->observed) {
            sum += factor * m->value;
            ++count;
        }
    EXPECT_NEAR(find(list, "stature_m")->value, sum / count, 0.01);
    const auto our_list = ours.measurements();
    EXPECT_LT(std::abs(find(our_list, "stature_m")->value - kStature_m),
              std::abs(find(list, "stature_m")->value - kStature_m));
}

TEST(PaperScan, ScalesGarmentsRelativeToTheirNominalSize) {
    PaperScan scan{ScanDesc{}};
    scan.add(frame_of(standing()));
    for (const char* name : {"short_sleeves", "long_sleeves", "trousers"}) {
        const PaperScan::Scale scale = scan.scale(name);
        const GarmentKind& kind = garment_kind(name);
        EXPECT_NEAR(scale.y, scale.height_m / kind.nominal_height_m, 1e-6f);
        const float by_width = scale.width_m / kind.nominal_widths_m[0];
        EXPECT_TRUE(kind.width_count > 1 || std::abs(scale.x - by_width) < 1e-6f) << name;
        EXPECT_GT(scale.sigma_x, 0.0f);
        EXPECT_GT(scale.sigma_y, 0.0f);
    }
    EXPECT_NEAR(scan.scale("trousers").width_m, kSeenHipBreadth_m, 0.006f);
    EXPECT_NEAR(scan.scale("long_sleeves").height_m, kStature_m, 0.01f);
    expect_error(VFIT_ERROR_ARGUMENT, "short_sleeves", [&] { scan.scale("hat"); });
}

TEST(PaperScan, SaysWhichDimensionOfAGarmentWasNotSeen) {
    Picture picture = standing();
    for (const int side : {0, 1}) {
        picture.body.joints[size_t(VFIT_JOINT_LEFT_HIP + side)].position.x += side == 0 ? 0.5f : -0.5f;
        picture.body.joints[size_t(VFIT_JOINT_LEFT_KNEE + side)].state = VFIT_JOINT_NOT_SEEN;
    }
    PaperScan scan{ScanDesc{}};
    ASSERT_TRUE(scan.add(frame_of(picture)).taken);
    expect_error(VFIT_ERROR_DATA, "hip_breadth_m", [&] { scan.scale("trousers"); });
    const auto all = scan.measurements();
    EXPECT_FALSE(find(all, "hip_breadth_m"));
}

TEST(PaperScan, InfersTheShouldersOfAPersonWhoStandsSideways) {
    Picture picture = standing();
    for (const int joint : {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER})
        picture.body.joints[size_t(joint)].position.z += joint == VFIT_JOINT_LEFT_SHOULDER ? 0.5f : -0.5f;
    PaperScan scan{ScanDesc{}};
    ASSERT_TRUE(scan.add(frame_of(picture)).taken);
    const auto list = scan.measurements();
    ASSERT_TRUE(find(list, "shoulder_breadth_m"));
    EXPECT_FALSE(find(list, "shoulder_breadth_m")->observed) << "turned sideways: from the head's width";
    EXPECT_NO_THROW(scan.scale("short_sleeves"));
}

TEST(PaperScan, NeedsAFrameBeforeItMeasures) {
    PaperScan scan{ScanDesc{}};
    expect_error(VFIT_ERROR_STATE, "no frame", [&] { scan.measurements(); });
    expect_error(VFIT_ERROR_STATE, "no frame", [&] { scan.scale("trousers"); });
    EXPECT_EQ(scan.radii()[VFIT_JOINT_HEAD], 0.0f);
}

TEST(PaperScan, ForgetsThePersonOnReset) {
    PaperScan scan{ScanDesc{}};
    scan.add(frame_of(standing()));
    scan.reset();
    EXPECT_EQ(scan.frames_taken(), 0u);
    EXPECT_EQ(scan.radii()[VFIT_JOINT_HEAD], 0.0f);
    expect_error(VFIT_ERROR_STATE, "no frame", [&] { scan.measurements(); });
    EXPECT_TRUE(scan.add(frame_of(standing())).taken);
}

TEST(PaperScan, RefusesWrongDescriptions) {
    ScanDesc none, wrong;
    none.frame_count = 0;
    wrong.sex = 9;
    expect_error(VFIT_ERROR_ARGUMENT, "frame_count", [&] { PaperScan scan(none); });
    expect_error(VFIT_ERROR_ARGUMENT, "sex", [&] { PaperScan scan(wrong); });
}

TEST(Guidance, NamesWhyAFrameIsOfNoUse) {
    EXPECT_EQ(guidance(standing()), VFIT_GUIDANCE_NONE);
    EXPECT_EQ(guidance(standing(), 2), VFIT_GUIDANCE_ONE_PERSON_ONLY);

    PaperScan scan{ScanDesc{}};
    ScanFrame nobody = frame_of(standing());
    nobody.body = nullptr;
    EXPECT_EQ(scan.add(nobody).guidance, VFIT_GUIDANCE_NOBODY);
    Picture empty = standing();
    std::fill(empty.users.begin(), empty.users.end(), uint8_t(0));
    EXPECT_EQ(guidance(empty), VFIT_GUIDANCE_NOBODY);

    EXPECT_EQ(guidance(take_picture(standing_figure(1.3f), level_camera())), VFIT_GUIDANCE_STEP_BACK);
    EXPECT_EQ(guidance(take_picture(standing_figure(5.9f), level_camera())), VFIT_GUIDANCE_STEP_CLOSER);
    EXPECT_EQ(guidance(take_picture(standing_figure(4.0f), level_camera(160, 120))),
              VFIT_GUIDANCE_STEP_CLOSER);
}

TEST(Guidance, KnowsThePortraitCamerasTopAndBottom) {
    const Camera portrait = level_camera(640, 480, 0.0f, 0.5f * kPi);
    EXPECT_EQ(guidance(take_picture(standing_figure(2.8f), portrait)), VFIT_GUIDANCE_NONE);
    EXPECT_EQ(guidance(take_picture(standing_figure(1.3f), portrait)), VFIT_GUIDANCE_STEP_BACK);
}

TEST(Guidance, MissesJointsAndFeet) {
    const auto without = [](std::initializer_list<int> joints) {
        Picture picture = standing();
        for (const int j : joints) picture.body.joints[size_t(j)].state = VFIT_JOINT_NOT_SEEN;
        return guidance(picture);
    };
    EXPECT_EQ(without({VFIT_JOINT_HEAD}), VFIT_GUIDANCE_JOINTS_MISSING);
    EXPECT_EQ(without({VFIT_JOINT_LEFT_SHOULDER}), VFIT_GUIDANCE_JOINTS_MISSING);
    EXPECT_EQ(without({VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT}), VFIT_GUIDANCE_FEET_NOT_VISIBLE);
    EXPECT_EQ(without({VFIT_JOINT_LEFT_FOOT}), VFIT_GUIDANCE_NONE) << "one foot will do";
    EXPECT_EQ(without({VFIT_JOINT_LEFT_HAND, VFIT_JOINT_TORSO}), VFIT_GUIDANCE_NONE);

    Picture lost = standing();
    lost.body.joints[VFIT_JOINT_HEAD].position.x += 0.5f;
    EXPECT_EQ(guidance(lost), VFIT_GUIDANCE_JOINTS_MISSING) << "a head beside the person";
}

TEST(Guidance, AsksToStandStillAndUpright) {
    Picture squat = standing();
    for (const int j : {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_RIGHT_KNEE})
        squat.body.joints[size_t(j)].position.z -= 0.25f;
    EXPECT_EQ(guidance(squat), VFIT_GUIDANCE_HOLD_STILL);

    Picture bow = standing();
    for (const int j : {VFIT_JOINT_NECK, VFIT_JOINT_HEAD}) bow.body.joints[size_t(j)].position.z -= 0.3f;
    EXPECT_EQ(guidance(bow), VFIT_GUIDANCE_HOLD_STILL);

    Picture legs_up = standing();
    for (const int side : {0, 1}) {
        legs_up.body.joints[size_t(VFIT_JOINT_LEFT_KNEE + side)].position.y -= 0.6f;
        legs_up.body.joints[size_t(VFIT_JOINT_LEFT_FOOT + side)].position.y -= 1.2f;
    }
    EXPECT_EQ(guidance(legs_up), VFIT_GUIDANCE_HOLD_STILL);

    // 10 cm in a frame of 1/30 s are 3 m/s, in a quarter of a second a stroll.
    PaperScan scan{ScanDesc{}};
    Picture later = standing();
    for (Joint& j : later.body.joints) j.position.z += 0.1f;
    scan.add(frame_of(standing()));
    later.body.time_ns = 33'000'000;
    EXPECT_EQ(scan.add(frame_of(later)).guidance, VFIT_GUIDANCE_HOLD_STILL);
    PaperScan patient{ScanDesc{}};
    patient.add(frame_of(standing()));
    later.body.time_ns = 250'000'000;
    EXPECT_EQ(patient.add(frame_of(later)).guidance, VFIT_GUIDANCE_NONE);
}

TEST(Guidance, DoesNotTakeTheNextPersonForAFastOne) {
    PaperScan scan{ScanDesc{}};
    scan.add(frame_of(standing()));
    Picture other = standing();
    for (Joint& j : other.body.joints) j.position.z += 0.1f;
    other.body.id = 2;
    for (uint8_t& user : other.users) user *= 2;
    EXPECT_EQ(scan.add(frame_of(other)).guidance, VFIT_GUIDANCE_NONE);
}

TEST(Guidance, SurvivesTimesAtTheEndsOfTheClock) {
    PaperScan scan{ScanDesc{}};
    Picture picture = standing();
    for (const int64_t time : {INT64_MIN, INT64_MAX, INT64_MIN}) {
        picture.body.time_ns = time;
        EXPECT_EQ(scan.add(frame_of(picture)).guidance, VFIT_GUIDANCE_NONE);
    }
}

}  // namespace
}  // namespace vfit
