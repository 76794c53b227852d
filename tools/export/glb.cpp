#include "export/glb.h"

#include <algorithm>

#include "export/glb_writer.h"

namespace vfit::tools {

namespace {

using glm::mat4;
using glm::quat;
using glm::vec3;

/// Place of a joint relative to its parent.
struct Local {
    quat rotation;
    vec3 translation;
};

mat4 joint_world(const vfit_rig_bone& bone, const mat4& skinning) {
    mat4 m = skinning;
    m[3] = skinning * glm::vec4(bone.rest_position[0], bone.rest_position[1], bone.rest_position[2], 1.0f);
    return m;
}

std::vector<Local> locals(const std::vector<vfit_rig_bone>& rig, const std::vector<mat4>& skinning) {
    std::vector<mat4> world(rig.size());
    std::vector<Local> out(rig.size());
    for (size_t i = 0; i < rig.size(); ++i) {
        world[i] = joint_world(rig[i], skinning[i]);
        const mat4 local =
            rig[i].parent < 0 ? world[i] : glm::inverse(world[size_t(rig[i].parent)]) * world[i];
        out[i] = {glm::normalize(glm::quat_cast(glm::mat3(local))), vec3(local[3])};
    }
    return out;
}

/// Joint indices and weights 4 by 4; an unused place names joint 0 with weight 0.
void add_skin_attributes(GlbWriter& writer, tinygltf::Primitive& primitive, vfit_frame rest) {
    struct Bones {
        uint16_t bone[8];
    };
    struct Weights {
        float weight[8];
    };
    const auto bones = items_of<Bones>(rest, VFIT_STREAM_SKIN_BONES);
    const auto weights = items_of<Weights>(rest, VFIT_STREAM_SKIN_WEIGHTS);
    for (int set = 0; set < 2; ++set) {
        std::vector<uint16_t> b;
        std::vector<float> w;
        for (size_t i = 0; i < bones.size(); ++i)
            for (int k = 4 * set; k < 4 * set + 4; ++k) {
                w.push_back(weights[i].weight[k]);
                b.push_back(weights[i].weight[k] > 0.0f ? bones[i].bone[k] : uint16_t(0));
            }
        const std::string suffix = std::to_string(set);
        primitive.attributes["JOINTS_" + suffix] = writer.add(
            b, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TARGET_ARRAY_BUFFER);
        primitive.attributes["WEIGHTS_" + suffix] =
            writer.add(w, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
}

int add_material(GlbWriter& writer, const Layer& layer) {
    const auto parts = stated_parts(layer.garment.get());
    if (parts.empty()) return writer.add_material(layer.info.name, {0.75, 0.20, 0.28, 1.0}, 0.85, true);
    const float* c = parts[0].color;
    return writer.add_material(layer.info.name, {c[0], c[1], c[2], 1.0}, 0.85, true);
}

/// The node of one garment: the shape of the first key, and one morph target for each later key.
int add_garment(GlbWriter& writer, const Layer& layer, const std::vector<GlbKey>& keys, size_t index,
                int time_accessor, tinygltf::Animation& animation) {
    tinygltf::Model& model = writer.model();
    Frame topology;
    check(vfit_cloth_acquire(layer.cloth.get(), topology.out()));
    const GlbKey::Shape& first = keys[0].garments[index];
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = add_material(writer, layer);
    primitive.attributes["POSITION"] = writer.add_vectors(first.positions, true);
    primitive.attributes["NORMAL"] = writer.add_vectors(first.normals, false);
    primitive.indices = writer.add_indices(items_of<uint32_t>(topology.get(), VFIT_STREAM_INDEX));
    const size_t targets = keys.size() - 1;
    for (size_t k = 1; k < keys.size(); ++k) {
        const GlbKey::Shape& shape = keys[k].garments[index];
        std::vector<vec3> moved(shape.positions.size()), turned(moved.size());
        for (size_t i = 0; i < moved.size(); ++i) {
            moved[i] = shape.positions[i] - first.positions[i];
            turned[i] = shape.normals[i] - first.normals[i];
        }
        primitive.targets.push_back(
            {{"POSITION", writer.add_vectors(moved, true)}, {"NORMAL", writer.add_vectors(turned, false)}});
    }
    tinygltf::Mesh mesh;
    mesh.name = layer.info.name;
    mesh.weights.assign(targets, 0.0);
    mesh.primitives.push_back(primitive);
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = layer.info.name;
    node.mesh = int(model.meshes.size()) - 1;
    const int added = writer.add_node(node);
    if (targets > 0) {
        // At key k the target k - 1 counts alone; between two keys they blend.
        std::vector<float> weights(keys.size() * targets, 0.0f);
        for (size_t k = 1; k < keys.size(); ++k) weights[k * targets + k - 1] = 1.0f;
        const int w = writer.add(weights, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
        add_channel(animation, added, "weights", time_accessor, w);
    }
    return added;
}

}  // namespace

GlbAnimation::GlbAnimation(vfit_avatar avatar, const WornOutfit& outfit)
    : avatar_(avatar), outfit_(outfit), rig_(rig_of(avatar)) {}

void GlbAnimation::add_key(float time_s) {
    Frame body;
    check(vfit_avatar_acquire(avatar_, body.out()));
    GlbKey key;
    key.time_s = time_s;
    key.bone_matrices = items_of<mat4>(body.get(), VFIT_STREAM_BONE_MATRIX);
    for (const vfit_cloth cloth : outfit_.cloths()) {
        Frame garment;
        check(vfit_cloth_acquire(cloth, garment.out()));
        key.garments.push_back({items_of<vec3>(garment.get(), VFIT_STREAM_POSITION),
                                items_of<vec3>(garment.get(), VFIT_STREAM_NORMAL)});
    }
    keys_.push_back(std::move(key));
}

void GlbAnimation::write(const std::string& path) const {
    if (keys_.empty()) throw Failure("the animation has no key frame");
    GlbWriter writer;
    tinygltf::Model& model = writer.model();
    Frame rest;
    check(vfit_avatar_acquire_rest(avatar_, rest.out()));
    const int skin_material = writer.add_material("skin", {0.80, 0.60, 0.48, 1.0}, 0.6, false);

    std::vector<float> times;
    for (const GlbKey& key : keys_) times.push_back(key.time_s);
    const int time_accessor = writer.add_times(times);
    tinygltf::Animation animation;
    animation.name = "motion";

    // The rig: one node a bone, in the pose of the first key.
    const std::vector<Local> first = locals(rig_, keys_[0].bone_matrices);
    tinygltf::Skin skin;
    skin.name = "rig";
    std::vector<mat4> inverse_bind;
    std::vector<int> roots;
    for (size_t i = 0; i < rig_.size(); ++i) {
        tinygltf::Node node;
        node.name = rig_[i].name;
        node.rotation = values(first[i].rotation);
        node.translation = values(first[i].translation);
        skin.joints.push_back(writer.add_node(node));
        mat4 bind(1.0f);
        bind[3] =
            glm::vec4(-rig_[i].rest_position[0], -rig_[i].rest_position[1], -rig_[i].rest_position[2], 1.0f);
        inverse_bind.push_back(bind);
        if (rig_[i].parent < 0)
            roots.push_back(skin.joints.back());
        else
            model.nodes[size_t(skin.joints[size_t(rig_[i].parent)])].children.push_back(skin.joints.back());
    }
    skin.inverseBindMatrices = writer.add_matrices(inverse_bind);
    model.skins.push_back(skin);

    std::vector<std::vector<quat>> rotations(rig_.size());
    std::vector<std::vector<vec3>> translations(rig_.size());
    for (const GlbKey& key : keys_) {
        const auto local = locals(rig_, key.bone_matrices);
        for (size_t i = 0; i < rig_.size(); ++i) {
            quat q = local[i].rotation;
            if (!rotations[i].empty() && glm::dot(q, rotations[i].back()) < 0.0f) q = -q;
            rotations[i].push_back(q);
            translations[i].push_back(local[i].translation);
        }
    }
    for (size_t i = 0; i < rig_.size(); ++i) {
        const int r = writer.add_rotations(rotations[i]);
        add_channel(animation, skin.joints[i], "rotation", time_accessor, r);
        if (rig_[i].parent < 0) {
            const int t = writer.add(translations[i], TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
            add_channel(animation, skin.joints[i], "translation", time_accessor, t);
        }
    }

    tinygltf::Mesh body_mesh;
    body_mesh.name = "body";
    tinygltf::Primitive body;
    body.mode = TINYGLTF_MODE_TRIANGLES;
    body.material = skin_material;
    body.attributes["POSITION"] = writer.add_vectors(items_of<vec3>(rest.get(), VFIT_STREAM_POSITION), true);
    body.attributes["NORMAL"] = writer.add_vectors(items_of<vec3>(rest.get(), VFIT_STREAM_NORMAL), false);
    body.attributes["TEXCOORD_0"] =
        writer.add(items_of<glm::vec2>(rest.get(), VFIT_STREAM_UV), TINYGLTF_TYPE_VEC2,
                   TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
    add_skin_attributes(writer, body, rest.get());
    body.indices = writer.add_indices(seen_triangles(avatar_, outfit_.cloths()));
    body_mesh.primitives.push_back(body);
    model.meshes.push_back(body_mesh);

    tinygltf::Node body_node;
    body_node.name = "body";
    body_node.mesh = 0;
    body_node.skin = 0;
    std::vector<int> nodes{writer.add_node(body_node)};
    for (size_t g = 0; g < outfit_.layers().size(); ++g)
        nodes.push_back(add_garment(writer, outfit_.layers()[g], keys_, g, time_accessor, animation));
    if (keys_.size() > 1) model.animations.push_back(animation);
    tinygltf::Scene scene;
    scene.nodes = roots;
    scene.nodes.insert(scene.nodes.end(), nodes.begin(), nodes.end());
    model.scenes.push_back(scene);
    model.defaultScene = 0;

    writer.save(path);
}

}  // namespace vfit::tools
