#include "avatar/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>

#include "avatar/gltf_compression.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr size_t kMaxFileBytes = size_t(512) << 20;
// More than any character has; what follows counts bones in 16 bits.
constexpr size_t kMostNodes = 60000;
constexpr int kDeepest = 64;  // levels of the text: a file of brackets alone would cost gigabytes

bool keep_picture_as_it_is(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                           int, void*) {
    return true;
}

/// Where a .gltf keeps its buffers: its own folder and those in it, nowhere else on the host's machine; of a
/// file in memory, nowhere.
struct OwnFolder {
    std::filesystem::path folder;  // empty: none

    bool holds(const std::string& path) const {
        if (folder.empty()) return false;
        const auto inside = std::filesystem::absolute(path).lexically_normal().lexically_relative(folder);
        std::error_code ignored;
        return !inside.empty() && *inside.begin() != ".." && std::filesystem::is_regular_file(path, ignored);
    }
};

bool file_exists(const std::string& path, void* own) {
    return static_cast<const OwnFolder*>(own)->holds(path);
}

std::string as_it_is(const std::string& path, void*) { return path; }

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                     void* own) {
    try {
        if (!file_exists(path, own)) return false;
        const std::vector<std::byte> bytes = read_file(path, kMaxFileBytes);
        out->resize(bytes.size());
        if (!bytes.empty()) std::memcpy(out->data(), bytes.data(), bytes.size());
        return true;
    } catch (const Error& failed) {
        if (error) *error += failed.what();
        return false;
    }
}

[[maybe_unused]] bool get_file_size(size_t* size, std::string* error, const std::string& path, void* own) {
    std::error_code failed;
    if (!file_exists(path, own)) return false;
    const auto bytes = std::filesystem::file_size(path, failed);
    if (failed && error) *error += failed.message();
    *size = failed ? 0 : size_t(bytes);
    return !failed;
}

bool refuse_to_write(std::string* error, const std::string&, const std::vector<unsigned char>&, void*) {
    if (error) *error += "a document that is read is never written";
    return false;
}

/// tinygltf asks these for the files beside a .gltf. By name: 2.8 added a field before user_data, and takes
/// no set of callbacks in which one is missing.
template <typename Callbacks = tinygltf::FsCallbacks>
Callbacks callbacks_of(OwnFolder& own) {
    Callbacks callbacks{};
    callbacks.FileExists = file_exists;
    callbacks.ExpandFilePath = as_it_is;
    callbacks.ReadWholeFile = read_whole_file;
    callbacks.WriteWholeFile = refuse_to_write;
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) callbacks.GetFileSizeInBytes = get_file_size;
    callbacks.user_data = &own;
    return callbacks;
}

/// tinygltf does not count the eight bytes before a chunk.
void check_glb(std::span<const std::byte> bytes) {
    const auto number = [&](size_t at) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return size_t(value);
    };
    const size_t size = number(8), text_end = 20 + number(12);
    if (size > bytes.size())
        fail(VFIT_ERROR_DATA, "no readable glTF file: it is cut, ", bytes.size(), " bytes of ", size);
    if (text_end > size || (text_end + 8 <= size && number(text_end) > size - text_end - 8))
        fail(VFIT_ERROR_DATA, "no readable glTF file: a chunk reaches beyond its end");
}

/// The JSON of a GLB, or the whole file.
std::string_view text_of(std::span<const std::byte> bytes, bool binary) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!binary) return all;
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return all.substr(20, length);
}

bool starts_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

/// Extensions that are read, or say nothing about where vertices are.
bool is_known(const std::string& extension) {
    for (const char* known : {"KHR_materials_", "KHR_texture_", "KHR_lights_", "KHR_xmp", "EXT_texture_",
                              "MSFT_texture_", "EXT_lights_", "VRM", "KHR_mesh_quantization",
                              "KHR_draco_mesh_compression", "EXT_meshopt_compression"})
        if (starts_with(extension, known)) return true;
    return false;
}

