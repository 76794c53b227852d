#include "export/glb_writer.h"

#include <algorithm>
#include <sstream>

#include "client/client.h"
#include "client/files.h"

namespace vfit::tools {

namespace {

void set_bounds(tinygltf::Accessor& accessor, const float* values) {
    const int n = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    accessor.minValues.assign(static_cast<size_t>(n), 1e30);
    accessor.maxValues.assign(static_cast<size_t>(n), -1e30);
    for (size_t i = 0; i < accessor.count; ++i)
        for (int c = 0; c < n; ++c) {
            const double x = values[i * static_cast<size_t>(n) + static_cast<size_t>(c)];
            auto& low = accessor.minValues[static_cast<size_t>(c)];
            auto& high = accessor.maxValues[static_cast<size_t>(c)];
            low = std::min(low, x);
            high = std::max(high, x);
        }
}

size_t size_of(int type, int component) {
    return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)) *
                               tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component)));
}

}  // namespace

GlbWriter::GlbWriter() {
    model_.asset.version = "2.0";
    model_.asset.generator = "vfit";
    model_.buffers.emplace_back();
}

GlbWriter::GlbWriter(tinygltf::Model model) : model_(std::move(model)) {
    if (model_.buffers.empty()) model_.buffers.emplace_back();
}

int GlbWriter::add_view(const unsigned char* from, size_t count, int target) {
    auto& bytes = model_.buffers[0].data;
    while (bytes.size() % 4) bytes.push_back(0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = count;
    view.target = target;
    bytes.insert(bytes.end(), from, from + count);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

int GlbWriter::add_bytes(const unsigned char* bytes, size_t count, int type, int component, int target,
                         bool bounds) {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(bytes, count, target);
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count / size_of(type, component);
    if (bounds) set_bounds(accessor, reinterpret_cast<const float*>(bytes));
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
}

int GlbWriter::add_vectors(const std::vector<glm::vec3>& v, bool bounds) {
    return add(v, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, bounds);
}

int GlbWriter::add_times(const std::vector<float>& times) {
    return add(times, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_FLOAT, 0, true);
}

int GlbWriter::add_indices(const std::vector<uint32_t>& indices) {
    return add(indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
               TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

int GlbWriter::add_matrices(const std::vector<glm::mat4>& matrices) {
    return add(matrices, TINYGLTF_TYPE_MAT4, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
}

int GlbWriter::add_rotations(const std::vector<glm::quat>& rotations) {
    // GLM keeps x, y, z, w in memory, as glTF does.
    return add(rotations, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
}

int GlbWriter::add_material(const std::string& name, const std::vector<double>& color, double roughness,
                            bool two_sided) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = color;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = roughness;
    material.doubleSided = two_sided;
    model_.materials.push_back(material);
    return static_cast<int>(model_.materials.size()) - 1;
}

int GlbWriter::add_node(tinygltf::Node node) {
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size()) - 1;
}

std::string GlbWriter::bytes(const std::string& path) {
    // Through memory: of a file that cannot be written tinygltf says nothing.
    tinygltf::TinyGLTF gltf;
    std::ostringstream bytes;
    if (!gltf.WriteGltfSceneToStream(&model_, bytes, false, true)) throw Failure(path + ": cannot be made");
    return bytes.str();
}

void GlbWriter::save(const std::string& path) { write_text(path, bytes(path)); }

void add_channel(tinygltf::Animation& animation, int node, const char* path, int times, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = times;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
    channel.target_node = node;
    channel.target_path = path;
    animation.channels.push_back(channel);
}

std::vector<double> values(const glm::vec3& v) { return {v.x, v.y, v.z}; }
std::vector<double> values(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

}  // namespace vfit::tools
