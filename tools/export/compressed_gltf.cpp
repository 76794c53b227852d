#include "export/compressed_gltf.h"

#include <cstdint>
#include <cstring>

#include "client/client.h"

namespace vfit::tools {

namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr size_t kHead = 20;  // of a GLB, before its text

bool is_glb(const std::string& file) { return file.size() >= kHead && file.compare(0, 4, "glTF") == 0; }

std::string text_of(const std::string& file) {
    if (!is_glb(file)) return file;
    uint32_t size = 0;
    std::memcpy(&size, file.data() + 12, sizeof size);
    return file.substr(kHead, size);
}

Json json_of(const std::string& file) {
    Json json = Json::parse(text_of(file), nullptr, false);
    if (!json.is_object()) throw Failure("no glTF file");
    return json;
}

/// The file with another text.
std::string with_text(const std::string& file, const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!is_glb(file)) return text;
    while (text.size() % 4) text += ' ';
    std::string out = file.substr(0, kHead) + text + file.substr(kHead + text_of(file).size());
    const auto size = uint32_t(out.size()), text_size = uint32_t(text.size());
    std::memcpy(out.data() + 8, &size, sizeof size);
    std::memcpy(out.data() + 12, &text_size, sizeof text_size);
    return out;
}

bool has_extension(const Json& object, const char* name) {
    return object.contains("extensions") && object["extensions"].contains(name);
}

/// A buffer that only says how large its plain data is.
bool is_empty(const Json& buffers, size_t b, bool glb) {
    return has_extension(buffers[b], kMeshopt) && !buffers[b].contains("uri") && !(glb && b == 0);
}

bool is_compressed(const std::string& file) {
    const std::string text = text_of(file);
    return text.find(kMeshopt) != std::string::npos || text.find(kDraco) != std::string::npos;
}

}  // namespace

std::string with_stand_ins(const std::string& file) {
    if (!is_compressed(file)) return file;
    Json json = json_of(file);
    Json &buffers = json["buffers"], &views = json["bufferViews"], &accessors = json["accessors"];
    for (size_t b = 0; b < buffers.size(); ++b) {
        if (!is_empty(buffers, b, is_glb(file))) continue;
        buffers[b] = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
    }
    const size_t stand_in = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    for (const Json& mesh : json["meshes"])
        for (const Json& part : mesh["primitives"])
            if (has_extension(part, kDraco) && part.contains("indices"))
                if (Json& accessor = accessors.at(part["indices"].get<size_t>());
                    !accessor.contains("bufferView"))
                    accessor["bufferView"] = stand_in;
    return with_text(file, json);
}

std::string with_compressed_data(const std::string& glb, const std::string& file) {
    if (!is_compressed(file)) return glb;
    Json written = json_of(glb);
    const Json read = json_of(file);
    for (size_t b = 0; read.contains("buffers") && b < read["buffers"].size(); ++b)
        if (is_empty(read["buffers"], b, is_glb(file))) written["buffers"].at(b) = read["buffers"][b];
    for (size_t v = 0; read.contains("bufferViews") && v < read["bufferViews"].size(); ++v)
        if (has_extension(read["bufferViews"][v], kMeshopt))
            written["bufferViews"].at(v) = read["bufferViews"][v];
    for (size_t a = 0; read.contains("accessors") && a < read["accessors"].size(); ++a)
        if (!read["accessors"][a].contains("bufferView")) written["accessors"].at(a).erase("bufferView");
    return with_text(glb, written);
}

}  // namespace vfit::tools