Mat4 local_of(const tinygltf::Node& node) {
    Mat4 m(1.0f);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) glm::value_ptr(m)[i] = float(node.matrix[size_t(i)]);
        return m;
    }
    const auto part = [](const std::vector<double>& list, size_t i, float preset) {
        return list.size() > i ? float(list[i]) : preset;
    };
    const Quat q(part(node.rotation, 3, 1.0f), part(node.rotation, 0, 0.0f), part(node.rotation, 1, 0.0f),
                 part(node.rotation, 2, 0.0f));
    m = glm::mat4_cast(glm::normalize(q));
    for (int c = 0; c < 3; ++c) {
        m[c] *= part(node.scale, size_t(c), 1.0f);
        m[3][c] = part(node.translation, size_t(c), 0.0f);
    }
    return m;
}

float number_at(const unsigned char* p, int type, bool normalized) {
    const auto read = [p](auto value) {
        std::memcpy(&value, p, sizeof value);
        return value;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return read(float{});
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const float v = float(read(int8_t{}));
            return normalized ? std::max(v / 127.0f, -1.0f) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return float(read(uint8_t{})) / (normalized ? 255.0f : 1.0f);
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const float v = float(read(int16_t{}));
            return normalized ? std::max(v / 32767.0f, -1.0f) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return float(read(uint16_t{})) / (normalized ? 65535.0f : 1.0f);
        default: return float(read(uint32_t{}));
    }
}

}  // namespace

GltfDocument::GltfDocument(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path, kMaxFileBytes);
    const auto folder = std::filesystem::path(path).parent_path();
    parse(bytes, folder.empty() ? "." : folder.string());
}

GltfDocument::GltfDocument(std::span<const std::byte> bytes) { parse(bytes, ""); }

void GltfDocument::parse(std::span<const std::byte> bytes, const std::string& folder) {
    if (bytes.size() < 20) fail(VFIT_ERROR_DATA, bytes.size(), " bytes are no glTF file");
    if (bytes.size() > kMaxFileBytes)
        fail(VFIT_ERROR_DATA, "the file has ", bytes.size(), " bytes, more than ", kMaxFileBytes);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_picture_as_it_is, nullptr);
    OwnFolder own;
    if (!folder.empty()) own.folder = std::filesystem::absolute(folder).lexically_normal();
    loader.SetFsCallbacks(callbacks_of(own));
    std::string error, warning;
    const bool binary = std::memcmp(bytes.data(), "glTF", 4) == 0;
    if (binary) check_glb(bytes);
    if (nests_deeper(text_of(bytes, binary), kDeepest))
        fail(VFIT_ERROR_DATA, "no glTF file: its text is nested deeper than ", kDeepest, " levels");
    const std::vector<std::byte> readable = with_stand_ins(bytes, text_of(bytes, binary), binary);
    if (!readable.empty()) bytes = readable;
    const auto size = static_cast<unsigned int>(bytes.size());
    bool read = false;
    try {
        read = binary ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                                    reinterpret_cast<const unsigned char*>(bytes.data()),
                                                    size, folder)
                      : loader.LoadASCIIFromString(&model_, &error, &warning,
                                                   reinterpret_cast<const char*>(bytes.data()), size, folder);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    if (!read) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        fail(VFIT_ERROR_DATA, "no readable glTF file: ", error.empty() ? "it is damaged" : error);
    }
    if (!starts_with(model_.asset.version, "2"))
        fail(VFIT_ERROR_UNSUPPORTED, "glTF version ", model_.asset.version, "; 2.0 can be read");
    check_extensions();
    decompress(model_);
    place_nodes();
}

void GltfDocument::check_extensions() const {
    for (const std::string& extension : model_.extensionsRequired)
        if (!is_known(extension))
            fail(VFIT_ERROR_UNSUPPORTED, "the file requires ", extension,
                 ", which is not supported: export it without that extension");
}

void GltfDocument::place_nodes() {
    const size_t count = model_.nodes.size();
    if (count > kMostNodes) fail(VFIT_ERROR_DATA, "the file has ", count, " nodes, more than ", kMostNodes);
    parents_.assign(count, -1);
    for (size_t n = 0; n < count; ++n)
        for (const int child : model_.nodes[n].children) {
            if (child < 0 || size_t(child) >= count)
                fail(VFIT_ERROR_DATA, "node ", n, " has a child ", child, " that is not there");
            if (parents_[size_t(child)] >= 0) fail(VFIT_ERROR_DATA, "node ", child, " has two parents");
            parents_[size_t(child)] = int(n);
        }
    worlds_.assign(count, Mat4(1.0f));
    for (size_t n = 0; n < count; ++n)
        if (parents_[n] < 0) order_.push_back(int(n));
    for (size_t i = 0; i < order_.size(); ++i) {
        const auto n = size_t(order_[i]);
        const Mat4 local = local_of(model_.nodes[n]);
        worlds_[n] = parents_[n] < 0 ? local : worlds_[size_t(parents_[n])] * local;
        for (int k = 0; k < 16; ++k)
            if (!std::isfinite(glm::value_ptr(worlds_[n])[k]))
                fail(VFIT_ERROR_DATA, "node ", n, " is not at a finite place");
        order_.insert(order_.end(), model_.nodes[n].children.begin(), model_.nodes[n].children.end());
    }
    if (order_.size() != count) fail(VFIT_ERROR_DATA, "the nodes form a ring");
}

