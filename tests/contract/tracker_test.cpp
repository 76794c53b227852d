// What a host may ask of a tracker beside bodies: whom it serves, and whether joints are steadied.
#include <cmath>

#include "contract/support.h"
#include "support/tiny_character.h"

using contract::ContextTest;
using contract::HostImage;

namespace {

constexpr int64_t kFrame_ns = 33'333'333;

class TrackerTest : public ContextTest {
protected:
    vfit_tracker make_tracker(const vfit_tracker_desc& desc) {
        vfit_tracker out{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &out), VFIT_OK) << contract::last_error();
        return out;
    }
    vfit_frame make_frame(int64_t time_ns) {
        vfit_frame_desc desc = image.desc();
        desc.time_ns = time_ns;
        vfit_frame out{};
        EXPECT_EQ(vfit_frame_create(context, &desc, &out), VFIT_OK) << contract::last_error();
        return out;
    }
    /// The frame with somebody more in it, who stands that far to the side of standing_joints and closer by
    /// that; `to` is given back.
    vfit_frame with(vfit_tracker tracker, vfit_frame to, uint32_t id, float aside, float closer) {
        std::vector<vfit_joint> joints = contract::standing_joints();
        for (vfit_joint& j : joints) {
            j.position[0] += aside;
            j.position[2] += closer;
        }
        vfit_body body = vfit_body_init();
        body.body_id = id;
        vfit_frame out{};
        EXPECT_EQ(vfit_tracker_submit(tracker, to, &body, joints.data(), sizeof(vfit_joint),
                                      uint32_t(joints.size()), &out),
                  VFIT_OK)
            << contract::last_error();
        EXPECT_EQ(vfit_frame_release(to), VFIT_OK);
        return out;
    }
    /// The active body of a frame, which is given back.
    struct Active {
        uint32_t id = 99;
        vfit_active_state state = -1;
    };
    Active active_of(vfit_frame frame) {
        Active out;
        EXPECT_EQ(vfit_frame_active_body(frame, &out.id, &out.state), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
        return out;
    }
    HostImage image;
};

}  // namespace

TEST_F(TrackerTest, TheActiveBodyIsTheNearestByDefault) {
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    for (int i = 1; i < 5; ++i) {
        const vfit_frame one = with(tracker, make_frame(i * kFrame_ns), 1, -0.6f, 0.0f);
        const Active active = active_of(with(tracker, one, 2, 0.8f, 0.5f));
        EXPECT_EQ(active.id, 2u);
        EXPECT_EQ(active.state, VFIT_ACTIVE_BY_RULE);
    }
}

TEST_F(TrackerTest, TheActiveBodyMayBeTheMostCentredOrTheFirst) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.follow = VFIT_FOLLOW_CENTRED;
    const vfit_tracker centred = make_tracker(desc);
    EXPECT_EQ(
        active_of(with(centred, with(centred, make_frame(kFrame_ns), 1, -0.2f, 0.0f), 2, 0.8f, 0.5f)).id, 1u);
    desc.follow = VFIT_FOLLOW_FIRST;
    const vfit_tracker first = make_tracker(desc);
    EXPECT_EQ(active_of(with(first, make_frame(kFrame_ns), 7, 0.0f, -1.0f)).id, 7u);
    for (int i = 2; i < 100; ++i)
        ASSERT_EQ(
            active_of(with(first, with(first, make_frame(i * kFrame_ns), 1, 0.0f, 0.5f), 7, 0.0f, -1.0f)).id,
            7u);
}

