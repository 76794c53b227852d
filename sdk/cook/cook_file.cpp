#include "cook/cook_file.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>

#include "avatar/gltf_document.h"
#include "cook/body/drawn_for.h"
#include "cook/draft/draft.h"
#include "cook/model/gltf.h"
#include "cook/model/obj.h"
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
    if (name.size() > tail.size() && name.compare(name.size() - tail.size(), tail.size(), tail) == 0)
        name.resize(name.size() - tail.size());
    return name;
}

/// A file does not tell whom its garment was made for: on the woman, and where that fails, or it crosses her
/// or itself, on the man too; the better of both.
std::vector<CookedGarment> better_of_both(
    const std::function<std::vector<CookedGarment>(vfit_sex)>& cook_on) {
    std::vector<CookedGarment> on_woman, on_man;
    std::exception_ptr fault;
    try {
        on_woman = cook_on(VFIT_SEX_FEMALE);
        if (crossings_of(on_woman) == 0) return on_woman;
    } catch (const Error&) {
        fault = std::current_exception();
    }
    try {
        on_man = cook_on(VFIT_SEX_MALE);
    } catch (const Error&) {
        if (on_woman.empty()) std::rethrow_exception(fault);
        return on_woman;
    }
    return !on_woman.empty() && crossings_of(on_woman) <= crossings_of(on_man) ? std::move(on_woman)
                                                                               : std::move(on_man);
}

/// Where GarmentCode keeps the measures of the body that a pattern was drawn for; empty: there are none.
std::string measures_beside(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    for (const std::string& name :
         {name_of(path) + "_body_measurements.yaml", std::string("body_measurements.yaml")})
        if (const auto file = folder / name; std::filesystem::exists(file)) return file.string();
    return "";
}

