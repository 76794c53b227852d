// A glTF or GLB file as its author wrote it, to be written again with something added.
#pragma once

#include <string>

#include "export/glb_writer.h"

namespace vfit::tools {

/// Pictures keep their bytes as they are; compressed data stays compressed and unread.
tinygltf::Model read_gltf(const std::string& path);

/// Pictures and buffers that lay beside the file go into it: the new one may stand elsewhere.
void take_in_files(GlbWriter& writer);

}  // namespace vfit::tools
