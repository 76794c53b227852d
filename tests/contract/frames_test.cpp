// Frames of the host: made, shared, viewed, written, released; bodies submitted to them.
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "contract/support.h"

using contract::ContextTest;
using contract::HostImage;

namespace {

class FrameTest : public ContextTest {
protected:
    vfit_frame make_frame() {
        const vfit_frame_desc desc = image.desc();
        vfit_frame frame{};
        EXPECT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
        return frame;
    }
    vfit_result create(const vfit_frame_desc& desc) {
        vfit_frame frame{};
        const vfit_result result = vfit_frame_create(context, &desc, &frame);
        if (result < 0) {
            EXPECT_EQ(frame.id, 0u);
        }
        return result;
    }
    HostImage image;
};

}  // namespace

TEST_F(FrameTest, PixelsAreCopiedAndComeBackAsTheyWere) {
    const vfit_frame frame = make_frame();
    const std::vector<uint16_t> before = image.depth;
    std::fill(image.depth.begin(), image.depth.end(), uint16_t(9));
    vfit_view view = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_OK);
    EXPECT_EQ(view.width, HostImage::kWidth);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(view.data) % 16, 0u);
    EXPECT_EQ(std::memcmp(view.data, before.data(), before.size() * 2), 0);
    vfit_stream streams[4];
    uint32_t count = 4;
    ASSERT_EQ(vfit_frame_streams(frame, streams, &count), VFIT_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_ERROR_HANDLE);
}

TEST_F(FrameTest, AFrameLivesAsLongAsItsReferences) {
    const vfit_frame frame = make_frame();
    ASSERT_EQ(vfit_frame_retain(frame), VFIT_OK);
    ASSERT_EQ(vfit_frame_release(frame), VFIT_OK);
    vfit_view view = vfit_view_init();
    EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_OK);
    ASSERT_EQ(vfit_frame_release(frame), VFIT_OK);
    EXPECT_EQ(vfit_frame_release(frame), VFIT_ERROR_HANDLE);
}

TEST_F(FrameTest, LentPixelsAreNotCopiedAndReleasedOnce) {
    std::atomic<int> released{0};
    vfit_frame_desc desc = image.desc();
    desc.release = [](void* user) { ++*static_cast<std::atomic<int>*>(user); };
    desc.user = &released;
    vfit_frame frame{};
    ASSERT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK);
    vfit_view view = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_OK);
    EXPECT_EQ(view.data, image.depth.data());
    EXPECT_EQ(released.load(), 0);
    vfit_frame_release(frame);
    EXPECT_EQ(released.load(), 1);
    image.views[0].format = VFIT_FORMAT_F32;
    desc = image.desc();
    desc.release = [](void* user) { ++*static_cast<std::atomic<int>*>(user); };
    desc.user = &released;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(released.load(), 1) << "a failed create must not release";
}

TEST_F(FrameTest, WrongPixelsAreRefusedByName) {
    vfit_frame_desc desc = image.desc();
    desc.count = 0;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    desc.count = 9;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    desc = image.desc();
    desc.intrinsics = nullptr;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    desc = image.desc();
    desc.streams = nullptr;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    image.views[0].data = nullptr;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("depth"), std::string::npos);
    image = HostImage();
    image.views[1].width = 17;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("17"), std::string::npos);
    image = HostImage();
    image.views[0].row_stride = 10;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    image = HostImage();
    image.streams[1] = VFIT_STREAM_DEPTH;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    image = HostImage();
    image.streams[0] = VFIT_STREAM_POSITION;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
}

TEST_F(FrameTest, WrongCamerasAreRefusedByName) {
    for (const float focal :
         {0.0f, -5.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        image.intrinsics.fx = focal;
        EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT) << focal;
    }
    image = HostImage();
    image.intrinsics.width = 1u << 30;
    image.views[0].width = image.views[1].width = 1u << 30;
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    image = HostImage();
    vfit_camera camera = vfit_camera_init();
    camera.floor_state = VFIT_FLOOR_GIVEN;
    vfit_frame_desc desc = image.desc();
    desc.camera = &camera;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT) << "a floor without a normal";
    camera = vfit_camera_init();
    camera.depth_unit_m = 7.0f;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
    image.intrinsics.distortion[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(create(image.desc()), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("distortion"), std::string::npos);
}

