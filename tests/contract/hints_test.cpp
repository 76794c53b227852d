// Hints of a pose network in the colour image: right ones help where a limb is hidden, wrong ones do limited
// harm, those of nobody do nothing.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contract/support.h"

namespace {

constexpr vfit_joint_id kHinted[] = {VFIT_JOINT_LEFT_HAND, VFIT_JOINT_RIGHT_HAND, VFIT_JOINT_LEFT_ELBOW,
                                     VFIT_JOINT_RIGHT_ELBOW};

struct Errors {
    std::vector<double> hidden, seen;  // m across the view, of the hinted joints by what the camera sees
    static double mean(const std::vector<double>& of) {
        double sum = 0.0;
        for (const double e : of) sum += e;
        return sum / double(std::max<size_t>(1, of.size()));
    }
};

class HintsTest : public contract::ContextTest {
protected:
    vfit_joint_hint hint_of(vfit_frame frame, const vfit_joint& joint) {
        const contract::Pixel at = contract::pixel_of(frame, joint);
        vfit_joint_hint hint = vfit_joint_hint_init();
        hint.joint = joint.joint;
        hint.x = at.x, hint.y = at.y;
        return hint;
    }
    /// Somebody turns about, so that one arm after the other is behind the body; hints `off` pixels from the
    /// truth.
    Errors run(float confidence, float off, int frames, vfit_track_fit fit = VFIT_FIT_AUTO) {
        Errors errors;
        vfit_sensor sensor{};
        const std::string uri =
            "virtual:motion=turn&rate=15&sensor=kinect_v1_320&seed=5&frames=" + std::to_string(frames);
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK);
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.joints = VFIT_TRACK_BUILT_IN;
        desc.fit = fit;
        vfit_tracker tracker{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &tracker), VFIT_OK);
        vfit_frame frame{};
        for (int index = 0; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK; ++index) {
            const auto truth = contract::joints_of(frame, 1);
            std::vector<vfit_joint_hint> hints;
            for (const vfit_joint_id id : kHinted) {
                hints.push_back(hint_of(frame, truth[size_t(id)]));
                hints.back().confidence = confidence;
                hints.back().x += off * std::cos(2.4f * float(index));
                hints.back().y += off * std::sin(2.4f * float(index));
            }
            if (confidence > 0.0f) {
                EXPECT_EQ(vfit_tracker_hint(tracker, hints.data(), sizeof hints[0], uint32_t(hints.size())),
                          VFIT_OK)
                    << contract::last_error();
            }
            vfit_frame tracked{};
            EXPECT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
            uint32_t bodies = 0;
            EXPECT_EQ(vfit_frame_bodies(tracked, nullptr, 0, &bodies), VFIT_OK);
            if (bodies == 1)
                for (const vfit_joint& j : contract::joints_of(tracked, 1))
                    if (std::find(std::begin(kHinted), std::end(kHinted), j.joint) != std::end(kHinted)) {
                        const vfit_joint& t = truth[size_t(j.joint)];
                        // Across the view of the level camera: a hint says nothing of depth.
                        const double e =
                            std::hypot(j.position[0] - t.position[0], j.position[1] - t.position[1]);
                        (t.state == VFIT_JOINT_MEASURED ? errors.seen : errors.hidden).push_back(e);
                    }
            vfit_frame_release(tracked);
            vfit_frame_release(frame);
        }
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        EXPECT_EQ(vfit_tracker_destroy(tracker), VFIT_OK);
        return errors;
    }
};

}  // namespace

TEST_F(HintsTest, RightOnesHelpWhereAnArmIsHiddenAndWrongOnesDoLimitedHarm) {
    for (const vfit_track_fit fit : {VFIT_FIT_OFF, VFIT_FIT_AUTO}) {
        const int frames = fit == VFIT_FIT_OFF ? 190 : 110;  // half the turn is enough for the second
        const Errors without = run(0.0f, 0.0f, frames, fit), right = run(0.9f, 0.0f, frames, fit);
        const Errors wrong = run(0.5f, 40.0f, frames, fit);
        ASSERT_GT(without.hidden.size(), 20u);
        ASSERT_GT(without.seen.size(), 100u);
        const std::string joints = fit == VFIT_FIT_OFF ? "network" : "fit";
        for (const auto& [hints, errors] :
             {std::pair{"none", &without}, {"right", &right}, {"wrong_by_40_pixels", &wrong}})
            for (const auto& [arm, of] : {std::pair{"hidden", &errors->hidden}, {"seen", &errors->seen}})
                RecordProperty(joints + "_" + hints + "_" + arm + "_mm",
                               std::to_string(std::lround(1000 * Errors::mean(*of))));
        EXPECT_LT(Errors::mean(right.hidden), 0.8 * Errors::mean(without.hidden));
        EXPECT_LT(Errors::mean(right.seen), Errors::mean(without.seen) + 0.002);
        EXPECT_LT(Errors::mean(wrong.hidden), Errors::mean(without.hidden) + 0.02);
        EXPECT_LT(Errors::mean(wrong.seen), Errors::mean(without.seen) + 0.02);
    }
}

TEST_F(HintsTest, FarFromAnybodyTheyChangeNothing) {
    const Errors without = run(0.0f, 0.0f, 30), far = run(1.0f, 600.0f, 30);
    EXPECT_EQ(without.hidden, far.hidden);
    EXPECT_EQ(without.seen, far.seen);
}

TEST_F(HintsTest, BadOnesAreRefusedByNameAndNoneIsTaken) {
    vfit_tracker tracker{};
    ASSERT_EQ(vfit_tracker_create(context, nullptr, &tracker), VFIT_OK);
    vfit_joint_hint hints[2] = {vfit_joint_hint_init(), vfit_joint_hint_init()};
    hints[1].joint = VFIT_JOINT_LEFT_HAND;
    hints[1].confidence = 0.5f;
    const auto give = [&] { return vfit_tracker_hint(tracker, hints, sizeof hints[0], 2); };
    EXPECT_EQ(give(), VFIT_OK) << contract::last_error();
    const vfit_joint_hint good = hints[1];
    hints[1].joint = 23;
    EXPECT_EQ(give(), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("23"), std::string::npos);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (float vfit_joint_hint::* field :
             {&vfit_joint_hint::x, &vfit_joint_hint::y, &vfit_joint_hint::confidence}) {
            hints[1] = good;
            hints[1].*field = bad;
            EXPECT_EQ(give(), VFIT_ERROR_DATA);
            EXPECT_NE(contract::last_error().find("LEFT_HAND"), std::string::npos);
        }
    for (const float bad : {-0.1f, 1.1f}) {
        hints[1] = good;
        hints[1].confidence = bad;
        EXPECT_EQ(give(), VFIT_ERROR_ARGUMENT);
    }
    hints[1] = good;
    hints[1].body_id = 256;
    EXPECT_EQ(give(), VFIT_ERROR_ARGUMENT);
    hints[1] = good;
    EXPECT_EQ(vfit_tracker_hint(tracker, nullptr, sizeof hints[0], 2), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint(tracker, hints, 3, 2), VFIT_ERROR_ARGUMENT);
    const std::vector<vfit_joint_hint> many(500, good);
    EXPECT_EQ(vfit_tracker_hint(tracker, many.data(), sizeof many[0], 500), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint(tracker, nullptr, 0, 0), VFIT_OK);
}
