// One part of a mesh that is compressed with Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vfit {

/// Whether this build can read it.
bool reads_draco();

/// Numbers of one vertex attribute as a glTF accessor stores them.
struct DracoAttribute {
    uint32_t id = 0;  // in the compressed data
    int component_type = 0, components = 0;
    std::vector<unsigned char> values;  // out: tightly packed
};

/// Fills the values, and the indices as 32-bit integers. index_count and vertex_count are those of the file's
/// accessors: VFIT_ERROR_DATA, opening with `what`, where the compressed data is damaged or has others.
std::vector<unsigned char> decode_draco(std::span<const unsigned char> bytes, size_t index_count,
                                        size_t vertex_count, std::span<DracoAttribute> attributes,
                                        const std::string& what);

}  // namespace vfit
