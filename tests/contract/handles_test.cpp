// Every handle-taking function answers null, invented, foreign and stale handles with VFIT_ERROR_HANDLE.
#include <chrono>
#include <functional>
#include <thread>

#include "contract/support.h"

using contract::ContextTest;

namespace {

struct Call {
    const char* name;
    std::function<vfit_result(uint64_t)> call;
};

vfit_frame frame_out;
vfit_scan scan_out;
vfit_motion motion_out;
vfit_tracker tracker_out;
vfit_avatar avatar_out;
vfit_sensor sensor_out;
vfit_cloth cloth_out;
vfit_garment garment_out;
vfit_size_chart chart_out;
vfit_recorder recorder_out;
vfit_prop prop_out;
uint32_t count;
uint64_t changes;
int64_t time_ns;
uint64_t hash;

/// Every function that takes a handle first, with valid further arguments.
std::vector<Call> calls() {
    static vfit_context_stats context_stats = vfit_context_stats_init();
    static vfit_view view = vfit_view_init();
    static vfit_intrinsics intrinsics = vfit_intrinsics_init();
    static vfit_camera camera = vfit_camera_init();
    static vfit_sensor_stats sensor_stats = vfit_sensor_stats_init();
    static vfit_cloth_stats cloth_stats = vfit_cloth_stats_init();
    static vfit_garment_info garment_info = vfit_garment_info_init();
    static vfit_scale scale = vfit_scale_init();
    static vfit_pose pose = vfit_pose_init();
    static char buffer[64];
    static vfit_log_level level;
    static vfit_target target = vfit_target_init();
    return {
        {"context_destroy", [](uint64_t h) { return vfit_context_destroy({h}); }},
        {"context_describe", [](uint64_t h) { return vfit_context_describe({h}, &context_stats); }},
        {"context_time", [](uint64_t h) { return vfit_context_time({h}, &time_ns); }},
        {"profile_list", [](uint64_t h) { return vfit_profile_list({h}, nullptr, 0, &count); }},
        {"profile_reset", [](uint64_t h) { return vfit_profile_reset({h}); }},
        {"log_next", [](uint64_t h) { return vfit_log_next({h}, &level, buffer, sizeof buffer); }},
        {"plugin_load", [](uint64_t h) { return vfit_plugin_load({h}, "x"); }},
        {"plugin_list", [](uint64_t h) { return vfit_plugin_list({h}, nullptr, 0, &count); }},
        {"frame_create",
         [](uint64_t h) {
             static contract::HostImage image;
             const auto d = image.desc();
             return vfit_frame_create({h}, &d, &frame_out);
         }},
        {"frame_retain", [](uint64_t h) { return vfit_frame_retain({h}); }},
        {"frame_release", [](uint64_t h) { return vfit_frame_release({h}); }},
        {"frame_streams", [](uint64_t h) { return vfit_frame_streams({h}, nullptr, &count); }},
        {"frame_view", [](uint64_t h) { return vfit_frame_view({h}, VFIT_STREAM_DEPTH, &view); }},
        {"frame_intrinsics", [](uint64_t h) { return vfit_frame_intrinsics({h}, &intrinsics); }},
        {"frame_camera", [](uint64_t h) { return vfit_frame_camera({h}, &camera); }},
        {"frame_meta",
         [](uint64_t h) { return vfit_frame_meta({h}, "index", buffer, sizeof buffer, &count); }},
        {"frame_write",
         [](uint64_t h) { return vfit_frame_write({h}, VFIT_STREAM_DEPTH, &target, nullptr); }},
        {"frame_bodies", [](uint64_t h) { return vfit_frame_bodies({h}, nullptr, 0, &count); }},
        {"frame_joints", [](uint64_t h) { return vfit_frame_joints({h}, 1, nullptr, 0, &count); }},
        {"sensor_list", [](uint64_t h) { return vfit_sensor_list({h}, nullptr, 0, &count); }},
        {"sensor_changes", [](uint64_t h) { return vfit_sensor_changes({h}, &changes); }},
        {"sensor_open", [](uint64_t h) { return vfit_sensor_open({h}, "virtual:", &sensor_out); }},
        {"sensor_modes", [](uint64_t h) { return vfit_sensor_modes({h}, nullptr, 0, &count); }},
        {"sensor_options", [](uint64_t h) { return vfit_sensor_options({h}, nullptr, 0, &count); }},
        {"sensor_set_option", [](uint64_t h) { return vfit_sensor_set_option({h}, "pace", "none"); }},
        {"sensor_start", [](uint64_t h) { return vfit_sensor_start({h}); }},
        {"sensor_stop", [](uint64_t h) { return vfit_sensor_stop({h}); }},
        {"sensor_close", [](uint64_t h) { return vfit_sensor_close({h}); }},
        {"sensor_acquire", [](uint64_t h) { return vfit_sensor_acquire({h}, 0, &frame_out); }},
        {"sensor_describe", [](uint64_t h) { return vfit_sensor_describe({h}, &sensor_stats); }},
        {"recorder_create",
         [](uint64_t h) { return vfit_recorder_create({h}, "x", nullptr, &recorder_out); }},
        {"recorder_write", [](uint64_t h) { return vfit_recorder_write({h}, {h}); }},
        {"recorder_destroy", [](uint64_t h) { return vfit_recorder_destroy({h}); }},
        {"tracker_create", [](uint64_t h) { return vfit_tracker_create({h}, nullptr, &tracker_out); }},
        {"tracker_destroy", [](uint64_t h) { return vfit_tracker_destroy({h}); }},
        {"tracker_update", [](uint64_t h) { return vfit_tracker_update({h}, {h}, &frame_out); }},
        {"tracker_submit",
         [](uint64_t h) { return vfit_tracker_submit({h}, {h}, nullptr, nullptr, 0, 0, &frame_out); }},
        {"tracker_hint", [](uint64_t h) { return vfit_tracker_hint({h}, nullptr, 0, 0); }},
        {"tracker_set_active", [](uint64_t h) { return vfit_tracker_set_active({h}, 1); }},
        {"frame_active_body", [](uint64_t h) { return vfit_frame_active_body({h}, &count, nullptr); }},
        {"tracker_reset", [](uint64_t h) { return vfit_tracker_reset({h}); }},
        {"scan_create", [](uint64_t h) { return vfit_scan_create({h}, nullptr, &scan_out); }},
        {"scan_destroy", [](uint64_t h) { return vfit_scan_destroy({h}); }},
        {"scan_reset", [](uint64_t h) { return vfit_scan_reset({h}); }},
        {"scan_add", [](uint64_t h) { return vfit_scan_add({h}, {h}, 1, nullptr); }},
        {"scan_measure", [](uint64_t h) { return vfit_scan_measure({h}, nullptr, 0, &count); }},
        {"scan_colliders", [](uint64_t h) { return vfit_scan_colliders({h}, nullptr, 0, &count); }},
        {"scan_scale", [](uint64_t h) { return vfit_scan_scale({h}, "trousers", &scale); }},
        {"size_chart_load", [](uint64_t h) { return vfit_size_chart_load({h}, "{}", 2, &chart_out); }},
        {"size_chart_open", [](uint64_t h) { return vfit_size_chart_open({h}, "paper", &chart_out); }},
        {"size_chart_destroy", [](uint64_t h) { return vfit_size_chart_destroy({h}); }},
        {"size_chart_rows", [](uint64_t h) { return vfit_size_chart_rows({h}, nullptr, 0, &count); }},
        {"size_recommend",
         [](uint64_t h) { return vfit_size_recommend({h}, "x", nullptr, 0, 0, nullptr, 0, &count); }},
        {"size_zones",
         [](uint64_t h) { return vfit_size_zones({h}, "x", "M", nullptr, 0, 0, nullptr, 0, &count); }},
        {"scan_extend", [](uint64_t h) { return vfit_scan_extend({h}, 1, 0); }},
        {"motion_create", [](uint64_t h) { return vfit_motion_create({h}, nullptr, &motion_out); }},
        {"motion_destroy", [](uint64_t h) { return vfit_motion_destroy({h}); }},
        {"motion_reset", [](uint64_t h) { return vfit_motion_reset({h}); }},
        {"motion_bind", [](uint64_t h) { return vfit_motion_bind({h}, {h}); }},
        {"motion_step", [](uint64_t h) { return vfit_motion_step({h}, {}, 1, 0); }},
        {"motion_step_body",
         [](uint64_t h) { return vfit_motion_step_body({h}, nullptr, nullptr, 0, 0, 0); }},
        {"motion_pose", [](uint64_t h) { return vfit_motion_pose({h}, &pose, nullptr, 0, &count); }},
        {"motion_joints", [](uint64_t h) { return vfit_motion_joints({h}, nullptr, 0, &count); }},
        {"shape_list", [](uint64_t h) { return vfit_shape_list({h}, nullptr, 0, &count); }},
        {"avatar_create_from_shape",
         [](uint64_t h) { return vfit_avatar_create_from_shape({h}, nullptr, nullptr, 0, 0, &avatar_out); }},
        {"avatar_create",
         [](uint64_t h) { return vfit_avatar_create({h}, nullptr, nullptr, 0, 0, &avatar_out); }},
        {"avatar_create_from_scan",
         [](uint64_t h) { return vfit_avatar_create_from_scan({h}, nullptr, {h}, &avatar_out); }},
        {"avatar_destroy", [](uint64_t h) { return vfit_avatar_destroy({h}); }},
        {"avatar_pose", [](uint64_t h) { return vfit_avatar_pose({h}, &pose, nullptr, 0, 0); }},
        {"avatar_pose_into",
         [](uint64_t h) { return vfit_avatar_pose_into({h}, &pose, nullptr, 0, 0, &target, nullptr); }},
        {"avatar_load", [](uint64_t h) { return vfit_avatar_load({h}, nullptr, nullptr, &avatar_out); }},
        {"avatar_describe", [](uint64_t h) { return vfit_avatar_describe({h}, nullptr); }},
        {"avatar_parts", [](uint64_t h) { return vfit_avatar_parts({h}, nullptr, 0, &count); }},
        {"avatar_pack", [](uint64_t h) { return vfit_avatar_pack({h}, "M", nullptr, &count); }},
        {"avatar_unpack",
         [](uint64_t h) { return vfit_avatar_unpack({h}, nullptr, "x", 1, nullptr, 0, &avatar_out); }},
        {"pose_pack", [](uint64_t h) { return vfit_pose_pack({h}, &pose, nullptr, 0, 0, nullptr, &count); }},
        {"pose_unpack", [](uint64_t h) { return vfit_pose_unpack({h}, "x", 1, &pose, nullptr, 0, &count); }},
        {"pose_osc",
         [](uint64_t h) { return vfit_pose_osc({h}, &pose, nullptr, 0, 0, VFIT_OSC_VMC, nullptr, &count); }},
        {"pose_bvh",
         [](uint64_t h) {
             return vfit_pose_bvh({h}, &pose, sizeof pose, 1, nullptr, 0, 0, 0.0f, nullptr, &count);
         }},
        {"avatar_colliders", [](uint64_t h) { return vfit_avatar_colliders({h}, nullptr, 0, &count); }},
        {"avatar_joints", [](uint64_t h) { return vfit_avatar_joints({h}, nullptr, 0, &count); }},
        {"avatar_rig", [](uint64_t h) { return vfit_avatar_rig({h}, nullptr, 0, &count); }},
        {"avatar_measure", [](uint64_t h) { return vfit_avatar_measure({h}, nullptr, 0, &count); }},
        {"avatar_measure_own",
         [](uint64_t h) { return vfit_avatar_measure_own({h}, "{}", 2, nullptr, 0, &count); }},
        {"avatar_acquire", [](uint64_t h) { return vfit_avatar_acquire({h}, &frame_out); }},
        {"avatar_acquire_rest", [](uint64_t h) { return vfit_avatar_acquire_rest({h}, &frame_out); }},
        {"garment_load", [](uint64_t h) { return vfit_garment_load({h}, "{}", 2, &garment_out); }},
        {"garment_open", [](uint64_t h) { return vfit_garment_open({h}, "sundress", &garment_out); }},
        {"garment_destroy", [](uint64_t h) { return vfit_garment_destroy({h}); }},
        {"garment_describe", [](uint64_t h) { return vfit_garment_describe({h}, &garment_info); }},
        {"cloth_create", [](uint64_t h) { return vfit_cloth_create({h}, {h}, nullptr, &cloth_out); }},
        {"cloth_destroy", [](uint64_t h) { return vfit_cloth_destroy({h}); }},
        {"cloth_reset", [](uint64_t h) { return vfit_cloth_reset({h}); }},
        {"cloth_step", [](uint64_t h) { return vfit_cloth_step({h}, 0.01f); }},
        {"cloth_begin_step", [](uint64_t h) { return vfit_cloth_begin_step({h}, 0.01f); }},
        {"cloth_end_step", [](uint64_t h) { return vfit_cloth_end_step({h}); }},
        {"cloth_teleport", [](uint64_t h) { return vfit_cloth_teleport({h}); }},
        {"cloth_set_wind",
         [](uint64_t h) {
             static const float kWind[3] = {};
             return vfit_cloth_set_wind({h}, kWind);
         }},
        {"cloth_set_quality", [](uint64_t h) { return vfit_cloth_set_quality({h}, 8, 0.0f); }},
        {"cloth_wear_over", [](uint64_t h) { return vfit_cloth_wear_over({h}, {h}); }},
        {"prop_create",
         [](uint64_t h) {
             vfit_prop_desc d = vfit_prop_desc_init();
             d.size[0] = 0.1f;
             return vfit_prop_create({h}, &d, &prop_out);
         }},
        {"prop_destroy", [](uint64_t h) { return vfit_prop_destroy({h}); }},
        {"prop_move",
         [](uint64_t h) {
             static constexpr float kAt[4] = {0.0f, 0.0f, 0.0f, 1.0f};
             return vfit_prop_move({h}, kAt, kAt);
         }},
        {"prop_deform",
         [](uint64_t h) {
             static constexpr float kAt[3] = {0.0f, 0.0f, 0.0f};
             return vfit_prop_deform({h}, kAt, 1);
         }},
        {"cloth_add_prop", [](uint64_t h) { return vfit_cloth_add_prop({h}, {h}); }},
        {"cloth_remove_prop", [](uint64_t h) { return vfit_cloth_remove_prop({h}, {h}); }},
        {"cloth_hide_skin",
         [](uint64_t h) {
             static uint8_t hidden[1];
             return vfit_cloth_hide_skin({h}, 0.0f, hidden, 1);
         }},
        {"cloth_acquire", [](uint64_t h) { return vfit_cloth_acquire({h}, &frame_out); }},
        {"cloth_describe", [](uint64_t h) { return vfit_cloth_describe({h}, &cloth_stats); }},
        {"cloth_state_hash", [](uint64_t h) { return vfit_cloth_state_hash({h}, &hash); }},
    };
}

/// Destroying null is a no-op.
bool takes_null(const std::string& name) {
    return name.ends_with("_destroy") || name == "frame_release" || name == "sensor_close";
}

}  // namespace

