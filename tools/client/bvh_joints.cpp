#include "client/bvh_joints.h"

#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "client/bvh_file.h"
#include "client/bvh_skeleton.h"
#include "client/client.h"
#include "client/joint_checks.h"

namespace vfit::tools {

namespace {

using glm::mat4;
using glm::vec3;

// Of grown people and of children that walk. No two of the units below bring one height in here.
constexpr float kMinStature_m = 1.1f, kMaxStature_m = 2.2f;
/// Metres, centimetres, millimetres, inches, and the unit of CMU's own database: inches / 0.45.
constexpr float kUnits_m[] = {1.0f, 0.01f, 0.001f, 0.0254f, 0.0254f / 0.45f};

float guessed_scale(float height) {
    for (const float unit : kUnits_m)
        if (height * unit >= kMinStature_m && height * unit <= kMaxStature_m) return unit;
    throw Failure(
        "the skeleton is " + std::to_string(height) +
        " units tall, which is no person in metres, centimetres, millimetres, inches or CMU's units; "
        "give --scale, metres in a unit of the file");
}

/// By joint id: the bone that a joint lies on.
constexpr std::array<vfit_bone_id, VFIT_JOINT_COUNT> kCarriers = {
    VFIT_BONE_HEAD,
    VFIT_BONE_NECK,
    VFIT_BONE_CHEST,
    VFIT_BONE_LEFT_UPPER_ARM,
    VFIT_BONE_RIGHT_UPPER_ARM,
    VFIT_BONE_LEFT_LOWER_ARM,
    VFIT_BONE_RIGHT_LOWER_ARM,
    VFIT_BONE_LEFT_HAND,
    VFIT_BONE_RIGHT_HAND,
    VFIT_BONE_LEFT_UPPER_LEG,
    VFIT_BONE_RIGHT_UPPER_LEG,
    VFIT_BONE_LEFT_LOWER_LEG,
    VFIT_BONE_RIGHT_LOWER_LEG,
    VFIT_BONE_LEFT_FOOT,
    VFIT_BONE_RIGHT_FOOT,
    VFIT_BONE_HIPS,
    VFIT_BONE_UPPER_CHEST,
    VFIT_BONE_LEFT_SHOULDER,
    VFIT_BONE_RIGHT_SHOULDER,
    VFIT_BONE_LEFT_HAND,
    VFIT_BONE_RIGHT_HAND,
    VFIT_BONE_LEFT_TOES,
    VFIT_BONE_RIGHT_TOES,
};

/// Of a bone that a file may be without, the one that it is a part of then.
vfit_bone_id below(vfit_bone_id bone) {
    switch (bone) {
        case VFIT_BONE_LEFT_TOES: return VFIT_BONE_LEFT_FOOT;
        case VFIT_BONE_RIGHT_TOES: return VFIT_BONE_RIGHT_FOOT;
        case VFIT_BONE_CHEST: return VFIT_BONE_SPINE;
        case VFIT_BONE_UPPER_CHEST: return VFIT_BONE_CHEST;
        default: return VFIT_BONE_UPPER_CHEST;
    }
}

/// A joint at a fixed place on a joint of the file.
struct Anchor {
    vfit_joint_id joint;
    size_t carrier;
    vec3 place;  // in the carrier's own axes
};

/// The joint or end that hangs on this one and stands the longest way from it; -1: there is none.
int tip_of(const BvhFile& file, size_t joint) {
    int tip = -1;
    for (size_t j = 0; j < file.joints.size(); ++j)
        if (file.joints[j].parent == int(joint) &&
            (tip < 0 || glm::length(file.joints[j].offset) > glm::length(file.joints[size_t(tip)].offset)))
            tip = int(j);
    return tip;
}

/// worlds: of the joints as the avatar's file has them.
std::vector<Anchor> anchors_of(vfit_avatar avatar, const BvhFile& file, const std::vector<mat4>& worlds,
                               const mat4& file_from_world) {
    vfit_character_info info = vfit_character_info_init();
    check(vfit_avatar_describe(avatar, &info));
    const mat4 world_from_rest = glm::inverse(glm::make_mat4(info.from_file));
    std::array<int, VFIT_BONE_COUNT> rig_of_bone;
    rig_of_bone.fill(-1);
    const std::vector<vfit_rig_bone> rig = rig_of(avatar);
    for (size_t i = 0; i < rig.size(); ++i)
        if (rig[i].bone >= 0) rig_of_bone[size_t(rig[i].bone)] = int(i);
    Frame frame;
    check(vfit_avatar_acquire(avatar, frame.out()));
    const auto matrices = items_of<mat4>(frame.get(), VFIT_STREAM_BONE_MATRIX);
    std::vector<Anchor> anchors;
    for (const auto& joint : list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_avatar_joints(avatar, items, stride, n);
         })) {
        vfit_bone_id bone = kCarriers[size_t(joint.joint)];
        while (rig_of_bone[size_t(bone)] < 0) bone = below(bone);
        const auto carrier = size_t(rig_of_bone[size_t(bone)]);
        const glm::vec4 posed(glm::make_vec3(joint.position), 1.0f);
        const glm::vec4 at = file_from_world * world_from_rest * glm::inverse(matrices[carrier]) * posed;
        const auto node = size_t(rig[carrier].node);
        Anchor anchor = {joint.joint, node, vec3(glm::inverse(worlds[node]) * at)};
        // Toes without a bone are where the foot ends.
        const bool is_toes = joint.joint == VFIT_JOINT_LEFT_TOES || joint.joint == VFIT_JOINT_RIGHT_TOES;
        if (const int tip = tip_of(file, anchor.carrier);
            is_toes && bone != kCarriers[size_t(joint.joint)] && tip >= 0)
            anchor.place = file.joints[size_t(tip)].offset;
        anchors.push_back(anchor);
    }
    return anchors;
}

