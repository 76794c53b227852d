#include "cloth/garment/garment.h"

#include <algorithm>
#include <map>
#include <set>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "core/json.h"
#include "math/finite.h"

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
        if (!value.is_number())
            fail(VFIT_ERROR_DATA, "garment: ", key, "[", values.size(), "] is not a number");
        values.push_back(value.get<float>());
    }
    return values;
}

std::vector<Vec2> pairs(const Json& root, const char* key) {
    const std::vector<float> values = numbers(root, key, 2);
    std::vector<Vec2> out;
    for (size_t i = 0; i < values.size(); i += 2) out.emplace_back(values[i], values[i + 1]);
    return out;
}

std::vector<Vec3> places(const Json& root, const char* key) {
    const std::vector<float> values = numbers(root, key, 3);
    std::vector<Vec3> out;
    for (size_t i = 0; i < values.size(); i += 3) out.emplace_back(values[i], values[i + 1], values[i + 2]);
    return out;
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
            if (key == "flat") {
                size.flat = pairs(entry, "flat");
                continue;
            }
            if (!value.is_number())
                fail(VFIT_ERROR_DATA, "garment: ", key, " of size ", size.label, " is not a number");
            size.nominal.push_back({key, value.get<float>()});
        }
        out.push_back(std::move(size));
    }
    return out;
}

std::vector<ShapeSetting> shape_settings(const Json& object) {
    if (!object.is_object()) fail(VFIT_ERROR_DATA, "garment: \"body_shape\" is not an object");
    std::vector<ShapeSetting> out;
    for (const auto& [key, value] : object.items()) {
        if (!value.is_number()) fail(VFIT_ERROR_DATA, "garment: \"body_shape\": ", key, " is not a number");
        out.push_back({key, value.get<float>()});
    }
    return out;
}

std::vector<GarmentPart> parts(const Json& root) {
    const Json& list = field(root, "parts");
    if (!list.is_array()) fail(VFIT_ERROR_DATA, "garment: \"parts\" is not an array");
    std::vector<GarmentPart> out;
    for (const Json& entry : list) {
        const std::string what = "garment: parts[" + std::to_string(out.size()) + "]";
        if (!entry.is_object()) fail(VFIT_ERROR_DATA, what, " is not an object");
        GarmentPart part;
        part.material = text_field(entry, "material");
        if (const auto texture = entry.find("texture"); texture != entry.end()) {
            if (!texture->is_string()) fail(VFIT_ERROR_DATA, what, ": \"texture\" is not a text");
            part.texture = texture->get<std::string>();
        }
        const std::vector<float> color = numbers(entry, "color", 1);
        if (color.size() != 3) fail(VFIT_ERROR_DATA, what, ": \"color\" is not three numbers");
        part.color = {color[0], color[1], color[2]};
        const std::vector<uint32_t> range = indices(entry, "triangles");
        if (range.size() != 2)
            fail(VFIT_ERROR_DATA, what, ": \"triangles\" is not the first one and their number");
        part.first_triangle = range[0], part.triangle_count = range[1];
        out.push_back(std::move(part));
    }
    return out;
}

DrawnMesh drawn(const Json& object) {
    if (!object.is_object()) fail(VFIT_ERROR_DATA, "garment: \"drawn\" is not an object");
    DrawnMesh out;
    out.triangles = indices(object, "triangles");
    out.weights = pairs(object, "weights");
    out.offsets = places(object, "offsets");
    out.normals = places(object, "normals");
    out.uvs = pairs(object, "uvs");
    out.indices = indices(object, "indices");
    return out;
}

void validate_sizes(const Garment& g) {
    std::set<std::string> labels;
    for (const GarmentSize& size : g.sizes) {
        if (!labels.insert(size.label).second)
            fail(VFIT_ERROR_DATA, "garment: size ", size.label, " occurs twice");
        if (size.nominal.empty() && g.cut_shape.empty())
            fail(VFIT_ERROR_DATA, "garment: size ", size.label, " names no girth");
        for (const Measurement& m : size.nominal) {
            if (measure_index(m.key) < 0)
                fail(VFIT_ERROR_DATA, "garment: size ", size.label, " names the unknown measure ", m.key);
            if (!finite(m.value) || m.value <= 0.0f)
                fail(VFIT_ERROR_DATA, "garment: ", m.key, " of size ", size.label, " is ", m.value, " m");
        }
    }
}

