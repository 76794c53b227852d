// Builds a glTF file with one binary buffer.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace vfit::tools {

class GlbWriter {
public:
    GlbWriter();
    /// Goes on with a file that was read: new data goes behind its own.
    explicit GlbWriter(tinygltf::Model model);
    tinygltf::Model& model() { return model_; }

    /// The accessor of these items.
    template <typename T>
    int add(const std::vector<T>& items, int type, int component, int target, bool bounds = false) {
        return add_bytes(reinterpret_cast<const unsigned char*>(items.data()), items.size() * sizeof(T), type,
                         component, target, bounds);
    }
    int add_vectors(const std::vector<glm::vec3>& v, bool bounds);
    int add_times(const std::vector<float>& times);
    int add_indices(const std::vector<uint32_t>& indices);
    int add_matrices(const std::vector<glm::mat4>& matrices);
    int add_rotations(const std::vector<glm::quat>& rotations);
    int add_material(const std::string& name, const std::vector<double>& color, double roughness,
                     bool two_sided);
    int add_node(tinygltf::Node node);
    /// Bytes that no accessor reads (a picture); the buffer view's index.
    int add_view(const unsigned char* bytes, size_t count, int target);

    /// The file; its name is for errors alone.
    std::string bytes(const std::string& path);
    void save(const std::string& path);

private:
    int add_bytes(const unsigned char* bytes, size_t count, int type, int component, int target, bool bounds);
    tinygltf::Model model_;
};

/// Key frames of one property of a node ("rotation", "translation", "weights"), blended linearly.
void add_channel(tinygltf::Animation& animation, int node, const char* path, int times, int output);

std::vector<double> values(const glm::vec3& v);
std::vector<double> values(const glm::quat& q);

}  // namespace vfit::tools
