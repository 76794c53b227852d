/* Sizes and offsets of every public struct: a field that moves breaks the build here. Written anew by
 * scripts/abi-offsets, only for a change of the ABI that is meant. */
#include <stddef.h>

#include "vfit_plugin.h"

#define OFFSET(type, field, bytes) _Static_assert(offsetof(type, field) == (bytes), #type "." #field)
#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)

OFFSET(vfit_context_desc, struct_size, 0);
OFFSET(vfit_context_desc, api_version, 4);
OFFSET(vfit_context_desc, flags, 8);
OFFSET(vfit_context_desc, axes, 12);
OFFSET(vfit_context_desc, log, 16);
OFFSET(vfit_context_desc, submit, 24);
OFFSET(vfit_context_desc, wait, 32);
OFFSET(vfit_context_desc, user, 40);
OFFSET(vfit_context_desc, plugin_dir, 48);
OFFSET(vfit_context_desc, data_dir, 56);
OFFSET(vfit_context_desc, worker_count, 64);
OFFSET(vfit_context_desc, reserved, 68);
SIZE(vfit_context_desc, 72);

OFFSET(vfit_library_info, struct_size, 0);
OFFSET(vfit_library_info, version, 4);
OFFSET(vfit_library_info, simd, 8);
OFFSET(vfit_library_info, build, 24);
SIZE(vfit_library_info, 136);

OFFSET(vfit_plugin_info, struct_size, 0);
OFFSET(vfit_plugin_info, version, 4);
OFFSET(vfit_plugin_info, name, 8);
OFFSET(vfit_plugin_info, schemes, 72);
OFFSET(vfit_plugin_info, path, 136);
SIZE(vfit_plugin_info, 392);

OFFSET(vfit_data_name, struct_size, 0);
OFFSET(vfit_data_name, name, 4);
SIZE(vfit_data_name, 68);

OFFSET(vfit_context_stats, struct_size, 0);
OFFSET(vfit_context_stats, handle_count, 4);
OFFSET(vfit_context_stats, frame_count, 8);
OFFSET(vfit_context_stats, worker_count, 12);
OFFSET(vfit_context_stats, frame_bytes, 16);
SIZE(vfit_context_stats, 24);

OFFSET(vfit_profile, struct_size, 0);
OFFSET(vfit_profile, calls, 4);
OFFSET(vfit_profile, last_ms, 8);
OFFSET(vfit_profile, mean_ms, 16);
OFFSET(vfit_profile, max_ms, 24);
OFFSET(vfit_profile, stage, 32);
SIZE(vfit_profile, 64);

OFFSET(vfit_view, struct_size, 0);
OFFSET(vfit_view, format, 4);
OFFSET(vfit_view, data, 8);
OFFSET(vfit_view, width, 16);
OFFSET(vfit_view, height, 20);
OFFSET(vfit_view, item_stride, 24);
OFFSET(vfit_view, row_stride, 28);
OFFSET(vfit_view, time_ns, 32);
OFFSET(vfit_view, serial, 40);
SIZE(vfit_view, 48);

OFFSET(vfit_target, struct_size, 0);
OFFSET(vfit_target, format, 4);
OFFSET(vfit_target, data, 8);
OFFSET(vfit_target, capacity, 16);
OFFSET(vfit_target, item_stride, 24);
OFFSET(vfit_target, reserved, 28);
SIZE(vfit_target, 32);

OFFSET(vfit_intrinsics, struct_size, 0);
OFFSET(vfit_intrinsics, width, 4);
OFFSET(vfit_intrinsics, height, 8);
OFFSET(vfit_intrinsics, reserved, 12);
OFFSET(vfit_intrinsics, fx, 16);
OFFSET(vfit_intrinsics, fy, 20);
OFFSET(vfit_intrinsics, cx, 24);
OFFSET(vfit_intrinsics, cy, 28);
OFFSET(vfit_intrinsics, distortion, 32);
SIZE(vfit_intrinsics, 64);

