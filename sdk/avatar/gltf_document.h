// A glTF 2.0 file, read by tinygltf, its numbers checked: whatever an index or an offset says, nothing is
// read beyond what the file holds.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "math/types.h"

namespace vfit {

class GltfDocument {
public:
    /// .glb or .gltf. Pictures are not decoded. VFIT_ERROR_DATA where it is no such file or damaged,
    /// VFIT_ERROR_UNSUPPORTED where it requires an extension that the mesh cannot be read without.
    explicit GltfDocument(const std::string& path);
    /// The same from memory; buffers outside of it cannot be found then.
    explicit GltfDocument(std::span<const std::byte> bytes);

    const tinygltf::Model& model() const { return model_; }

    /// World transform of every node as the file's scene has it.
    const std::vector<Mat4>& node_worlds() const { return worlds_; }
    /// -1: a root.
    int parent(int node) const { return parents_[static_cast<size_t>(node)]; }
    /// Parents before children.
    const std::vector<int>& nodes_in_order() const { return order_; }
    std::string node_name(int node) const;

    /// Rows of `components` numbers each, normalised integers as fractions; `what` names them in errors.
    std::vector<float> numbers(int accessor, int components, const std::string& what) const;
    /// The same of whole numbers that are none below zero.
    std::vector<uint32_t> integers(int accessor, int components, const std::string& what) const;

private:
    struct Rows {
        const unsigned char* data;
        size_t stride, count;
        int component_type;
        bool normalized;
    };
    void parse(std::span<const std::byte> bytes, const std::string& folder);
    void check_extensions() const;
    void place_nodes();
    Rows rows(int accessor, int components, const std::string& what) const;

    tinygltf::Model model_;
    std::vector<Mat4> worlds_;
    std::vector<int> parents_, order_;
};

}  // namespace vfit
