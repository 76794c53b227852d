#include "cook/model/gltf.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <set>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

/// "a b.png" of "a%20b.png".
std::string decoded(const std::string& uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string out;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool is_code =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        out += is_code ? char(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
        if (is_code) i += 2;
    }
    return out;
}

class GltfReader {
public:
    GltfReader(const GltfDocument& document, const std::string& file, const Beside& beside)
        : document_(document), file_(file), beside_(beside) {}

    Model run() {
        for (const tinygltf::Material& material : document_.model().materials) add_material(material);
        for (const int node : document_.nodes_in_order())
            if (document_.model().nodes[size_t(node)].mesh >= 0) add_node(node);
        if (model_.faces.empty()) fail(VFIT_ERROR_DATA, "the file has no triangles");
        if (lines_) model_.notes.push_back("points and lines are left out");
        if (morphs_) model_.notes.push_back("morph targets are left out");
        if (!document_.model().animations.empty()) model_.notes.push_back("animations are left out");
        std::set<uint32_t> used;
        for (const ModelFace& face : model_.faces) used.insert(face.material);
        for (const uint32_t m : used)
            if (m < model_.materials.size()) note_picture(m);
        return std::move(model_);
    }

private:
    /// The picture of a material's base colour, -1: none.
    int picture_of(const tinygltf::Material& material) const {
        const int texture = material.pbrMetallicRoughness.baseColorTexture.index;
        if (texture < 0) return -1;
        const auto& textures = document_.model().textures;
        if (size_t(texture) >= textures.size())
            fail(VFIT_ERROR_DATA, "material \"", material.name, "\" names a texture that is not there");
        const int image = textures[size_t(texture)].source;
        if (image >= 0 && size_t(image) >= document_.model().images.size())
            fail(VFIT_ERROR_DATA, "the texture of material \"", material.name,
                 "\" names an image that is not there");
        return image;
    }

    void add_material(const tinygltf::Material& material) {
        ModelMaterial out;
        out.name = material.name.empty() ? text("material ", model_.materials.size()) : material.name;
        const std::vector<double>& color = material.pbrMetallicRoughness.baseColorFactor;
        for (int i = 0; i < 3; ++i) {
            out.color[i] = color.size() > size_t(i) ? float(color[size_t(i)]) : 1.0f;
            if (!(out.color[i] >= 0.0f && out.color[i] <= 1.0f))
                fail(VFIT_ERROR_DATA, "the base colour of material \"", out.name, "\" is not from 0 to 1");
        }
        if (const int image = picture_of(material); image >= 0) {
            const std::string& uri = document_.model().images[size_t(image)].uri;
            out.texture = uri.empty() ? text(file_, "#/images/", image) : uri;
        }
        model_.materials.push_back(out);
    }

    void note_picture(uint32_t m) {
        const tinygltf::TextureInfo& info =
            document_.model().materials[m].pbrMetallicRoughness.baseColorTexture;
        const std::string of = " of material \"" + model_.materials[m].name + "\"";
        if (info.index < 0) return;
        const int image = picture_of(document_.model().materials[m]);
        if (image < 0)
            model_.notes.push_back("the texture" + of + " is none that can be named: it is left out");
        else if (const std::string& uri = document_.model().images[size_t(image)].uri; !uri.empty())
            note_missing_texture(beside_, decoded(uri), of, model_.notes);
    }

    void add_node(int node) {
        const tinygltf::Model& file = document_.model();
        const tinygltf::Node& n = file.nodes[size_t(node)];
        if (size_t(n.mesh) >= file.meshes.size())
            fail(VFIT_ERROR_DATA, "node \"", document_.node_name(node), "\" names a mesh that is not there");
        joints_.clear();
        if (n.skin >= 0) read_skin(n.skin, document_.node_name(node));
        const tinygltf::Mesh& mesh = file.meshes[size_t(n.mesh)];
        for (size_t p = 0; p < mesh.primitives.size(); ++p)
            add_part(mesh.primitives[p], text("mesh \"", mesh.name, "\", part ", p), node);
    }