OFFSET(vfit_camera, struct_size, 0);
OFFSET(vfit_camera, floor_state, 4);
OFFSET(vfit_camera, depth_unit_m, 8);
OFFSET(vfit_camera, height_m, 12);
OFFSET(vfit_camera, tilt_rad, 16);
OFFSET(vfit_camera, roll_rad, 20);
OFFSET(vfit_camera, floor_normal, 24);
OFFSET(vfit_camera, floor_distance_m, 36);
OFFSET(vfit_camera, world_from_camera, 40);
SIZE(vfit_camera, 104);

OFFSET(vfit_frame_desc, struct_size, 0);
OFFSET(vfit_frame_desc, count, 4);
OFFSET(vfit_frame_desc, streams, 8);
OFFSET(vfit_frame_desc, views, 16);
OFFSET(vfit_frame_desc, intrinsics, 24);
OFFSET(vfit_frame_desc, camera, 32);
OFFSET(vfit_frame_desc, time_ns, 40);
OFFSET(vfit_frame_desc, release, 48);
OFFSET(vfit_frame_desc, user, 56);
SIZE(vfit_frame_desc, 64);

OFFSET(vfit_sensor_info, struct_size, 0);
OFFSET(vfit_sensor_info, caps, 4);
OFFSET(vfit_sensor_info, uri, 8);
OFFSET(vfit_sensor_info, name, 264);
OFFSET(vfit_sensor_info, plugin, 328);
SIZE(vfit_sensor_info, 392);

OFFSET(vfit_sensor_mode, struct_size, 0);
OFFSET(vfit_sensor_mode, width, 4);
OFFSET(vfit_sensor_mode, height, 8);
OFFSET(vfit_sensor_mode, rate_hz, 12);
OFFSET(vfit_sensor_mode, name, 16);
SIZE(vfit_sensor_mode, 80);

OFFSET(vfit_sensor_option, struct_size, 0);
OFFSET(vfit_sensor_option, reserved, 4);
OFFSET(vfit_sensor_option, key, 8);
OFFSET(vfit_sensor_option, value, 40);
OFFSET(vfit_sensor_option, text, 136);
SIZE(vfit_sensor_option, 264);

OFFSET(vfit_sensor_stats, struct_size, 0);
OFFSET(vfit_sensor_stats, running, 4);
OFFSET(vfit_sensor_stats, state, 8);
OFFSET(vfit_sensor_stats, reserved, 12);
OFFSET(vfit_sensor_stats, received, 16);
OFFSET(vfit_sensor_stats, taken, 24);
OFFSET(vfit_sensor_stats, dropped, 32);
OFFSET(vfit_sensor_stats, latency_ns, 40);
SIZE(vfit_sensor_stats, 48);

OFFSET(vfit_recorder_desc, struct_size, 0);
OFFSET(vfit_recorder_desc, reserved, 4);
OFFSET(vfit_recorder_desc, sensor_name, 8);
OFFSET(vfit_recorder_desc, rate_hz, 16);
OFFSET(vfit_recorder_desc, segmented, 20);
SIZE(vfit_recorder_desc, 24);

OFFSET(vfit_joint, struct_size, 0);
OFFSET(vfit_joint, joint, 4);
OFFSET(vfit_joint, state, 8);
OFFSET(vfit_joint, confidence, 12);
OFFSET(vfit_joint, position, 16);
OFFSET(vfit_joint, rotation, 28);
OFFSET(vfit_joint, reserved, 44);
SIZE(vfit_joint, 48);

OFFSET(vfit_body, struct_size, 0);
OFFSET(vfit_body, body_id, 4);
OFFSET(vfit_body, time_ns, 8);
OFFSET(vfit_body, flags, 16);
OFFSET(vfit_body, reserved, 20);
SIZE(vfit_body, 24);

OFFSET(vfit_tracker_desc, struct_size, 0);
OFFSET(vfit_tracker_desc, reserved, 4);
OFFSET(vfit_tracker_desc, floor, 8);
OFFSET(vfit_tracker_desc, joints, 16);
OFFSET(vfit_tracker_desc, user_map, 20);
OFFSET(vfit_tracker_desc, follow, 24);
OFFSET(vfit_tracker_desc, filter, 28);
OFFSET(vfit_tracker_desc, fit, 32);
OFFSET(vfit_tracker_desc, reserved2, 36);
SIZE(vfit_tracker_desc, 40);

