#include "person.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "error.h"

namespace vfit::virtual_person {

OwnContext::OwnContext() {
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    desc.flags = VFIT_CONTEXT_DETERMINISTIC;
    desc.worker_count = 1;
    desc.plugin_dir = "";  // none: it only shapes and poses a body
    check(vfit_context_create(&desc, &context_), "vfit_context_create");
}

std::vector<vfit_shape_value> shape_list(vfit_context context) {
    uint32_t count = 0;
    check(vfit_shape_list(context, nullptr, sizeof(vfit_shape_value), &count), "vfit_shape_list");
    std::vector<vfit_shape_value> values(count, vfit_shape_value_init());
    check(vfit_shape_list(context, values.data(), sizeof(vfit_shape_value), &count), "vfit_shape_list");
    values.resize(count);
    return values;
}

Person::Person(vfit_context context, vfit_sex sex, uint32_t detail,
               const std::map<std::string, float>& shape) {
    std::vector<vfit_shape_value> values;
    for (const auto& [key, value] : shape) {
        vfit_shape_value v = vfit_shape_value_init();
        v.value = value;
        std::snprintf(v.key, sizeof v.key, "%s", key.c_str());
        values.push_back(v);
    }
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.flags = VFIT_AVATAR_LIMBS_AS_POSED;  // the motion keeps its limbs clear; scans learn from plain skin
    desc.sex = sex;
    desc.detail = detail;
    check(vfit_avatar_create_from_shape(context, &desc, values.data(), sizeof(vfit_shape_value),
                                        static_cast<uint32_t>(values.size()), &avatar_),
          "vfit_avatar_create_from_shape");
    try {
        joints_.resize(VFIT_JOINT_COUNT, vfit_joint_init());
        BonePose t_pose;
        t_pose.rotation.fill(kNoRotation);
        pose(t_pose, Vec3(0.0f));
        read_triangles();
        read_proportions();
        read_measures();
    } catch (...) {
        vfit_frame_release(mesh_);
        vfit_avatar_destroy(avatar_);
        throw;
    }
}

Person::~Person() {
    if (mesh_.id) vfit_frame_release(mesh_);
    vfit_avatar_destroy(avatar_);
}

void Person::pose(const BonePose& pose, const Vec3& offset) {
    std::array<vfit_bone, VFIT_BONE_COUNT> bones;
    for (size_t i = 0; i < bones.size(); ++i) {
        bones[i] = vfit_bone_init();
        bones[i].bone = static_cast<vfit_bone_id>(i);
        const Quat& q = pose.rotation[i];
        const float xyzw[4] = {q.x, q.y, q.z, q.w};
        std::memcpy(bones[i].rotation, xyzw, sizeof xyzw);
    }
    const Vec3 hips = pose.hips + offset;
    for (int k = 0; k < 3; ++k) bones[VFIT_BONE_HIPS].position[k] = hips[k];
    vfit_pose header = vfit_pose_init();
    if (pose.contact[kLeft]) header.contact_flags |= VFIT_CONTACT_LEFT;
    if (pose.contact[kRight]) header.contact_flags |= VFIT_CONTACT_RIGHT;
    check(vfit_avatar_pose(avatar_, &header, bones.data(), sizeof(vfit_bone), VFIT_BONE_COUNT),
          "vfit_avatar_pose");

    if (mesh_.id) vfit_frame_release(mesh_);
    mesh_ = {};
    check(vfit_avatar_acquire(avatar_, &mesh_), "vfit_avatar_acquire");
    const vfit_view skin = vertices(VFIT_STREAM_POSITION);
    vertex_count_ = skin.width;
    skin_ = static_cast<const float*>(skin.data);
    surface_ = skin_;
    if (clothing_)
        surface_ = clothing_->dress(skin_, static_cast<const float*>(vertices(VFIT_STREAM_NORMAL).data));
    read_joints();
}

vfit_view Person::vertices(vfit_stream stream) const {
    vfit_view view = vfit_view_init();
    check(vfit_frame_view(mesh_, stream, &view), "vfit_frame_view");
    if (view.format != VFIT_FORMAT_F32X3 || view.item_stride != 3 * sizeof(float))
        fail(VFIT_ERROR_UNSUPPORTED, "virtual: the body's vertices are not packed floats");
    return view;
}

void Person::wear(const Thickness& thickness, uint64_t seed) {
    clothing_.reset();
    if (!thickness.any()) return;
    const BodyLandmarks landmarks{joint_place(VFIT_JOINT_NECK).y, joint_place(VFIT_JOINT_TORSO).y,
                                  joint_place(VFIT_JOINT_LEFT_FOOT).y, joint_place(VFIT_JOINT_LEFT_WRIST).x,
                                  joint_place(VFIT_JOINT_LEFT_SHOULDER).x};
    clothing_.emplace(std::span(skin_, size_t{3} * vertex_count_), triangles_, landmarks, thickness, seed);
}

void Person::read_joints() {
    auto count = static_cast<uint32_t>(joints_.size());
    check(vfit_avatar_joints(avatar_, joints_.data(), sizeof(vfit_joint), &count), "vfit_avatar_joints");
    if (count != VFIT_JOINT_COUNT)
        fail(VFIT_ERROR_DATA, "virtual: the body has ", count, " joints, not ", VFIT_JOINT_COUNT);
}

void Person::read_triangles() {
    vfit_view view = vfit_view_init();
    check(vfit_frame_view(mesh_, VFIT_STREAM_INDEX, &view), "vfit_frame_view");
    const auto* indices = static_cast<const uint32_t*>(view.data);
    triangles_.assign(indices, indices + view.width);
}

Vec3 Person::joint_place(vfit_joint_id joint) const {
    for (const vfit_joint& j : joints_)
        if (j.joint == joint) return {j.position[0], j.position[1], j.position[2]};
    fail(VFIT_ERROR_DATA, "virtual: the body has no joint ", joint);
}

// From the T-pose with the hips at (0, 1, 0).
void Person::read_proportions() {
    const Vec3 hips(0, 1, 0);
    float lowest = skin_[1];
    for (uint32_t i = 0; i < vertex_count_; ++i) lowest = std::min(lowest, skin_[3 * i + 1]);
    float ankle = 0;
    for (const int side : {kLeft, kRight}) {
        const auto at = [&](vfit_joint_id left) {
            return joint_place(left + side);
        };  // the right one follows the left
        Leg& leg = proportions_.leg[size_t(side)];
        leg.hip = at(VFIT_JOINT_LEFT_HIP) - hips;
        leg.thigh = at(VFIT_JOINT_LEFT_KNEE) - at(VFIT_JOINT_LEFT_HIP);
        leg.shank = at(VFIT_JOINT_LEFT_FOOT) - at(VFIT_JOINT_LEFT_KNEE);
        leg.foot = at(VFIT_JOINT_LEFT_TOES) - at(VFIT_JOINT_LEFT_FOOT);
        proportions_.upper_arm[size_t(side)] = at(VFIT_JOINT_LEFT_ELBOW) - at(VFIT_JOINT_LEFT_SHOULDER);
        proportions_.forearm[size_t(side)] = at(VFIT_JOINT_LEFT_WRIST) - at(VFIT_JOINT_LEFT_ELBOW);
        ankle += 0.5f * (at(VFIT_JOINT_LEFT_FOOT).y - lowest);
    }
    proportions_.ankle_height_m = ankle;
}

void Person::read_measures() {
    uint32_t count = 0;
    check(vfit_avatar_measure(avatar_, nullptr, sizeof(vfit_measurement), &count), "vfit_avatar_measure");
    std::vector<vfit_measurement> items(count, vfit_measurement_init());
    check(vfit_avatar_measure(avatar_, items.data(), sizeof(vfit_measurement), &count),
          "vfit_avatar_measure");
    measures_json_.assign(1, '{');
    for (uint32_t i = 0; i < count; ++i) {
        // Whole tenths of a millimetre, written with a point whatever the locale.
        const auto tenths = static_cast<long long>(items[i].value * 10000.0 + 0.5);
        char text[80];
        std::snprintf(text, sizeof text, "%s\"%s\": %lld.%04lld", i ? ", " : "", items[i].key, tenths / 10000,
                      tenths % 10000);
        measures_json_ += text;
    }
    measures_json_ += '}';
}

}  // namespace vfit::virtual_person