TEST_F(FrameTest, TheCameraTellsItsHeightAndTilt) {
    constexpr float kTilt = 0.3f, kHeight = 1.8f;
    vfit_camera camera = vfit_camera_init();
    camera.floor_state = VFIT_FLOOR_GIVEN;
    camera.floor_normal[1] = -std::cos(kTilt);
    camera.floor_normal[2] = -std::sin(kTilt);
    camera.floor_distance_m = kHeight;
    vfit_frame_desc desc = image.desc();
    desc.camera = &camera;
    vfit_frame frame{};
    ASSERT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
    vfit_camera out = vfit_camera_init();
    ASSERT_EQ(vfit_frame_camera(frame, &out), VFIT_OK);
    EXPECT_EQ(out.floor_state, VFIT_FLOOR_GIVEN);
    EXPECT_NEAR(out.height_m, kHeight, 1e-5);
    EXPECT_NEAR(out.tilt_rad, kTilt, 1e-5);
    EXPECT_NEAR(out.roll_rad, 0.0f, 1e-5);
    EXPECT_NEAR(out.depth_unit_m, 0.001f, 1e-9);
    // The point of the floor below the camera is the world's origin.
    const float p[3] = {-camera.floor_normal[0] * kHeight, -camera.floor_normal[1] * kHeight,
                        -camera.floor_normal[2] * kHeight};
    for (int row = 0; row < 3; ++row) {
        const float* m = out.world_from_camera;
        EXPECT_NEAR(m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row], 0.0f, 1e-5) << row;
    }
}

TEST_F(FrameTest, WritesAtTheHostsStrideAndFormatAndSkipsWhatItHas) {
    const vfit_frame frame = make_frame();
    std::vector<float> metres(HostImage::kWidth * HostImage::kHeight * 2, -1.0f);
    vfit_target target = vfit_target_init();
    target.format = VFIT_FORMAT_F32;
    target.data = metres.data();
    target.capacity = metres.size() * sizeof(float);
    target.item_stride = 8;
    uint64_t serial = 0;
    ASSERT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, &serial), VFIT_OK)
        << contract::last_error();
    EXPECT_FLOAT_EQ(metres[0], 3.0f);
    EXPECT_FLOAT_EQ(metres[1], -1.0f) << "between items nothing is written";
    EXPECT_NE(serial, 0u);
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, &serial), VFIT_NOT_READY);
    target.capacity -= 8;
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, nullptr), VFIT_ERROR_CAPACITY);
    target.capacity += 8;
    target.format = VFIT_FORMAT_F32X3;
    target.item_stride = 0;
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, nullptr), VFIT_ERROR_CAPACITY);
    target.format = 99;
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, nullptr), VFIT_ERROR_ARGUMENT);
    target.format = VFIT_FORMAT_U8;
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, nullptr), VFIT_ERROR_UNSUPPORTED);
    target.format = VFIT_FORMAT_NONE;
    target.data = nullptr;
    EXPECT_EQ(vfit_frame_write(frame, VFIT_STREAM_DEPTH, &target, nullptr), VFIT_ERROR_ARGUMENT);
}

TEST_F(FrameTest, ViewsOfALaterCallersSizeAreFoundOneAfterTheOther) {
    struct NewerView {
        vfit_view known;
        uint64_t more;
    } views[2] = {{image.views[0], 0}, {image.views[1], 0}};
    for (NewerView& view : views) view.known.struct_size = sizeof view;
    vfit_frame_desc desc = image.desc();
    desc.views = &views[0].known;
    EXPECT_EQ(create(desc), VFIT_OK) << contract::last_error();
    views[1].more = 1;
    EXPECT_EQ(create(desc), VFIT_ERROR_UNSUPPORTED);
    views[0].known.struct_size = 0;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
}

TEST_F(FrameTest, LentPixelsMustLieWhereTheirFormatCanBeRead) {
    vfit_frame_desc desc = image.desc();
    desc.release = [](void*) { ADD_FAILURE() << "a failed create must not release"; };
    image.views[0].data = reinterpret_cast<const char*>(image.depth.data()) + 1;
    EXPECT_EQ(create(desc), VFIT_ERROR_ARGUMENT);
}

