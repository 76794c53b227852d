#include "cloth/fabric/fabric_library.h"

#include <cmath>

#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

float positive_number(const Json& preset, const std::string& name, const char* key) {
    const auto it = preset.find(key);
    if (it == preset.end() || !it->is_number())
        fail(VFIT_ERROR_DATA, "fabric ", name, ": ", key, " is not a number");
    const float value = it->get<float>();
    if (!std::isfinite(value) || value <= 0.0f)
        fail(VFIT_ERROR_DATA, "fabric ", name, ": ", key, " must be above zero, is ", value);
    return value;
}

}  // namespace

FabricLibrary FabricLibrary::parse(std::span<const std::byte> json) {
    const Json root = parse_json(json, "fabrics");
    if (!root.is_object()) fail(VFIT_ERROR_DATA, "fabrics: not a JSON object");
    if (root.value("format", Json()) != "vfit-fabrics")
        fail(VFIT_ERROR_DATA, "fabrics: format is not \"vfit-fabrics\"");
    if (root.value("version", Json()) != 1) fail(VFIT_ERROR_VERSION, "fabrics: version is not 1");
    const auto presets = root.find("fabrics");
    if (presets == root.end() || !presets->is_object() || presets->empty())
        fail(VFIT_ERROR_DATA, "fabrics: \"fabrics\" is missing or empty");

    FabricLibrary library;
    for (const auto& [name, preset] : presets->items()) {
        if (!preset.is_object()) fail(VFIT_ERROR_DATA, "fabric ", name, " is not an object");
        FabricMaterial material{positive_number(preset, name, "density_kg_m2"),
                                positive_number(preset, name, "stretch_warp_n_m"),
                                positive_number(preset, name, "stretch_weft_n_m"),
                                positive_number(preset, name, "shear_n_m"),
                                positive_number(preset, name, "bend_n_m"),
                                positive_number(preset, name, "friction")};
        if (preset.contains("most_strain"))
            material.most_strain = positive_number(preset, name, "most_strain");
        library.add(name, material);
    }
    return library;
}

std::vector<std::string> FabricLibrary::names() const {
    std::vector<std::string> out;
    for (const auto& entry : materials_) out.push_back(entry.first);
    return out;
}

const FabricMaterial& FabricLibrary::get(const std::string& name) const {
    const auto it = materials_.find(name);
    if (it != materials_.end()) return it->second;
    std::string known;
    for (const auto& [key, value] : materials_) known += (known.empty() ? "" : ", ") + key;
    fail(VFIT_ERROR_DATA, "unknown fabric \"", name, "\"; there are: ", known);
}

}  // namespace vfit
