// Character files that are compressed: encoded here, they load as the same character that is not.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "avatar/avatar.h"
#include "avatar/character.h"
#include "avatar/gltf_document.h"
#include "core/error.h"
#include "support/tiny_character.h"

#if VFIT_HAS_DRACO
#include <draco/compression/encode.h>
#endif

namespace vfit {
namespace {

// As TinyCharacter has them.
enum View : size_t { kPositions, kJoints, kWeights, kIndices, kBinds };
constexpr size_t kVertices = 15 * 8;

Character load(const TinyCharacter& tiny) { return load_character(GltfDocument(tiny.glb()), ""); }

/// What a view holds.
template <typename T>
std::vector<T> items_of(const TinyCharacter& tiny, size_t view) {
    const auto& v = tiny.json["bufferViews"][view];
    std::vector<T> out(v["byteLength"].get<size_t>() / sizeof(T));
    std::memcpy(out.data(), tiny.binary.data() + v["byteOffset"].get<size_t>(), out.size() * sizeof(T));
    return out;
}

/// Puts bytes at the end of the file's own buffer; returns where.
size_t append(TinyCharacter& tiny, const void* bytes, size_t size) {
    const size_t at = tiny.binary.size();
    const auto* from = static_cast<const unsigned char*>(bytes);
    tiny.binary.insert(tiny.binary.end(), from, from + size);
    while (tiny.binary.size() % 4) tiny.binary.push_back(0);
    tiny.json["buffers"][0]["byteLength"] = tiny.binary.size();
    return at;
}

void require(TinyCharacter& tiny, const char* extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) tiny.json[list] = {extension};
}

/// The view's data is from now on in the extension alone; its plain bytes would be in a buffer that has none.
void pack(TinyCharacter& tiny, size_t view, const std::vector<unsigned char>& packed, size_t count,
          size_t stride, const char* mode, const char* filter = nullptr) {
    require(tiny, "EXT_meshopt_compression");
    auto& v = tiny.json["bufferViews"][view];
    // The plain bytes are not read any more.
    for (size_t i = 0; v["buffer"] == 0 && i < v["byteLength"].get<size_t>(); ++i)
        tiny.binary[v["byteOffset"].get<size_t>() + i] = 0xcd;
    const size_t at = append(tiny, packed.data(), packed.size());
    v = {{"buffer", 1}, {"byteLength", count * stride}};
    v["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},          {"byteOffset", at}, {"byteLength", packed.size()},
        {"byteStride", stride}, {"count", count},   {"mode", mode}};
    if (filter) v["extensions"]["EXT_meshopt_compression"]["filter"] = filter;
    tiny.json["buffers"][1] = {{"byteLength", 1 << 20},
                               {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
}

template <typename T>
std::vector<unsigned char> packed_rows(const std::vector<T>& rows, size_t count) {
    const size_t stride = rows.size() * sizeof(T) / count;
    std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), rows.data(), count, stride));
    return out;
}

template <typename T>
void pack_rows(TinyCharacter& tiny, size_t view, const std::vector<T>& rows, size_t count,
               const char* filter = nullptr) {
    pack(tiny, view, packed_rows(rows, count), count, rows.size() * sizeof(T) / count, "ATTRIBUTES", filter);
}

void pack_indices(TinyCharacter& tiny, const char* mode) {
    const auto plain = items_of<uint16_t>(tiny, kIndices);
    std::vector<unsigned char> out;
    if (std::string(mode) == "TRIANGLES") {
        out.resize(meshopt_encodeIndexBufferBound(plain.size(), kVertices));
        out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), plain.data(), plain.size()));
    } else {
        out.resize(meshopt_encodeIndexSequenceBound(plain.size(), kVertices));
        out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), plain.data(), plain.size()));
    }
    pack(tiny, kIndices, out, plain.size(), 2, mode);
}

TinyCharacter packed_by_meshopt(const char* index_mode = "INDICES") {
    TinyCharacter tiny;
    pack_rows(tiny, kPositions, items_of<float>(tiny, kPositions), kVertices);
    pack_rows(tiny, kJoints, items_of<uint16_t>(tiny, kJoints), kVertices);
    pack_rows(tiny, kWeights, items_of<float>(tiny, kWeights), kVertices);
    pack_rows(tiny, kBinds, items_of<float>(tiny, kBinds), 15);
    pack_indices(tiny, index_mode);
    return tiny;
}