constexpr float kFarthest_m = 10.0f;  // a garment in centimetres or millimetres is a mistake
// A sliver below this is as good as none: a garment's triangles are a centimetre or so a side.
constexpr float kSmallestArea_m2 = 1e-9f;

float area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5f * glm::length(glm::cross(b - a, c - a));
}

void validate_triangles(const Mesh& mesh) {
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
        if (!(area(mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]) >= kSmallestArea_m2))
            fail(VFIT_ERROR_DATA, "garment: triangle ", triangle, " is degenerate");
        for (int k = 0; k < 3; ++k) {
            const auto [other, fresh] = edges.insert({{v[k], v[(k + 1) % 3]}, triangle});
            if (!fresh)
                fail(VFIT_ERROR_DATA, "garment: edge ", v[k], "-", v[(k + 1) % 3], " of triangle ", triangle,
                     " is not manifold: triangle ", other->second, " runs along it in the same direction");
        }
    }
}

/// Triangles as they are cut, of the garment or one of its sizes.
void validate_flat(const Garment& g, std::span<const Vec2> flat, const std::string& whose) {
    if (flat.size() != g.uv_count())
        fail(VFIT_ERROR_DATA, "garment: ", whose, " has ", flat.size(), " flat places for ", g.uv_count(),
             " vertices and copies");
    for (size_t i = 0; i < flat.size(); ++i)
        if (!finite(flat[i].x) || !finite(flat[i].y) || glm::length(flat[i]) > kFarthest_m)
            fail(VFIT_ERROR_DATA, "garment: ", whose, ": flat place ", i, " is not finite or further than ",
                 kFarthest_m, " m away");
    for (size_t i = 0; i + 2 < g.uv_indices().size(); i += 3) {
        const uint32_t* v = &g.uv_indices()[i];
        const Vec2 a = flat[v[1]] - flat[v[0]], b = flat[v[2]] - flat[v[0]];
        if (!(0.5f * std::abs(a.x * b.y - a.y * b.x) >= kSmallestArea_m2))
            fail(VFIT_ERROR_DATA, "garment: ", whose, ": triangle ", i / 3, " is cut without an area");
    }
}

/// The triangles' own lengths in space.
void validate_cut_shape(const Garment& g) {
    if (!g.flat.empty())
        fail(VFIT_ERROR_DATA,
             "garment: there are both \"flat\" and \"shape\": its lengths are the one or the other");
    if (g.cut_shape.size() != g.vertex_count())
        fail(VFIT_ERROR_DATA, "garment: \"shape\" has ", g.cut_shape.size(), " places for ", g.vertex_count(),
             " vertices");
    for (size_t i = 0; i < g.cut_shape.size(); ++i)
        if (!finite(g.cut_shape[i]) || glm::length(g.cut_shape[i]) > kFarthest_m)
            fail(VFIT_ERROR_DATA, "garment: place ", i, " of \"shape\" is not finite or further than ",
                 kFarthest_m, " m away");
    for (size_t i = 0; i < g.mesh.indices.size(); i += 3) {
        const uint32_t* v = &g.mesh.indices[i];
        if (!(area(g.cut_shape[v[0]], g.cut_shape[v[1]], g.cut_shape[v[2]]) >= kSmallestArea_m2))
            fail(VFIT_ERROR_DATA, "garment: triangle ", i / 3, " has no area in \"shape\"");
    }
}