mat4 upright_from(bool z_up) {
    return z_up ? glm::mat4_cast(glm::angleAxis(-0.5f * 3.14159265f, vec3(1, 0, 0))) : mat4(1.0f);
}

/// Whether people of a file whose skeleton is upright along Z move so, too: a root may turn them to Y.
bool moves_along_z(const BvhFile& file, const std::vector<Anchor>& anchors) {
    vec3 sum(0.0f);
    const auto place = [&](const std::vector<mat4>& pose, vfit_joint_id joint) {
        for (const Anchor& anchor : anchors)
            if (anchor.joint == joint) return vec3(pose[anchor.carrier][3]);
        return vec3(0.0f);
    };
    for (size_t f = 0; f < file.frame_count; ++f) {
        const std::vector<mat4> pose = file.pose(f);
        sum += place(pose, VFIT_JOINT_HEAD) - place(pose, VFIT_JOINT_PELVIS);
    }
    return std::abs(sum.z) > std::abs(sum.y);
}

/// Which of vfit's joints lie where on the file's, and the size of its unit.
struct Skeleton {
    std::vector<Anchor> anchors;
    float scale = 1.0f;
    bool is_z_up = false;
};

/// Of the joints as they stand in `worlds`, which has to be upright.
Skeleton skeleton_of(vfit_context context, const BvhFile& file, const std::vector<mat4>& worlds,
                     const BvhOptions& options) {
    vec3 low(worlds.front()[3]), high = low;
    for (const mat4& m : worlds) low = glm::min(low, vec3(m[3])), high = glm::max(high, vec3(m[3]));
    const vec3 size = high - low;
    Skeleton skeleton;
    skeleton.is_z_up = size.z > size.y && size.z > size.x;
    skeleton.scale = options.scale > 0.0f ? options.scale : guessed_scale(skeleton.is_z_up ? size.z : size.y);

    const std::string glb = skeleton_glb(file, worlds, skeleton.is_z_up, 0.01f / skeleton.scale);
    vfit_character_desc desc = vfit_character_desc_init();
    desc.bytes = glb.data();
    desc.byte_count = glb.size();
    desc.scale = skeleton.scale;
    if (!options.bone_map.empty()) desc.bone_map = options.bone_map.c_str();
    vfit_avatar_desc as_posed = vfit_avatar_desc_init();
    as_posed.flags = VFIT_AVATAR_LIMBS_AS_POSED;
    Avatar avatar;
    check(vfit_avatar_load(context, &as_posed, &desc, avatar.out()));
    skeleton.anchors = anchors_of(avatar.get(), file, worlds, glm::inverse(upright_from(skeleton.is_z_up)));
    if (skeleton.is_z_up) skeleton.is_z_up = moves_along_z(file, skeleton.anchors);
    return skeleton;
}

/// Where no channel moves the joints; else, because some files have their bones folded up there, in the first
/// frame.
Skeleton skeleton_of(vfit_context context, const BvhFile& file, const BvhOptions& options) {
    std::vector<mat4> rest;
    for (const vec3& place : file.rest()) {
        rest.emplace_back(1.0f);
        rest.back()[3] = glm::vec4(place, 1.0f);
    }
    try {
        return skeleton_of(context, file, rest, options);
    } catch (const Failure&) {
        try {
            return skeleton_of(context, file, file.pose(0), options);
        } catch (const Failure&) {
        }
        throw;
    }
}

}  // namespace

std::vector<JointRow> read_bvh_joints(vfit_context context, const std::string& path,
                                      const BvhOptions& options) {
    const BvhFile file = read_bvh(path);
    Skeleton skeleton;
    try {
        skeleton = skeleton_of(context, file, options);
    } catch (const Failure& failure) {
        throw Failure(path + ": its skeleton cannot be moved: " + failure.what());
    }
    const mat4 world_from_file = upright_from(skeleton.is_z_up);
    std::vector<JointRow> rows(file.frame_count);
    for (size_t f = 0; f < rows.size(); ++f) {
        rows[f].time_ns = std::llround(1e9 * file.frame_time_s * double(f));
        const std::vector<mat4> pose = file.pose(f);
        for (const Anchor& anchor : skeleton.anchors) {
            const vec3 at =
                skeleton.scale * vec3(world_from_file * pose[anchor.carrier] * glm::vec4(anchor.place, 1.0f));
            add_joint(rows[f], anchor.joint, at.x, at.y, at.z);
        }
    }
    put_on_floor(rows);
    check_times(rows, path);
    check_lengths(rows, path);
    return rows;
}

}  // namespace vfit::tools
