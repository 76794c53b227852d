#include "export/character_animation.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "client/files.h"
#include "export/compressed_gltf.h"
#include "export/gltf_file.h"

namespace vfit::tools {

namespace {

using glm::mat4;
using glm::quat;
using glm::vec3;

struct Local {
    vec3 translation{0.0f}, scale{1.0f};
    quat rotation{1, 0, 0, 0};
    mat4 matrix() const {
        mat4 m = glm::mat4_cast(rotation);
        for (int c = 0; c < 3; ++c) m[c] *= scale[c];
        m[3] = glm::vec4(translation, 1.0f);
        return m;
    }
};

Local local_of(const tinygltf::Node& node) {
    Local local;
    if (node.matrix.size() == 16) {
        mat4 m;
        for (int i = 0; i < 16; ++i) glm::value_ptr(m)[i] = float(node.matrix[size_t(i)]);
        local.translation = vec3(m[3]);
        for (int c = 0; c < 3; ++c) local.scale[c] = glm::length(vec3(m[c]));
        glm::mat3 axes(m);
        for (int c = 0; c < 3; ++c) axes[c] /= local.scale[c];
        local.rotation = glm::normalize(glm::quat_cast(axes));
        return local;
    }
    const auto vector = [](const std::vector<double>& list, const vec3& preset) {
        return list.size() == 3 ? vec3(float(list[0]), float(list[1]), float(list[2])) : preset;
    };
    local.translation = vector(node.translation, vec3(0.0f));
    local.scale = vector(node.scale, vec3(1.0f));
    if (node.rotation.size() == 4)
        local.rotation = glm::normalize(quat(float(node.rotation[3]), float(node.rotation[0]),
                                             float(node.rotation[1]), float(node.rotation[2])));
    return local;
}

quat rotation_of(const mat4& m) {
    glm::mat3 axes(m);
    for (int c = 0; c < 3; ++c) axes[c] = glm::normalize(axes[c]);
    return glm::normalize(glm::quat_cast(axes));
}

}  // namespace

void CharacterAnimation::add_key(float time_s) {
    Frame body;
    check(vfit_avatar_acquire(avatar_, body.out()));
    keys_.push_back({time_s, items_of<mat4>(body.get(), VFIT_STREAM_BONE_MATRIX)});
}

void CharacterAnimation::write(const std::string& path) const {
    if (keys_.empty()) throw Failure("the animation has no key frame");
    vfit_character_info info = vfit_character_info_init();
    check(vfit_avatar_describe(avatar_, &info));
    const mat4 to_file = glm::inverse(glm::make_mat4(info.from_file));
    const std::vector<vfit_rig_bone> rig = rig_of(avatar_);

    GlbWriter writer(read_gltf(file_));
    tinygltf::Model& model = writer.model();
    std::vector<Local> rest;
    for (tinygltf::Node& node : model.nodes) rest.push_back(local_of(node));
    std::vector<int> bone_of(model.nodes.size(), -1), parent(model.nodes.size(), -1);
    for (size_t b = 0; b < rig.size(); ++b)
        if (rig[b].node >= 0) bone_of.at(size_t(rig[b].node)) = int(b);
    for (size_t n = 0; n < model.nodes.size(); ++n)
        for (const int child : model.nodes[n].children) parent[size_t(child)] = int(n);

    // Parents before children. The library has refused trees that are none.
    std::vector<size_t> order;
    for (size_t n = 0; n < model.nodes.size(); ++n)
        if (parent[n] < 0) order.push_back(n);
    for (size_t i = 0; i < order.size(); ++i)
        for (const int child : model.nodes[order[i]].children) order.push_back(size_t(child));

    // World rotations are those of the posed bones; translations stay but for the hips', who alone may move.
    std::vector<std::vector<quat>> rotations(model.nodes.size());
    std::vector<std::vector<vec3>> translations(model.nodes.size());
    std::vector<float> times;
    for (const Key& key : keys_) {
        times.push_back(key.time_s);
        std::vector<mat4> world(model.nodes.size());
        for (const size_t n : order) {
            const mat4 above = parent[n] < 0 ? mat4(1.0f) : world[size_t(parent[n])];
            Local local = rest[n];
            if (const int b = bone_of[n]; b >= 0) {
                const vfit_rig_bone& bone = rig[size_t(b)];
                const mat4 posed = to_file * key.bone_matrices[size_t(b)];
                const quat axes(bone.rest_rotation[3], bone.rest_rotation[0], bone.rest_rotation[1],
                                bone.rest_rotation[2]);
                local.rotation =
                    glm::normalize(glm::conjugate(rotation_of(above)) * rotation_of(posed) * axes);
                if (!rotations[n].empty() && glm::dot(local.rotation, rotations[n].back()) < 0.0f)
                    local.rotation = -local.rotation;
                rotations[n].push_back(local.rotation);
                if (bone.bone == VFIT_BONE_HIPS) {
                    const vec3 head(bone.rest_position[0], bone.rest_position[1], bone.rest_position[2]);
                    local.translation = vec3(glm::inverse(above) * posed * glm::vec4(head, 1.0f));
                    translations[n].push_back(local.translation);
                }
            }
            world[n] = above * local.matrix();
        }
    }

    tinygltf::Animation animation;
    animation.name = "vfit";
    const int time_accessor = writer.add_times(times);
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        if (rotations[n].empty()) continue;
        if (model.nodes[n].matrix.size() == 16) {  // an animated node may have no matrix
            model.nodes[n].matrix.clear();
            model.nodes[n].translation = values(rest[n].translation);
            model.nodes[n].rotation = values(rest[n].rotation);
            model.nodes[n].scale = values(rest[n].scale);
        }
        add_channel(animation, int(n), "rotation", time_accessor, writer.add_rotations(rotations[n]));
        if (!translations[n].empty())
            add_channel(animation, int(n), "translation", time_accessor,
                        writer.add(translations[n], TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, 0));
    }
    model.animations = {animation};
    take_in_files(writer);
    write_text(path, with_compressed_data(writer.bytes(path), read_text(file_)));
}

}  // namespace vfit::tools
