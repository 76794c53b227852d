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

namespace {

/// Two virtual cameras that see one person, the second one from another side.
class OtherCameraTest : public contract::ContextTest {
protected:
    vfit_sensor open(const std::string& options) {
        vfit_sensor sensor{};
        EXPECT_EQ(vfit_sensor_open(context, ("virtual:" + options).c_str(), &sensor), VFIT_OK);
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        return sensor;
    }
    vfit_tracker tracker() {
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.joints = VFIT_TRACK_BUILT_IN;
        vfit_tracker out{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &out), VFIT_OK);
        return out;
    }
    static constexpr float kUnit[4] = {0, 0, 0, 1};
    /// The pose of a camera that stands elsewhere and is turned by 120 degrees.
    static constexpr float kThere[3] = {1.5f, 0.2f, -4.0f}, kTurned[4] = {0, 0.8660254f, 0, 0.5f};
    /// A point of this camera's world in that one's.
    static void carry_there(float (&p)[3]) {
        const float c = -0.5f, s = 0.8660254f;  // of 120 degrees about Y
        const float x = p[0] - kThere[0], z = p[2] - kThere[2];
        p[0] = c * x - s * z, p[1] -= kThere[1], p[2] = s * x + c * z;
    }
};

}  // namespace

TEST_F(OtherCameraTest, TellsWhichWayAPersonFaces) {
    // Three cameras are sure and wrong: the truth of a person who is seen from behind, with left and right
    // exchanged. Cameras that are believed where they are wrong are believed where they are right.
    vfit_sensor sensor = open("motion=scan&sex=m&seed=4&facing=180&frames=12");
    const vfit_tracker alone = tracker(), told = tracker(), other = tracker();
    vfit_frame frame{}, seen{}, first{}, second{};
    double across_alone = 0.0, across_told = 0.0;
    const auto left_of_right = [](vfit_frame tracked) {
        const auto joints = contract::joints_of(tracked, 1);
        return double(joints[VFIT_JOINT_LEFT_SHOULDER].position[0] -
                      joints[VFIT_JOINT_RIGHT_SHOULDER].position[0]);
    };
    while (vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK) {
        auto joints = contract::joints_of(frame, 1);
        for (vfit_joint& joint : joints) {
            joint.position[0] = -joint.position[0];  // about the person's own middle
            carry_there(joint.position);
        }
        vfit_body body = vfit_body_init();
        body.body_id = 9;
        ASSERT_EQ(vfit_tracker_submit(other, frame, &body, joints.data(), sizeof joints[0],
                                      uint32_t(joints.size()), &seen),
                  VFIT_OK)
            << contract::last_error();
        for (int camera = 0; camera < 3; ++camera)
            ASSERT_EQ(vfit_tracker_hint_from(told, seen, 9, kThere, kTurned), VFIT_OK)
                << contract::last_error();
        ASSERT_EQ(vfit_tracker_update(alone, frame, &first), VFIT_OK);
        ASSERT_EQ(vfit_tracker_update(told, frame, &second), VFIT_OK);
        across_alone = left_of_right(first), across_told = left_of_right(second);
        for (const vfit_frame f : {frame, seen, first, second}) vfit_frame_release(f);
    }
    EXPECT_LT(across_alone, -0.2) << "from behind the left is the image's left";
    EXPECT_GT(across_told, 0.2);
    for (const vfit_tracker each : {alone, told, other}) EXPECT_EQ(vfit_tracker_destroy(each), VFIT_OK);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST_F(OtherCameraTest, IsFoundByPeopleWhoWalkAbout) {
    vfit_sensor sensors[2] = {open("motion=walk&seed=3&frames=90"),
                              open("motion=walk&seed=3&frames=90&facing=90")};
    std::vector<float> points[2];
    vfit_frame frames[2]{};
    while (vfit_sensor_acquire(sensors[0], -1, &frames[0]) == VFIT_OK &&
           vfit_sensor_acquire(sensors[1], -1, &frames[1]) == VFIT_OK)
        for (int k = 0; k < 2; ++k) {
            const auto joints = contract::joints_of(frames[k], 1);
            const auto& p = joints[VFIT_JOINT_PELVIS].position;
            points[k].insert(points[k].end(), std::begin(p), std::end(p));
            vfit_frame_release(frames[k]);
        }
    float position[3], rotation[4], rms = 1.0f;
    ASSERT_EQ(vfit_world_align(context, points[0].data(), points[1].data(), uint32_t(points[0].size() / 3),
                               position, rotation, &rms),
              VFIT_OK)
        << contract::last_error();
    // The person has turned to their left before it: it stands to their right.
    EXPECT_NEAR(2.0f * std::atan2(rotation[1], rotation[3]), -1.5708f, 0.01f);
    EXPECT_NEAR(position[0], -2.7f, 0.05f);
    EXPECT_NEAR(position[1], 0.0f, 0.02f);
    EXPECT_NEAR(position[2], -2.7f, 0.05f);
    EXPECT_LT(rms, 0.02f);
    for (const vfit_sensor sensor : sensors) EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST_F(OtherCameraTest, BadPlacesAndPeopleAreRefused) {
    vfit_sensor sensor = open("motion=scan&frames=1");
    vfit_frame frame{};
    ASSERT_EQ(vfit_sensor_acquire(sensor, -1, &frame), VFIT_OK);
    const vfit_tracker own = tracker();
    const float here[3] = {0, 0, 0}, nowhere[3] = {0, NAN, 0}, far_off[3] = {0, 0, 1e9f},
                none[4] = {0, 0, 0, 0};
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 7, here, kUnit), VFIT_INCOMPLETE);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, nowhere, kUnit), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, far_off, kUnit), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, here, none), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, nullptr, kUnit), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, here, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_hint_from(own, {0}, 1, here, kUnit), VFIT_ERROR_HANDLE);
    for (int i = 0; i < 300; ++i) {
        const vfit_result result = vfit_tracker_hint_from(own, frame, 1, here, kUnit);
        EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_CAPACITY) << contract::last_error();
    }
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, here, kUnit), VFIT_ERROR_CAPACITY);
    EXPECT_EQ(vfit_tracker_reset(own), VFIT_OK);
    EXPECT_EQ(vfit_tracker_hint_from(own, frame, 1, here, kUnit), VFIT_OK);
    // An update takes what it was told, whatever comes of it.
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = VFIT_TRACK_GIVEN;
    vfit_tracker given{};
    ASSERT_EQ(vfit_tracker_create(context, &desc, &given), VFIT_OK);
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(vfit_tracker_hint_from(given, frame, 1, here, kUnit), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_tracker_hint_from(given, frame, 1, here, kUnit), VFIT_ERROR_CAPACITY);
    const contract::HostImage image;
    const vfit_frame_desc bare = image.desc();
    vfit_frame without_joints{}, tracked{};
    ASSERT_EQ(vfit_frame_create(context, &bare, &without_joints), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_tracker_update(given, without_joints, &tracked), VFIT_ERROR_UNSUPPORTED);
    EXPECT_EQ(vfit_tracker_hint_from(given, frame, 1, here, kUnit), VFIT_OK);
    // Joints that are nowhere say nothing.
    auto joints = contract::joints_of(frame, 1);
    joints[VFIT_JOINT_LEFT_HIP].position[0] = 2e38f;
    joints[VFIT_JOINT_RIGHT_HIP].position[0] = -2e38f;
    vfit_body body = vfit_body_init();
    body.body_id = 2;
    ASSERT_EQ(vfit_tracker_submit(given, frame, &body, joints.data(), sizeof joints[0],
                                  uint32_t(joints.size()), &tracked),
              VFIT_OK)
        << contract::last_error();
    EXPECT_EQ(vfit_tracker_hint_from(own, tracked, 2, here, kUnit), VFIT_ERROR_DATA);
    EXPECT_EQ(vfit_frame_release(tracked), VFIT_OK);
    EXPECT_EQ(vfit_frame_release(without_joints), VFIT_OK);
    EXPECT_EQ(vfit_tracker_destroy(given), VFIT_OK);
    float position[3], rotation[4];
    EXPECT_EQ(vfit_world_align(context, here, here, 1, position, rotation, nullptr), VFIT_ERROR_DATA);
    EXPECT_EQ(vfit_world_align(context, nullptr, here, 1, position, rotation, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_world_align(context, here, here, 1, nullptr, rotation, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_world_align(context, here, here, 1u << 30, position, rotation, nullptr),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    EXPECT_EQ(vfit_tracker_destroy(own), VFIT_OK);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST(WorldAlign, IsInTheAxesAndUnitOfTheContext) {
    for (const vfit_axes axes : {VFIT_AXES_RH_Y_UP, VFIT_AXES_UNITY, VFIT_AXES_UNREAL}) {
        vfit_context_desc desc = contract::context_desc();
        desc.axes = axes;
        vfit_context context{};
        ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK) << contract::last_error();
        const bool unreal = axes == VFIT_AXES_UNREAL;
        const float metre = unreal ? 100.0f : 1.0f;
        const int up = unreal ? 2 : 1, a = unreal ? 0 : 2, b = unreal ? 1 : 0;  // turned from a to b
        const float turn = 0.9f, moved[3] = {0.4f * metre, -0.7f * metre, 1.1f * metre};
        std::vector<float> here, there;
        for (int i = 0; i < 40; ++i) {
            float p[3], q[3];
            p[up] = 0.03f * metre * float(i % 5);
            p[a] = metre * std::cos(0.16f * float(i)),
            p[b] = metre * std::sin(0.16f * float(i)) + 2.0f * metre;
            q[up] = p[up];
            q[a] = std::cos(turn) * p[a] - std::sin(turn) * p[b];
            q[b] = std::sin(turn) * p[a] + std::cos(turn) * p[b];
            for (int k = 0; k < 3; ++k) q[k] += moved[k];
            there.insert(there.end(), std::begin(p), std::end(p));
            here.insert(here.end(), std::begin(q), std::end(q));
        }
        float position[3], rotation[4], rms = 1.0f;
        ASSERT_EQ(vfit_world_align(context, here.data(), there.data(), 40, position, rotation, &rms), VFIT_OK)
            << contract::last_error();
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(position[k], moved[k], 1e-3f * metre) << axes;
        EXPECT_NEAR(rotation[up], std::sin(0.5f * turn), 1e-3f) << axes;
        EXPECT_NEAR(rotation[3], std::cos(0.5f * turn), 1e-3f) << axes;
        EXPECT_LT(rms, 1e-3f * metre);
        EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
    }
}
