// Cameras that stand on their sides or hang upside down, and images without a person: what the built-in
// tracker says of them.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "contract/support.h"
#include "support/shared_folder.h"

namespace {

class CameraStandTest : public contract::ContextTest {
protected:
    void SetUp() override {
        ContextTest::SetUp();
        vfit_tracker_desc desc = vfit_tracker_desc_init();
        desc.joints = desc.user_map = VFIT_TRACK_BUILT_IN;
        ASSERT_EQ(vfit_tracker_create(context, &desc, &tracker), VFIT_OK) << contract::last_error();
    }
    void TearDown() override {
        EXPECT_EQ(vfit_tracker_destroy(tracker), VFIT_OK);
        ContextTest::TearDown();
    }

    struct Outcome {
        uint32_t bodies = 0;
        vfit_camera camera = vfit_camera_init();
        std::string absence;  // "": not said
        std::vector<vfit_joint> joints;
    };

    Outcome update(vfit_frame frame) {
        Outcome out;
        vfit_frame tracked{};
        EXPECT_EQ(vfit_tracker_update(tracker, frame, &tracked), VFIT_OK) << contract::last_error();
        vfit_body bodies[8] = {vfit_body_init()};
        out.bodies = 8;
        EXPECT_EQ(vfit_frame_bodies(tracked, bodies, sizeof bodies[0], &out.bodies), VFIT_OK);
        if (out.bodies) out.joints = contract::joints_of(tracked, bodies[0].body_id);
        EXPECT_EQ(vfit_frame_camera(tracked, &out.camera), VFIT_OK);
        char text[256];
        if (vfit_frame_meta(tracked, "no_person", text, sizeof text, nullptr) == VFIT_OK) out.absence = text;
        EXPECT_EQ(vfit_frame_release(tracked), VFIT_OK);
        return out;
    }

    /// An image of the host; of its camera no more is known than the lens.
    Outcome update(const std::vector<uint16_t>& depth, uint32_t width, uint32_t height, float focal_px) {
        vfit_view view = vfit_view_init();
        view.format = VFIT_FORMAT_U16;
        view.data = const_cast<uint16_t*>(depth.data());
        view.width = width, view.height = height;
        vfit_intrinsics intrinsics = vfit_intrinsics_init();
        intrinsics.width = width, intrinsics.height = height;
        intrinsics.fx = intrinsics.fy = focal_px;
        intrinsics.cx = 0.5f * float(width - 1), intrinsics.cy = 0.5f * float(height - 1);
        const vfit_stream stream = VFIT_STREAM_DEPTH;
        vfit_frame_desc desc = vfit_frame_desc_init();
        desc.count = 1, desc.streams = &stream, desc.views = &view, desc.intrinsics = &intrinsics;
        desc.time_ns = time_ns += 33'333'333;
        vfit_frame frame{};
        EXPECT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
        const Outcome out = update(frame);
        EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
        return out;
    }

    /// The last of so many images of a virtual person in a room, seen by a camera that is turned by that many
    /// quarters.
    Outcome after(int frames, int quarters) {
        const std::string person = "virtual:sensor=ideal&motion=wave&body=77&seed=3&distance=2.9&frames=";
        return after(person + std::to_string(frames), quarters, 594.0f);
    }

    Outcome after(const std::string& uri, int quarters, float focal_px) {
        vfit_sensor sensor{};
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        Outcome last;
        for (vfit_frame frame{}; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK;) {
            vfit_view view = vfit_view_init();
            EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_OK);
            const bool lies = quarters % 2 != 0;
            const uint32_t width = lies ? view.height : view.width, height = lies ? view.width : view.height;
            std::vector<uint16_t> turned(size_t(width) * height);
            for (uint32_t v = 0; v < view.height; ++v) {
                const auto* row = reinterpret_cast<const uint16_t*>(static_cast<const uint8_t*>(view.data) +
                                                                    size_t(v) * view.row_stride);
                for (uint32_t u = 0; u < view.width; ++u) {
                    const uint32_t x = quarters == 1   ? view.height - 1 - v
                                       : quarters == 2 ? view.width - 1 - u
                                                       : v;
                    const uint32_t y = quarters == 1   ? u
                                       : quarters == 2 ? view.height - 1 - v
                                                       : view.width - 1 - u;
                    turned[size_t(quarters == 0 ? v : y) * width + (quarters == 0 ? u : x)] = row[u];
                }
            }
            EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
            last = update(turned, width, height, focal_px);
        }
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        return last;
    }

    vfit_tracker tracker{};
    int64_t time_ns = 0;
};

}  // namespace