TEST_F(TrackerTest, AChosenBodyIsActiveUntilItHasLeft) {
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    ASSERT_EQ(vfit_tracker_set_active(tracker, 1), VFIT_OK);
    Active active =
        active_of(with(tracker, with(tracker, make_frame(kFrame_ns), 1, -0.6f, 0.0f), 2, 0.8f, 0.5f));
    EXPECT_EQ(active.id, 1u);
    EXPECT_EQ(active.state, VFIT_ACTIVE_CHOSEN);
    active = active_of(with(tracker, make_frame(2 * kFrame_ns), 2, 0.8f, 0.5f));
    EXPECT_EQ(active.id, 1u);
    EXPECT_EQ(active.state, VFIT_ACTIVE_LOST);
    active = active_of(with(tracker, make_frame(80 * kFrame_ns), 2, 0.8f, 0.5f));
    EXPECT_EQ(active.id, 2u);
    EXPECT_EQ(active.state, VFIT_ACTIVE_BY_RULE);
}

TEST_F(TrackerTest, ABodyThatIsWaitedForHoldsPoseAndScan) {
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    vfit_motion motion{};
    vfit_scan scan{};
    ASSERT_EQ(vfit_motion_create(context, nullptr, &motion), VFIT_OK);
    ASSERT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
    const vfit_frame there = with(tracker, make_frame(kFrame_ns), 3, 0.0f, 0.0f);
    uint32_t id = 0;
    ASSERT_EQ(vfit_frame_active_body(there, &id, nullptr), VFIT_OK);
    EXPECT_EQ(vfit_motion_step(motion, there, id, kFrame_ns), VFIT_OK);
    const vfit_frame gone = with(tracker, make_frame(2 * kFrame_ns), 4, 0.0f, -0.5f);
    ASSERT_EQ(vfit_frame_active_body(gone, &id, nullptr), VFIT_OK);
    EXPECT_EQ(id, 3u);
    EXPECT_EQ(vfit_motion_step(motion, gone, id, 2 * kFrame_ns), VFIT_NOT_READY);
    vfit_scan_state state = vfit_scan_state_init();
    EXPECT_EQ(vfit_scan_add(scan, gone, id, &state), VFIT_INCOMPLETE);
}

TEST_F(TrackerTest, AFrameWithoutTrackerHasItsFirstBodyAndResetForgetsTheChoice) {
    Active active = active_of(make_frame(kFrame_ns));
    EXPECT_EQ(active.id, 0u);
    EXPECT_EQ(active.state, VFIT_ACTIVE_NOBODY);
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    ASSERT_EQ(vfit_tracker_set_active(tracker, 200), VFIT_OK);
    ASSERT_EQ(vfit_tracker_reset(tracker), VFIT_OK);
    EXPECT_EQ(active_of(with(tracker, make_frame(kFrame_ns), 5, 0.0f, 0.0f)).id, 5u);
}

TEST_F(TrackerTest, WrongRulesAndIdsAreRefusedByName) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    for (const int32_t rule : {-1, 4, 1000}) {
        desc.follow = rule;
        vfit_tracker none{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &none), VFIT_ERROR_ARGUMENT) << rule;
        EXPECT_NE(contract::last_error().find("follow"), std::string::npos);
    }
    desc = vfit_tracker_desc_init();
    for (const int32_t fit : {-1, 3, 1000}) {
        desc.fit = fit;
        vfit_tracker none{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &none), VFIT_ERROR_ARGUMENT) << fit;
        EXPECT_NE(contract::last_error().find("desc.fit"), std::string::npos);
    }
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    EXPECT_EQ(vfit_tracker_set_active(tracker, 256), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("256"), std::string::npos);
    const vfit_frame frame = make_frame(kFrame_ns);
    EXPECT_EQ(vfit_frame_active_body(frame, nullptr, nullptr), VFIT_ERROR_ARGUMENT);
}

