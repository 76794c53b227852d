#include "export/worn_character.h"

#include <algorithm>
#include <map>

#include "client/client.h"
#include "client/files.h"
#include "export/gltf_file.h"

namespace vfit::tools {

namespace {

void forget_compression(tinygltf::Model& model) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_draco_mesh_compression"}) {
        for (auto* list : {&model.extensionsUsed, &model.extensionsRequired})
            list->erase(std::remove(list->begin(), list->end(), name), list->end());
        for (tinygltf::BufferView& view : model.bufferViews) view.extensions.erase(name);
        for (tinygltf::Buffer& buffer : model.buffers) buffer.extensions.erase(name);
        for (tinygltf::Mesh& mesh : model.meshes)
            for (tinygltf::Primitive& part : mesh.primitives) part.extensions.erase(name);
    }
}

/// A GLB has one buffer in its own chunk; others would be text.
void join_buffers(tinygltf::Model& model) {
    for (size_t b = 1; b < model.buffers.size(); ++b) {
        std::vector<unsigned char>& all = model.buffers[0].data;
        while (all.size() % 4) all.push_back(0);
        for (tinygltf::BufferView& view : model.bufferViews)
            if (view.buffer == int(b)) view.buffer = 0, view.byteOffset += all.size();
        all.insert(all.end(), model.buffers[b].data.begin(), model.buffers[b].data.end());
    }
    if (!model.buffers.empty()) model.buffers.resize(1);
    // What was compressed has strides everywhere; glTF allows them for vertices alone.
    std::vector<uint8_t> of_vertices(model.bufferViews.size(), 0);
    const auto mark = [&](const std::map<std::string, int>& attributes) {
        for (const auto& [name, accessor] : attributes)
            if (const int view = model.accessors.at(size_t(accessor)).bufferView; view >= 0)
                of_vertices[size_t(view)] = 1;
    };
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& part : mesh.primitives) {
            mark(part.attributes);
            for (const auto& target : part.targets) mark(target);
        }
    for (const tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView < 0 || of_vertices[size_t(accessor.bufferView)]) continue;
        size_t& stride = model.bufferViews[size_t(accessor.bufferView)].byteStride;
        if (stride == size_t(tinygltf::GetNumComponentsInType(uint32_t(accessor.type)) *
                             tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType))))
            stride = 0;
    }
}

/// The indices of a part of a mesh, three a triangle.
std::vector<uint32_t> indices_of(const tinygltf::Model& model, const tinygltf::Primitive& part) {
    std::vector<uint32_t> out;
    if (part.indices < 0) {
        const tinygltf::Accessor& positions = model.accessors.at(size_t(part.attributes.at("POSITION")));
        for (uint32_t i = 0; i < positions.count; ++i) out.push_back(i);
        return out;
    }
    const tinygltf::Accessor& accessor = model.accessors.at(size_t(part.indices));
    const tinygltf::BufferView& view = model.bufferViews.at(size_t(accessor.bufferView));
    const std::vector<unsigned char>& bytes = model.buffers.at(size_t(view.buffer)).data;
    const size_t size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType)));
    const size_t first = view.byteOffset + accessor.byteOffset,
                 stride = view.byteStride ? view.byteStride : size;
    for (size_t i = 0; i < accessor.count; ++i) {
        uint32_t index = 0;
        for (size_t b = 0; b < size; ++b) index |= uint32_t(bytes.at(first + i * stride + b)) << (8 * b);
        out.push_back(index);
    }
    return out;
}

/// Parts that keep no triangle are left out, and meshes that keep no part, save those that expressions may
/// move.
void hide(GlbWriter& writer, const std::vector<WornCharacter::Hidden>& hidden) {
    tinygltf::Model& model = writer.model();
    std::map<int, std::vector<const WornCharacter::Hidden*>> of_node;
    for (const WornCharacter::Hidden& part : hidden) of_node[part.node].push_back(&part);
    // A mesh that several nodes show keeps what one of them shows.
    std::map<int, int> shown_by;
    for (const tinygltf::Node& node : model.nodes)
        if (node.mesh >= 0) ++shown_by[node.mesh];
    for (const auto& [node, parts] : of_node) {
        const int own = model.nodes.at(size_t(node)).mesh;
        if (shown_by[own] > 1) {
            --shown_by[own];
            model.meshes.push_back(tinygltf::Mesh(model.meshes[size_t(own)]));
            model.nodes[size_t(node)].mesh = int(model.meshes.size()) - 1;
        }
        std::vector<tinygltf::Primitive> kept;
        const std::vector<tinygltf::Primitive> all =
            model.meshes[size_t(model.nodes[size_t(node)].mesh)].primitives;
        for (size_t p = 0; p < all.size(); ++p) {
            tinygltf::Primitive part = all[p];
            const auto found = std::find_if(parts.begin(), parts.end(),
                                            [&](const auto* h) { return h->primitive == int(p); });
            const bool has_hidden = found != parts.end() &&
                                    std::find(found[0]->triangles.begin(), found[0]->triangles.end(), 1) !=
                                        found[0]->triangles.end();
            if (has_hidden) {
                const std::vector<uint32_t> indices = indices_of(model, part);
                std::vector<uint32_t> left;
                for (size_t t = 0; t < found[0]->triangles.size() && 3 * t + 2 < indices.size(); ++t)
                    if (!found[0]->triangles[t])
                        left.insert(left.end(), &indices[3 * t], &indices[3 * t] + 3);
                if (left.empty()) continue;
                part.indices = writer.add_indices(left);
            }
            kept.push_back(std::move(part));
        }
        tinygltf::Node& shown = model.nodes[size_t(node)];
        const auto morphs = std::find_if(
            all.begin(), all.end(), [](const tinygltf::Primitive& part) { return !part.targets.empty(); });
        if (kept.empty() && morphs != all.end()) {
            // Expressions of the file name this node or its mesh: it stays, with a triangle without area.
            kept.push_back(*morphs);
            kept.back().indices = writer.add_indices({0, 0, 0});
        }
        if (kept.empty())
            shown.mesh = shown.skin = -1;
        else
            model.meshes[size_t(shown.mesh)].primitives = std::move(kept);
    }
}