TEST_F(ContextTest, NullHandlesAreRefusedAndDestroyingNullIsANoOp) {
    for (const Call& c : calls()) {
        EXPECT_EQ(c.call(0), takes_null(c.name) ? VFIT_OK : VFIT_ERROR_HANDLE) << c.name;
    }
    EXPECT_NE(contract::last_error().find("null"), std::string::npos);
}

TEST_F(ContextTest, InventedHandlesAreRefused) {
    for (const Call& c : calls())
        for (const uint64_t id : {uint64_t(1), uint64_t(0xFFFFFFFFFFFFFFFF), uint64_t(0x0100000100000FFF),
                                  context.id + (uint64_t(1) << 32), context.id ^ (uint64_t(1) << 55)})
            EXPECT_EQ(c.call(id), VFIT_ERROR_HANDLE) << c.name << " " << id;
}

TEST_F(ContextTest, ForeignHandlesAreRefused) {
    vfit_scan scan{};
    ASSERT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
    vfit_motion motion{};
    ASSERT_EQ(vfit_motion_create(context, nullptr, &motion), VFIT_OK);
    EXPECT_EQ(vfit_motion_reset({scan.id}), VFIT_ERROR_HANDLE);
    EXPECT_NE(contract::last_error().find("scan"), std::string::npos);
    EXPECT_EQ(vfit_scan_reset({motion.id}), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_context_destroy({scan.id}), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_frame_release({context.id}), VFIT_ERROR_HANDLE);
}

