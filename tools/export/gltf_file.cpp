#include "export/gltf_file.h"

#include <algorithm>
#include <filesystem>

#include "client/client.h"
#include "client/files.h"
#include "export/compressed_gltf.h"

namespace vfit::tools {

namespace {

bool keep_picture(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

}  // namespace

tinygltf::Model read_gltf(const std::string& path) {
    const std::string bytes = with_stand_ins(read_text(path));
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_picture, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const bool binary = bytes.compare(0, 4, "glTF") == 0;
    const bool read = binary
                          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(bytes.data()),
                                                        uint32_t(bytes.size()), folder)
                          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(),
                                                       uint32_t(bytes.size()), folder);
    if (!read) throw Failure(path + ": " + error);
    return model;
}

void take_in_files(GlbWriter& writer) {
    tinygltf::Model& model = writer.model();
    for (tinygltf::Image& image : model.images) {
        if (image.bufferView >= 0 || image.image.empty()) continue;
        constexpr unsigned char kPng[] = {0x89, 'P', 'N', 'G'};
        const bool png = image.image.size() > sizeof kPng &&
                         std::equal(std::begin(kPng), std::end(kPng), image.image.begin());
        image.mimeType = png ? "image/png" : "image/jpeg";
        image.bufferView = writer.add_view(image.image.data(), image.image.size(), 0);
        image.uri.clear();
    }
    for (tinygltf::Buffer& buffer : model.buffers) buffer.uri.clear();
}

}  // namespace vfit::tools
