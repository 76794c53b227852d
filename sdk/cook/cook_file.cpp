#include "cook/cook_file.h"

#include <filesystem>

#include "cook/draft/draft.h"
#include "cook/pattern/garmentcode.h"
#include "cook/sundress.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

namespace vfit {

namespace {

/// "sundress_f" of ".../sundress_f_specification.json".
std::string name_of(const std::string& path) {
    std::string name = std::filesystem::path(path).stem().string();
    const std::string tail = "_specification";
    if (name.size() > tail.size() && name.compare(name.size() - tail.size(), tail.size(), tail) == 0) name.resize(name.size() - tail.size());
    return name;
}

CookedGarment cook_specification(const BodyModel& model, const FabricLibrary& fabrics, const CookRequest& request, std::span<const std::byte> text, Jobs& jobs) {
    CookOptions options;
    if (!request.kind.empty()) options.kind = request.kind;
    if (!request.fabric.empty()) options.fabric = request.fabric;
    if (request.sex != VFIT_SEX_UNKNOWN) options.sex = request.sex;
    options.triangle_m = request.triangle_m;
    options.drape = request.drape;
    const Pattern pattern = parse_garmentcode(text, request.name.empty() ? name_of(request.path) : request.name);
    return cook_pattern(model, {{"", {}, pattern}}, 0, fabrics, options, jobs);
}

CookedGarment cook_design(const BodyModel& model, const FabricLibrary& fabrics, const CookRequest& request, std::span<const std::byte> text, Jobs& jobs) {
    const GarmentDesign design = parse_design(text);
    const DraftedGarment drafted = draft(model, design);
    std::vector<PatternSize> sizes;
    for (const DraftedSize& size : drafted.sizes) sizes.push_back({size.label, size.nominal, size.pattern});
    CookOptions options;
    options.kind = request.kind.empty() ? design.kind : request.kind;
    options.fabric = request.fabric.empty() ? design.fabric : request.fabric;
    options.sex = design.sex;
    options.triangle_m = request.triangle_m;
    options.drape = request.drape;
    CookedGarment cooked = cook_pattern(model, sizes, drafted.base, fabrics, options, jobs);
    cooked.garment.name = design.name;
    return cooked;
}

}  // namespace

CookedGarment cook_file(const BodyModel& model, const FabricLibrary& fabrics, const CookRequest& request, Jobs& jobs) {
    const std::vector<std::byte> text = read_file(request.path);
    if (is_garmentcode(text)) return cook_specification(model, fabrics, request, text, jobs);
    const Json root = parse_json(text, "garment design");
    const std::string format = root.is_object() && root.contains("format") && root["format"].is_string() ? root["format"].get<std::string>() : "";
    if (format == "vfit-sundress") return {cook_sundress(model, parse_sundress(text)), {}};
    if (format == "vfit-design") return cook_design(model, fabrics, request, text, jobs);
    fail(VFIT_ERROR_UNSUPPORTED, request.path, " is no garment that can be cooked: neither a GarmentCode specification (\"pattern\" with \"panels\") nor a design of vfit's (\"format\": \"vfit-design\" or \"vfit-sundress\")");
}

}  // namespace vfit
