#include "avatar/gltf_draco.h"

#include "core/error.h"

#if VFIT_HAS_DRACO

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>
#include <new>

#include "avatar/gltf_document.h"

namespace vfit {

namespace {

[[noreturn]] void damaged(const std::string& what, const std::string& cause) {
    fail(VFIT_ERROR_DATA, what, ": its Draco data is damaged: ", cause);
}

/// The decoder makes room for the counts that the data opens with before it reads any further.
void check_counts(std::span<const unsigned char> bytes, size_t index_count, size_t vertex_count,
                  const std::string& what) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) damaged(what, "it has no header");
    // The version that KHR_draco_mesh_compression names.
    if (header.version_major != 2 || header.version_minor != 2)
        fail(VFIT_ERROR_UNSUPPORTED, what, ": Draco data of version ", int(header.version_major), ".",
             int(header.version_minor), "; 2.2 can be read");
    if (header.encoder_type != draco::TRIANGULAR_MESH) damaged(what, "it holds no triangles");
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    draco::GeometryMetadata metadata;
    if ((header.flags & METADATA_FLAG_MASK) &&
        !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
        damaged(what, "its metadata is cut");
    const bool is_sequential = header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
    uint8_t traversal = 0;
    uint32_t vertices = 0, faces = 0;
    const bool read = is_sequential
                          ? draco::DecodeVarint(&faces, &buffer) && draco::DecodeVarint(&vertices, &buffer)
                          : buffer.Decode(&traversal) && draco::DecodeVarint(&vertices, &buffer) &&
                                draco::DecodeVarint(&faces, &buffer);
    if (!read) damaged(what, "it is cut");
    if (3 * size_t(faces) != index_count)
        damaged(what, text("it has ", faces, " triangles, the file says ", index_count, " indices"));
    // Where attributes have seams, vertices are split after these are read.
    if (vertices > vertex_count || (is_sequential && vertices != vertex_count))
        damaged(what, text("it has ", vertices, " vertices, the file says ", vertex_count));
}

template <typename T>
bool copy_values(const draco::PointAttribute& from, size_t vertex_count, int components,
                 std::vector<unsigned char>& out) {
    out.resize(vertex_count * size_t(components) * sizeof(T));
    T row[4];
    for (uint32_t v = 0; v < vertex_count; ++v) {
        const draco::AttributeValueIndex at = from.mapped_index(draco::PointIndex(v));
        if (at.value() >= from.size() || !from.ConvertValue<T>(at, int8_t(components), row)) return false;
        std::memcpy(out.data() + size_t(v) * size_t(components) * sizeof(T), row,
                    size_t(components) * sizeof(T));
    }
    return true;
}

bool copy(const draco::PointAttribute& from, size_t vertex_count, DracoAttribute& to) {
    switch (to.component_type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return copy_values<float>(from, vertex_count, to.components, to.values);
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return copy_values<int8_t>(from, vertex_count, to.components, to.values);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return copy_values<uint8_t>(from, vertex_count, to.components, to.values);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return copy_values<int16_t>(from, vertex_count, to.components, to.values);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return copy_values<uint16_t>(from, vertex_count, to.components, to.values);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return copy_values<uint32_t>(from, vertex_count, to.components, to.values);
        default: return false;
    }
}

std::unique_ptr<draco::Mesh> decoded(std::span<const unsigned char> bytes, const std::string& what) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    try {
        auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok()) damaged(what, mesh.status().error_msg_string());
        return std::move(mesh).value();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& thrown) {
        damaged(what, thrown.what());
    }
}

}  // namespace

bool reads_draco() { return true; }

std::vector<unsigned char> decode_draco(std::span<const unsigned char> bytes, size_t index_count,
                                        size_t vertex_count, std::span<DracoAttribute> attributes,
                                        const std::string& what) {
    check_counts(bytes, index_count, vertex_count, what);
    const std::unique_ptr<draco::Mesh> mesh = decoded(bytes, what);
    if (mesh->num_points() != vertex_count || 3 * size_t(mesh->num_faces()) != index_count)
        damaged(what, text("it has ", mesh->num_points(), " vertices, the file says ", vertex_count));
    for (DracoAttribute& attribute : attributes) {
        const draco::PointAttribute* from = mesh->GetAttributeByUniqueId(attribute.id);
        if (!from) damaged(what, text("it has no attribute ", attribute.id));
        if (from->num_components() != attribute.components || !copy(*from, vertex_count, attribute))
            damaged(what, text("its attribute ", attribute.id, " is not as the file says"));
    }
    std::vector<uint32_t> indices;
    indices.reserve(index_count);
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh->face(f)) indices.push_back(corner.value());
    std::vector<unsigned char> out(indices.size() * sizeof(uint32_t));
    if (!indices.empty()) std::memcpy(out.data(), indices.data(), out.size());
    return out;
}

}  // namespace vfit

#else

namespace vfit {

bool reads_draco() { return false; }

std::vector<unsigned char> decode_draco(std::span<const unsigned char>, size_t, size_t,
                                        std::span<DracoAttribute>, const std::string&) {
    fail(VFIT_ERROR_UNSUPPORTED, "this file is compressed with Draco; this build has no Draco");
}

}  // namespace vfit

#endif
