// Compressed data of a glTF file made plain: buffer views of EXT_meshopt_compression, parts of meshes of
// KHR_draco_mesh_compression.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace tinygltf {
class Model;
}

namespace vfit {

/// What a file may unpack to, all together.
inline constexpr size_t kMaxUnpackedBytes = size_t(512) << 20;

/// tinygltf refuses buffers without bytes and indices without a view, which compressed files may have. A copy
/// of the file in which these lead to a buffer of one byte; empty where the file can be read as it is.
std::vector<std::byte> with_stand_ins(std::span<const std::byte> bytes, std::string_view text, bool is_glb);

/// From now on accessors lead to plain data. VFIT_ERROR_DATA where compressed data is damaged,
/// VFIT_ERROR_UNSUPPORTED where this build cannot read it.
void decompress(tinygltf::Model& model);

}  // namespace vfit