OFFSET(vfit_joint_hint, struct_size, 0);
OFFSET(vfit_joint_hint, body_id, 4);
OFFSET(vfit_joint_hint, joint, 8);
OFFSET(vfit_joint_hint, x, 12);
OFFSET(vfit_joint_hint, y, 16);
OFFSET(vfit_joint_hint, confidence, 20);
SIZE(vfit_joint_hint, 24);

OFFSET(vfit_scan_desc, struct_size, 0);
OFFSET(vfit_scan_desc, method, 4);
OFFSET(vfit_scan_desc, frame_count, 8);
OFFSET(vfit_scan_desc, sex, 12);
OFFSET(vfit_scan_desc, side_frame_count, 16);
OFFSET(vfit_scan_desc, flags, 20);
OFFSET(vfit_scan_desc, camera_count, 24);
SIZE(vfit_scan_desc, 28);

OFFSET(vfit_scan_state, struct_size, 0);
OFFSET(vfit_scan_state, frames_taken, 4);
OFFSET(vfit_scan_state, frames_wanted, 8);
OFFSET(vfit_scan_state, guidance, 12);
OFFSET(vfit_scan_state, correction_m, 16);
OFFSET(vfit_scan_state, compute_ms, 20);
OFFSET(vfit_scan_state, side_frames_taken, 24);
OFFSET(vfit_scan_state, side_frames_wanted, 28);
OFFSET(vfit_scan_state, turn_seen, 32);
OFFSET(vfit_scan_state, turn_wanted, 36);
SIZE(vfit_scan_state, 40);

OFFSET(vfit_measurement, struct_size, 0);
OFFSET(vfit_measurement, observed, 4);
OFFSET(vfit_measurement, value, 8);
OFFSET(vfit_measurement, sigma, 12);
OFFSET(vfit_measurement, key, 16);
SIZE(vfit_measurement, 64);

OFFSET(vfit_collider, struct_size, 0);
OFFSET(vfit_collider, joint, 4);
OFFSET(vfit_collider, center, 8);
OFFSET(vfit_collider, radius, 20);
OFFSET(vfit_collider, joint_b, 24);
OFFSET(vfit_collider, center_b, 28);
OFFSET(vfit_collider, radius_b, 40);
OFFSET(vfit_collider, reserved, 44);
SIZE(vfit_collider, 48);

OFFSET(vfit_scale, struct_size, 0);
OFFSET(vfit_scale, x, 4);
OFFSET(vfit_scale, y, 8);
OFFSET(vfit_scale, sigma_x, 12);
OFFSET(vfit_scale, sigma_y, 16);
OFFSET(vfit_scale, width_m, 20);
OFFSET(vfit_scale, height_m, 24);
OFFSET(vfit_scale, reserved, 28);
SIZE(vfit_scale, 32);

OFFSET(vfit_size, struct_size, 0);
OFFSET(vfit_size, probability, 4);
OFFSET(vfit_size, label, 8);
SIZE(vfit_size, 40);

OFFSET(vfit_size_row, struct_size, 0);
OFFSET(vfit_size_row, measure_count, 4);
OFFSET(vfit_size_row, garment_kind, 8);
OFFSET(vfit_size_row, label, 40);
SIZE(vfit_size_row, 72);

OFFSET(vfit_size_zone, struct_size, 0);
OFFSET(vfit_size_zone, ease, 4);
OFFSET(vfit_size_zone, sigma, 8);
OFFSET(vfit_size_zone, tight, 12);
OFFSET(vfit_size_zone, regular, 16);
OFFSET(vfit_size_zone, loose, 20);
OFFSET(vfit_size_zone, key, 24);
SIZE(vfit_size_zone, 72);

OFFSET(vfit_calibrated_measure, struct_size, 0);
OFFSET(vfit_calibrated_measure, people, 4);
OFFSET(vfit_calibrated_measure, enough, 8);
OFFSET(vfit_calibrated_measure, offset, 12);
OFFSET(vfit_calibrated_measure, widening, 16);
OFFSET(vfit_calibrated_measure, key, 20);
SIZE(vfit_calibrated_measure, 68);

