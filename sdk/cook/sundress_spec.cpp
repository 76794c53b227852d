// Reads the design parameters of a sundress.
#include <cmath>

#include "anthropometry/measure_keys.h"
#include "cook/sundress.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

float number(const Json& root, const char* key, float low, float high) {
    const auto it = root.find(key);
    if (it == root.end() || !it->is_number())
        fail(VFIT_ERROR_DATA, "sundress: \"", key, "\" is not a number");
    const float value = it->get<float>();
    if (!(value >= low && value <= high))
        fail(VFIT_ERROR_DATA, "sundress: \"", key, "\" must be ", low, " to ", high, ", is ", value);
    return value;
}

uint32_t count(const Json& root, const char* key, uint32_t low, uint32_t high) {
    const float value = number(root, key, float(low), float(high));
    if (value != std::floor(value)) fail(VFIT_ERROR_DATA, "sundress: \"", key, "\" is not a whole number");
    return uint32_t(value);
}

std::string text_of(const Json& root, const char* key) {
    const auto it = root.find(key);
    if (it == root.end() || !it->is_string() || it->get_ref<const std::string&>().empty())
        fail(VFIT_ERROR_DATA, "sundress: \"", key, "\" is not a text");
    return it->get<std::string>();
}

}  // namespace

SundressSpec parse_sundress(std::span<const std::byte> json) {
    const Json root = parse_json(json, "sundress");
    if (!root.is_object()) fail(VFIT_ERROR_DATA, "sundress: not a JSON object");
    if (text_of(root, "format") != "vfit-sundress")
        fail(VFIT_ERROR_DATA, "sundress: format is not \"vfit-sundress\"");
    if (count(root, "version", 1, 1u << 20) != 1) fail(VFIT_ERROR_VERSION, "sundress: version is not 1");

    SundressSpec spec;
    spec.name = text_of(root, "name");
    spec.kind = text_of(root, "kind");
    if (root.contains("size_chart")) spec.size_chart = text_of(root, "size_chart");
    spec.fabric = text_of(root, "fabric");
    spec.columns = count(root, "columns", 24, 400);
    if (spec.columns % 2 != 0) fail(VFIT_ERROR_DATA, "sundress: \"columns\" must be even, is ", spec.columns);
    spec.bodice_rows = count(root, "bodice_rows", 2, 200);
    spec.skirt_rows = count(root, "skirt_rows", 2, 400);
    spec.strap_columns = count(root, "strap_columns", 2, 20);
    spec.strap_rows = count(root, "strap_rows", 2, 200);
    spec.top_center = number(root, "top_center", -0.5f, 1.0f);
    spec.top_strap = number(root, "top_strap", -0.5f, 1.0f);
    spec.top_side = number(root, "top_side", -0.5f, 1.0f);
    spec.top_back = number(root, "top_back", -0.5f, 1.0f);
    spec.strap_place = number(root, "strap_place", 0.2f, 0.9f);
    spec.hem = number(root, "hem", -1.0f, 1.0f);
    spec.bodice_ease_m = number(root, "bodice_ease_m", 0.0f, 0.1f);
    spec.skirt_ease_m = number(root, "skirt_ease_m", 0.0f, 0.3f);
    spec.flare = number(root, "flare", 0.0f, 2.0f);
    const auto sizes = root.find("sizes");
    if (sizes == root.end() || !sizes->is_array())
        fail(VFIT_ERROR_DATA, "sundress: \"sizes\" is not an array");
    for (const Json& entry : *sizes) {
        GarmentSize size;
        size.label = text_of(entry, "label");
        for (const auto& [key, value] : entry.items()) {
            if (key == "label") continue;
            if (measure_index(key) < 0)
                fail(VFIT_ERROR_DATA, "sundress: size ", size.label, " names the unknown measure ", key);
            size.nominal.push_back({key, number(entry, key.c_str(), 0.1f, 5.0f)});
        }
        spec.sizes.push_back(std::move(size));
    }
    return spec;
}

}  // namespace vfit
