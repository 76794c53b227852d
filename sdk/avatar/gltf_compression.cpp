#include "avatar/gltf_compression.h"

#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "avatar/gltf_document.h"
#include "avatar/gltf_draco.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kDraco = "KHR_draco_mesh_compression";

const Json* extension_of(const Json& object, const char* name) {
    if (!object.is_object()) return nullptr;
    const auto list = object.find("extensions");
    if (list == object.end() || !list->is_object()) return nullptr;
    const auto found = list->find(name);
    return found == list->end() ? nullptr : &*found;
}

/// Calls visit(item, index) for each item of the object's array, where it has one.
template <typename Visit>
void each(Json& object, const char* name, Visit&& visit) {
    if (!object.is_object() || !object.contains(name) || !object[name].is_array()) return;
    for (size_t i = 0; i < object[name].size(); ++i) visit(object[name][i], i);
}

/// Buffers that only say how large the plain data is. A GLB's first one is in the file itself.
bool replace_empty_buffers(Json& file, bool is_glb) {
    bool changed = false;
    each(file, "buffers", [&](Json& buffer, size_t index) {
        if (!extension_of(buffer, kMeshopt) || buffer.contains("uri") || (is_glb && index == 0)) return;
        buffer["uri"] = "data:application/octet-stream;base64,AA==";
        buffer["byteLength"] = 1;
        changed = true;
    });
    return changed;
}

