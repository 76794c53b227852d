#include "cook/garment_writer.h"

#include <charconv>
#include <utility>

#include "core/json.h"

namespace vfit {

namespace {

void add(std::string& out, float value) {
    // Not printf, whose decimal point may be a comma.
    char buffer[48];
    const auto written = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 5);
    out.append(buffer, written.ptr);
}
void add(std::string& out, uint32_t value) { out += std::to_string(value); }
void add(std::string& out, uint8_t value) { out += char('0' + value); }
void add(std::string& out, const Vec2& v) {
    add(out, v.x);
    out += ',';
    add(out, v.y);
}
void add(std::string& out, const Vec3& v) {
    add(out, Vec2(v));
    out += ',';
    add(out, v.z);
}

template <typename T>
void add_array(std::string& out, const char* key, const std::vector<T>& values) {
    out += std::string(" \"") + key + "\": [";
    for (size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out += ',';
        add(out, values[i]);
    }
    out += "]";
}

}  // namespace

std::string write_garment(const Garment& garment) {
    // Names come from files of others and file systems: JSON is UTF-8, whatever they are.
    const auto quoted = [](const std::string& s) {
        return Json(s).dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    std::string out = std::string("{\n \"format\": \"vfit-garment\", \"version\": ") +
                      (!garment.drawn.empty()        ? "4"
                       : !garment.body_shape.empty() ? "3"
                       : garment.has_own_lengths()   ? "2"
                                                     : "1") +
                      ",\n";
    out += " \"name\": " + quoted(garment.name) + ", \"kind\": " + quoted(garment.kind);
    if (!garment.size_chart.empty()) out += ", \"size_chart\": " + quoted(garment.size_chart);
    out += ", \"fabric\": " + quoted(garment.fabric);
    out += std::string(", \"body_sex\": \"") + (garment.body_sex == VFIT_SEX_MALE ? "m" : "f") + "\"";
    if (!garment.body_shape.empty()) {
        out += ", \"body_shape\": {";
        for (size_t i = 0; i < garment.body_shape.size(); ++i) {
            out += (i > 0 ? ", " : "") + quoted(garment.body_shape[i].key) + ": ";
            add(out, garment.body_shape[i].value);
        }
        out += "}";
    }
    out += ",\n";
    out += " \"sizes\": [";
    for (size_t i = 0; i < garment.sizes.size(); ++i) {
        out += (i > 0 ? ", " : "") + std::string("{\"label\": ") + quoted(garment.sizes[i].label);
        for (const Measurement& m : garment.sizes[i].nominal) {
            out += ", " + quoted(m.key) + ": ";
            add(out, m.value);
        }
        if (!garment.sizes[i].flat.empty()) {
            out += ",\n ";
            add_array(out, "flat", garment.sizes[i].flat);
        }
        out += "}";
    }
    out += "],\n";
    add_array(out, "positions", garment.mesh.positions);
    out += ",\n";
    add_array(out, "uvs", garment.mesh.uvs);
    out += ",\n";
    add_array(out, "indices", garment.mesh.indices);
    out += ",\n";
    add_array(out, "simulated", garment.simulated);
    out += ",\n";
    add_array(out, "backstop", garment.backstop);
    if (garment.has_own_lengths()) {
        for (const auto& [key, values] :
             {std::pair("copies", &garment.copies), std::pair("corners", &garment.corners)}) {
            out += ",\n";
            add_array(out, key, *values);
        }
        out += ",\n";
        if (garment.cut_shape.empty())
            add_array(out, "flat", garment.flat);
        else
            add_array(out, "shape", garment.cut_shape);
        out += ",\n";
        add_array(out, "on_arm", garment.on_arm);
        out += ",\n \"parts\": [";
        for (size_t i = 0; i < garment.parts.size(); ++i) {
            const GarmentPart& part = garment.parts[i];
            out += (i > 0 ? ", " : "") + std::string("{\"material\": ") + quoted(part.material) +
                   ", \"texture\": " + quoted(part.texture) + ", \"color\": [";
            add(out, part.color);
            out += "], \"triangles\": [" + std::to_string(part.first_triangle) + "," +
                   std::to_string(part.triangle_count) + "]}";
        }
        out += "]";
    }
    if (const DrawnMesh& drawn = garment.drawn; !drawn.empty()) {
        out += ",\n \"drawn\": {\n ";
        add_array(out, "triangles", drawn.triangles);
        out += ",\n ";
        add_array(out, "weights", drawn.weights);
        for (const auto& [key, values] :
             {std::pair("offsets", &drawn.offsets), std::pair("normals", &drawn.normals)}) {
            out += ",\n ";
            add_array(out, key, *values);
        }
        out += ",\n ";
        add_array(out, "uvs", drawn.uvs);
        out += ",\n ";
        add_array(out, "indices", drawn.indices);
        out += "}";
    }
    out += "\n}\n";
    return out;
}

}  // namespace vfit
