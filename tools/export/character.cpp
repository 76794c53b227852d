#include "export/character.h"

#include <algorithm>
#include <array>
#include <map>

#include "export/glb_writer.h"

namespace vfit::tools {

namespace {

using glm::mat4;
using glm::quat;
using glm::vec3;

/// A bone of the style: its name, and the humanoid bone that it is or shares the twist of.
struct StyleBone {
    std::string name;
    int bone = -1;  // VFIT_BONE_*; of a twist bone that of its limb
    int parent = -1;
    bool twist = false;
};

struct Style {
    const char* name;
    RigStyle style;
};
constexpr Style kStyles[] = {{"vrm0", RigStyle::vrm0},
                             {"vrm1", RigStyle::vrm1},
                             {"mixamo", RigStyle::mixamo},
                             {"bones31", RigStyle::bones31}};

// A picture of 1 x 1 pixels (PNG): so that there is a texture to carry along.
constexpr unsigned char kPixel[] = {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D,
                                    0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                    0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
                                    0x0C, 0x49, 0x44, 0x41, 0x54, 0x08, 0xD7, 0x63, 0xF8, 0xFF, 0xFF, 0x3F,
                                    0x00, 0x05, 0xFE, 0x02, 0xFE, 0xDC, 0xCC, 0x59, 0xE7, 0x00, 0x00, 0x00,
                                    0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

bool is_required(int bone) {
    switch (bone) {
        case VFIT_BONE_CHEST:
        case VFIT_BONE_UPPER_CHEST:
        case VFIT_BONE_NECK:
        case VFIT_BONE_LEFT_SHOULDER:
        case VFIT_BONE_RIGHT_SHOULDER:
        case VFIT_BONE_LEFT_TOES:
        case VFIT_BONE_RIGHT_TOES: return false;
        default: return true;
    }
}

bool is_limb(int bone) {
    for (const int b : {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_UPPER_ARM,
                        VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG,
                        VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG})
        if (b == bone) return true;
    return false;
}

std::string style_name(RigStyle style, int bone) {
    constexpr const char* kMixamo[] = {
        "Hips",         "Spine",     "Spine1",      "Spine2",      "Neck",          "Head",
        "LeftShoulder", "LeftArm",   "LeftForeArm", "LeftHand",    "RightShoulder", "RightArm",
        "RightForeArm", "RightHand", "LeftUpLeg",   "LeftLeg",     "LeftFoot",      "LeftToeBase",
        "RightUpLeg",   "RightLeg",  "RightFoot",   "RightToeBase"};
    constexpr const char* kUnreal[] = {"pelvis",     "spine_01",   "spine_02",   "spine_03",   "neck_01",
                                       "head",       "clavicle_l", "upperarm_l", "lowerarm_l", "hand_l",
                                       "clavicle_r", "upperarm_r", "lowerarm_r", "hand_r",     "thigh_l",
                                       "calf_l",     "foot_l",     "ball_l",     "thigh_r",    "calf_r",
                                       "foot_r",     "ball_r"};
    static_assert(std::size(kMixamo) == VFIT_BONE_COUNT && std::size(kUnreal) == VFIT_BONE_COUNT);
    switch (style) {
        case RigStyle::mixamo: return std::string("mixamorig:") + kMixamo[bone];
        case RigStyle::bones31: return kUnreal[bone];
        case RigStyle::vrm0: return "J_" + bone_name(bone);
        default: return bone_name(bone);
    }
}

std::vector<StyleBone> bones_of_style(RigStyle style) {
    std::vector<StyleBone> bones;
    std::array<int, VFIT_BONE_COUNT> of{};
    of.fill(-1);
    if (style == RigStyle::bones31) bones.push_back({"root", -1, -1, false});
    for (int b = 0; b < int(VFIT_BONE_COUNT); ++b) {
        if (style == RigStyle::vrm1 && !is_required(b)) continue;
        int above = vfit_bone_parent(b);
        while (above >= 0 && of[size_t(above)] < 0) above = vfit_bone_parent(above);
        of[size_t(b)] = int(bones.size());
        bones.push_back({style_name(style, b), b,
                         above >= 0 ? of[size_t(above)] : int(style == RigStyle::bones31) - 1, false});
    }
    if (style == RigStyle::bones31)
        for (int b = 0; b < int(VFIT_BONE_COUNT); ++b)
            if (is_limb(b)) {
                std::string name = style_name(style, b);
                name.insert(name.size() - 2, "_twist_01");
                bones.push_back({name, b, of[size_t(b)], true});
            }
    return bones;
}

/// The body in the posture that the file binds to, world space, and where its bones start.
struct Bind {
    std::vector<vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<uint32_t> indices;
    std::vector<std::array<uint16_t, 8>> skin_bones;
    std::vector<std::array<float, 8>> skin_weights;
    std::vector<vfit_rig_bone> rig;
    std::vector<vec3> heads;  // one a rig bone
};

Bind bind_of(vfit_avatar avatar, bool t_pose) {
    struct Bones {
        std::array<uint16_t, 8> bone;
    };
    struct Weights {
        std::array<float, 8> weight;
    };
    Frame frame;
    check(t_pose ? vfit_avatar_acquire(avatar, frame.out()) : vfit_avatar_acquire_rest(avatar, frame.out()));
    Bind bind;
    bind.positions = items_of<vec3>(frame.get(), VFIT_STREAM_POSITION);
    bind.normals = items_of<vec3>(frame.get(), VFIT_STREAM_NORMAL);
    bind.uvs = items_of<glm::vec2>(frame.get(), VFIT_STREAM_UV);
    bind.indices = items_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX);
    for (const Bones& b : items_of<Bones>(frame.get(), VFIT_STREAM_SKIN_BONES))
        bind.skin_bones.push_back(b.bone);
    for (const Weights& w : items_of<Weights>(frame.get(), VFIT_STREAM_SKIN_WEIGHTS))
        bind.skin_weights.push_back(w.weight);
    bind.rig = rig_of(avatar);
    const auto matrices = items_of<mat4>(frame.get(), VFIT_STREAM_BONE_MATRIX);
    for (size_t i = 0; i < bind.rig.size(); ++i) {
        const float* p = bind.rig[i].rest_position;
        bind.heads.push_back(vec3(matrices[i] * glm::vec4(p[0], p[1], p[2], 1.0f)));
    }
    return bind;
}

/// Weights by bones of the style, four and the rest.
struct StyleSkin {
    std::vector<std::array<uint16_t, 8>> bones;
    std::vector<std::array<float, 8>> weights;
};

StyleSkin style_skin(const Bind& bind, const std::vector<StyleBone>& style, const std::vector<vec3>& heads) {
    std::vector<int> to(bind.rig.size(), -1);  // the style's bone that takes over
    for (size_t i = 0; i < bind.rig.size(); ++i) {
        for (size_t s = 0; s < style.size(); ++s)
            if (bind.rig[i].bone >= 0 && style[s].bone == bind.rig[i].bone && !style[s].twist) to[i] = int(s);
        if (to[i] < 0 && bind.rig[i].parent >= 0) to[i] = to[size_t(bind.rig[i].parent)];
        if (to[i] < 0) to[i] = style[0].bone < 0 ? 1 : 0;
    }
    StyleSkin skin;
    for (size_t v = 0; v < bind.positions.size(); ++v) {
        std::map<int, float> share;
        for (size_t k = 0; k < 8; ++k)
            if (bind.skin_weights[v][k] > 0.0f) share[to[bind.skin_bones[v][k]]] += bind.skin_weights[v][k];
        for (size_t s = 0; s < style.size(); ++s) {
            if (!style[s].twist || !share.count(style[s].parent)) continue;
            // The limb's part grows linearly into the twist bone towards the next joint.
            size_t next = 0;
            for (size_t n = 0; n < style.size(); ++n)
                if (style[n].parent == style[s].parent && !style[n].twist) next = n;
            const vec3 start = heads[size_t(style[s].parent)], axis = heads[next] - start;
            const float along =
                std::clamp(glm::dot(bind.positions[v] - start, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
            float& limb = share[style[s].parent];
            share[int(s)] = along * limb;
            limb *= 1.0f - along;
        }
        std::vector<std::pair<float, int>> sorted;
        for (const auto& [bone, weight] : share)
            if (weight > 0.0f) sorted.emplace_back(weight, bone);
        std::sort(sorted.rbegin(), sorted.rend());
        sorted.resize(std::min<size_t>(sorted.size(), 8));
        std::array<uint16_t, 8> b{};
        std::array<float, 8> w{};
        float sum = 0.0f;
        for (const auto& item : sorted) sum += item.first;
        for (size_t k = 0; k < sorted.size(); ++k) {
            b[k] = uint16_t(sorted[k].second);
            w[k] = sorted[k].first / sum;
        }
        skin.bones.push_back(b);
        skin.weights.push_back(w);
    }
    return skin;
}

quat along_y(const vec3& direction) {
    const vec3 d = glm::normalize(direction), y(0, 1, 0);
    if (d.y < -0.9999f) return quat(0, 1, 0, 0);  // half a turn about X
    const vec3 axis = glm::cross(y, d);
    return glm::normalize(quat(1.0f + d.y, axis.x, axis.y, axis.z));
}

tinygltf::Value object(const std::map<std::string, tinygltf::Value>& members) {
    return tinygltf::Value(members);
}

void add_vrm(tinygltf::Model& model, RigStyle style, const std::vector<StyleBone>& bones,
             const std::vector<int>& nodes) {
    using Value = tinygltf::Value;
    if (style == RigStyle::vrm0) {
        std::vector<Value> list;
        for (size_t i = 0; i < bones.size(); ++i)
            list.push_back(object({{"bone", Value(bone_name(bones[i].bone))},
                                   {"node", Value(nodes[i])},
                                   {"useDefaultValues", Value(true)}}));
        model.extensions["VRM"] = object({{"specVersion", Value(std::string("0.0"))},
                                          {"meta", object({{"title", Value(std::string("vfit body"))}})},
                                          {"humanoid", object({{"humanBones", Value(list)}})}});
        model.extensionsUsed = {"VRM"};
    } else {
        std::map<std::string, Value> members;
        for (size_t i = 0; i < bones.size(); ++i)
            members[bone_name(bones[i].bone)] = object({{"node", Value(nodes[i])}});
        model.extensions["VRMC_vrm"] = object({{"specVersion", Value(std::string("1.0"))},
                                               {"meta", object({{"name", Value(std::string("vfit body"))}})},
                                               {"humanoid", object({{"humanBones", object(members)}})}});
        model.extensionsUsed = {"VRMC_vrm"};
    }
}

int add_textured_material(GlbWriter& writer) {
    tinygltf::Model& model = writer.model();
    tinygltf::Image image;
    image.name = "skin";
    image.mimeType = "image/png";
    image.bufferView = writer.add_view(kPixel, sizeof kPixel, 0);
    model.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = 0;
    model.textures.push_back(texture);
    const int material = writer.add_material("skin", {0.80, 0.60, 0.48, 1.0}, 0.6, false);
    model.materials[size_t(material)].pbrMetallicRoughness.baseColorTexture.index = 0;
    return material;
}

}  // namespace

RigStyle rig_style_from(const std::string& name) {
    for (const Style& s : kStyles)
        if (name == s.name) return s.style;
    throw Failure("\"" + name + "\" is no rig");
}

std::vector<std::string> rig_style_names() {
    std::vector<std::string> names;
    for (const Style& s : kStyles) names.emplace_back(s.name);
    return names;
}

void export_character(vfit_context context, const vfit_avatar_desc& body,
                      const std::vector<vfit_shape_value>& shape, RigStyle style, const std::string& path) {
    vfit_avatar_desc desc = body;
    desc.flags |= VFIT_AVATAR_SINGLE_BONES;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                        uint32_t(shape.size()), avatar.out()));
    const Bind bind = bind_of(avatar.get(), style != RigStyle::bones31);
    const std::vector<StyleBone> bones = bones_of_style(style);
    std::vector<vec3> heads(bones.size(), vec3(0.0f));
    for (size_t s = 0; s < bones.size(); ++s)
        for (size_t i = 0; i < bind.rig.size(); ++i)
            if (bones[s].bone >= 0 && bind.rig[i].bone == bones[s].bone) heads[s] = bind.heads[i];
    const StyleSkin skin = style_skin(bind, bones, heads);