OFFSET(vfit_person, struct_size, 0);
OFFSET(vfit_person, sex, 4);
OFFSET(vfit_person, age_years, 8);
OFFSET(vfit_person, reserved, 12);
SIZE(vfit_person, 16);

OFFSET(vfit_doubt, struct_size, 0);
OFFSET(vfit_doubt, kind, 4);
OFFSET(vfit_doubt, value, 8);
OFFSET(vfit_doubt, suggested, 12);
OFFSET(vfit_doubt, expected, 16);
OFFSET(vfit_doubt, sigma, 20);
OFFSET(vfit_doubt, key, 24);
OFFSET(vfit_doubt, other_key, 72);
SIZE(vfit_doubt, 120);

OFFSET(vfit_bone, struct_size, 0);
OFFSET(vfit_bone, bone, 4);
OFFSET(vfit_bone, rotation, 8);
OFFSET(vfit_bone, position, 24);
OFFSET(vfit_bone, reserved, 36);
SIZE(vfit_bone, 40);

OFFSET(vfit_pose, struct_size, 0);
OFFSET(vfit_pose, contact_flags, 4);
OFFSET(vfit_pose, time_ns, 8);
OFFSET(vfit_pose, root_correction, 16);
OFFSET(vfit_pose, foot_correction_m, 28);
SIZE(vfit_pose, 32);

OFFSET(vfit_motion_desc, struct_size, 0);
OFFSET(vfit_motion_desc, flags, 4);
OFFSET(vfit_motion_desc, smoothing, 8);
OFFSET(vfit_motion_desc, correction, 12);
OFFSET(vfit_motion_desc, prediction, 16);
OFFSET(vfit_motion_desc, jitter_radius_m, 20);
OFFSET(vfit_motion_desc, max_deviation_radius_m, 24);
OFFSET(vfit_motion_desc, rotation_divisor, 28);
OFFSET(vfit_motion_desc, rotation_divisor_switched, 32);
OFFSET(vfit_motion_desc, filter, 36);
OFFSET(vfit_motion_desc, min_cutoff_hz, 40);
OFFSET(vfit_motion_desc, beta, 44);
OFFSET(vfit_motion_desc, derivative_cutoff_hz, 48);
OFFSET(vfit_motion_desc, prediction_s, 52);
OFFSET(vfit_motion_desc, contact_rule, 56);
OFFSET(vfit_motion_desc, reserved, 60);
OFFSET(vfit_motion_desc, range_of_motion, 64);
SIZE(vfit_motion_desc, 72);

OFFSET(vfit_avatar_desc, struct_size, 0);
OFFSET(vfit_avatar_desc, flags, 4);
OFFSET(vfit_avatar_desc, sex, 8);
OFFSET(vfit_avatar_desc, detail, 12);
SIZE(vfit_avatar_desc, 16);

OFFSET(vfit_shape_value, struct_size, 0);
OFFSET(vfit_shape_value, value, 4);
OFFSET(vfit_shape_value, minimum, 8);
OFFSET(vfit_shape_value, maximum, 12);
OFFSET(vfit_shape_value, key, 16);
SIZE(vfit_shape_value, 64);

OFFSET(vfit_rig_bone, struct_size, 0);
OFFSET(vfit_rig_bone, parent, 4);
OFFSET(vfit_rig_bone, bone, 8);
OFFSET(vfit_rig_bone, rest_position, 12);
OFFSET(vfit_rig_bone, name, 24);
OFFSET(vfit_rig_bone, rest_rotation, 72);
OFFSET(vfit_rig_bone, node, 88);
OFFSET(vfit_rig_bone, reserved, 92);
SIZE(vfit_rig_bone, 96);

OFFSET(vfit_character_desc, struct_size, 0);
OFFSET(vfit_character_desc, scale, 4);
OFFSET(vfit_character_desc, path, 8);
OFFSET(vfit_character_desc, bytes, 16);
OFFSET(vfit_character_desc, byte_count, 24);
OFFSET(vfit_character_desc, bone_map, 32);
SIZE(vfit_character_desc, 40);