/// Indices of compressed parts: what they lead to comes later.
bool place_indices(Json& file) {
    if (!file.is_object() || !file.contains("bufferViews") || !file["bufferViews"].is_array()) return false;
    const size_t stand_in = file["bufferViews"].size();
    std::set<uint64_t> wanted;
    each(file, "meshes", [&](Json& mesh, size_t) {
        each(mesh, "primitives", [&](Json& part, size_t) {
            if (extension_of(part, kDraco) && part.contains("indices") &&
                part["indices"].is_number_unsigned())
                wanted.insert(part["indices"].get<uint64_t>());
        });
    });
    bool changed = false;
    each(file, "accessors", [&](Json& accessor, size_t index) {
        if (!accessor.is_object() || accessor.contains("bufferView") || !wanted.contains(index)) return;
        accessor["bufferView"] = stand_in;
        changed = true;
    });
    if (changed) file["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    return changed;
}

/// The same GLB with another text.
std::vector<std::byte> glb_with(std::span<const std::byte> glb, std::string_view old, std::string text) {
    while (text.size() % 4) text += ' ';
    const size_t head = 20, rest = std::min(head + old.size(), glb.size());
    std::vector<std::byte> out(head + text.size() + glb.size() - rest);
    std::memcpy(out.data(), glb.data(), head);
    const auto size = uint32_t(out.size()), text_size = uint32_t(text.size());
    std::memcpy(out.data() + 8, &size, 4);
    std::memcpy(out.data() + 12, &text_size, 4);
    std::memcpy(out.data() + head, text.data(), text.size());
    if (glb.size() > rest) std::memcpy(out.data() + head + text.size(), &glb[rest], glb.size() - rest);
    return out;
}

/// Numbers and words of an extension.
class Fields {
public:
    Fields(const tinygltf::Value& value, std::string what) : value_(value), what_(std::move(what)) {}

    const std::string& what() const { return what_; }
    size_t whole(const char* key) const {
        if (!has(key) || !value_.Get(key).IsNumber())
            fail(VFIT_ERROR_DATA, what_, ": ", key, " is no number");
        return whole(value_.Get(key), key);
    }
    size_t whole_or(const char* key, size_t preset) const { return has(key) ? whole(key) : preset; }
    size_t whole(const tinygltf::Value& value, const std::string& key) const {
        constexpr double kMax = 4294967295.0;
        const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
        if (!(number >= 0.0 && number <= kMax) || number != std::floor(number))
            fail(VFIT_ERROR_DATA, what_, ": ", key, " is no whole number");
        return size_t(number);
    }
    std::string word(const char* key, const char* preset) const {
        if (!has(key)) return preset;
        return value_.Get(key).IsString() ? value_.Get(key).Get<std::string>() : std::string();
    }

private:
    bool has(const char* key) const { return value_.IsObject() && value_.Has(key); }

    const tinygltf::Value& value_;
    std::string what_;
};

class Unpacker {
public:
    explicit Unpacker(tinygltf::Model& model) : model_(model) {}

    void run() {
        // Draco's data may lie in a view that is compressed itself.
        for (size_t v = 0; v < model_.bufferViews.size(); ++v) {
            const auto found = model_.bufferViews[v].extensions.find(kMeshopt);
            if (found != model_.bufferViews[v].extensions.end())
                unpack_view(model_.bufferViews[v], Fields(found->second, text("buffer view ", v)));
        }
        for (tinygltf::Mesh& mesh : model_.meshes)
            for (size_t p = 0; p < mesh.primitives.size(); ++p) {
                const auto found = mesh.primitives[p].extensions.find(kDraco);
                if (found != mesh.primitives[p].extensions.end())
                    unpack_part(mesh.primitives[p], found->second,
                                text("mesh \"", mesh.name, "\", part ", p));
            }
    }

private:
    std::span<const unsigned char> bytes_of(size_t buffer, size_t offset, size_t length,
                                            const std::string& what) const {
        if (buffer >= model_.buffers.size()) fail(VFIT_ERROR_DATA, what, ": its buffer is not there");
        const std::vector<unsigned char>& all = model_.buffers[buffer].data;
        if (offset > all.size() || length > all.size() - offset)
            fail(VFIT_ERROR_DATA, what, " reaches beyond its buffer");
        return std::span(all).subspan(offset, length);
    }

    void count(size_t items, size_t bytes_each, const std::string& what) {
        if (items > (kMaxUnpackedBytes - unpacked_) / bytes_each)
            fail(VFIT_ERROR_DATA, what, ": the file unpacks to more than ", kMaxUnpackedBytes, " bytes");
        unpacked_ += items * bytes_each;
    }

    int add_buffer(std::vector<unsigned char> data) {
        model_.buffers.emplace_back();
        model_.buffers.back().data = std::move(data);
        return int(model_.buffers.size()) - 1;
    }

    void unpack_view(tinygltf::BufferView& view, const Fields& packed) {
        const std::string& what = packed.what();
        const size_t items = packed.whole("count"), stride = packed.whole("byteStride");
        const std::string mode = packed.word("mode", ""), filter = packed.word("filter", "NONE");
        const bool is_rows = mode == "ATTRIBUTES";
        if (!is_rows && mode != "TRIANGLES" && mode != "INDICES")
            fail(VFIT_ERROR_UNSUPPORTED, what, ": meshopt's mode \"", mode, "\" is not known");
        if (is_rows ? stride == 0 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4)
            fail(VFIT_ERROR_DATA, what, ": meshopt data of ", stride, " bytes an item");
        if (mode == "TRIANGLES" && items % 3 != 0)
            fail(VFIT_ERROR_DATA, what, ": ", items, " indices are no whole triangles");
        const auto bytes = bytes_of(packed.whole("buffer"), packed.whole_or("byteOffset", 0),
                                    packed.whole("byteLength"), what);
        count(items, stride, what);
        std::vector<unsigned char> data(items * stride);
        const int failed =
            is_rows ? meshopt_decodeVertexBuffer(data.data(), items, stride, bytes.data(), bytes.size())
            : mode == "TRIANGLES"
                ? meshopt_decodeIndexBuffer(data.data(), items, stride, bytes.data(), bytes.size())
                : meshopt_decodeIndexSequence(data.data(), items, stride, bytes.data(), bytes.size());
        if (failed) fail(VFIT_ERROR_DATA, what, ": its meshopt data is damaged");
        if (filter == "OCTAHEDRAL" && is_rows && (stride == 4 || stride == 8))
            meshopt_decodeFilterOct(data.data(), items, stride);
        else if (filter == "QUATERNION" && is_rows && stride == 8)
            meshopt_decodeFilterQuat(data.data(), items, stride);
        else if (filter == "EXPONENTIAL" && is_rows)
            meshopt_decodeFilterExp(data.data(), items, stride);
        else if (filter != "NONE")
            fail(VFIT_ERROR_DATA, what, ": meshopt's filter \"", filter, "\" does not go with ", mode, " of ",
                 stride, " bytes an item");
        view.byteOffset = 0;
        view.byteLength = data.size();
        view.byteStride = is_rows ? stride : 0;
        view.buffer = add_buffer(std::move(data));
    }

    tinygltf::Accessor& accessor(int index, const std::string& what) {
        if (index < 0 || size_t(index) >= model_.accessors.size())
            fail(VFIT_ERROR_DATA, what, ": accessor ", index, " is not there");
        return model_.accessors[size_t(index)];
    }

    /// The accessor leads to the data from now on, alone and tightly packed.
    void lead_to(tinygltf::Accessor& accessor, std::vector<unsigned char> data) {
        tinygltf::BufferView view;
        view.byteLength = data.size();
        view.buffer = add_buffer(std::move(data));
        model_.bufferViews.push_back(view);
        accessor.bufferView = int(model_.bufferViews.size()) - 1;
        accessor.byteOffset = 0;
        accessor.sparse.isSparse = false;
    }

    bool is_required() const {
        for (const std::string& extension : model_.extensionsRequired)
            if (extension == kDraco) return true;
        return false;
    }

    void unpack_part(tinygltf::Primitive& part, const tinygltf::Value& extension, const std::string& what) {
        if (!reads_draco() && !is_required()) return;  // the plain data is there as well
        const Fields packed(extension, what);
        const size_t view_index = packed.whole("bufferView");
        if (view_index >= model_.bufferViews.size())
            fail(VFIT_ERROR_DATA, what, ": its Draco data is not there");
        const tinygltf::BufferView& view = model_.bufferViews[view_index];
        const auto bytes = bytes_of(view.buffer < 0 ? SIZE_MAX : size_t(view.buffer), view.byteOffset,
                                    view.byteLength, what);
        if (!extension.Has("attributes") || !extension.Get("attributes").IsObject())
            fail(VFIT_ERROR_DATA, what, ": its Draco data names no attributes");
        std::vector<int> targets;
        std::vector<DracoAttribute> attributes;
        bool all_done = done(part.indices, view_index, what);
        for (const std::string& name : extension.Get("attributes").Keys()) {
            const auto used = part.attributes.find(name);
            if (used == part.attributes.end())
                fail(VFIT_ERROR_DATA, what, ": its Draco data has ", name, ", which the part has not");
            const tinygltf::Accessor& a = accessor(used->second, what);
            DracoAttribute attribute;
            attribute.id = uint32_t(packed.whole(extension.Get("attributes").Get(name), name));
            attribute.component_type = a.componentType;
            attribute.components = tinygltf::GetNumComponentsInType(uint32_t(a.type));
            if (attribute.components < 1 || attribute.components > 4)
                fail(VFIT_ERROR_DATA, what, ": ", name, " has another shape than 1 to 4 numbers an item");
            attributes.push_back(attribute);
            targets.push_back(used->second);
            all_done = done(used->second, view_index, what) && all_done;
        }
        if (all_done) return;
        const auto position = part.attributes.find("POSITION");
        const size_t vertices =
            accessor(position == part.attributes.end() ? -1 : position->second, what + ": POSITION").count;
        const size_t corners = accessor(part.indices, what + ": indices").count;
        count(corners, sizeof(uint32_t), what);
        for (size_t i = 0; i < attributes.size(); ++i) {
            if (accessor(targets[i], what).count != vertices)
                fail(VFIT_ERROR_DATA, what, ": its attributes have other counts than POSITION");
            count(vertices, 4 * sizeof(float), what);
        }
        std::vector<unsigned char> indices = decode_draco(bytes, corners, vertices, attributes, what);
        accessor(part.indices, what).componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        lead_to(accessor(part.indices, what), std::move(indices));
        from_view_[part.indices] = view_index;
        for (size_t i = 0; i < attributes.size(); ++i) {
            lead_to(accessor(targets[i], what), std::move(attributes[i].values));
            from_view_[targets[i]] = view_index;
        }
    }

    /// Whether the accessor has been unpacked from the same data before: nodes and parts may share it.
    bool done(int accessor, size_t view, const std::string& what) const {
        const auto found = from_view_.find(accessor);
        if (found == from_view_.end()) return false;
        if (found->second != view)
            fail(VFIT_ERROR_DATA, what, ": accessor ", accessor, " belongs to other Draco data as well");
        return true;
    }

    tinygltf::Model& model_;
    size_t unpacked_ = 0;
    std::map<int, size_t> from_view_;  // by accessor: the view with its Draco data
};

}  // namespace

std::vector<std::byte> with_stand_ins(std::span<const std::byte> bytes, std::string_view text, bool is_glb) {
    if (text.find(kMeshopt) == std::string_view::npos && text.find(kDraco) == std::string_view::npos)
        return {};
    Json file = parse_json(text, "no glTF file");
    const bool buffers = replace_empty_buffers(file, is_glb), indices = place_indices(file);
    if (!buffers && !indices) return {};
    const std::string changed = file.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (is_glb) return glb_with(bytes, text, changed);
    const auto* from = reinterpret_cast<const std::byte*>(changed.data());
    return {from, from + changed.size()};
}

void decompress(tinygltf::Model& model) { Unpacker(model).run(); }

}  // namespace vfit