    // VRM 0 faces -Z; Mixamo's are centimetres under a root that shrinks them.
    const bool turned = style == RigStyle::vrm0, centimetres = style == RigStyle::mixamo;
    const quat facing = turned ? quat(0, 0, 1, 0) : quat(1, 0, 0, 0);
    const float unit = centimetres ? 100.0f : 1.0f;
    GlbWriter writer;
    tinygltf::Model& model = writer.model();
    const auto place = [&](const vec3& p) { return unit * (facing * p); };

    std::vector<mat4> worlds, binds;
    std::vector<quat> turns;
    for (size_t s = 0; s < bones.size(); ++s) {
        quat q(1, 0, 0, 0);
        if (style == RigStyle::mixamo || style == RigStyle::bones31) {
            vec3 direction(0, 1, 0);
            for (size_t c = 0; c < bones.size(); ++c)
                if (bones[c].parent == int(s) && !bones[c].twist) direction = heads[c] - heads[s];
            if (glm::length(direction) > 1e-3f) q = along_y(direction);
        }
        turns.push_back(q);
        mat4 world = glm::mat4_cast(q);
        world[3] = glm::vec4(place(heads[s]), 1.0f);
        worlds.push_back(world);
        binds.push_back(glm::inverse(world));
    }
    std::vector<int> nodes;
    std::vector<int> roots;
    tinygltf::Node armature;
    armature.name = "Armature";
    if (centimetres) armature.scale = {0.01, 0.01, 0.01};
    const int armature_node = writer.add_node(armature);
    for (size_t s = 0; s < bones.size(); ++s) {
        const mat4 local =
            bones[s].parent < 0 ? worlds[s] : glm::inverse(worlds[size_t(bones[s].parent)]) * worlds[s];
        tinygltf::Node node;
        node.name = bones[s].name;
        node.translation = values(vec3(local[3]));
        node.rotation = values(glm::normalize(glm::quat_cast(glm::mat3(local))));
        nodes.push_back(writer.add_node(node));
        model.nodes[size_t(bones[s].parent < 0 ? armature_node : nodes[size_t(bones[s].parent)])]
            .children.push_back(nodes.back());
    }
    tinygltf::Skin rig;
    rig.joints = nodes;
    rig.inverseBindMatrices = writer.add_matrices(binds);
    model.skins.push_back(rig);