namespace {

/// Submits somebody frame by frame whose head jumps to and fro by a centimetre.
class FilterTest : public TrackerTest {
protected:
    vfit_joint head_after(vfit_joint_filter filter, int frames, float confidence = 1.0f) {
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.filter = filter;
        const vfit_tracker tracker = make_tracker(desc);
        vfit_joint head = vfit_joint_init();
        for (int i = 1; i <= frames; ++i) {
            std::vector<vfit_joint> joints = contract::standing_joints();
            joints[0].position[0] = i % 2 ? 0.005f : -0.005f;
            joints[0].confidence = confidence;
            vfit_body body = vfit_body_init();
            body.body_id = 1;
            const vfit_frame frame = make_frame(i * kFrame_ns);
            vfit_frame tracked{};
            EXPECT_EQ(
                vfit_tracker_submit(tracker, frame, &body, joints.data(), sizeof(vfit_joint), 15, &tracked),
                VFIT_OK)
                << contract::last_error();
            std::vector<vfit_joint> out(VFIT_JOINT_COUNT);
            uint32_t count = VFIT_JOINT_COUNT;
            EXPECT_EQ(vfit_frame_joints(tracked, 1, out.data(), sizeof(vfit_joint), &count), VFIT_OK);
            head = out[0];
            vfit_frame_release(tracked);
            vfit_frame_release(frame);
        }
        return head;
    }
};

}  // namespace

TEST_F(FilterTest, SubmittedJointsAreSteadiedUnlessTheHostWantsThemRaw) {
    EXPECT_LT(std::abs(head_after(VFIT_FILTER_AUTO, 30).position[0]), 0.004f);
    EXPECT_LT(std::abs(head_after(VFIT_FILTER_ON, 30).position[0]), 0.004f);
    EXPECT_FLOAT_EQ(head_after(VFIT_FILTER_OFF, 30).position[0], -0.005f);
}

TEST_F(FilterTest, TheirStatesFollowTheirConfidence) {
    EXPECT_EQ(head_after(VFIT_FILTER_AUTO, 2, 0.8f).state, VFIT_JOINT_MEASURED);
    EXPECT_EQ(head_after(VFIT_FILTER_AUTO, 2, 0.2f).state, VFIT_JOINT_INFERRED);
    EXPECT_EQ(head_after(VFIT_FILTER_AUTO, 2, 0.0f).joint, VFIT_JOINT_NECK)
        << "a head that nobody is sure of is not listed";
    EXPECT_EQ(head_after(VFIT_FILTER_OFF, 2, 0.0f).state, VFIT_JOINT_MEASURED);
}

TEST_F(FilterTest, JointsOfASourceStayAsTheyAreUnlessTheHostWantsThemSteadied) {
    for (const vfit_joint_filter filter : {VFIT_FILTER_AUTO, VFIT_FILTER_ON}) {
        vfit_sensor sensor{};
        ASSERT_EQ(vfit_sensor_open(context, "virtual:motion=wave&frames=45&sensor=kinect_v1_320", &sensor),
                  VFIT_OK);
        ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.filter = filter;
        const vfit_tracker tracker = make_tracker(desc);
        float moved = 0.0f;
        vfit_frame frame{};
        while (vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK) {
            vfit_frame tracked{};
            ASSERT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
            uint32_t before = VFIT_JOINT_COUNT, after = VFIT_JOINT_COUNT;
            std::vector<vfit_joint> a(before), b(after);
            ASSERT_EQ(vfit_frame_joints(frame, 1, a.data(), sizeof(vfit_joint), &before), VFIT_OK);
            ASSERT_EQ(vfit_frame_joints(tracked, 1, b.data(), sizeof(vfit_joint), &after), VFIT_OK);
            ASSERT_EQ(before, after);
            for (uint32_t i = 0; i < before; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    moved = std::max(moved, std::abs(a[i].position[axis] - b[i].position[axis]));
            vfit_frame_release(tracked);
            vfit_frame_release(frame);
        }
        if (filter == VFIT_FILTER_AUTO)
            EXPECT_EQ(moved, 0.0f);
        else
            EXPECT_GT(moved, 0.001f);
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
    }
}

TEST_F(FilterTest, AWrongFilterIsRefusedByName) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.filter = 3;
    vfit_tracker none{};
    EXPECT_EQ(vfit_tracker_create(context, &desc, &none), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("filter"), std::string::npos);
}