TEST_F(FrameTest, AHostMayHandOnTheEstimatedFloorOfAnotherFrame) {
    vfit_camera camera = vfit_camera_init();
    camera.floor_state = VFIT_FLOOR_ESTIMATED;
    camera.floor_normal[1] = -1.0f;
    camera.floor_distance_m = 1.3f;
    vfit_frame_desc desc = image.desc();
    desc.camera = &camera;
    vfit_frame frame{};
    ASSERT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
    vfit_camera out = vfit_camera_init();
    ASSERT_EQ(vfit_frame_camera(frame, &out), VFIT_OK);
    EXPECT_EQ(out.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_FLOAT_EQ(out.height_m, 1.3f);
}

TEST_F(FrameTest, TheContextTellsTheMemoryOfItsFrames) {
    vfit_context_stats stats = vfit_context_stats_init();
    ASSERT_EQ(vfit_context_describe(context, &stats), VFIT_OK);
    EXPECT_EQ(stats.frame_bytes, 0u);
    make_frame();
    ASSERT_EQ(vfit_context_describe(context, &stats), VFIT_OK);
    EXPECT_EQ(stats.frame_bytes, HostImage::kWidth * HostImage::kHeight * 3u);
}

TEST_F(FrameTest, ThePoolIsBoundedAndSaysSo) {
    std::vector<vfit_frame> held;
    const vfit_frame_desc desc = image.desc();
    vfit_result result = VFIT_OK;
    while (held.size() < 1000) {
        vfit_frame frame{};
        result = vfit_frame_create(context, &desc, &frame);
        if (result != VFIT_OK) break;
        held.push_back(frame);
    }
    EXPECT_EQ(result, VFIT_ERROR_BUSY);
    EXPECT_LT(held.size(), 1000u);
    vfit_frame_release(held.back());
    held.pop_back();
    const vfit_frame again = make_frame();
    EXPECT_NE(again.id, 0u);
}

namespace {

class SubmitTest : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        frame = make_frame();
        ASSERT_EQ(vfit_tracker_create(context, nullptr, &tracker), VFIT_OK);
        body = vfit_body_init();
        body.body_id = 1;
        joints = contract::standing_joints();
    }
    vfit_result submit(vfit_frame to) {
        tracked = {};
        return vfit_tracker_submit(tracker, to, &body, joints.data(), sizeof(vfit_joint),
                                   static_cast<uint32_t>(joints.size()), &tracked);
    }
    vfit_frame frame{}, tracked{};
    vfit_tracker tracker{};
    vfit_body body;
    std::vector<vfit_joint> joints;
};

}  // namespace

TEST_F(SubmitTest, AFrameWithoutBodiesIsUnsupportedWhereTheyMustBeTheSources) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = VFIT_TRACK_GIVEN;
    vfit_tracker given{};
    ASSERT_EQ(vfit_tracker_create(context, &desc, &given), VFIT_OK);
    EXPECT_EQ(vfit_tracker_update(given, frame, &tracked), VFIT_ERROR_UNSUPPORTED);
    EXPECT_NE(contract::last_error().find("no joints"), std::string::npos);
    EXPECT_EQ(tracked.id, 0u);
    desc.joints = 9;
    EXPECT_EQ(vfit_tracker_create(context, &desc, &given), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("joints"), std::string::npos);
}

TEST_F(SubmitTest, TheTrackerFindsNobodyInAnImageOfNobody) {
    vfit_frame_desc desc = image.desc();
    desc.count = 1;  // without a user map
    vfit_frame bare{};
    ASSERT_EQ(vfit_frame_create(context, &desc, &bare), VFIT_OK);
    ASSERT_EQ(vfit_tracker_update(tracker, bare, &tracked), VFIT_OK) << contract::last_error();
    uint32_t count = 9;
    EXPECT_EQ(vfit_frame_bodies(tracked, nullptr, 0, &count), VFIT_OK);
    EXPECT_EQ(count, 0u);
    vfit_view map = vfit_view_init();
    EXPECT_EQ(vfit_frame_view(tracked, VFIT_STREAM_USER_MAP, &map), VFIT_OK);
    EXPECT_EQ(vfit_tracker_reset(tracker), VFIT_OK);
}

TEST_F(SubmitTest, SubmittedJointsComeBackWithTheImagesShared) {
    ASSERT_EQ(submit(frame), VFIT_OK) << contract::last_error();
    uint32_t count = 0;
    ASSERT_EQ(vfit_frame_joints(tracked, 1, nullptr, 0, &count), VFIT_OK);
    ASSERT_EQ(count, 15u);
    std::vector<vfit_joint> out(count);
    ASSERT_EQ(vfit_frame_joints(tracked, 1, out.data(), sizeof(vfit_joint), &count), VFIT_OK);
    EXPECT_EQ(out[0].joint, VFIT_JOINT_HEAD);
    EXPECT_FLOAT_EQ(out[0].position[1], 1.60f);
    EXPECT_EQ(vfit_frame_joints(tracked, 2, nullptr, 0, &count), VFIT_ERROR_ARGUMENT);
    vfit_view a = vfit_view_init(), b = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &a), VFIT_OK);
    ASSERT_EQ(vfit_frame_view(tracked, VFIT_STREAM_DEPTH, &b), VFIT_OK);
    EXPECT_EQ(a.data, b.data);
    vfit_frame_release(frame);
    EXPECT_EQ(static_cast<const uint16_t*>(b.data)[0], 3000) << "the tracked frame keeps the images alive";
}