void validate_drawn(const Garment& g) {
    const DrawnMesh& d = g.drawn;
    const size_t n = d.triangles.size();
    if (d.weights.size() != n || d.offsets.size() != n || d.normals.size() != n || d.uvs.size() != n)
        fail(VFIT_ERROR_DATA, "garment: the lists of \"drawn\" are not of equal length: ", n, " triangles, ",
             d.weights.size(), " weights, ", d.offsets.size(), " offsets, ", d.normals.size(), " normals, ",
             d.uvs.size(), " uvs");
    if (n == 0) {
        if (!d.indices.empty()) fail(VFIT_ERROR_DATA, "garment: \"drawn\" has indices, but no vertices");
        return;
    }
    for (size_t i = 0; i < n; ++i) {
        if (d.triangles[i] >= g.mesh.indices.size() / 3)
            fail(VFIT_ERROR_DATA, "garment: vertex ", i, " of \"drawn\" names triangle ", d.triangles[i],
                 " of ", g.mesh.indices.size() / 3);
        const Vec2& w = d.weights[i];
        if (!(w.x >= 0.0f && w.y >= 0.0f && w.x + w.y <= 1.001f))
            fail(VFIT_ERROR_DATA, "garment: the weights of vertex ", i,
                 " of \"drawn\" are not in its triangle");
        const float normal = finite(d.normals[i]) ? glm::length(d.normals[i]) : 0.0f;
        if (!(normal > 0.5f && normal < 2.0f))
            fail(VFIT_ERROR_DATA, "garment: the normal of vertex ", i, " of \"drawn\" is not of unit length");
        if (!finite(d.offsets[i]) || glm::length(d.offsets[i]) > kFarthest_m || !finite(d.uvs[i].x) ||
            !finite(d.uvs[i].y))
            fail(VFIT_ERROR_DATA, "garment: vertex ", i,
                 " of \"drawn\" has numbers that are not finite, or an "
                 "offset of more than ",
                 kFarthest_m, " m");
    }
    if (d.indices.empty() || d.indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "garment: ", d.indices.size(),
             " indices of \"drawn\" are no list of triangles");
    for (size_t i = 0; i < d.indices.size(); ++i)
        if (d.indices[i] >= n)
            fail(VFIT_ERROR_DATA, "garment: index ", i, " of \"drawn\" names vertex ", d.indices[i], " of ",
                 n);
}

void validate_cut(const Garment& g) {
    const uint32_t n = g.vertex_count();
    for (size_t i = 0; i < g.copies.size(); ++i)
        if (g.copies[i] >= n)
            fail(VFIT_ERROR_DATA, "garment: copies[", i, "] names vertex ", g.copies[i], " of ", n);
    if (!g.copies.empty() && g.corners.empty())
        fail(VFIT_ERROR_DATA, "garment: there are copies of vertices, but no \"corners\"");
    if (!g.corners.empty() && g.corners.size() != g.mesh.indices.size())
        fail(VFIT_ERROR_DATA, "garment: ", g.corners.size(), " corners for ", g.mesh.indices.size(),
             " indices");
    for (size_t i = 0; i < g.corners.size(); ++i) {
        const uint32_t v = g.corners[i];
        if (v >= g.uv_count() || (v < n ? v : g.copies[v - n]) != g.mesh.indices[i])
            fail(VFIT_ERROR_DATA, "garment: corners[", i, "] is ", v, ", no copy of vertex ",
                 g.mesh.indices[i]);
    }
    if (!g.flat.empty()) validate_flat(g, g.flat, "the garment");
    if (!g.cut_shape.empty()) validate_cut_shape(g);
    for (const GarmentSize& size : g.sizes) {
        if (size.flat.empty() != g.flat.empty())
            fail(VFIT_ERROR_DATA, "garment: size ", size.label,
                 " and the garment: one of the two has no \"flat\"");
        if (!size.flat.empty()) validate_flat(g, size.flat, "size " + size.label);
    }
    if (!g.on_arm.empty() && g.on_arm.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"on_arm\" has ", g.on_arm.size(), " flags for ", n, " vertices");
    uint32_t next = 0;
    for (const GarmentPart& part : g.parts) {
        if (part.first_triangle != next || part.triangle_count == 0 ||
            part.triangle_count > g.drawn_indices().size() / 3 - next)
            fail(VFIT_ERROR_DATA, "garment: the triangles of part ", part.material,
                 " do not follow on those of the one before, or are more than there are");
        next += part.triangle_count;
        if (!finite(part.color))
            fail(VFIT_ERROR_DATA, "garment: the colour of part ", part.material, " is not finite");
    }
    if (!g.parts.empty() && next != g.drawn_indices().size() / 3)
        fail(VFIT_ERROR_DATA, "garment: ", g.drawn_indices().size() / 3 - next, " triangles are in no part");
}

}  // namespace

const GarmentSize& Garment::size(const std::string& label) const {
    std::string labels;
    for (const GarmentSize& s : sizes) {
        if (s.label == label) return s;
        labels += (labels.empty() ? "" : ", ") + s.label;
    }
    fail(VFIT_ERROR_ARGUMENT, "garment ", name, " has no size \"", label, "\"; there are: ", labels);
}

uint32_t Garment::simulated_count() const {
    return uint32_t(std::count(simulated.begin(), simulated.end(), uint8_t(1)));
}