/// The body of a request, where it names one.
std::optional<BodyDrawnFor> body_of(const BodyModel& model, const CookRequest& request,
                                    const std::string& measures) {
    if (!request.shape.empty() && !request.measures.empty())
        fail(VFIT_ERROR_ARGUMENT, "either measures or a shape tell on which body it is made, not both");
    if (!request.shape.empty())
        return BodyDrawnFor{
            request.sex == VFIT_SEX_UNKNOWN ? VFIT_SEX_FEMALE : request.sex, request.shape, {}};
    if (measures.empty()) return std::nullopt;
    const std::vector<std::byte> bytes = read_file(measures);
    try {
        DrawnFor drawn_for = parse_drawn_for({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        if (request.sex != VFIT_SEX_UNKNOWN) drawn_for.sex = request.sex;
        return body_drawn_for(model, drawn_for);
    } catch (const Error& error) {
        fail(error.code(), measures, ": ", error.what());
    }
}

std::vector<CookedGarment> one(CookedGarment&& cooked) {
    std::vector<CookedGarment> out;
    out.push_back(std::move(cooked));
    return out;
}

CookedGarment cook_specification(const BodyModel& model, const FabricLibrary& fabrics,
                                 const CookRequest& request, std::span<const std::byte> text, Jobs& jobs) {
    CookOptions options;
    if (!request.kind.empty()) options.kind = request.kind, options.kind_told = true;
    if (!request.fabric.empty()) options.fabric = request.fabric;
    options.size_chart = request.size_chart;
    if (request.sex != VFIT_SEX_UNKNOWN) options.sex = request.sex;
    options.triangle_m = request.triangle_m;
    options.drape = request.drape;
    Pattern pattern = parse_garmentcode(text, request.name.empty() ? name_of(request.path) : request.name);
    const std::string measures = request.measures.empty() ? measures_beside(request.path) : request.measures;
    const auto body = body_of(model, request, measures);
    pattern.worn_as_placed = body && request.shape.empty();
    const std::vector<PatternSize> sizes{{"", {}, pattern}};
    if (body) {
        options.sex = body->sex, options.shape = body->shape;
        CookedGarment cooked = cook_pattern(model, sizes, 0, fabrics, options, jobs);
        cooked.notes.insert(cooked.notes.begin(), body->notes.begin(), body->notes.end());
        return cooked;
    }
    if (request.sex != VFIT_SEX_UNKNOWN) return cook_pattern(model, sizes, 0, fabrics, options, jobs);
    return std::move(better_of_both([&](vfit_sex sex) {
                         options.sex = sex;
                         return one(cook_pattern(model, sizes, 0, fabrics, options, jobs));
                     }).front());
}

CookedGarment cook_design(const BodyModel& model, const FabricLibrary& fabrics, const CookRequest& request,
                          std::span<const std::byte> text, Jobs& jobs) {
    const GarmentDesign design = parse_design(text);
    const DraftedGarment drafted = draft(model, design);
    std::vector<PatternSize> sizes;
    for (const DraftedSize& size : drafted.sizes) sizes.push_back({size.label, size.nominal, size.pattern});
    CookOptions options;
    options.kind = request.kind.empty() ? design.kind : request.kind;
    options.fabric = request.fabric.empty() ? design.fabric : request.fabric;
    options.size_chart = request.size_chart.empty() ? design.size_chart : request.size_chart;
    options.sex = design.sex;
    options.triangle_m = request.triangle_m;
    options.drape = request.drape;
    CookedGarment cooked = cook_pattern(model, sizes, drafted.base, fabrics, options, jobs);
    cooked.garment.name = design.name;
    return cooked;
}

constexpr const char *kDesign = "vfit-design", *kSundress = "vfit-sundress";

/// Of a JSON file; empty where it states none.
std::string format_of(const std::vector<std::byte>& text) {
    const Json root = parse_json(text, "garment design");
    const bool stated = root.is_object() && root.contains("format") && root["format"].is_string();
    return stated ? root["format"].get<std::string>() : "";
}

/// ".obj" of ".../shirt.OBJ".
std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
    return ending;
}

Model read_model(const std::string& path) {
    constexpr size_t kMostBytes = size_t(256) << 20;
    const std::filesystem::path file(path);
    const Beside beside(file.parent_path().string());
    if (ending_of(path) != ".obj") return read_gltf(GltfDocument(path), file.filename().string(), beside);
    const std::vector<std::byte> bytes = read_file(path, kMostBytes);
    return read_obj({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, beside);
}

std::vector<CookedGarment> cook_mesh(const BodyModel& model, const FabricLibrary& fabrics,
                                     const CookRequest& request, Jobs& jobs) {
    ModelOptions options;
    options.name = request.name.empty() ? name_of(request.path) : request.name;
    if (!request.kind.empty()) options.cook.kind = request.kind, options.cook.kind_told = true;
    if (!request.fabric.empty()) options.cook.fabric = request.fabric;
    options.cook.size_chart = request.size_chart;
    if (request.sex != VFIT_SEX_UNKNOWN) options.cook.sex = request.sex;
    options.cook.drape = request.drape;
    const auto body = body_of(model, request, request.measures);
    if (body) options.cook.sex = body->sex, options.cook.shape = body->shape;
    if (request.unit_m > 0.0f) options.alignment.unit_m = request.unit_m, options.alignment.unit_told = true;
    options.alignment.scale = request.scale;
    options.alignment.stands_by = request.stands_by;
    options.remake = request.remake;
    options.size_label = request.size_label;
    try {
        const Model mesh = read_model(request.path);
        if (request.sex != VFIT_SEX_UNKNOWN || body) return cook_model(model, mesh, fabrics, options, jobs);
        return better_of_both([&](vfit_sex sex) {
            options.cook.sex = sex;
            return cook_model(model, mesh, fabrics, options, jobs);
        });
    } catch (const Error& error) {
        const std::string name = std::filesystem::path(request.path).filename().string(), what = error.what();
        if (what.find(name) != std::string::npos) throw;
        fail(error.code(), name, ": ", what);
    }
}

}  // namespace

bool is_mesh_file(const std::string& path) {
    const std::string ending = ending_of(path);
    return ending == ".obj" || ending == ".gltf" || ending == ".glb";
}

bool is_design_file(const std::string& path) {
    const std::vector<std::byte> text = read_file(path);
    if (is_garmentcode(text)) return true;
    const std::string format = format_of(text);
    return format == kSundress || format == kDesign;
}

std::vector<CookedGarment> cook_file(const BodyModel& model, const FabricLibrary& fabrics,
                                     const CookRequest& request, Jobs& jobs) {
    if (is_mesh_file(request.path)) return cook_mesh(model, fabrics, request, jobs);
    const std::vector<std::byte> text = read_file(request.path);
    if (is_garmentcode(text)) return one(cook_specification(model, fabrics, request, text, jobs));
    const std::string format = format_of(text);
    if (format == kSundress) return one({cook_sundress(model, parse_sundress(text)), {}, {}, {}, {}, {}});
    if (format == kDesign) return one(cook_design(model, fabrics, request, text, jobs));
    fail(VFIT_ERROR_UNSUPPORTED, request.path,
         " is no garment that can be cooked: neither a mesh (.obj, .gltf, .glb) nor a GarmentCode "
         "specification (\"pattern\" with \"panels\") nor a design of vfit's (\"format\": \"",
         kDesign, "\" or \"", kSundress, "\")");
}

}  // namespace vfit
