// The built-in tracker where people come, go and are hidden, as a host sees it: virtual people of whom it
// gets the depth alone.
#include <functional>
#include <set>

#include "contract/support.h"

using contract::ContextTest;

namespace {

constexpr int kSoon = 5;  // frames, a sixth of a second

/// The source's truth about one frame and what the tracker made of it.
struct Moment {
    bool in_view = false, whole = false;
    int seen = 0;              // of the paper's 15 joints
    int outside = 0;           // tracked joints whose place is outside the image
    int measured_outside = 0;  // of these, MEASURED
    std::vector<vfit_body> tracked;
};

class PeopleTest : public ContextTest {
protected:
    std::vector<vfit_body> bodies(vfit_frame frame) {
        uint32_t count = 0;
        EXPECT_EQ(vfit_frame_bodies(frame, nullptr, sizeof(vfit_body), &count), VFIT_OK);
        std::vector<vfit_body> out(count, vfit_body_init());
        if (count > 0) {
            EXPECT_EQ(vfit_frame_bodies(frame, out.data(), sizeof(vfit_body), &count), VFIT_OK);
        }
        return out;
    }
    Moment moment_of(vfit_frame frame, vfit_frame tracked) {
        Moment m;
        for (const vfit_body& body : bodies(frame)) {
            m.in_view = true;
            m.whole = !(body.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW);
            vfit_joint joints[VFIT_JOINT_COUNT];
            for (vfit_joint& j : joints) j = vfit_joint_init();
            uint32_t count = VFIT_JOINT_COUNT;
            EXPECT_EQ(vfit_frame_joints(frame, body.body_id, joints, sizeof joints[0], &count), VFIT_OK);
            for (uint32_t i = 0; i < count; ++i)
                m.seen += joints[i].joint <= VFIT_JOINT_RIGHT_FOOT && joints[i].state == VFIT_JOINT_MEASURED;
        }
        m.tracked = bodies(tracked);
        return m;
    }
    void count_outside(vfit_frame tracked, Moment& m) {
        vfit_intrinsics lens = vfit_intrinsics_init();
        EXPECT_EQ(vfit_frame_intrinsics(tracked, &lens), VFIT_OK);
        for (const vfit_body& body : m.tracked)
            for (const vfit_joint& joint : contract::joints_of(tracked, body.body_id)) {
                const contract::Pixel at = contract::pixel_of(tracked, joint);
                if (at.x > -1 && at.y > -1 && at.x < float(lens.width) + 1 && at.y < float(lens.height) + 1)
                    continue;
                ++m.outside;
                m.measured_outside += joint.state == VFIT_JOINT_MEASURED;
            }
    }
    /// Half the Kinect's resolution: what is tested here does not hang on it, and it takes a third of the
    /// time.
    std::vector<Moment> watch(const std::string& options, vfit_track_fit fit = VFIT_FIT_AUTO) {
        vfit_sensor sensor{};
        const std::string uri = "virtual:sensor=kinect_v1_320&floor=unknown&" + options;
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK) << contract::last_error();
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.joints = desc.user_map = VFIT_TRACK_BUILT_IN;
        desc.fit = fit;
        vfit_tracker tracker{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &tracker), VFIT_OK) << contract::last_error();
        std::vector<Moment> moments;
        vfit_frame frame{}, tracked{};
        while (vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK) {
            if (vfit_tracker_update(tracker, frame, &tracked) != VFIT_OK) {
                ADD_FAILURE() << contract::last_error();
                break;
            }
            moments.push_back(moment_of(frame, tracked));
            count_outside(tracked, moments.back());
            vfit_frame_release(tracked);
            vfit_frame_release(frame);
        }
        EXPECT_EQ(vfit_tracker_destroy(tracker), VFIT_OK);
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        return moments;
    }
};

using Is = std::function<bool(const Moment&)>;