OFFSET(vfit_character_info, struct_size, 0);
OFFSET(vfit_character_info, kind, 4);
OFFSET(vfit_character_info, vertex_count, 8);
OFFSET(vfit_character_info, index_count, 12);
OFFSET(vfit_character_info, bone_count, 16);
OFFSET(vfit_character_info, part_count, 20);
OFFSET(vfit_character_info, stature_m, 24);
OFFSET(vfit_character_info, from_file, 28);
OFFSET(vfit_character_info, name, 92);
OFFSET(vfit_character_info, reserved, 156);
SIZE(vfit_character_info, 160);

OFFSET(vfit_avatar_part, struct_size, 0);
OFFSET(vfit_avatar_part, first_index, 4);
OFFSET(vfit_avatar_part, index_count, 8);
OFFSET(vfit_avatar_part, material, 12);
OFFSET(vfit_avatar_part, mesh, 16);
OFFSET(vfit_avatar_part, material_name, 64);
SIZE(vfit_avatar_part, 112);

OFFSET(vfit_garment_info, struct_size, 0);
OFFSET(vfit_garment_info, vertex_count, 4);
OFFSET(vfit_garment_info, simulated_count, 8);
OFFSET(vfit_garment_info, size_count, 12);
OFFSET(vfit_garment_info, name, 16);
OFFSET(vfit_garment_info, garment_kind, 80);
OFFSET(vfit_garment_info, fabric, 112);
OFFSET(vfit_garment_info, size_chart, 144);
OFFSET(vfit_garment_info, body_sex, 204);
SIZE(vfit_garment_info, 208);

OFFSET(vfit_garment_part, struct_size, 0);
OFFSET(vfit_garment_part, first_index, 4);
OFFSET(vfit_garment_part, index_count, 8);
OFFSET(vfit_garment_part, color, 12);
OFFSET(vfit_garment_part, material, 24);
OFFSET(vfit_garment_part, texture, 72);
SIZE(vfit_garment_part, 272);

OFFSET(vfit_cloth_desc, struct_size, 0);
OFFSET(vfit_cloth_desc, substeps, 4);
OFFSET(vfit_cloth_desc, gravity, 8);
OFFSET(vfit_cloth_desc, friction, 20);
OFFSET(vfit_cloth_desc, damping, 24);
OFFSET(vfit_cloth_desc, thickness_m, 28);
OFFSET(vfit_cloth_desc, size_label, 32);
OFFSET(vfit_cloth_desc, flags, 40);
OFFSET(vfit_cloth_desc, reserved, 44);
OFFSET(vfit_cloth_desc, wind, 48);
OFFSET(vfit_cloth_desc, drag, 60);
OFFSET(vfit_cloth_desc, lift, 64);
OFFSET(vfit_cloth_desc, inertia, 68);
OFFSET(vfit_cloth_desc, self_thickness_m, 72);
OFFSET(vfit_cloth_desc, budget_ms, 76);
OFFSET(vfit_cloth_desc, cover_m, 80);
OFFSET(vfit_cloth_desc, virtual_m, 84);
OFFSET(vfit_cloth_desc, carry_speed_m_s, 88);
OFFSET(vfit_cloth_desc, carry_way_m, 92);
SIZE(vfit_cloth_desc, 96);

OFFSET(vfit_cloth_stats, struct_size, 0);
OFFSET(vfit_cloth_stats, vertex_count, 4);
OFFSET(vfit_cloth_stats, simulated_count, 8);
OFFSET(vfit_cloth_stats, constraint_count, 12);
OFFSET(vfit_cloth_stats, strain_mean, 16);
OFFSET(vfit_cloth_stats, strain_p99, 20);
OFFSET(vfit_cloth_stats, strain_max, 24);
OFFSET(vfit_cloth_stats, step_ms, 28);
OFFSET(vfit_cloth_stats, substeps, 32);
OFFSET(vfit_cloth_stats, collider_count, 36);
OFFSET(vfit_cloth_stats, sleeves_taken_up_m, 40);
OFFSET(vfit_cloth_stats, legs_taken_up_m, 44);
SIZE(vfit_cloth_stats, 48);