std::string GltfDocument::node_name(int node) const {
    const std::string& name = model_.nodes[size_t(node)].name;
    return name.empty() ? text("node ", node) : name;
}

GltfDocument::Rows GltfDocument::rows(int index, int components, const std::string& what) const {
    if (index < 0 || size_t(index) >= model_.accessors.size())
        fail(VFIT_ERROR_DATA, what, ": accessor ", index, " is not there");
    const tinygltf::Accessor& a = model_.accessors[size_t(index)];
    if (a.sparse.isSparse) fail(VFIT_ERROR_UNSUPPORTED, what, ": sparse accessors are not supported");
    if (tinygltf::GetNumComponentsInType(uint32_t(a.type)) != components)
        fail(VFIT_ERROR_DATA, what, ": accessor ", index, " has another shape than ", components,
             " numbers an item");
    const int size = tinygltf::GetComponentSizeInBytes(uint32_t(a.componentType));
    if (size <= 0 || a.componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE)
        fail(VFIT_ERROR_DATA, what, ": unknown kind of number");
    if (a.bufferView < 0 || size_t(a.bufferView) >= model_.bufferViews.size())
        fail(VFIT_ERROR_UNSUPPORTED, what, ": accessor ", index, " has no data");
    const tinygltf::BufferView& view = model_.bufferViews[size_t(a.bufferView)];
    if (view.buffer < 0 || size_t(view.buffer) >= model_.buffers.size())
        fail(VFIT_ERROR_DATA, what, ": its buffer is not there");
    const auto& bytes = model_.buffers[size_t(view.buffer)].data;
    const size_t row = size_t(size) * size_t(components), stride = view.byteStride ? view.byteStride : row;
    const bool fits = view.byteOffset <= bytes.size() && view.byteLength <= bytes.size() - view.byteOffset &&
                      a.byteOffset <= view.byteLength && stride >= row &&
                      (a.count == 0 || (row <= view.byteLength - a.byteOffset &&
                                        (a.count - 1) <= (view.byteLength - a.byteOffset - row) / stride));
    if (!fits) fail(VFIT_ERROR_DATA, what, ": accessor ", index, " reaches beyond its buffer");
    return {bytes.data() + view.byteOffset + a.byteOffset, stride, a.count, a.componentType, a.normalized};
}

std::vector<float> GltfDocument::numbers(int accessor, int components, const std::string& what) const {
    const Rows r = rows(accessor, components, what);
    const auto size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(r.component_type)));
    std::vector<float> out;
    out.reserve(r.count * size_t(components));
    for (size_t i = 0; i < r.count; ++i)
        for (size_t c = 0; c < size_t(components); ++c) {
            const float value = number_at(r.data + i * r.stride + c * size, r.component_type, r.normalized);
            if (!std::isfinite(value)) fail(VFIT_ERROR_DATA, what, " ", i, " is not finite");
            out.push_back(value);
        }
    return out;
}

std::vector<uint32_t> GltfDocument::integers(int accessor, int components, const std::string& what) const {
    const Rows r = rows(accessor, components, what);
    const auto size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(r.component_type)));
    if (r.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        r.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        r.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(VFIT_ERROR_DATA, what, ": no whole numbers");
    std::vector<uint32_t> out;
    out.reserve(r.count * size_t(components));
    for (size_t i = 0; i < r.count; ++i)
        for (size_t c = 0; c < size_t(components); ++c) {
            uint32_t value = 0;  // little-endian, as glTF is
            std::memcpy(&value, r.data + i * r.stride + c * size, size);
            out.push_back(value);
        }
    return out;
}

}  // namespace vfit
