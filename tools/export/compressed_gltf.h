// Compressed glTF files through tinygltf, which knows none: their data stays as it is.
#pragma once

#include <string>

namespace vfit::tools {

/// The same file with one byte in place of buffers that have none, and views for indices that are compressed.
/// Files that are not compressed come back as they are.
std::string with_stand_ins(const std::string& file);

/// A GLB that tinygltf wrote from with_stand_ins(file), with what it left out of `file`.
std::string with_compressed_data(const std::string& glb, const std::string& file);

}  // namespace vfit::tools