/// A corner of a triangle, whatever its number.
struct Corner {
    Vec3 position;
    uint16_t bone;
    bool operator<(const Corner& other) const {
        return std::tie(position.x, position.y, position.z, bone) <
               std::tie(other.position.x, other.position.y, other.position.z, other.bone);
    }
};

/// All triangles, the lowest corner first, in order.
std::vector<std::array<Corner, 3>> triangles_of(const Character& character) {
    const Mesh& rest = character.source.rest;
    std::vector<std::array<Corner, 3>> out;
    for (size_t i = 0; i < rest.indices.size(); i += 3) {
        std::array<Corner, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = rest.indices[i + k];
            corners[k] = {rest.positions[v], character.source.skin_bones[v][0]};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        out.push_back(corners);
    }
    std::sort(out.begin(), out.end());
    return out;
}

void expect_same_triangles(const Character& got, const Character& wanted, float tolerance) {
    const auto a = triangles_of(got), b = triangles_of(wanted);
    ASSERT_EQ(a.size(), b.size());
    for (size_t t = 0; t < a.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_LE(glm::distance(a[t][k].position, b[t][k].position), tolerance) << t;
            EXPECT_EQ(a[t][k].bone, b[t][k].bone) << t;
        }
}

void expect_refused(const std::function<void()>& read, const char* word, vfit_result code = VFIT_ERROR_DATA) {
    try {
        read();
        ADD_FAILURE() << "accepted: " << word;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

/// Files cut, and with other bytes, come to an error or to a character, and nothing else.
void expect_no_harm(const std::vector<std::byte>& good, size_t first_packed) {
    std::mt19937 bits(5);
    int refused = 0;
    for (int run = 0; run < 1500; ++run) {
        std::vector<std::byte> bad = good;
        const size_t from = run % 2 ? first_packed : 20;
        if (run % 10 == 0) bad.resize(bits() % bad.size());
        for (int k = 0; k < 3 && bad.size() > from; ++k)
            bad[from + bits() % (bad.size() - from)] = std::byte(bits());
        try {
            const Character character = load_character(GltfDocument(bad), "");
            Avatar avatar(character.source, AvatarDesc());
        } catch (const Error& error) {
            ++refused;
            EXPECT_TRUE(error.code() == VFIT_ERROR_DATA || error.code() == VFIT_ERROR_UNSUPPORTED)
                << error.what();
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(MeshoptCharacter, LoadsAsThePlainOne) {
    const Character plain = load(TinyCharacter()), got = load(packed_by_meshopt());
    EXPECT_EQ(got.source.rest.indices, plain.source.rest.indices);
    EXPECT_EQ(got.source.rest.positions, plain.source.rest.positions);
    EXPECT_EQ(got.source.skin_bones, plain.source.skin_bones);
    EXPECT_EQ(got.source.skin_weights, plain.source.skin_weights);
    expect_same_triangles(load(packed_by_meshopt("TRIANGLES")), plain, 0.0f);
}

TEST(MeshoptCharacter, IsReadWithoutAPlaceForThePlainBytes) {
    // A .gltf may have no buffer without bytes either.
    TinyCharacter tiny = packed_by_meshopt();
    std::string base64;
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    while (tiny.binary.size() % 3) tiny.binary.push_back(0);
    for (size_t i = 0; i < tiny.binary.size(); i += 3) {
        const uint32_t three =
            uint32_t(tiny.binary[i]) << 16 | uint32_t(tiny.binary[i + 1]) << 8 | tiny.binary[i + 2];
        for (const int shift : {18, 12, 6, 0}) base64 += digits[three >> shift & 63];
    }
    tiny.json["buffers"][0] = {{"byteLength", tiny.binary.size()},
                               {"uri", "data:application/octet-stream;base64," + base64}};
    const std::string text = tiny.json.dump();
    const Character got =
        load_character(GltfDocument(std::as_bytes(std::span(text.data(), text.size()))), "");
    EXPECT_EQ(got.source.rest.positions, load(TinyCharacter()).source.rest.positions);
}

TEST(MeshoptCharacter, OfQuantizedPlacesAndExponentsIsThePlainOneButForRounding) {
    TinyCharacter tiny = packed_by_meshopt();
    // Places as fractions of two metres; the bind matrices bring them back, as gltf-transform writes it.
    const TinyCharacter plain;
    std::vector<int16_t> places;
    const auto floats = items_of<float>(plain, kPositions);
    for (size_t v = 0; v < kVertices; ++v)
        for (size_t k = 0; k < 4; ++k)
            places.push_back(k < 3 ? int16_t(std::lround(floats[3 * v + k] / 2.0f * 32767.0f)) : int16_t(0));
    pack_rows(tiny, kPositions, places, kVertices);
    tiny.json["accessors"][0]["componentType"] = 5122;
    tiny.json["accessors"][0]["normalized"] = true;
    auto binds = items_of<float>(plain, kBinds);
    for (size_t b = 0; b < 15; ++b)
        for (size_t k = 0; k < 12; ++k) binds[16 * b + k] *= 2.0f;
    std::vector<uint32_t> packed_binds(16 * 15);  // as 2^E * M
    meshopt_encodeFilterExp(packed_binds.data(), 15, 64, 20, binds.data());
    pack_rows(tiny, kBinds, packed_binds, 15, "EXPONENTIAL");
    const Character got = load(tiny), wanted = load(plain);
    for (size_t v = 0; v < kVertices; ++v)
        EXPECT_LT(glm::distance(got.source.rest.positions[v], wanted.source.rest.positions[v]), 1.5e-4f);
    EXPECT_EQ(got.source.skin_weights, wanted.source.skin_weights);
}

TEST(MeshoptCharacter, OctahedralNormalsAndQuaternionsAreUnfolded) {
    std::mt19937 bits(1);
    std::normal_distribution<float> normal;
    std::vector<float> directions, turns;
    for (size_t v = 0; v < kVertices; ++v) {
        const Vec3 n = glm::normalize(Vec3(normal(bits), normal(bits), normal(bits)));
        const Vec4 q = glm::normalize(Vec4(normal(bits), normal(bits), normal(bits), normal(bits)));
        directions.insert(directions.end(), {n.x, n.y, n.z, 0.0f});
        turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
    }
    struct Case {
        size_t stride;
        int component;
        const char* filter;
        float tolerance;
    };
    for (const Case& c : {Case{4, 5120, "OCTAHEDRAL", 0.02f}, Case{8, 5122, "OCTAHEDRAL", 1e-3f},
                          Case{8, 5122, "QUATERNION", 1e-3f}}) {
        TinyCharacter tiny = packed_by_meshopt();
        const bool is_turn = c.filter[0] == 'Q';
        std::vector<unsigned char> rows(kVertices * c.stride);
        if (is_turn)
            meshopt_encodeFilterQuat(rows.data(), kVertices, c.stride, 16, turns.data());
        else
            meshopt_encodeFilterOct(rows.data(), kVertices, c.stride, int(2 * c.stride), directions.data());
        tiny.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 4}});
        const size_t view = tiny.json["bufferViews"].size() - 1;
        pack_rows(tiny, view, rows, kVertices, c.filter);
        tiny.json["accessors"].push_back({{"bufferView", view},
                                          {"componentType", c.component},
                                          {"normalized", true},
                                          {"count", kVertices},
                                          {"type", is_turn ? "VEC4" : "VEC3"}});
        const GltfDocument document(tiny.glb());
        const int n = is_turn ? 4 : 3;
        const auto got = document.numbers(int(tiny.json["accessors"].size()) - 1, n, "rows");
        for (size_t v = 0; v < kVertices; ++v) {
            float dot = 0.0f;
            for (size_t k = 0; k < size_t(n); ++k)
                dot += got[size_t(n) * v + k] * (is_turn ? turns : directions)[4 * v + k];
            EXPECT_NEAR(is_turn ? std::abs(dot) : dot, 1.0f, c.tolerance) << c.filter << c.stride << " " << v;
        }
    }
}

TEST(MeshoptCharacter, IsRefusedWithTheReason) {
    const auto refused = [](const char* word, auto&& change, vfit_result code = VFIT_ERROR_DATA) {
        TinyCharacter tiny = packed_by_meshopt();
        change(tiny.json["bufferViews"][kPositions]["extensions"]["EXT_meshopt_compression"]);
        expect_refused([&] { load(tiny); }, word, code);
    };
    refused("is damaged", [](auto& e) { e["byteLength"] = 40; });
    refused("is damaged", [](auto& e) { e["byteStride"] = 16; });
    refused("is damaged", [](auto& e) { e["count"] = 400; });
    refused("bytes an item", [](auto& e) { e["byteStride"] = 0; });
    refused("bytes an item", [](auto& e) { e["byteStride"] = 260; });
    refused("bytes an item", [](auto& e) { e["byteStride"] = 6; });
    refused("reaches beyond its buffer", [](auto& e) { e["byteLength"] = 1 << 20; });
    refused("reaches beyond its buffer", [](auto& e) { e["byteOffset"] = 2000000000; });
    refused("buffer is not there", [](auto& e) { e["buffer"] = 7; });
    refused("unpacks to more than", [](auto& e) { e["count"] = 2000000000; });
    refused("count is no whole number", [](auto& e) { e["count"] = -4; });
    refused("count is no number", [](auto& e) { e.erase("count"); });
    refused("does not go with", [](auto& e) { e["filter"] = "QUATERNION"; });
    refused("does not go with", [](auto& e) { e["filter"] = "PINK"; });
    refused("is not known", [](auto& e) { e["mode"] = "PINK"; }, VFIT_ERROR_UNSUPPORTED);
}

TEST(MeshoptCharacter, DamageIsAnErrorAndNoHarm) {
    const TinyCharacter tiny = packed_by_meshopt();
    const std::vector<std::byte> good = tiny.glb();
    const size_t plain = TinyCharacter().binary.size();
    expect_no_harm(good, good.size() - (tiny.binary.size() - plain));
}

TEST(DracoCharacter, IsReadFromItsPlainDataWhereTheExtensionIsNotRequired) {
    TinyCharacter tiny;
    tiny.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    EXPECT_NO_THROW(load(tiny));
}

#if VFIT_HAS_DRACO

enum class DracoWay { sequential, edgebreaker, quantized };

void fill(draco::Mesh& mesh, const TinyCharacter& tiny) {
    const auto positions = items_of<float>(tiny, kPositions), weights = items_of<float>(tiny, kWeights);
    const auto joints = items_of<uint16_t>(tiny, kJoints), indices = items_of<uint16_t>(tiny, kIndices);
    mesh.set_num_points(kVertices);
    const auto add = [&](draco::GeometryAttribute::Type kind, const auto& rows, draco::DataType type) {
        const auto components = int8_t(rows.size() / kVertices);
        const size_t stride = size_t(components) * sizeof rows[0];
        draco::GeometryAttribute attribute;
        attribute.Init(kind, nullptr, components, type, false, int64_t(stride), 0);
        const int id = mesh.AddAttribute(attribute, true, kVertices);
        for (uint32_t v = 0; v < kVertices; ++v)
            mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v),
                                                  &rows[size_t(components) * v]);
    };
    add(draco::GeometryAttribute::POSITION, positions, draco::DT_FLOAT32);
    add(draco::GeometryAttribute::GENERIC, joints, draco::DT_UINT16);
    add(draco::GeometryAttribute::GENERIC, weights, draco::DT_FLOAT32);
    for (size_t i = 0; i < indices.size(); i += 3)
        mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]),
                      draco::PointIndex(indices[i + 2])});
}

