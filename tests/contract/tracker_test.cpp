// What a host may ask of a tracker beside bodies: whom it serves.
#include <cmath>

#include "contract/support.h"

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
    /// The frame with somebody more in it, who stands that far to the side of standing_joints and closer by that;
    /// `to` is given back.
    vfit_frame with(vfit_tracker tracker, vfit_frame to, uint32_t id, float aside, float closer) {
        std::vector<vfit_joint> joints = contract::standing_joints();
        for (vfit_joint& j : joints) {
            j.position[0] += aside;
            j.position[2] += closer;
        }
        vfit_body body = vfit_body_init();
        body.body_id = id;
        vfit_frame out{};
        EXPECT_EQ(vfit_tracker_submit(tracker, to, &body, joints.data(), sizeof(vfit_joint), uint32_t(joints.size()), &out),
                  VFIT_OK) << contract::last_error();
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
    EXPECT_EQ(active_of(with(centred, with(centred, make_frame(kFrame_ns), 1, -0.2f, 0.0f), 2, 0.8f, 0.5f)).id, 1u);
    desc.follow = VFIT_FOLLOW_FIRST;
    const vfit_tracker first = make_tracker(desc);
    EXPECT_EQ(active_of(with(first, make_frame(kFrame_ns), 7, 0.0f, -1.0f)).id, 7u);
    for (int i = 2; i < 100; ++i)
        ASSERT_EQ(active_of(with(first, with(first, make_frame(i * kFrame_ns), 1, 0.0f, 0.5f), 7, 0.0f, -1.0f)).id, 7u);
}

TEST_F(TrackerTest, AChosenBodyIsActiveUntilItHasLeft) {
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    ASSERT_EQ(vfit_tracker_set_active(tracker, 1), VFIT_OK);
    Active active = active_of(with(tracker, with(tracker, make_frame(kFrame_ns), 1, -0.6f, 0.0f), 2, 0.8f, 0.5f));
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
    const vfit_tracker tracker = make_tracker(vfit_tracker_desc_init());
    EXPECT_EQ(vfit_tracker_set_active(tracker, 256), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("256"), std::string::npos);
    const vfit_frame frame = make_frame(kFrame_ns);
    EXPECT_EQ(vfit_frame_active_body(frame, nullptr, nullptr), VFIT_ERROR_ARGUMENT);
}