TEST_F(TrackerTest, AMapOfItsOwnHasTheIdsOfTheSourcesBodies) {
    vfit_sensor sensor{};
    ASSERT_EQ(vfit_sensor_open(context, "virtual:motion=wave&frames=10&sensor=kinect_v1_320", &sensor),
              VFIT_OK);
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.user_map = VFIT_TRACK_BUILT_IN;
    const vfit_tracker tracker = make_tracker(desc);
    vfit_frame frame{};
    while (vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK) {
        vfit_frame tracked{};
        ASSERT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
        vfit_view truth = vfit_view_init(), found = vfit_view_init();
        ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_USER_MAP, &truth), VFIT_OK);
        ASSERT_EQ(vfit_frame_view(tracked, VFIT_STREAM_USER_MAP, &found), VFIT_OK);
        EXPECT_NE(truth.data, found.data);
        double both = 0.0, either = 0.0;
        for (size_t i = 0; i < size_t(truth.width) * truth.height; ++i) {
            const bool a = static_cast<const uint8_t*>(truth.data)[i] == 1,
                       b = static_cast<const uint8_t*>(found.data)[i] == 1;
            both += a && b;
            either += a || b;
        }
        EXPECT_GT(both / either, 0.9);
        uint32_t joints = 0;
        EXPECT_EQ(vfit_frame_joints(tracked, 1, nullptr, 0, &joints), VFIT_OK);
        EXPECT_EQ(joints, VFIT_JOINT_COUNT);
        vfit_frame_release(tracked);
        vfit_frame_release(frame);
    }
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST_F(TrackerTest, ADepthUnitThatIsWrongIsNamed) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = desc.user_map = VFIT_TRACK_BUILT_IN;
    const vfit_tracker tracker = make_tracker(desc);
    vfit_camera camera = vfit_camera_init();
    camera.depth_unit_m = 0.01f;
    vfit_frame_desc wrong = image.desc();
    wrong.camera = &camera, wrong.time_ns = kFrame_ns;
    vfit_frame frame{}, tracked{};
    ASSERT_EQ(vfit_frame_create(context, &wrong, &frame), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("median is 30 m"), std::string::npos) << contract::last_error();
    EXPECT_EQ(tracked.id, 0u);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    frame = make_frame(2 * kFrame_ns);
    EXPECT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_frame_release(tracked), VFIT_OK);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
}

TEST_F(ContextTest, ACharacterIsScaledAndAScaleThatIsNoneIsRefused) {
    const std::vector<std::byte> file = vfit::TinyCharacter().glb();
    vfit_character_desc desc = vfit_character_desc_init();
    desc.bytes = file.data(), desc.byte_count = file.size();
    float stature_m[2] = {};
    for (const bool twice : {false, true}) {
        desc.scale = twice ? 2.0f : 0.0f;
        vfit_avatar avatar{};
        ASSERT_EQ(vfit_avatar_load(context, nullptr, &desc, &avatar), VFIT_OK) << contract::last_error();
        vfit_character_info info = vfit_character_info_init();
        EXPECT_EQ(vfit_avatar_describe(avatar, &info), VFIT_OK);
        stature_m[twice] = info.stature_m;
        EXPECT_EQ(vfit_avatar_destroy(avatar), VFIT_OK);
    }
    EXPECT_NEAR(stature_m[1], 2.0f * stature_m[0], 1e-3f);
    for (const float scale : {NAN, INFINITY, -1.0f, 1e-9f}) {
        desc.scale = scale;
        vfit_avatar avatar{};
        EXPECT_EQ(vfit_avatar_load(context, nullptr, &desc, &avatar), VFIT_ERROR_ARGUMENT) << scale;
        EXPECT_EQ(avatar.id, 0u);
    }
}