TinyCharacter packed_by_draco(DracoWay way) {
    TinyCharacter tiny;
    draco::Encoder encoder;
    encoder.SetEncodingMethod(way == DracoWay::sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                          : draco::MESH_EDGEBREAKER_ENCODING);
    if (way == DracoWay::quantized) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    draco::Mesh mesh;
    fill(mesh, tiny);
    const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
    EXPECT_TRUE(status.ok()) << status.error_msg_string();
    require(tiny, "KHR_draco_mesh_compression");
    const size_t binds = tiny.json["bufferViews"][kBinds]["byteOffset"].get<size_t>();
    std::fill(tiny.binary.begin(), tiny.binary.begin() + long(binds), static_cast<unsigned char>(0xcd));
    const size_t at = append(tiny, buffer.data(), buffer.size());
    tiny.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", buffer.size()}});
    auto& part = tiny.json["meshes"][0]["primitives"][0];
    for (const size_t a : {0, 1, 2, 3}) tiny.json["accessors"][a].erase("bufferView");
    part["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", tiny.json["bufferViews"].size() - 1},
        {"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}}}};
    return tiny;
}

TEST(DracoCharacter, LoadsAsThePlainOne) {
    const Character plain = load(TinyCharacter()), in_order = load(packed_by_draco(DracoWay::sequential));
    EXPECT_EQ(in_order.source.rest.positions, plain.source.rest.positions);
    EXPECT_EQ(in_order.source.rest.indices, plain.source.rest.indices);
    EXPECT_EQ(in_order.source.skin_weights, plain.source.skin_weights);
    expect_same_triangles(load(packed_by_draco(DracoWay::edgebreaker)), plain, 0.0f);
}

TEST(DracoCharacter, OfQuantizedPlacesIsThePlainOneButForRounding) {
    const Character plain = load(TinyCharacter()), got = load(packed_by_draco(DracoWay::quantized));
    ASSERT_EQ(got.source.rest.positions.size(), kVertices);
    for (const Vec3& p : plain.source.rest.positions) {
        float closest = 1.0f;
        for (const Vec3& q : got.source.rest.positions) closest = std::min(closest, glm::distance(p, q));
        EXPECT_LT(closest, 3e-4f);
    }
    expect_same_triangles(got, got, 0.0f);
}

TEST(DracoCharacter, PartsMayShareTheirData) {
    TinyCharacter tiny = packed_by_draco(DracoWay::edgebreaker);
    auto& parts = tiny.json["meshes"][0]["primitives"];
    parts.push_back(parts[0]);
    EXPECT_EQ(load(tiny).source.rest.indices.size(), 2 * load(TinyCharacter()).source.rest.indices.size());
}

TEST(DracoCharacter, IsRefusedWithTheReason) {
    const auto refused = [](const char* word, auto&& change, vfit_result code = VFIT_ERROR_DATA) {
        for (const DracoWay way : {DracoWay::sequential, DracoWay::edgebreaker}) {
            TinyCharacter tiny = packed_by_draco(way);
            change(tiny);
            expect_refused([&] { load(tiny); }, word, code);
        }
    };
    const auto packed = [](TinyCharacter& tiny) -> nlohmann::json& {
        return tiny.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
    };
    const auto byte_of = [&](TinyCharacter& tiny, size_t at) -> unsigned char& {
        const auto& view = tiny.json["bufferViews"].back();
        return tiny.binary[view["byteOffset"].get<size_t>() + at];
    };
    refused("is damaged", [](TinyCharacter& t) { t.json["bufferViews"].back()["byteLength"] = 300; });
    refused("it has no header", [](TinyCharacter& t) { t.json["bufferViews"].back()["byteLength"] = 3; });
    refused("it is cut", [](TinyCharacter& t) { t.json["bufferViews"].back()["byteLength"] = 12; });
    refused("it has no header", [&](TinyCharacter& t) { byte_of(t, 0) = 'X'; });
    refused("version 2.9", [&](TinyCharacter& t) { byte_of(t, 6) = 9; }, VFIT_ERROR_UNSUPPORTED);
    refused("holds no triangles", [&](TinyCharacter& t) { byte_of(t, 7) = 0; });
    refused("triangles, the file says", [](TinyCharacter& t) { t.json["accessors"][3]["count"] = 3; });
    refused("vertices, the file says", [](TinyCharacter& t) {
        for (const size_t a : {0, 1, 2}) t.json["accessors"][a]["count"] = 100;
    });
    refused("other counts", [](TinyCharacter& t) { t.json["accessors"][1]["count"] = 7; });
    refused("not as the file says", [](TinyCharacter& t) { t.json["accessors"][0]["type"] = "VEC2"; });
    refused("no attribute 9", [&](TinyCharacter& t) { packed(t)["attributes"]["POSITION"] = 9; });
    refused("which the part has not", [&](TinyCharacter& t) { packed(t)["attributes"]["COLOR_0"] = 1; });
    refused("Draco data is not there", [&](TinyCharacter& t) { packed(t)["bufferView"] = 99; });
    refused("names no attributes", [&](TinyCharacter& t) { packed(t).erase("attributes"); });
    refused("beyond its buffer",
            [](TinyCharacter& t) { t.json["bufferViews"].back()["byteLength"] = 1 << 24; });
    refused("unpacks to more than", [](TinyCharacter& t) { t.json["accessors"][3]["count"] = 4000000000u; });
}

TEST(DracoCharacter, DamageIsAnErrorAndNoHarm) {
    for (const DracoWay way : {DracoWay::sequential, DracoWay::edgebreaker, DracoWay::quantized}) {
        const TinyCharacter tiny = packed_by_draco(way);
        const std::vector<std::byte> good = tiny.glb();
        const size_t packed = tiny.json["bufferViews"].back()["byteLength"].get<size_t>();
        expect_no_harm(good, good.size() - packed);
    }
}

#else

TEST(DracoCharacter, IsRefusedByABuildWithoutDraco) {
    TinyCharacter tiny;
    require(tiny, "KHR_draco_mesh_compression");
    tiny.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    expect_refused([&] { load(tiny); }, "this build has no Draco", VFIT_ERROR_UNSUPPORTED);
}

#endif

}  // namespace
}  // namespace vfit
