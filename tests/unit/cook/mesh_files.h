// Garments as mesh files, made of few numbers, for the tests of the cook.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cloth/garment/garment.h"

namespace vfit {

/// Squares around a body, open above and below: the first column is there twice, with the uvs of both ends of
/// the picture.
struct TubeMesh {
    int columns = 36, rows = 20;
    float top_m = 1.05f, bottom_m = 0.6f, radius_m = 0.125f, flare = 0.3f;
    float unit = 1.0f;

    std::vector<Vec3> positions() const {
        std::vector<Vec3> out;
        for (int r = 0; r <= rows; ++r)
            for (int c = 0; c <= columns; ++c) {
                const float y = top_m - (top_m - bottom_m) * float(r) / float(rows),
                            radius = radius_m + flare * (top_m - y),
                            angle = 2.0f * kPi * float(c % columns) / float(columns);
                out.push_back(Vec3(radius * std::sin(angle), y, radius * std::cos(angle)) * unit);
            }
        return out;
    }
    std::vector<Vec2> uvs() const {
        std::vector<Vec2> out;
        for (int r = 0; r <= rows; ++r)
            for (int c = 0; c <= columns; ++c)
                out.emplace_back(float(c) / float(columns), float(r) / float(rows));
        return out;
    }
    /// Corners of the squares, four each, counter-clockwise from outside.
    std::vector<uint32_t> squares() const {
        std::vector<uint32_t> out;
        const auto at = [&](int r, int c) { return uint32_t(r * (columns + 1) + c); };
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c)
                for (const uint32_t v : {at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)})
                    out.push_back(v);
        return out;
    }
    std::vector<uint32_t> triangles() const {
        const std::vector<uint32_t> q = squares();
        std::vector<uint32_t> out;
        for (size_t i = 0; i < q.size(); i += 4)
            for (const size_t k : {0, 1, 2, 0, 2, 3}) out.push_back(q[i + k]);
        return out;
    }
};

inline std::string obj_vertices(const std::vector<Vec3>& positions, const std::vector<Vec2>& uvs) {
    std::ostringstream out;
    out.precision(8);
    for (const Vec3& p : positions) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (const Vec2& uv : uvs) out << "vt " << uv.x << ' ' << 1.0f - uv.y << '\n';
    return out.str();
}
inline std::string obj_faces(const std::vector<uint32_t>& corners, size_t count) {
    std::ostringstream out;
    for (size_t i = 0; i < corners.size(); ++i)
        out << (i % count == 0 ? "f" : "") << ' ' << corners[i] + 1 << '/' << corners[i] + 1
            << (i % count == count - 1 ? "\n" : "");
    return out.str();
}
inline std::string obj_of(const TubeMesh& tube) {
    return obj_vertices(tube.positions(), tube.uvs()) + obj_faces(tube.squares(), 4);
}

/// A GLB file, to be changed and damaged.
struct TinyGlb {
    nlohmann::json json;
    std::string binary;

    TinyGlb(const std::vector<Vec3>& positions, const std::vector<Vec2>& uvs,
            const std::vector<uint32_t>& indices) {
        json["asset"]["version"] = "2.0";
        Vec3 low(1e9f), high(-1e9f);
        for (const Vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
        auto& primitive = json["meshes"][0]["primitives"][0];
        json["meshes"][0]["name"] = "shirt";
        primitive["attributes"]["POSITION"] =
            add(positions.data(), positions.size() * sizeof(Vec3), "VEC3", 5126, positions.size());
        json["accessors"][0]["min"] = {low.x, low.y, low.z};
        json["accessors"][0]["max"] = {high.x, high.y, high.z};
        if (!uvs.empty())
            primitive["attributes"]["TEXCOORD_0"] =
                add(uvs.data(), uvs.size() * sizeof(Vec2), "VEC2", 5126, uvs.size());
        primitive["indices"] = add(indices.data(), indices.size() * 4, "SCALAR", 5125, indices.size());
        primitive["material"] = 0;
        json["materials"][0] = {{"name", "linen"},
                                {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 1.0}}}}};
        json["nodes"] = {{{"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }

    int add(const void* data, size_t size, const char* type, int component, size_t count) {
        const int view = json.contains("bufferViews") ? int(json["bufferViews"].size()) : 0;
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}});
        binary.append(static_cast<const char*>(data), size);
        json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return int(json["accessors"].size()) - 1;
    }
    std::string bytes() const {
        nlohmann::json whole = json;
        whole["buffers"] = {{{"byteLength", binary.size()}}};
        std::string text = whole.dump(), out = "glTF";
        while (text.size() % 4) text += ' ';
        const auto number = [&](size_t n) {
            for (int i = 0; i < 4; ++i) out += char(uint8_t(n >> (8 * i)));
        };
        number(2);
        number(12 + 8 + text.size() + 8 + binary.size());
        number(text.size());
        out += "JSON" + text;
        number(binary.size());
        return out + std::string("BIN\0", 4) + binary;
    }
};

}  // namespace vfit