size_t first_where(const std::vector<Moment>& moments, size_t begin, const Is& is) {
    while (begin < moments.size() && !is(moments[begin])) ++begin;
    return begin;
}

std::set<uint32_t> ids(const std::vector<Moment>& moments, size_t begin, size_t end) {
    std::set<uint32_t> out;
    for (size_t i = begin; i < end; ++i)
        for (const vfit_body& body : moments[i].tracked) out.insert(body.body_id);
    return out;
}

bool nobody_tracked(const Moment& m) { return m.tracked.empty(); }
bool somebody_tracked(const Moment& m) { return !m.tracked.empty(); }

}  // namespace

TEST_F(PeopleTest, AVisitorIsFoundKeepsTheIdAndIsGoneWhenGone) {
    const auto moments = watch("distance=3&motion=visit&frames=480&clothing=0.02&body=3");
    ASSERT_EQ(moments.size(), 480u);
    const size_t whole = first_where(moments, 0, [](const Moment& m) { return m.whole; });
    const size_t part = first_where(moments, whole, [](const Moment& m) { return !m.whole; });
    const size_t gone = first_where(moments, part, [](const Moment& m) { return !m.in_view; });
    ASSERT_LT(gone, 460u) << "the visit is over before the frames are";
    for (size_t i = 0; i < first_where(moments, 0, [](const Moment& m) { return m.in_view; }); ++i)
        EXPECT_TRUE(moments[i].tracked.empty()) << "a body in an empty room, frame " << i;
    EXPECT_LE(first_where(moments, whole, somebody_tracked), whole + kSoon);
    EXPECT_EQ(ids(moments, whole, part).size(), 1u);
    EXPECT_LE(first_where(moments, gone, nobody_tracked), gone + kSoon);
    EXPECT_TRUE(moments.back().tracked.empty());
}

TEST_F(PeopleTest, NoJointOutsideTheImageIsMeasured) {
    for (const vfit_track_fit fit : {VFIT_FIT_OFF, VFIT_FIT_AUTO}) {
        int outside = 0, measured = 0;
        for (int body = 1; body <= 3; ++body) {
            const auto moments = watch(
                "distance=1.6&camera_height=1.5&tilt=-4&motion=reach&frames=60&body=" + std::to_string(body),
                fit);
            for (const Moment& m : moments) outside += m.outside, measured += m.measured_outside;
        }
        EXPECT_GT(outside, 300) << "a person is seen to the knees";
        EXPECT_EQ(measured, 0) << "of " << outside << ", fit " << fit;
    }
}

TEST_F(PeopleTest, WhoWasHiddenForASecondIsFoundAgainSoonAfter) {
    const auto moments = watch("distance=3&motion=sway&occluder=3&frames=180&clothing=0.02&body=4");
    ASSERT_EQ(moments.size(), 180u);
    const size_t hidden = first_where(moments, 0, [](const Moment& m) { return m.seen == 0; });
    const size_t back = first_where(moments, hidden, [](const Moment& m) { return m.seen >= 8; });
    ASSERT_LT(back, 170u);
    ASSERT_GT(back, hidden + 25);
    const auto before = ids(moments, 0, 20);  // the box is not in view yet
    ASSERT_EQ(before.size(), 1u);
    for (size_t i = hidden + 10; i < back - 10; ++i)
        EXPECT_TRUE(moments[i].tracked.empty()) << "nobody can be seen in frame " << i;
    EXPECT_LE(first_where(moments, back, somebody_tracked), back + kSoon);
    EXPECT_EQ(moments.back().tracked.size(), 1u);
}

TEST_F(PeopleTest, ARoomAChairAndACoatRackAreNobody) {
    for (const char* furniture : {"", "chair,rack"})
        for (const Moment& m : watch(std::string("distance=3&people=0&frames=60&furniture=") + furniture))
            ASSERT_TRUE(m.tracked.empty()) << "furniture: " << furniture;
}