    std::vector<vec3> positions, normals;
    for (const vec3& p : bind.positions) positions.push_back(place(p));
    for (const vec3& n : bind.normals) normals.push_back(facing * n);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = add_textured_material(writer);
    primitive.attributes["POSITION"] = writer.add_vectors(positions, true);
    primitive.attributes["NORMAL"] = writer.add_vectors(normals, false);
    primitive.attributes["TEXCOORD_0"] =
        writer.add(bind.uvs, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
    for (size_t set = 0; set < 2; ++set) {
        std::vector<uint16_t> b;
        std::vector<float> w;
        for (size_t v = 0; v < skin.bones.size(); ++v)
            for (size_t k = 4 * set; k < 4 * set + 4; ++k) {
                b.push_back(skin.bones[v][k]);
                w.push_back(skin.weights[v][k]);
            }
        primitive.attributes["JOINTS_" + std::to_string(set)] = writer.add(
            b, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TARGET_ARRAY_BUFFER);
        primitive.attributes["WEIGHTS_" + std::to_string(set)] =
            writer.add(w, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    primitive.indices = writer.add_indices(bind.indices);
    tinygltf::Mesh mesh;
    mesh.name = "body";
    mesh.primitives.push_back(primitive);
    model.meshes.push_back(mesh);
    tinygltf::Node mesh_node;
    mesh_node.name = "body";
    mesh_node.mesh = 0;
    mesh_node.skin = 0;
    const int mesh_index = writer.add_node(mesh_node);
    tinygltf::Scene scene;
    scene.nodes = {armature_node, mesh_index};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    if (style == RigStyle::vrm0 || style == RigStyle::vrm1) add_vrm(model, style, bones, nodes);
    writer.save(path);
}

}  // namespace vfit::tools
