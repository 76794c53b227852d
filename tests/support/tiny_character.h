// A character of sixteen boxes: the least that is a skinned humanoid in a GLB file, to be changed and
// damaged.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vfit {

class TinyCharacter {
public:
    nlohmann::json json;
    std::vector<unsigned char> binary;

    TinyCharacter() {
        struct Bone {
            const char* name;
            int parent;
            float x, y, z;  // from its parent
        };
        // VRM's required ones, arms out, facing +Z, its left on +X.
        const Bone bones[] = {{"hips", -1, 0, 0.95f, 0},
                              {"spine", 0, 0, 0.1f, 0},
                              {"head", 1, 0, 0.5f, 0},
                              {"leftUpperArm", 1, 0.17f, 0.35f, 0},
                              {"leftLowerArm", 3, 0.28f, 0, 0},
                              {"leftHand", 4, 0.25f, 0, 0},
                              {"rightUpperArm", 1, -0.17f, 0.35f, 0},
                              {"rightLowerArm", 6, -0.28f, 0, 0},
                              {"rightHand", 7, -0.25f, 0, 0},
                              {"leftUpperLeg", 0, 0.1f, -0.05f, 0},
                              {"leftLowerLeg", 9, 0, -0.4f, 0},
                              {"leftFoot", 10, 0, -0.42f, 0},
                              {"rightUpperLeg", 0, -0.1f, -0.05f, 0},
                              {"rightLowerLeg", 12, 0, -0.4f, 0},
                              {"rightFoot", 13, 0, -0.42f, 0}};
        constexpr size_t kBones = std::size(bones);
        std::vector<float> positions, weights, binds;
        std::vector<uint16_t> joints, indices;
        std::vector<std::array<float, 3>> heads;
        json["asset"]["version"] = "2.0";
        for (size_t b = 0; b < kBones; ++b) {
            const Bone& bone = bones[b];
            std::array<float, 3> head = {bone.x, bone.y, bone.z};
            for (size_t i = 0; bone.parent >= 0 && i < 3; ++i) head[i] += heads[size_t(bone.parent)][i];
            heads.push_back(head);
            nlohmann::json node = {{"name", bone.name}, {"translation", {bone.x, bone.y, bone.z}}};
            json["nodes"].push_back(node);
            if (bone.parent >= 0) json["nodes"][size_t(bone.parent)]["children"].push_back(b);
            const float bind[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -head[0], -head[1], -head[2], 1};
            binds.insert(binds.end(), bind, bind + 16);
            json["skins"][0]["joints"].push_back(b);
            const auto first = uint16_t(positions.size() / 3);
            for (int corner = 0; corner < 8; ++corner) {
                for (int axis = 0; axis < 3; ++axis)
                    positions.push_back(head[size_t(axis)] + ((corner >> axis) & 1 ? 0.06f : -0.06f));
                const uint16_t row[4] = {uint16_t(b), 0, 0, 0};
                joints.insert(joints.end(), row, row + 4);
                const float weight[4] = {1, 0, 0, 0};
                weights.insert(weights.end(), weight, weight + 4);
            }
            for (const int i : {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
                indices.push_back(uint16_t(first + i));
        }
        json["scenes"] = {{{"nodes", {0, kBones}}}};
        json["scene"] = 0;
        json["nodes"].push_back({{"name", "mesh"}, {"mesh", 0}, {"skin", 0}});
        const size_t count = positions.size() / 3;
        auto& primitive = json["meshes"][0]["primitives"][0];
        primitive["attributes"]["POSITION"] = add(positions, "VEC3", 5126, count);
        json["accessors"][0]["min"] = {-1, 0, -1};
        json["accessors"][0]["max"] = {1, 2, 1};
        primitive["attributes"]["JOINTS_0"] = add(joints, "VEC4", 5123, count);
        primitive["attributes"]["WEIGHTS_0"] = add(weights, "VEC4", 5126, count);
        primitive["indices"] = add(indices, "SCALAR", 5123, indices.size());
        json["skins"][0]["inverseBindMatrices"] = add(binds, "MAT4", 5126, kBones);
        json["buffers"] = {{{"byteLength", binary.size()}}};
    }

    /// The file's bytes.
    std::vector<std::byte> glb() const {
        std::string text = json.dump();
        while (text.size() % 4) text += ' ';
        std::vector<unsigned char> out = {'g', 'l', 'T', 'F'};
        const auto number = [&](uint32_t n) {
            for (int i = 0; i < 4; ++i) out.push_back(uint8_t(n >> (8 * i)));
        };
        number(2);
        number(uint32_t(12 + 8 + text.size() + 8 + binary.size()));
        number(uint32_t(text.size()));
        number(0x4E4F534A);  // JSON
        out.insert(out.end(), text.begin(), text.end());
        number(uint32_t(binary.size()));
        number(0x004E4942);  // BIN
        out.insert(out.end(), binary.begin(), binary.end());
        std::vector<std::byte> bytes(out.size());
        std::memcpy(bytes.data(), out.data(), out.size());
        return bytes;
    }

private:
    template <typename T>
    size_t add(const std::vector<T>& items, const char* type, int component, size_t count) {
        while (binary.size() % 4) binary.push_back(0);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", items.size() * sizeof(T)}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
        const auto* from = reinterpret_cast<const unsigned char*>(items.data());
        binary.insert(binary.end(), from, from + items.size() * sizeof(T));
        return json["accessors"].size() - 1;
    }
};

}  // namespace vfit