TEST_F(CameraStandTest, PeopleShowWhichSideOfTheImageIsUp) {
    constexpr float kDegree = 3.14159265f / 180.0f;
    for (int quarters = 0; quarters < 4; ++quarters) {
        ASSERT_EQ(vfit_tracker_reset(tracker), VFIT_OK);
        const Outcome seen = after(8, quarters);
        ASSERT_EQ(seen.bodies, 1u) << quarters;
        EXPECT_EQ(seen.absence, "");
        EXPECT_EQ(seen.camera.floor_state, VFIT_FLOOR_ESTIMATED);
        EXPECT_NEAR(seen.camera.height_m, 1.0f, 0.05f) << quarters;
        const float off =
            std::remainder(seen.camera.roll_rad + float(quarters) * 90.0f * kDegree, 360.0f * kDegree);
        EXPECT_LT(std::abs(off), 3.0f * kDegree) << quarters << ": " << seen.camera.roll_rad / kDegree;
        EXPECT_GT(seen.joints[VFIT_JOINT_HEAD].position[1], 1.3f) << quarters;
    }
}

TEST_F(CameraStandTest, ARealWomanBeforeACameraOnItsSideIsFoundInTheFirstImage) {
    const std::string recording = vfit::test::shared_data("field/depthkit_chae_portrait");
    if (recording.empty()) GTEST_SKIP() << "no shared data";
    vfit_sensor sensor{};
    ASSERT_EQ(vfit_sensor_open(context, ("recording:" + recording).c_str(), &sensor), VFIT_OK);
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    int frames = 0;
    for (vfit_frame frame{}; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK; ++frames) {
        const Outcome seen = update(frame);
        ASSERT_EQ(seen.bodies, 1u) << frames << ": " << seen.absence;
        EXPECT_NEAR(std::abs(seen.camera.roll_rad), 1.5708f, 0.26f);
        const float stature = seen.joints[VFIT_JOINT_HEAD].position[1];
        EXPECT_TRUE(stature > 1.3f && stature < 1.8f) << stature;
        EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    }
    EXPECT_EQ(frames, 2);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST_F(CameraStandTest, FiveRealPeopleAreFoundFromTheFirstImageOnWhateverSideIsUp) {
    namespace fs = std::filesystem;
    const std::string still = vfit::test::shared_data("scenes/five_people_depth_mm.png");
    if (still.empty()) GTEST_SKIP() << "no shared data";
    const fs::path folder = fs::path(testing::TempDir()) / "vfit_five_people";
    fs::create_directories(folder / "depth");
    fs::copy_file(still, folder / "depth" / "000000.png", fs::copy_options::overwrite_existing);
    std::ofstream(folder / "camera.json")
        << R"({"format": "vfit-recording", "version": 1, "width": 640, "height": 480, "fx": 525, "fy": 525,)"
        << R"( "cx": 319.5, "cy": 239.5, "fps": 30, "depth_unit_m": 0.001})";
    const auto see_them = [&] {
        for (int quarters = 0; quarters < 4; ++quarters) {
            ASSERT_EQ(vfit_tracker_reset(tracker), VFIT_OK);
            const Outcome seen = after("recording:" + folder.string(), quarters, 525.0f);
            EXPECT_EQ(seen.bodies, 5u) << quarters;
            EXPECT_NEAR(seen.camera.height_m, 1.27f, 0.04f) << quarters;  // published with the picture
        }
    };
    see_them();
    // A picture that is shown again and again is no sign that its people are things.
    for (int images : {2, 40}) {
        for (int i = 1; i < images; ++i)
            fs::copy_file(still, folder / "depth" / (std::to_string(1000000 + i).substr(1) + ".png"),
                          fs::copy_options::overwrite_existing);
        see_them();
    }
    fs::remove_all(folder);
}

TEST_F(CameraStandTest, AChairTellsNothingAboutUp) {
    // With another side up the chair is taken for a person for a moment, and then is none.
    struct Box {
        float low[3], high[3];  // x, height, distance in metres
    };
    constexpr Box kChairAndBench[] = {
        {{-0.65f, 0.34f, 1.67f}, {-0.04f, 0.39f, 2.06f}}, {{-0.65f, 0.39f, 2.06f}, {-0.04f, 0.68f, 2.10f}},
        {{-0.69f, 0.00f, 1.82f}, {-0.61f, 0.39f, 1.90f}}, {{-0.08f, 0.00f, 1.82f}, {0.00f, 0.39f, 1.90f}},
        {{0.36f, 0.36f, 1.28f}, {1.04f, 0.41f, 1.81f}},   {{0.32f, 0.00f, 1.50f}, {0.40f, 0.41f, 1.58f}},
        {{1.00f, 0.00f, 1.50f}, {1.08f, 0.41f, 1.58f}}};
    constexpr uint32_t width = 320, height = 240;
    constexpr float focal_px = 290.0f, eye[] = {0.0f, 0.478f, 0.0f}, wall_m = 3.89f, tilt_deg = 19.5f;
    const float c = std::cos(tilt_deg / 57.29578f), s = std::sin(tilt_deg / 57.29578f);
    std::vector<uint16_t> depth(size_t(width) * height);
    for (uint32_t v = 0; v < height; ++v)
        for (uint32_t u = 0; u < width; ++u) {
            const float x = (float(u) - 159.5f) / focal_px, y = (float(v) - 119.5f) / focal_px;
            const float ray[] = {x, -c * y - s, c - s * y};
            float z = ray[2] > 0 ? wall_m / ray[2] : 9.0f;
            if (ray[1] < 0) z = std::min(z, -eye[1] / ray[1]);
            for (const Box& box : kChairAndBench) {
                float in = 0.0f, out = 9.0f;
                for (int k = 0; k < 3; ++k) {
                    const float a = (box.low[k] - eye[k]) / ray[k], b = (box.high[k] - eye[k]) / ray[k];
                    in = std::max(in, std::min(a, b)), out = std::min(out, std::max(a, b));
                }
                if (in < out) z = std::min(z, in);
            }
            depth[size_t(v) * width + u] = z < 7.0f ? uint16_t(std::lround(1000.0f * z)) : uint16_t(0);
        }
    for (int image = 0; image < 3; ++image) {
        const Outcome seen = update(depth, width, height, focal_px);
        EXPECT_EQ(seen.bodies, 0u) << image;
        EXPECT_EQ(seen.camera.floor_state, VFIT_FLOOR_ESTIMATED) << image;
        EXPECT_NEAR(seen.camera.height_m, eye[1], 0.02f) << image;
        EXPECT_NEAR(seen.camera.tilt_rad * 57.29578f, tilt_deg, 1.0f) << image;
    }
}

TEST_F(CameraStandTest, APersonFiveMetresBeforeATimeOfFlightCameraIsFound) {
    vfit_sensor sensor{};
    const char* uri =
        "virtual:sensor=azure_binned&motion=sway&wall=0&distance=5&body=31&clothing=0.02&floor=unknown&"
        "frames=5";
    ASSERT_EQ(vfit_sensor_open(context, uri, &sensor), VFIT_OK) << contract::last_error();
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    for (vfit_frame frame{}; vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK;) {
        const Outcome seen = update(frame);
        EXPECT_EQ(seen.bodies, 1u) << seen.absence;
        EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
    }
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
}

TEST_F(CameraStandTest, AFloorThatIsOutOfSightIsGivenUpWhenNoPersonStandsOnIt) {
    ASSERT_EQ(after(8, 0).camera.floor_state, VFIT_FLOOR_ESTIMATED);
    const std::vector<uint16_t> board(640 * 480, 1000);
    Outcome last;
    for (int i = 0; i < 45; ++i) last = update(board, 640, 480, 594.0f);
    EXPECT_EQ(last.camera.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_NEAR(last.camera.height_m, 1.0f, 0.05f);
    for (int i = 0; i < 30; ++i) last = update(board, 640, 480, 594.0f);
    EXPECT_EQ(last.camera.floor_state, VFIT_FLOOR_DEFAULT);
    EXPECT_EQ(after(8, 0).bodies, 1u);
}

TEST_F(CameraStandTest, SaysWhyNoPersonIsFound) {
    constexpr uint32_t kWidth = 320, kHeight = 240;
    std::vector<uint16_t> depth(kWidth * kHeight, 0);
    const auto see = [&](int images) {
        Outcome out;
        for (int i = 0; i < images; ++i) {
            out = update(depth, kWidth, kHeight, 290.0f);
            EXPECT_EQ(out.bodies, 0u);
        }
        return out.absence;
    };
    EXPECT_EQ(see(1), "\"the depth image has no readings\"");
    std::fill(depth.begin(), depth.end(), uint16_t(7000));
    EXPECT_EQ(see(1), "\"nothing is within 6 m\"");
    std::fill(depth.begin(), depth.end(), uint16_t(3000));
    EXPECT_EQ(see(60), "\"there is nothing but floor and background\"");
    for (uint32_t y = 40; y < 80; ++y)
        for (uint32_t x = 140; x < 180; ++x) depth[y * kWidth + x] = 1500;
    EXPECT_EQ(see(1), "\"nothing in view has the size and shape of a person\"");
}