TEST_F(SubmitTest, ASecondBodyIsAddedAndTheSameIdTwiceIsRefused) {
    ASSERT_EQ(submit(frame), VFIT_OK);
    const vfit_frame first = tracked;
    EXPECT_EQ(submit(first), VFIT_ERROR_ARGUMENT);
    body.body_id = 2;
    ASSERT_EQ(submit(first), VFIT_OK);
    uint32_t count = 0;
    ASSERT_EQ(vfit_frame_bodies(tracked, nullptr, 0, &count), VFIT_OK);
    EXPECT_EQ(count, 2u);
}

TEST_F(SubmitTest, BadBodiesAreRefusedByName) {
    body.body_id = 0;
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    body.body_id = 256;
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    body.body_id = 1;
    body.flags = 64;
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    body.flags = 0;
    joints[5].position[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(submit(frame), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("LEFT_ELBOW"), std::string::npos);
    joints = contract::standing_joints();
    joints[3].joint = 99;
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    joints = contract::standing_joints();
    joints[3].state = 7;
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    joints.clear();
    EXPECT_EQ(submit(frame), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_submit(tracker, frame, &body, nullptr, sizeof(vfit_joint), 15, &tracked),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_tracker_submit(tracker, frame, nullptr, joints.data(), sizeof(vfit_joint), 0, &tracked),
              VFIT_ERROR_ARGUMENT);
}

TEST_F(SubmitTest, JointsInCameraSpaceAreCarriedToTheFloorBelowTheFeet) {
    for (vfit_joint& j : joints) {
        // World to the camera space of a level camera 1.2 m above the floor.
        j.position[1] = 1.2f - j.position[1];
        j.position[2] = -j.position[2];
    }
    body.flags = VFIT_BODY_CAMERA_SPACE;
    ASSERT_EQ(submit(frame), VFIT_OK) << contract::last_error();
    vfit_camera camera = vfit_camera_init();
    ASSERT_EQ(vfit_frame_camera(tracked, &camera), VFIT_OK);
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_NEAR(camera.height_m, 1.2f, 0.02f);
    uint32_t count = VFIT_JOINT_COUNT;
    std::vector<vfit_joint> out(count);
    ASSERT_EQ(vfit_frame_joints(tracked, 1, out.data(), sizeof(vfit_joint), &count), VFIT_OK);
    EXPECT_NEAR(out[0].position[1], 1.60f, 0.02f);
    EXPECT_NEAR(out[0].position[2], -2.0f, 1e-4f);
    vfit_body got = vfit_body_init();
    count = 1;
    ASSERT_EQ(vfit_frame_bodies(tracked, &got, sizeof got, &count), VFIT_OK);
    EXPECT_EQ(got.flags & VFIT_BODY_CAMERA_SPACE, 0u) << "bodies of a frame are in world space";
}

TEST_F(SubmitTest, TheTrackersFloorCarriesTheBodiesOfASourceThatKnowsNone) {
    for (vfit_joint& j : joints) {
        j.position[1] = 1.2f - j.position[1];
        j.position[2] = -j.position[2];
    }
    body.flags = VFIT_BODY_CAMERA_SPACE;
    ASSERT_EQ(submit(frame), VFIT_OK) << contract::last_error();
    const vfit_frame estimated = tracked;
    vfit_camera floor = vfit_camera_init();
    floor.floor_normal[1] = -1.0f;
    floor.floor_distance_m = 2.2f;
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.floor = &floor;
    vfit_tracker knows{};
    ASSERT_EQ(vfit_tracker_create(context, &desc, &knows), VFIT_OK) << contract::last_error();
    vfit_frame placed{};
    ASSERT_EQ(vfit_tracker_update(knows, estimated, &placed), VFIT_OK) << contract::last_error();
    vfit_camera camera = vfit_camera_init();
    ASSERT_EQ(vfit_frame_camera(placed, &camera), VFIT_OK);
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_GIVEN);
    EXPECT_FLOAT_EQ(camera.height_m, 2.2f);
    uint32_t count = VFIT_JOINT_COUNT;
    std::vector<vfit_joint> out(count);
    ASSERT_EQ(vfit_frame_joints(placed, 1, out.data(), sizeof(vfit_joint), &count), VFIT_OK);
    EXPECT_NEAR(out[0].position[1], 2.60f, 1e-4f) << "the camera is a metre higher, and so is the person";
    EXPECT_NEAR(out[0].position[2], -2.0f, 1e-4f);
    // A frame whose source knows its floor is left as it is.
    vfit_frame again{};
    ASSERT_EQ(vfit_tracker_update(tracker, placed, &again), VFIT_OK);
    ASSERT_EQ(vfit_frame_camera(again, &camera), VFIT_OK);
    EXPECT_FLOAT_EQ(camera.height_m, 2.2f);
}