tinygltf::Value text_value(const char* text) { return tinygltf::Value(std::string(text)); }

/// VRM 0 lists the properties of each material of the file.
void tell_vrm0(tinygltf::Model& model, const std::string& material) {
    const auto vrm = model.extensions.find("VRM");
    if (vrm == model.extensions.end() || !vrm->second.IsObject()) return;
    auto object = vrm->second.Get<tinygltf::Value::Object>();
    tinygltf::Value::Array list;
    if (object.count("materialProperties") && object["materialProperties"].IsArray())
        list = object["materialProperties"].Get<tinygltf::Value::Array>();
    tinygltf::Value::Object entry;
    entry["name"] = tinygltf::Value(material);
    entry["shader"] = text_value("VRM_USE_GLTFSHADER");
    entry["renderQueue"] = tinygltf::Value(2000);
    for (const char* key :
         {"floatProperties", "vectorProperties", "textureProperties", "keywordMap", "tagMap"})
        entry[key] = tinygltf::Value(tinygltf::Value::Object());
    list.push_back(tinygltf::Value(entry));
    object["materialProperties"] = tinygltf::Value(list);
    vrm->second = tinygltf::Value(object);
}

int add_texture(GlbWriter& writer, const std::string& name, const std::string& bytes) {
    tinygltf::Model& model = writer.model();
    tinygltf::Image image;
    image.name = name;
    image.mimeType = bytes.compare(1, 3, "PNG") == 0 ? "image/png" : "image/jpeg";
    image.bufferView = writer.add_view(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), 0);
    model.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = int(model.images.size()) - 1;
    model.textures.push_back(texture);
    return int(model.textures.size()) - 1;
}

int add_skin(GlbWriter& writer, const std::vector<WornCharacter::Joint>& joints) {
    tinygltf::Skin skin;
    skin.name = "garments";
    std::vector<glm::mat4> binds;
    for (const WornCharacter::Joint& joint : joints) {
        skin.joints.push_back(joint.node);
        binds.push_back(glm::inverse(joint.world));
        // The last row is exact in a file that validates.
        for (int c = 0; c < 4; ++c) binds.back()[c][3] = c == 3 ? 1.0f : 0.0f;
    }
    skin.inverseBindMatrices = writer.add_matrices(binds);
    writer.model().skins.push_back(skin);
    return int(writer.model().skins.size()) - 1;
}

void add_mesh(GlbWriter& writer, const WornMesh& worn, int skin) {
    tinygltf::Mesh mesh;
    mesh.name = worn.name;
    std::map<std::string, int> attributes;
    attributes["POSITION"] = writer.add_vectors(worn.positions, true);
    attributes["NORMAL"] = writer.add_vectors(worn.normals, false);
    if (!worn.uvs.empty())
        attributes["TEXCOORD_0"] = writer.add(worn.uvs, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                              TINYGLTF_TARGET_ARRAY_BUFFER);
    attributes["JOINTS_0"] = writer.add(worn.joints, TINYGLTF_TYPE_VEC4,
                                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TARGET_ARRAY_BUFFER);
    attributes["WEIGHTS_0"] = writer.add(worn.weights, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                         TINYGLTF_TARGET_ARRAY_BUFFER);
    for (const WornMesh::Part& part : worn.parts) {
        const std::string material_name = part.name.empty() ? worn.name : part.name;
        const bool has_picture = !part.picture.empty();
        const int material =
            writer.add_material(material_name, {part.color.r, part.color.g, part.color.b, 1.0}, 0.9, true);
        if (has_picture)
            writer.model().materials[size_t(material)].pbrMetallicRoughness.baseColorTexture.index =
                add_texture(writer, material_name, part.picture);
        tell_vrm0(writer.model(), material_name);
        tinygltf::Primitive primitive;
        primitive.attributes = attributes;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = material;
        primitive.indices = writer.add_indices(
            std::vector<uint32_t>(worn.indices.begin() + part.first_index,
                                  worn.indices.begin() + part.first_index + part.index_count));
        mesh.primitives.push_back(primitive);
    }
    tinygltf::Model& model = writer.model();
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = worn.name;
    node.mesh = int(model.meshes.size()) - 1;
    node.skin = skin;
    const int at = writer.add_node(node);
    if (model.scenes.empty()) model.scenes.emplace_back();
    model.scenes[size_t(std::max(0, model.defaultScene))].nodes.push_back(at);
}

}  // namespace

void write_worn_character(tinygltf::Model file, const WornCharacter& worn, const std::string& path) {
    GlbWriter writer(std::move(file));
    forget_compression(writer.model());
    join_buffers(writer.model());
    hide(writer, worn.hidden);
    const int skin = add_skin(writer, worn.joints);
    for (const WornMesh& mesh : worn.meshes) add_mesh(writer, mesh, skin);
    take_in_files(writer);
    writer.save(path);
}

}  // namespace vfit::tools
