#include "client/bvh_joints.h"

#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "client/bvh_file.h"
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

float guessed_scale(const std::string& path, float height) {
    for (const float unit : kUnits_m)
        if (height * unit >= kMinStature_m && height * unit <= kMaxStature_m) return unit;
    throw Failure(
        path + ": the skeleton is " + std::to_string(height) +
        " units tall, which is no person in metres, centimetres, millimetres, inches or CMU's units; "
        "give --scale, metres in a unit of the file");
}

/// The skeleton at rest as a character's file: a small tetrahedron at each joint, carried by it.
class SkeletonGlb {
public:
    SkeletonGlb(const BvhFile& file, bool is_z_up, float size) {
        const std::vector<vec3> places = file.rest();
        const size_t count = places.size();
        json_["asset"]["version"] = "2.0";
        for (size_t j = 0; j < count; ++j) {
            const BvhJoint& joint = file.joints[j];
            json_["nodes"].push_back({{"name", joint.name}, {"translation", list_of(joint.offset)}});
            if (joint.parent >= 0) json_["nodes"][size_t(joint.parent)]["children"].push_back(j);
            json_["skins"][0]["joints"].push_back(j);
            mat4 bind(1.0f);
            bind[3] = glm::vec4(-places[j], 1.0f);
            binds_.insert(binds_.end(), glm::value_ptr(bind), glm::value_ptr(bind) + 16);
            // The end of a bone is a part of it: of the head, the crown.
            add_tetrahedron(places[j], joint.is_end ? joint.parent : int(j), size);
        }
        json_["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
        const float half = std::sqrt(0.5f);
        if (is_z_up)
            json_["nodes"].push_back(
                {{"name", "Z up"}, {"children", {0}}, {"rotation", {-half, 0, 0, half}}});
        json_["scenes"] = Json::array({{{"nodes", {is_z_up ? count + 1 : 0, count}}}});
        Json& part = json_["meshes"][0]["primitives"][0];
        const size_t vertices = positions_.size() / 3;
        part["attributes"]["POSITION"] = add(positions_, "VEC3", 5126, vertices);
        part["attributes"]["JOINTS_0"] = add(bones_, "VEC4", 5123, vertices);
        part["attributes"]["WEIGHTS_0"] = add(weights_, "VEC4", 5126, vertices);
        part["indices"] = add(indices_, "SCALAR", 5125, indices_.size());
        json_["skins"][0]["inverseBindMatrices"] = add(binds_, "MAT4", 5126, count);
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    }

    std::string bytes() const {
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        while (text.size() % 4) text += ' ';
        std::string out = "glTF";
        const auto number = [&](uint32_t n) {
            for (int i = 0; i < 4; ++i) out += char(n >> (8 * i));
        };
        number(2);
        number(uint32_t(12 + 8 + text.size() + 8 + binary_.size()));
        number(uint32_t(text.size()));
        return (out += "JSON") += text, number(uint32_t(binary_.size())),
               out += std::string("BIN\0", 4) + binary_;
    }

private:
    static Json list_of(const vec3& v) { return Json::array({v.x, v.y, v.z}); }

    void add_tetrahedron(const vec3& at, int bone, float size) {
        const auto first = uint32_t(positions_.size() / 3);
        for (const vec3 corner : {vec3(0, 0, 0), vec3(size, 0, 0), vec3(0, size, 0), vec3(0, 0, size)}) {
            const vec3 p = at + corner;
            positions_.insert(positions_.end(), {p.x, p.y, p.z});
            bones_.insert(bones_.end(), {uint16_t(bone), 0, 0, 0});
            weights_.insert(weights_.end(), {1.0f, 0.0f, 0.0f, 0.0f});
        }
        for (const uint32_t i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) indices_.push_back(first + i);
    }

    template <typename T>
    size_t add(const std::vector<T>& items, const char* type, int component, size_t count) {
        while (binary_.size() % 4) binary_ += '\0';
        const size_t size = items.size() * sizeof(T);
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                      {"componentType", component},
                                      {"count", count},
                                      {"type", type}});
        binary_.append(reinterpret_cast<const char*>(items.data()), size);
        return json_["accessors"].size() - 1;
    }

    Json json_;
    std::string binary_;
    std::vector<float> positions_, weights_, binds_;
    std::vector<uint16_t> bones_;
    std::vector<uint32_t> indices_;
};

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
    vec3 place;  // from the carrier's own place, at rest
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

std::vector<Anchor> anchors_of(vfit_avatar avatar, const BvhFile& file, const mat4& file_from_world) {
    const std::vector<vec3> rest = file.rest();
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
        Anchor anchor = {joint.joint, size_t(rig[carrier].node), vec3(at)};
        anchor.place -= rest[anchor.carrier];
        // Toes without a bone are where the foot ends.
        const bool is_toes = joint.joint == VFIT_JOINT_LEFT_TOES || joint.joint == VFIT_JOINT_RIGHT_TOES;
        if (const int tip = tip_of(file, anchor.carrier);
            is_toes && bone != kCarriers[size_t(joint.joint)] && tip >= 0)
            anchor.place = file.joints[size_t(tip)].offset;
        anchors.push_back(anchor);
    }
    return anchors;
}

/// Along the axis that the skeleton is longest in, where that is Y or Z.
bool is_z_up(const vec3& size) { return size.z > size.y && size.z > size.x; }

}  // namespace

std::vector<JointRow> read_bvh_joints(vfit_context context, const std::string& path,
                                      const BvhOptions& options) {
    const BvhFile file = read_bvh(path);
    const std::vector<vec3> rest = file.rest();
    vec3 low = rest.front(), high = low;
    for (const vec3& p : rest) low = glm::min(low, p), high = glm::max(high, p);
    const bool z_up = is_z_up(high - low);
    const float height = (high - low)[z_up ? 2 : 1];
    const float scale = options.scale > 0.0f ? options.scale : guessed_scale(path, height);

    const std::string glb = SkeletonGlb(file, z_up, 0.01f / scale).bytes();
    vfit_character_desc desc = vfit_character_desc_init();
    desc.bytes = glb.data();
    desc.byte_count = glb.size();
    desc.scale = scale;
    if (!options.bone_map.empty()) desc.bone_map = options.bone_map.c_str();
    vfit_avatar_desc as_posed = vfit_avatar_desc_init();
    as_posed.flags = VFIT_AVATAR_LIMBS_AS_POSED;
    Avatar avatar;
    try {
        check(vfit_avatar_load(context, &as_posed, &desc, avatar.out()));
    } catch (const Failure& failure) {
        throw Failure(path + ": its skeleton cannot be moved: " + failure.what());
    }

    mat4 upright(1.0f);
    if (z_up) upright = glm::mat4_cast(glm::angleAxis(-0.5f * 3.14159265f, vec3(1, 0, 0)));
    const std::vector<Anchor> anchors = anchors_of(avatar.get(), file, glm::inverse(upright));
    std::vector<JointRow> rows(file.frame_count);
    for (size_t f = 0; f < rows.size(); ++f) {
        rows[f].time_ns = std::llround(1e9 * file.frame_time_s * double(f));
        const std::vector<mat4> pose = file.pose(f);
        for (const Anchor& anchor : anchors) {
            const vec3 at = scale * vec3(upright * pose[anchor.carrier] * glm::vec4(anchor.place, 1.0f));
            add_joint(rows[f], anchor.joint, at.x, at.y, at.z);
        }
    }
    put_on_floor(rows);
    check_times(rows, path);
    check_lengths(rows, path);
    return rows;
}

}  // namespace vfit::tools
