#include "cloth/garment/garment.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/json.h"
#include "math/finite.h"
#include "measure/measure_keys.h"

namespace vfit {

namespace {

const Json& field(const Json& object, const char* key) {
    const auto it = object.find(key);
    if (it == object.end()) fail(VFIT_ERROR_DATA, "garment: field \"", key, "\" is missing");
    return *it;
}

std::string text_field(const Json& object, const char* key) {
    const Json& value = field(object, key);
    if (!value.is_string() || value.get<std::string>().empty())
        fail(VFIT_ERROR_DATA, "garment: field \"", key, "\" is not a text");
    return value.get<std::string>();
}

/// Flat array of numbers, `width` to an item.
std::vector<float> numbers(const Json& root, const char* key, size_t width) {
    const Json& list = field(root, key);
    if (!list.is_array() || list.size() % width != 0)
        fail(VFIT_ERROR_DATA, "garment: \"", key, "\" is not a flat array of ", width, " numbers an item");
    std::vector<float> values;
    values.reserve(list.size());
    for (const Json& value : list) {
        if (!value.is_number()) fail(VFIT_ERROR_DATA, "garment: ", key, "[", values.size(), "] is not a number");
        values.push_back(value.get<float>());
    }
    return values;
}

std::vector<uint32_t> indices(const Json& root, const char* key) {
    const Json& list = field(root, key);
    if (!list.is_array()) fail(VFIT_ERROR_DATA, "garment: \"", key, "\" is not an array");
    std::vector<uint32_t> values;
    values.reserve(list.size());
    for (const Json& value : list) {
        if (!value.is_number_unsigned() || value.get<uint64_t>() > UINT32_MAX)
            fail(VFIT_ERROR_DATA, "garment: ", key, "[", values.size(), "] is not an index");
        values.push_back(value.get<uint32_t>());
    }
    return values;
}

std::vector<uint8_t> flags(const Json& root, const char* key) {
    const std::vector<uint32_t> values = indices(root, key);
    for (size_t i = 0; i < values.size(); ++i)
        if (values[i] > 1) fail(VFIT_ERROR_DATA, "garment: ", key, "[", i, "] is neither 0 nor 1");
    return {values.begin(), values.end()};
}

std::vector<GarmentSize> sizes(const Json& root) {
    const Json& list = field(root, "sizes");
    if (!list.is_array()) fail(VFIT_ERROR_DATA, "garment: \"sizes\" is not an array");
    std::vector<GarmentSize> out;
    for (const Json& entry : list) {
        if (!entry.is_object()) fail(VFIT_ERROR_DATA, "garment: sizes[", out.size(), "] is not an object");
        GarmentSize size;
        size.label = text_field(entry, "label");
        for (const auto& [key, value] : entry.items()) {
            if (key == "label") continue;
            if (!value.is_number())
                fail(VFIT_ERROR_DATA, "garment: ", key, " of size ", size.label, " is not a number");
            size.nominal.push_back({key, value.get<float>()});
        }
        out.push_back(std::move(size));
    }
    return out;
}

void validate_sizes(const Garment& g) {
    std::set<std::string> labels;
    for (const GarmentSize& size : g.sizes) {
        if (!labels.insert(size.label).second) fail(VFIT_ERROR_DATA, "garment: size ", size.label, " occurs twice");
        if (size.nominal.empty()) fail(VFIT_ERROR_DATA, "garment: size ", size.label, " names no girth");
        for (const Measurement& m : size.nominal) {
            if (measure_index(m.key) < 0)
                fail(VFIT_ERROR_DATA, "garment: size ", size.label, " names the unknown measure ", m.key);
            if (!finite(m.value) || m.value <= 0.0f)
                fail(VFIT_ERROR_DATA, "garment: ", m.key, " of size ", size.label, " is ", m.value, " m");
        }
    }
}

void validate_triangles(const Mesh& mesh) {
    // A sliver below this is as good as none: a garment's triangles are a centimetre or so a side.
    constexpr float kSmallestArea_m2 = 1e-9f;
    std::map<std::pair<uint32_t, uint32_t>, size_t> edges;  // directed edge -> its triangle
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const size_t triangle = i / 3;
        const uint32_t v[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        for (uint32_t index : v)
            if (index >= mesh.positions.size())
                fail(VFIT_ERROR_DATA, "garment: triangle ", triangle, " names vertex ", index, " of ",
                     mesh.positions.size());
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
            fail(VFIT_ERROR_DATA, "garment: triangle ", triangle, " names a vertex twice");
        const Vec3& a = mesh.positions[v[0]];
        const float area = 0.5f * glm::length(glm::cross(mesh.positions[v[1]] - a, mesh.positions[v[2]] - a));
        if (!(area >= kSmallestArea_m2)) fail(VFIT_ERROR_DATA, "garment: triangle ", triangle, " is degenerate");
        for (int k = 0; k < 3; ++k) {
            const auto [other, fresh] = edges.insert({{v[k], v[(k + 1) % 3]}, triangle});
            if (!fresh)
                fail(VFIT_ERROR_DATA, "garment: edge ", v[k], "-", v[(k + 1) % 3], " of triangle ", triangle,
                     " is not manifold: triangle ", other->second, " runs along it in the same direction");
        }
    }
}

constexpr float kFarthest_m = 10.0f;  // a garment in centimetres or millimetres is a mistake

}  // namespace

uint32_t Garment::simulated_count() const {
    return uint32_t(std::count(simulated.begin(), simulated.end(), uint8_t(1)));
}

void validate_garment(const Garment& g, const FabricLibrary& fabrics) {
    const size_t n = g.mesh.positions.size();
    if (n == 0) fail(VFIT_ERROR_DATA, "garment: there are no vertices");
    if (g.mesh.indices.empty() || g.mesh.indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "garment: ", g.mesh.indices.size(), " indices are no list of triangles");
    if (g.mesh.uvs.size() != n) fail(VFIT_ERROR_DATA, "garment: ", g.mesh.uvs.size(), " uvs for ", n, " vertices");
    if (g.simulated.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"simulated\" has ", g.simulated.size(), " flags for ", n, " vertices");
    if (g.backstop.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"backstop\" has ", g.backstop.size(), " flags for ", n, " vertices");
    if (!g.most_way.empty() && g.most_way.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"max_distance\" has ", g.most_way.size(), " numbers for ", n, " vertices");
    for (const float way : g.most_way)
        if (!finite(way) || way < 0.0f) fail(VFIT_ERROR_DATA, "garment: a \"max_distance\" is ", way, " m");
    for (size_t i = 0; i < n; ++i) {
        if (!finite(g.mesh.positions[i])) fail(VFIT_ERROR_DATA, "garment: position ", i, " is not finite");
        if (glm::length(g.mesh.positions[i]) > kFarthest_m)
            fail(VFIT_ERROR_DATA, "garment: position ", i, " is more than ", kFarthest_m, " m from the body: positions are metres");
        if (!finite(g.mesh.uvs[i].x) || !finite(g.mesh.uvs[i].y))
            fail(VFIT_ERROR_DATA, "garment: uv ", i, " is not finite");
    }
    fabrics.get(g.fabric);
    validate_triangles(g.mesh);
    validate_sizes(g);
}

Garment parse_garment(std::span<const std::byte> json, const FabricLibrary& fabrics) {
    const Json root = parse_json(json, "garment");
    if (!root.is_object()) fail(VFIT_ERROR_DATA, "garment: not a JSON object");
    if (text_field(root, "format") != "vfit-garment")
        fail(VFIT_ERROR_DATA, "garment: format is not \"vfit-garment\"");
    const Json& version = field(root, "version");
    if (!version.is_number_unsigned() || version.get<uint64_t>() == 0)
        fail(VFIT_ERROR_DATA, "garment: \"version\" is not a version number");
    if (version.get<uint64_t>() != 1)
        fail(VFIT_ERROR_VERSION, "garment: version ", version.get<uint64_t>(), " is not known, 1 is");

    Garment g;
    g.name = text_field(root, "name");
    g.kind = text_field(root, "kind");
    g.fabric = text_field(root, "fabric");
    const std::string sex = text_field(root, "body_sex");
    if (sex != "f" && sex != "m") fail(VFIT_ERROR_DATA, "garment: body_sex is neither \"f\" nor \"m\"");
    g.body_sex = sex == "f" ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    const std::vector<float> positions = numbers(root, "positions", 3);
    for (size_t i = 0; i < positions.size(); i += 3)
        g.mesh.positions.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
    const std::vector<float> uvs = numbers(root, "uvs", 2);
    for (size_t i = 0; i < uvs.size(); i += 2) g.mesh.uvs.emplace_back(uvs[i], uvs[i + 1]);
    g.mesh.indices = indices(root, "indices");
    g.simulated = flags(root, "simulated");
    g.backstop = flags(root, "backstop");
    if (root.contains("max_distance")) g.most_way = numbers(root, "max_distance", 1);
    g.sizes = sizes(root);
    validate_garment(g, fabrics);
    compute_normals(g.mesh.positions, g.mesh.indices, g.mesh.normals);
    return g;
}

float size_ratio(const Garment& garment, const std::string& label, const std::vector<Measurement>& body) {
    std::string labels;
    for (const GarmentSize& size : garment.sizes) {
        labels += (labels.empty() ? "" : ", ") + size.label;
        if (size.label != label) continue;
        float sum = 0.0f;
        int count = 0;
        for (const Measurement& nominal : size.nominal)
            if (const Measurement* own = find(body, nominal.key); own && own->value > 0.0f) {
                sum += nominal.value / own->value;
                ++count;
            }
        if (count == 0) fail(VFIT_ERROR_DATA, "size ", label, ": none of its girths is known of the body");
        return sum / float(count);
    }
    fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, " has no size \"", label, "\"; there are: ", labels);
}

}  // namespace vfit
