#include "client/client.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace vfit::tools {

std::string last_error() {
    std::string message(vfit_last_error(nullptr, 0), '\0');
    vfit_last_error(message.data(), static_cast<uint32_t>(message.size() + 1));
    return message;
}

vfit_result check(vfit_result result) {
    if (result < 0) {
        const std::string message = last_error();
        throw Failure(message.empty() ? vfit_result_name(result) : message);
    }
    return result;
}

std::string joint_name(vfit_joint_id joint) {
    char name[32];
    vfit_joint_name(joint, name, sizeof name);
    return name;
}

std::string bone_name(vfit_bone_id bone) {
    char name[32];
    vfit_bone_name(bone, name, sizeof name);
    return name;
}

Context open_context() {
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    Context context;
    check(vfit_context_create(&desc, context.out()));
    return context;
}

Tracker open_tracker(vfit_context context, const TrackOptions& options) {
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    desc.joints = options.joints;
    desc.user_map = options.user_map;
    desc.fit = options.fit;
    desc.follow = options.chosen ? VFIT_FOLLOW_CHOSEN : options.follow;
    Tracker tracker;
    check(vfit_tracker_create(context, &desc, tracker.out()));
    check(vfit_tracker_set_active(tracker.get(), options.chosen));
    return tracker;
}

Source::Source(vfit_context context, const std::string& uri) {
    check(vfit_sensor_open(context, uri.c_str(), sensor_.out()));
    check(vfit_sensor_start(sensor_.get()));
}

std::optional<Frame> Source::next() {
    Frame frame;
    if (check(vfit_sensor_acquire(sensor_.get(), -1, frame.out())) != VFIT_OK) return std::nullopt;
    ++taken_;
    return frame;
}

uint32_t first_body(vfit_frame frame) {
    const auto bodies = list<vfit_body>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_bodies(frame, items, stride, n);
    });
    return bodies.empty() ? 0 : bodies.front().body_id;
}

uint32_t active_body(vfit_frame frame) {
    uint32_t id = 0;
    check(vfit_frame_active_body(frame, &id, nullptr));
    return id;
}

uint32_t active_body_in_view(vfit_frame frame) {
    uint32_t id = 0;
    vfit_active_state state = VFIT_ACTIVE_NOBODY;
    check(vfit_frame_active_body(frame, &id, &state));
    return state == VFIT_ACTIVE_LOST ? 0 : id;
}

std::vector<vfit_joint> joints_of(vfit_frame frame, uint32_t body_id) {
    return list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_joints(frame, body_id, items, stride, n);
    });
}

vfit_camera camera_of(vfit_frame frame) {
    vfit_camera camera = vfit_camera_init();
    check(vfit_frame_camera(frame, &camera));
    return camera;
}

vfit_view view_of(vfit_frame frame, vfit_stream stream) {
    vfit_view view = vfit_view_init();
    check(vfit_frame_view(frame, stream, &view));
    return view;
}

bool has_stream(vfit_frame frame, vfit_stream stream) {
    vfit_view view = vfit_view_init();
    return vfit_frame_view(frame, stream, &view) == VFIT_OK;
}

std::vector<vfit_rig_bone> rig_of(vfit_avatar avatar) {
    return list<vfit_rig_bone>(
        [&](auto* items, uint32_t stride, uint32_t* n) { return vfit_avatar_rig(avatar, items, stride, n); });
}

std::vector<vfit_bone> bones_of(vfit_motion motion, vfit_pose& pose) {
    return list<vfit_bone>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_motion_pose(motion, &pose, items, stride, n);
    });
}

std::vector<uint32_t> seen_triangles(vfit_avatar avatar, std::span<const vfit_cloth> cloths) {
    Frame rest;
    check(vfit_avatar_acquire_rest(avatar, rest.out()));
    const auto indices = items_of<uint32_t>(rest.get(), VFIT_STREAM_INDEX);
    std::vector<uint8_t> hidden(indices.size() / 3);
    for (const vfit_cloth cloth : cloths)
        check(vfit_cloth_hide_skin(cloth, 0.0f, hidden.data(), uint32_t(hidden.size())));
    std::vector<uint32_t> seen;
    for (size_t t = 0; t < hidden.size(); ++t)
        if (!hidden[t]) seen.insert(seen.end(), &indices[3 * t], &indices[3 * t] + 3);
    return seen;
}

void set_pose(vfit_avatar avatar, const vfit_pose& pose, const std::vector<vfit_bone>& bones) {
    check(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof(vfit_bone),
                           static_cast<uint32_t>(bones.size())));
}

Point to_camera(const vfit_camera& camera, const float (&world)[3]) {
    // The inverse of a rigid transform: columns of the rotation dotted with what is left of the translation.
    const float* m = camera.world_from_camera;
    const float d[3] = {world[0] - m[12], world[1] - m[13], world[2] - m[14]};
    const auto column = [&](int c) { return m[4 * c] * d[0] + m[4 * c + 1] * d[1] + m[4 * c + 2] * d[2]; };
    return {column(0), column(1), column(2)};
}

Json joints_json(const std::vector<vfit_joint>& joints, const vfit_camera& camera) {
    Json out = Json::object();
    for (const vfit_joint& joint : joints) {
        const Point p = to_camera(camera, joint.position);
        out[joint_name(joint.joint)] = {p.x, p.y, p.z, joint.confidence};
    }
    return out;
}

void stand(vfit_avatar avatar, float leg_rad) {
    constexpr float kArm_rad = 0.785f;
    const std::map<vfit_bone_id, float> turned_rad{{VFIT_BONE_HIPS, 0.0f},
                                                   {VFIT_BONE_LEFT_UPPER_ARM, -kArm_rad},
                                                   {VFIT_BONE_RIGHT_UPPER_ARM, kArm_rad},
                                                   {VFIT_BONE_LEFT_UPPER_LEG, leg_rad},
                                                   {VFIT_BONE_RIGHT_UPPER_LEG, -leg_rad}};
    std::vector<vfit_bone> bones;
    for (const vfit_rig_bone& rig : rig_of(avatar)) {
        const auto turn = turned_rad.find(rig.bone);
        if (turn == turned_rad.end()) continue;
        vfit_bone bone = vfit_bone_init();
        bone.bone = rig.bone;
        std::copy(rig.rest_position, rig.rest_position + 3, bone.position);
        bone.rotation[2] = std::sin(0.5f * turn->second), bone.rotation[3] = std::cos(0.5f * turn->second);
        bones.push_back(bone);
    }
    set_pose(avatar, vfit_pose_init(), bones);
}

}  // namespace vfit::tools