TEST_F(ContextTest, StaleHandlesAreRefusedAlsoWhenTheSlotIsUsedAgain) {
    vfit_scan first{}, second{};
    ASSERT_EQ(vfit_scan_create(context, nullptr, &first), VFIT_OK);
    ASSERT_EQ(vfit_scan_destroy(first), VFIT_OK);
    EXPECT_EQ(vfit_scan_reset(first), VFIT_ERROR_HANDLE);
    EXPECT_NE(contract::last_error().find("stale"), std::string::npos);
    ASSERT_EQ(vfit_scan_create(context, nullptr, &second), VFIT_OK);
    EXPECT_NE(first.id, second.id);
    EXPECT_EQ(vfit_scan_reset(first), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_scan_destroy(first), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_scan_reset(second), VFIT_OK);
}

TEST(Contract, AContextTakesItsChildrenWithIt) {
    const vfit_context_desc desc = contract::context_desc();
    vfit_context context{};
    ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK);
    vfit_scan scan{};
    ASSERT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
    contract::HostImage image;
    const vfit_frame_desc frame_desc = image.desc();
    vfit_frame frame{};
    ASSERT_EQ(vfit_frame_create(context, &frame_desc, &frame), VFIT_OK) << contract::last_error();
    vfit_context_stats stats = vfit_context_stats_init();
    ASSERT_EQ(vfit_context_describe(context, &stats), VFIT_OK);
    EXPECT_EQ(stats.handle_count, 2u);
    EXPECT_EQ(stats.frame_count, 1u);
    ASSERT_EQ(vfit_context_destroy(context), VFIT_OK);
    EXPECT_EQ(vfit_scan_reset(scan), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_frame_retain(frame), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_context_destroy(context), VFIT_ERROR_HANDLE);
}