void validate_garment(const Garment& g, const FabricLibrary& fabrics) {
    const size_t n = g.mesh.positions.size();
    if (n == 0) fail(VFIT_ERROR_DATA, "garment: there are no vertices");
    if (g.mesh.indices.empty() || g.mesh.indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "garment: ", g.mesh.indices.size(), " indices are no list of triangles");
    if (g.mesh.uvs.size() != g.uv_count())
        fail(VFIT_ERROR_DATA, "garment: ", g.mesh.uvs.size(), " uvs for ", g.uv_count(),
             " vertices and copies");
    if (g.simulated.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"simulated\" has ", g.simulated.size(), " flags for ", n,
             " vertices");
    if (g.backstop.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"backstop\" has ", g.backstop.size(), " flags for ", n, " vertices");
    if (!g.most_way.empty() && g.most_way.size() != n)
        fail(VFIT_ERROR_DATA, "garment: \"max_distance\" has ", g.most_way.size(), " numbers for ", n,
             " vertices");
    for (const float way : g.most_way)
        if (!finite(way) || way < 0.0f) fail(VFIT_ERROR_DATA, "garment: a \"max_distance\" is ", way, " m");
    for (size_t i = 0; i < n; ++i) {
        if (!finite(g.mesh.positions[i])) fail(VFIT_ERROR_DATA, "garment: position ", i, " is not finite");
        if (glm::length(g.mesh.positions[i]) > kFarthest_m)
            fail(VFIT_ERROR_DATA, "garment: position ", i, " is more than ", kFarthest_m,
                 " m from the body: positions are metres");
    }
    for (size_t i = 0; i < g.mesh.uvs.size(); ++i)
        if (!finite(g.mesh.uvs[i].x) || !finite(g.mesh.uvs[i].y))
            fail(VFIT_ERROR_DATA, "garment: uv ", i, " is not finite");
    fabrics.get(g.fabric);
    validate_triangles(g.mesh);
    validate_drawn(g);
    validate_cut(g);
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
    if (version.get<uint64_t>() > 4)
        fail(VFIT_ERROR_VERSION, "garment: version ", version.get<uint64_t>(), " is not known, 1 to 4 are");

    Garment g;
    g.name = text_field(root, "name");
    g.kind = text_field(root, "kind");
    if (root.contains("size_chart")) g.size_chart = text_field(root, "size_chart");
    g.fabric = text_field(root, "fabric");
    const std::string sex = text_field(root, "body_sex");
    if (sex != "f" && sex != "m") fail(VFIT_ERROR_DATA, "garment: body_sex is neither \"f\" nor \"m\"");
    g.body_sex = sex == "f" ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    if (root.contains("body_shape")) g.body_shape = shape_settings(root["body_shape"]);
    g.mesh.positions = places(root, "positions");
    g.mesh.uvs = pairs(root, "uvs");
    g.mesh.indices = indices(root, "indices");
    g.simulated = flags(root, "simulated");
    g.backstop = flags(root, "backstop");
    if (root.contains("max_distance")) g.most_way = numbers(root, "max_distance", 1);
    g.sizes = sizes(root);
    if (root.contains("copies")) g.copies = indices(root, "copies");
    if (root.contains("corners")) g.corners = indices(root, "corners");
    if (root.contains("flat")) g.flat = pairs(root, "flat");
    if (root.contains("shape")) g.cut_shape = places(root, "shape");
    if (root.contains("on_arm")) g.on_arm = flags(root, "on_arm");
    if (root.contains("parts")) g.parts = parts(root);
    if (root.contains("drawn")) g.drawn = drawn(field(root, "drawn"));
    validate_garment(g, fabrics);
    compute_normals(g.mesh.positions, g.mesh.indices, g.mesh.normals);
    return g;
}

float size_ratio(const Garment& garment, const std::string& label, const std::vector<Measurement>& body) {
    float sum = 0.0f;
    int count = 0;
    for (const Measurement& nominal : garment.size(label).nominal)
        if (const Measurement* own = find(body, nominal.key); own && own->value > 0.0f) {
            sum += nominal.value / own->value;
            ++count;
        }
    if (count == 0) fail(VFIT_ERROR_DATA, "size ", label, ": none of its girths is known of the body");
    return sum / float(count);
}

}  // namespace vfit