TEST_F(SubmitTest, AFrameOfAnotherContextIsForeign) {
    const vfit_context_desc desc = contract::context_desc();
    vfit_context other{};
    ASSERT_EQ(vfit_context_create(&desc, &other), VFIT_OK);
    const vfit_frame_desc frame_desc = image.desc();
    vfit_frame foreign{};
    ASSERT_EQ(vfit_frame_create(other, &frame_desc, &foreign), VFIT_OK);
    EXPECT_EQ(submit(foreign), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_tracker_update(tracker, foreign, &tracked), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_context_destroy(other), VFIT_OK);
}

TEST_F(SubmitTest, AScanOfAHostsFrameTellsWhyItDoesNotTakeOne) {
    vfit_scan scan{};
    ASSERT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
    uint32_t count = 0;
    EXPECT_EQ(vfit_scan_measure(scan, nullptr, 0, &count), VFIT_ERROR_STATE);
    vfit_scale scale = vfit_scale_init();
    EXPECT_EQ(vfit_scan_scale(scan, "trousers", &scale), VFIT_ERROR_STATE);
    vfit_avatar avatar{};
    EXPECT_EQ(vfit_avatar_create_from_scan(context, nullptr, scan, &avatar), VFIT_ERROR_STATE);
    ASSERT_EQ(submit(frame), VFIT_OK);
    vfit_scan_state state = vfit_scan_state_init();
    EXPECT_EQ(vfit_scan_add(scan, tracked, 5, &state), VFIT_INCOMPLETE);
    EXPECT_EQ(state.guidance, VFIT_GUIDANCE_NOBODY);
    EXPECT_EQ(state.frames_taken, 0u);
    EXPECT_EQ(state.frames_wanted, 30u);
}

TEST_F(SubmitTest, AScanWithoutUserMapIsUnsupportedWithAClearMessage) {
    vfit_frame_desc desc = image.desc();
    desc.count = 1;
    vfit_frame bare{};
    ASSERT_EQ(vfit_frame_create(context, &desc, &bare), VFIT_OK);
    ASSERT_EQ(submit(bare), VFIT_OK);
    vfit_scan scan{};
    ASSERT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
    EXPECT_EQ(vfit_scan_add(scan, tracked, 1, nullptr), VFIT_ERROR_UNSUPPORTED);
    EXPECT_NE(contract::last_error().find("user map"), std::string::npos);
}

TEST_F(SubmitTest, MotionFollowsASubmittedBodyAndHoldsWhenItLeaves) {
    vfit_motion motion{};
    ASSERT_EQ(vfit_motion_create(context, nullptr, &motion), VFIT_OK);
    uint32_t count = 0;
    EXPECT_EQ(vfit_motion_pose(motion, nullptr, nullptr, 0, &count), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_motion_step(motion, {}, 1, 0), VFIT_NOT_READY);
    body.time_ns = 1000000000;
    ASSERT_EQ(submit(frame), VFIT_OK);
    ASSERT_EQ(vfit_motion_step(motion, tracked, 1, 1000000000), VFIT_OK) << contract::last_error();
    vfit_pose pose = vfit_pose_init();
    count = VFIT_BONE_COUNT;
    std::vector<vfit_bone> bones(count);
    ASSERT_EQ(vfit_motion_pose(motion, &pose, bones.data(), sizeof(vfit_bone), &count), VFIT_OK);
    EXPECT_EQ(count, uint32_t(VFIT_BONE_COUNT));
    for (const vfit_bone& b : bones) {
        const float* q = b.rotation;
        EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0f, 1e-3f) << b.bone;
    }
    EXPECT_EQ(vfit_motion_step(motion, tracked, 9, 1100000000), VFIT_NOT_READY) << "that person is not there";
    EXPECT_EQ(vfit_motion_pose(motion, &pose, bones.data(), sizeof(vfit_bone), &count), VFIT_OK);
}
