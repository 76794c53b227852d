#include "client/bvh_skeleton.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "client/client.h"

namespace vfit::tools {

namespace {

using glm::mat4;
using glm::vec3;

class SkeletonGlb {
public:
    SkeletonGlb(const BvhFile& file, const std::vector<mat4>& worlds, bool is_z_up, float size) {
        const size_t count = worlds.size();
        json_["asset"]["version"] = "2.0";
        for (size_t j = 0; j < count; ++j) {
            const BvhJoint& joint = file.joints[j];
            const mat4 local =
                joint.parent < 0 ? worlds[j] : glm::inverse(worlds[size_t(joint.parent)]) * worlds[j];
            const glm::quat turn = glm::normalize(glm::quat_cast(glm::mat3(local)));
            json_["nodes"].push_back({{"name", joint.name},
                                      {"translation", {local[3].x, local[3].y, local[3].z}},
                                      {"rotation", {turn.x, turn.y, turn.z, turn.w}}});
            if (joint.parent >= 0) json_["nodes"][size_t(joint.parent)]["children"].push_back(j);
            json_["skins"][0]["joints"].push_back(j);
            const mat4 bind = glm::inverse(worlds[j]);
            binds_.insert(binds_.end(), glm::value_ptr(bind), glm::value_ptr(bind) + 16);
            // The end of a bone is a part of it: of the head, the crown.
            add_tetrahedron(vec3(worlds[j][3]), joint.is_end ? joint.parent : int(j), size);
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

}  // namespace

std::string skeleton_glb(const BvhFile& file, const std::vector<mat4>& worlds, bool is_z_up, float size) {
    return SkeletonGlb(file, worlds, is_z_up, size).bytes();
}

}  // namespace vfit::tools