    void read_skin(int index, const std::string& node) {
        if (size_t(index) >= document_.model().skins.size())
            fail(VFIT_ERROR_DATA, "node \"", node, "\" names a skin that is not there");
        const tinygltf::Skin& skin = document_.model().skins[size_t(index)];
        std::vector<float> binds;
        if (skin.inverseBindMatrices >= 0)
            binds = document_.numbers(skin.inverseBindMatrices, 16, "inverse bind matrix");
        if (skin.inverseBindMatrices >= 0 && binds.size() < 16 * skin.joints.size())
            fail(VFIT_ERROR_DATA, "skin ", skin.name, " has fewer inverse bind matrices than joints");
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            const int joint = skin.joints[j];
            if (joint < 0 || size_t(joint) >= document_.node_worlds().size())
                fail(VFIT_ERROR_DATA, "skin ", skin.name, " names node ", joint, ", which is not there");
            joints_.push_back(document_.node_worlds()[size_t(joint)] *
                              (binds.empty() ? Mat4(1.0f) : glm::make_mat4(&binds[16 * j])));
        }
    }

    static int attribute(const tinygltf::Primitive& p, const std::string& name) {
        const auto it = p.attributes.find(name);
        return it == p.attributes.end() ? -1 : it->second;
    }
    std::vector<float> rows(const tinygltf::Primitive& p, const std::string& name, int components,
                            size_t count, const std::string& what) const {
        if (attribute(p, name) < 0) return {};
        std::vector<float> list = document_.numbers(attribute(p, name), components, what + ": " + name);
        if (list.size() != count * size_t(components))
            fail(VFIT_ERROR_DATA, what, ": ", name, " has another count than POSITION");
        return list;
    }

    void add_part(const tinygltf::Primitive& p, const std::string& what, int node) {
        if (!p.targets.empty()) morphs_ = true;
        const int mode = p.mode < 0 ? TINYGLTF_MODE_TRIANGLES : p.mode;
        if (mode == TINYGLTF_MODE_POINTS || mode == TINYGLTF_MODE_LINE || mode == TINYGLTF_MODE_LINE_LOOP ||
            mode == TINYGLTF_MODE_LINE_STRIP) {
            lines_ = true;
            return;
        }
        if (mode != TINYGLTF_MODE_TRIANGLES)
            fail(VFIT_ERROR_UNSUPPORTED, what, ": triangle strips and fans are not supported");
        if (attribute(p, "POSITION") < 0) fail(VFIT_ERROR_DATA, what, " has no positions");
        const auto first = uint32_t(model_.positions.size()), first_uv = uint32_t(model_.uvs.size());
        const Mat4& fixed = document_.node_worlds()[size_t(node)];
        const uint32_t count = add_positions(p, what, fixed);
        const bool has_uvs = add_uvs(p, what, count);

        std::vector<uint32_t> indices;
        if (p.indices >= 0) {
            indices = document_.integers(p.indices, 1, what + ": indices");
        } else {
            for (uint32_t i = 0; i < count; ++i) indices.push_back(i);
        }
        if (indices.size() % 3 != 0)
            fail(VFIT_ERROR_DATA, what, ": ", indices.size(), " indices are no whole triangles");
        // A node that mirrors turns its triangles over.
        const bool mirrors = joints_.empty() && glm::determinant(Mat3(fixed)) < 0.0f;
        const auto group = uint32_t(model_.groups.size());
        model_.groups.push_back(what + ": triangle ");
        const uint32_t material = p.material >= 0 && size_t(p.material) < model_.materials.size()
                                      ? uint32_t(p.material)
                                      : uint32_t(model_.materials.size());
        for (size_t i = 0; i < indices.size(); i += 3) {
            model_.faces.push_back({uint32_t(model_.corners.size()), 3, material, group, uint32_t(i / 3)});
            for (const size_t k :
                 {size_t(0), mirrors ? size_t(2) : size_t(1), mirrors ? size_t(1) : size_t(2)}) {
                const uint32_t v = indices[i + k];
                if (v >= count)
                    fail(VFIT_ERROR_DATA, what, ": triangle ", i / 3, " names vertex ", v, " of ", count);
                model_.corners.push_back({first + v, has_uvs ? first_uv + v : kNoUv});
            }
        }
        model_.check_count();
    }

    /// Returns their number.
    uint32_t add_positions(const tinygltf::Primitive& p, const std::string& what, const Mat4& fixed) {
        const std::vector<float> positions =
            document_.numbers(attribute(p, "POSITION"), 3, what + ": POSITION");
        const size_t count = positions.size() / 3;
        std::vector<uint32_t> bones;
        std::vector<float> weights;
        if (!joints_.empty() && attribute(p, "JOINTS_0") >= 0) {
            bones = document_.integers(attribute(p, "JOINTS_0"), 4, what + ": JOINTS_0");
            weights = rows(p, "WEIGHTS_0", 4, count, what);
            if (bones.size() != 4 * count || weights.size() != 4 * count)
                fail(VFIT_ERROR_DATA, what, ": JOINTS_0 or WEIGHTS_0 has another count than POSITION");
        }
        for (size_t v = 0; v < count; ++v) {
            Mat4 sum(0.0f);
            float total = 0.0f;
            for (size_t k = 4 * v; k < 4 * v + 4 && !bones.empty(); ++k) {
                if (!(weights[k] > 0.0f)) continue;
                if (bones[k] >= joints_.size())
                    fail(VFIT_ERROR_DATA, what, ": vertex ", v, " names joint ", bones[k], " of ",
                         joints_.size());
                sum += weights[k] * joints_[bones[k]];
                total += weights[k];
            }
            const Mat4 m = total > 0.0f ? sum / total : !joints_.empty() ? joints_[0] : fixed;
            const Vec3 place(m * Vec4(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1.0f));
            if (!finite(place)) fail(VFIT_ERROR_DATA, what, ": vertex ", v, " is not at a finite place");
            model_.positions.push_back(place);
        }
        // Nodes may share a mesh: a small file can ask for any number of copies.
        model_.check_count();
        return uint32_t(count);
    }

    bool add_uvs(const tinygltf::Primitive& p, const std::string& what, size_t count) {
        int set = 0;
        TextureTransform transform;
        if (p.material >= 0 && size_t(p.material) < document_.model().materials.size()) {
            const tinygltf::TextureInfo& info =
                document_.model().materials[size_t(p.material)].pbrMetallicRoughness.baseColorTexture;
            set = std::max(0, info.texCoord);
            if (const auto found = info.extensions.find("KHR_texture_transform");
                found != info.extensions.end())
                transform = transform_of(found->second, what, set);
        }
        const std::vector<float> uvs = rows(p, text("TEXCOORD_", set), 2, count, what);
        for (size_t i = 0; i + 1 < uvs.size(); i += 2)
            model_.uvs.push_back(transform.axes * Vec2(uvs[i], uvs[i + 1]) + transform.offset);
        return !uvs.empty();
    }

    /// KHR_texture_transform: the garment's uvs are those of the picture.
    struct TextureTransform {
        glm::mat2 axes{1.0f};
        Vec2 offset{0.0f};
    };
    static TextureTransform transform_of(const tinygltf::Value& value, const std::string& what, int& set) {
        const auto number = [&](const tinygltf::Value& of) {
            const double number = of.IsNumber() ? of.GetNumberAsDouble() : NAN;
            constexpr double kMost = 1e4;
            if (!(std::abs(number) <= kMost))
                fail(VFIT_ERROR_DATA, what, ": a number of KHR_texture_transform is none");
            return float(number);
        };
        const auto pair = [&](const char* key, const Vec2& usual) {
            if (!value.Has(key)) return usual;
            const tinygltf::Value& of = value.Get(key);
            if (!of.IsArray() || of.ArrayLen() != 2)
                fail(VFIT_ERROR_DATA, what, ": \"", key, "\" of KHR_texture_transform are not two numbers");
            return Vec2(number(of.Get(0)), number(of.Get(1)));
        };
        const Vec2 scale = pair("scale", Vec2(1.0f));
        const float turn = value.Has("rotation") ? number(value.Get("rotation")) : 0.0f;
        if (value.Has("texCoord")) set = std::max(0, value.Get("texCoord").GetNumberAsInt());
        const Vec2 across(std::cos(turn), -std::sin(turn)), down(std::sin(turn), std::cos(turn));
        return {glm::mat2(scale.x * across, scale.y * down), pair("offset", Vec2(0.0f))};
    }

    const GltfDocument& document_;
    const std::string& file_;
    const Beside& beside_;
    Model model_;
    std::vector<Mat4> joints_;  // of the node's skin: from the mesh to where its bones stand
    bool lines_ = false, morphs_ = false;
};

}  // namespace

Model read_gltf(const GltfDocument& document, const std::string& file, const Beside& beside) {
    return GltfReader(document, file, beside).run();
}

}  // namespace vfit