TEST(Contract, ShutdownEndsEveryContext) {
    const vfit_context_desc desc = contract::context_desc();
    vfit_context a{}, b{};
    ASSERT_EQ(vfit_context_create(&desc, &a), VFIT_OK);
    ASSERT_EQ(vfit_context_create(&desc, &b), VFIT_OK);
    EXPECT_EQ(vfit_shutdown(), VFIT_OK);
    EXPECT_EQ(vfit_profile_reset(a), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_profile_reset(b), VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_shutdown(), VFIT_OK);
}

TEST(Contract, ShutdownIsWellAlsoWhereAPlugInHasAContextOfItsOwn) {
    const vfit_context_desc desc = contract::context_desc();
    for (int round = 0; round < 4; ++round) {
        // The plug-in's context takes the place of one that is gone: it stands before its host's in the
        // table.
        vfit_context gone[8]{}, context{};
        for (vfit_context& c : gone) ASSERT_EQ(vfit_context_create(&desc, &c), VFIT_OK);
        ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK);
        for (vfit_context& c : gone) ASSERT_EQ(vfit_context_destroy(c), VFIT_OK);
        vfit_sensor sensor{};
        ASSERT_EQ(vfit_sensor_open(context, "virtual:sensor=kinect_v1_320", &sensor), VFIT_OK)
            << contract::last_error();
        ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        std::this_thread::sleep_for(std::chrono::milliseconds(round));  // it works on its first frames
        EXPECT_EQ(vfit_shutdown(), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_profile_reset(context), VFIT_ERROR_HANDLE);
    }
}

TEST_F(ContextTest, HandlesAreMadeAndDestroyedFromManyThreadsAtOnce) {
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([this] {
            for (int i = 0; i < 500; ++i) {
                vfit_scan scan{};
                EXPECT_EQ(vfit_scan_create(context, nullptr, &scan), VFIT_OK);
                EXPECT_EQ(vfit_scan_reset(scan), VFIT_OK);
                EXPECT_EQ(vfit_scan_destroy(scan), VFIT_OK);
            }
        });
    for (std::thread& t : threads) t.join();
    vfit_context_stats stats = vfit_context_stats_init();
    ASSERT_EQ(vfit_context_describe(context, &stats), VFIT_OK);
    EXPECT_EQ(stats.handle_count, 0u);
}
