// The body fit of the built-in tracker: whose joints it moves, and that it moves them to where they are.
#include <array>
#include <cmath>
#include <map>

#include "contract/support.h"

namespace {

class FitTest : public contract::ContextTest {
protected:
    /// Mean over the last frames of the first person's paper joints, metres, and who has rotations in the
    /// last one.
    struct Outcome {
        double error_m = 0.0;
        std::map<uint32_t, bool> rotations;
        uint32_t active = 0;
    };

    static bool has_rotation(const vfit_joint& j) {
        const float* q = j.rotation;
        const float length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (length != 0.0f) {
            EXPECT_NEAR(length, 1.0f, 1e-3f);
        }
        return length != 0.0f;
    }

    /// Frames of a virtual person through the tracker, one after the other in time. Returns in how many of
    /// them their left shoulder is nearer to the true right one.
    int exchanged_in(vfit_tracker tracker, const std::string& options, int64_t& time_ns) {
        vfit_sensor sensor{};
        const std::string uri =
            "virtual:sensor=kinect_v1&motion=wave&body=20106&seed=6&clothing=0.02"
            "&distance=2.9&floor=unknown&" +
            options;
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        int exchanged = 0;
        for (vfit_frame frame{}; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK;) {
            const vfit_stream stream = VFIT_STREAM_DEPTH;
            vfit_view depth = vfit_view_init();
            vfit_intrinsics intrinsics = vfit_intrinsics_init();
            EXPECT_EQ(vfit_frame_view(frame, stream, &depth), VFIT_OK);
            EXPECT_EQ(vfit_frame_intrinsics(frame, &intrinsics), VFIT_OK);
            vfit_frame_desc desc = vfit_frame_desc_init();
            desc.count = 1, desc.streams = &stream, desc.views = &depth, desc.intrinsics = &intrinsics;
            desc.time_ns = time_ns += 33'333'333;
            vfit_frame later{}, tracked{};
            EXPECT_EQ(vfit_frame_create(context, &desc, &later), VFIT_OK) << contract::last_error();
            EXPECT_EQ(vfit_tracker_update(tracker, later, &tracked), VFIT_OK) << contract::last_error();
            vfit_body body = vfit_body_init();
            uint32_t count = 1;
            EXPECT_EQ(vfit_frame_bodies(tracked, &body, sizeof body, &count), VFIT_OK);
            if (const auto joints = contract::joints_of(tracked, body.body_id); !joints.empty()) {
                const auto truth = contract::joints_of(frame, 1);
                const auto off_m = [&](int of_truth) {
                    const float *a = joints[VFIT_JOINT_LEFT_SHOULDER].position,
                                *b = truth[size_t(of_truth)].position;
                    return std::hypot(a[0] - b[0], a[2] - b[2]);
                };
                exchanged += off_m(VFIT_JOINT_RIGHT_SHOULDER) < off_m(VFIT_JOINT_LEFT_SHOULDER);
            }
            for (const vfit_frame f : {tracked, later, frame}) EXPECT_EQ(vfit_frame_release(f), VFIT_OK);
        }
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        return exchanged;
    }

    Outcome run(vfit_track_fit fit, int people) {
        Outcome out;
        vfit_sensor sensor{};
        const std::string uri =
            "virtual:motion=reach&rate=30&sensor=kinect_v1_320&clothing=0.02&seed=6&frames=24&people=" +
            std::to_string(people);
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.joints = VFIT_TRACK_BUILT_IN;  // with the source's user map, so that ids are the truth's
        desc.fit = fit;
        vfit_tracker tracker{};
        EXPECT_EQ(vfit_tracker_create(context, &desc, &tracker), VFIT_OK);
        vfit_frame frame{};
        size_t counted = 0;
        for (int index = 0; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK; ++index) {
            vfit_frame tracked{};
            EXPECT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
            std::array<vfit_body, 8> bodies{};
            uint32_t count = 8;
            EXPECT_EQ(vfit_frame_bodies(tracked, bodies.data(), sizeof(vfit_body), &count), VFIT_OK);
            EXPECT_EQ(vfit_frame_active_body(tracked, &out.active, nullptr), VFIT_OK);
            out.rotations.clear();
            for (uint32_t b = 0; b < count; ++b) {
                const auto joints = contract::joints_of(tracked, bodies[b].body_id);
                out.rotations[bodies[b].body_id] = !joints.empty() && has_rotation(joints.front());
                if (bodies[b].body_id != 1 || index < 8) continue;
                const auto truth = contract::joints_of(frame, 1);
                for (const vfit_joint& j : joints) {
                    if (j.joint >= 15) continue;
                    const float* a = j.position;
                    const float* b2 = truth[size_t(j.joint)].position;
                    out.error_m += std::hypot(a[0] - b2[0], a[1] - b2[1], a[2] - b2[2]);
                    ++counted;
                }
            }
            EXPECT_EQ(vfit_frame_release(tracked), VFIT_OK);
            EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
        }
        EXPECT_GT(counted, 150u);
        out.error_m /= double(counted);
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        EXPECT_EQ(vfit_tracker_destroy(tracker), VFIT_OK);
        return out;
    }
};

}  // namespace

TEST_F(FitTest, BringsJointsNearerToTheTruth) {
    const Outcome without = run(VFIT_FIT_OFF, 1), with = run(VFIT_FIT_AUTO, 1);
    EXPECT_FALSE(without.rotations.at(1));
    EXPECT_TRUE(with.rotations.at(1));
    EXPECT_LT(with.error_m, 0.8 * without.error_m);
}

TEST_F(FitTest, IsOfTheActivePersonOrOfEverybody) {
    const Outcome active = run(VFIT_FIT_AUTO, 2), all = run(VFIT_FIT_EVERYBODY, 2);
    ASSERT_EQ(active.rotations.size(), 2u);
    for (const auto& [id, rotated] : active.rotations) EXPECT_EQ(rotated, id == active.active) << id;
    for (const auto& [id, rotated] : all.rotations) EXPECT_TRUE(rotated) << id;
}

TEST_F(FitTest, AfterACutToASideViewLeftIsLeft) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = desc.user_map = VFIT_TRACK_BUILT_IN;
    vfit_tracker tracker{};
    ASSERT_EQ(vfit_tracker_create(context, &desc, &tracker), VFIT_OK);
    int64_t time_ns = 1;
    EXPECT_EQ(exchanged_in(tracker, "facing=0&frames=20", time_ns), 0);
    EXPECT_LE(exchanged_in(tracker, "facing=86&frames=10", time_ns), 1);
    EXPECT_EQ(vfit_tracker_destroy(tracker), VFIT_OK);
}