OFFSET(vfit_prop_desc, struct_size, 0);
OFFSET(vfit_prop_desc, shape, 4);
OFFSET(vfit_prop_desc, size, 8);
OFFSET(vfit_prop_desc, vertex_count, 20);
OFFSET(vfit_prop_desc, positions, 24);
OFFSET(vfit_prop_desc, indices, 32);
OFFSET(vfit_prop_desc, index_count, 40);
OFFSET(vfit_prop_desc, reserved, 44);
SIZE(vfit_prop_desc, 48);

OFFSET(vfit_fit_zone, struct_size, 0);
OFFSET(vfit_fit_zone, fit, 4);
OFFSET(vfit_fit_zone, body_m, 8);
OFFSET(vfit_fit_zone, garment_m, 12);
OFFSET(vfit_fit_zone, ease_m, 16);
OFFSET(vfit_fit_zone, strain, 20);
OFFSET(vfit_fit_zone, pressure_pa, 24);
OFFSET(vfit_fit_zone, opening_m, 28);
OFFSET(vfit_fit_zone, key, 32);
SIZE(vfit_fit_zone, 80);

OFFSET(vfit_crossing, struct_size, 0);
OFFSET(vfit_crossing, kind, 4);
OFFSET(vfit_crossing, cloth, 8);
OFFSET(vfit_crossing, other, 12);
OFFSET(vfit_crossing, pair_count, 16);
OFFSET(vfit_crossing, triangle, 20);
OFFSET(vfit_crossing, other_triangle, 24);
OFFSET(vfit_crossing, reserved, 28);
SIZE(vfit_crossing, 32);

OFFSET(vfit_frame_layout, struct_size, 0);
OFFSET(vfit_frame_layout, stream, 4);
OFFSET(vfit_frame_layout, format, 8);
OFFSET(vfit_frame_layout, width, 12);
OFFSET(vfit_frame_layout, height, 16);
OFFSET(vfit_frame_layout, reserved, 20);
SIZE(vfit_frame_layout, 24);

OFFSET(vfit_host, struct_size, 0);
OFFSET(vfit_host, abi_min, 4);
OFFSET(vfit_host, abi_max, 8);
OFFSET(vfit_host, reserved, 12);
OFFSET(vfit_host, self, 16);
OFFSET(vfit_host, log, 24);
OFFSET(vfit_host, sensor_added, 32);
OFFSET(vfit_host, sensor_removed, 40);
OFFSET(vfit_host, frame_begin, 48);
OFFSET(vfit_host, frame_pixels, 56);
OFFSET(vfit_host, frame_intrinsics, 64);
OFFSET(vfit_host, frame_camera, 72);
OFFSET(vfit_host, frame_body, 80);
OFFSET(vfit_host, frame_meta, 88);
OFFSET(vfit_host, frame_push, 96);
OFFSET(vfit_host, frame_drop, 104);
OFFSET(vfit_host, stream_state, 112);
OFFSET(vfit_host, time_ns, 120);
SIZE(vfit_host, 128);

OFFSET(vfit_plugin, struct_size, 0);
OFFSET(vfit_plugin, abi, 4);
OFFSET(vfit_plugin, version, 8);
OFFSET(vfit_plugin, caps, 12);
OFFSET(vfit_plugin, name, 16);
OFFSET(vfit_plugin, schemes, 24);
OFFSET(vfit_plugin, usb_ids, 32);
OFFSET(vfit_plugin, self, 40);
OFFSET(vfit_plugin, discover, 48);
OFFSET(vfit_plugin, last_error, 56);
OFFSET(vfit_plugin, open, 64);
OFFSET(vfit_plugin, set_option, 72);
OFFSET(vfit_plugin, mode, 80);
OFFSET(vfit_plugin, option, 88);
OFFSET(vfit_plugin, start, 96);
OFFSET(vfit_plugin, stop, 104);
OFFSET(vfit_plugin, close, 112);
OFFSET(vfit_plugin, shutdown, 120);
SIZE(vfit_plugin, 128);

int main(void) { return 0; }
