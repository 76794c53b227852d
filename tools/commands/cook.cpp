// vfit cook: makes garment files from their designs, offline.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

#include "body/body_model.h"
#include "client/files.h"
#include "client/output.h"
#include "client/shape_option.h"
#include "commands/commands.h"
#include "cook/cook_file.h"
#include "cook/garment_writer.h"
#include "core/error.h"
#include "core/files.h"
#include "core/platform.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string design, out, body, fabrics, kind, size_chart, fabric, sex, unit, size_label, measures, shape,
        stand, remake;
    float triangle_mm = 20.0f, scale = 0.0f;
    bool json = false;
};

/// A file of data beside the program: of a build, or of an installation with its own name for lib.
std::string data_beside(const std::string& name) {
    const std::string prefix = library_folder() + "/../", file = "/vfit_data/" + name;
    const std::string built = prefix + "lib" + file;
    return std::filesystem::exists(built) ? built : prefix + VFIT_LIBDIR + file;
}

float unit_named(const std::string& name) {
    for (const auto& [known, metres] : {std::pair("m", 1.0f), std::pair("dm", 0.1f), std::pair("cm", 0.01f),
                                        std::pair("mm", 0.001f), std::pair("in", 0.0254f)})
        if (name == known) return metres;
    return 0.3048f;
}

Json report_of(const CookedGarment& cooked) {
    const vfit::Garment& g = cooked.garment;
    const DrapeReport& r = cooked.report;
    Json sizes = Json::array();
    for (const GarmentSize& size : g.sizes) sizes.push_back(size.label);
    Json out = {{"garment", g.name},
                {"kind", g.kind},
                {"size_chart", g.size_chart},
                {"fabric", g.fabric},
                {"body_sex", g.body_sex == VFIT_SEX_MALE ? "m" : "f"},
                {"vertices", g.vertex_count()},
                {"simulated", g.simulated_count()},
                {"sizes", sizes}};
    if (!g.has_own_lengths()) return out;
    out["triangles"] = g.mesh.indices.size() / 3;
    if (!g.drawn.empty()) {
        out["drawn_vertices"] = g.drawn_count();
        out["drawn_triangles"] = g.drawn_indices().size() / 3;
    }
    out["hangs_on"] = r.hangs_on == HangsOn::shoulders ? "shoulders"
                      : r.hangs_on == HangsOn::waist   ? "waist"
                                                       : "nothing";
    out["goes_round"] = cooked.round;
    out["raised_m"] = r.raised_m;
    out["widest_seam_m"] = r.widest_seam_m;
    out["skin_crossings"] = r.skin_crossings;
    out["self_crossings"] = r.self_crossings;
    out["strain_p99"] = r.strain_p99;
    out["seconds"] = r.seconds;
    out["warnings"] = cooked.notes;
    if (!g.cut_shape.empty()) out["openings_m"] = cooked.openings_m;
    return out;
}

class Cook {
public:
    explicit Cook(const Options& options)
        : options_(options),
          model_(BodyModel::load(options.body.empty() ? data_beside("body.bin") : options.body)),
          fabrics_(FabricLibrary::parse(
              read_file(options.fabrics.empty() ? data_beside("fabrics.json") : options.fabrics))),
          jobs_(Jobs::own(1)) {}

    /// A report each of its garments, the innermost first.
    std::vector<Json> cook(const std::string& design, const std::string& out) {
        CookRequest request;
        request.path = design;
        request.kind = options_.kind;
        request.size_chart = options_.size_chart;
        request.fabric = options_.fabric;
        request.sex = options_.sex.empty()  ? VFIT_SEX_UNKNOWN
                      : options_.sex == "m" ? VFIT_SEX_MALE
                                            : VFIT_SEX_FEMALE;
        request.measures = options_.measures;
        for (const vfit_shape_value& value : shape_values(options_.shape))
            request.shape.push_back({value.key, value.value});
        request.remake = options_.remake == "never"    ? Remake::never
                         : options_.remake == "always" ? Remake::always
                                                       : Remake::where_needed;
        request.triangle_m = options_.triangle_mm / 1000.0f;
        if (!options_.unit.empty()) request.unit_m = unit_named(options_.unit);
        request.scale = options_.scale;
        request.stands_by = options_.stand == "as-modelled" ? StandsBy::as_modelled
                            : options_.stand == "shoulders" ? StandsBy::shoulders
                            : options_.stand == "waist"     ? StandsBy::waist
                                                            : StandsBy::any;
        request.size_label = options_.size_label;
        std::vector<Json> reports;
        for (const CookedGarment& cooked : cook_file(*model_, fabrics_, request, *jobs_)) {
            std::filesystem::path file(out);
            if (!cooked.of_set.empty())
                file.replace_filename(file.stem().string() + "_" + cooked.of_set + file.extension().string());
            write_text(file.string(), write_garment(cooked.garment));
            reports.push_back(report_of(cooked));
            reports.back()["file"] = file.string();
        }
        return reports;
    }

private:
    const Options& options_;
    std::shared_ptr<const BodyModel> model_;
    FabricLibrary fabrics_;
    std::unique_ptr<Jobs> jobs_;
};

/// "chest, waist, hips".
std::string listed(const Json& words) {
    std::string out;
    for (const Json& word : words) out += (out.empty() ? "" : ", ") + word.get<std::string>();
    return out;
}

std::string line_of(const Json& r) {
    std::string line = text(r["garment"].get<std::string>(), ": ", r["vertices"].get<int>(), " vertices, ",
                            r["simulated"].get<int>(), " of them simulated");
    if (r.contains("seconds"))
        line += text(", worn from the ", r["hangs_on"].get<std::string>(), ", goes round ",
                     listed(r["goes_round"]), ", ", r["skin_crossings"].get<int>(),
                     " crossings with the skin, ", r["self_crossings"].get<int>(), " with itself, in ",
                     int(r["seconds"].get<double>() * 10.0) / 10.0, " s");
    line += ", in " + r["file"].get<std::string>();
    if (r.contains("warnings"))
        for (const Json& warning : r["warnings"]) line += "\n  " + warning.get<std::string>();
    return line;
}

/// Who makes GarmentCode specifications keeps what was simulated of them beside them.
bool is_simulation(const std::filesystem::path& design) {
    if (!is_mesh_file(design.string())) return false;
    const std::string tail = "_specification";
    for (const auto& entry : std::filesystem::directory_iterator(design.parent_path())) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".json" && name.size() > tail.size() &&
            name.compare(name.size() - tail.size(), tail.size(), tail) == 0)
            return true;
    }
    return false;
}

void cook(const Options& options) {
    Cook kitchen(options);
    if (!std::filesystem::is_directory(options.design)) {
        const std::vector<Json> reports = kitchen.cook(options.design, options.out);
        if (!options.json)
            for (const Json& report : reports) std::cout << line_of(report) << "\n";
        else if (reports.size() == 1)
            print_document(reports[0]);
        else
            print_document({{"garments", reports}});
        return;
    }
    // A catalogue: every design below the folder; one that fails does not stop the others.
    std::vector<std::filesystem::path> designs;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(options.design))
        if (entry.is_regular_file() &&
            (entry.path().extension() == ".json" || is_mesh_file(entry.path().string())))
            designs.push_back(entry.path());
    std::sort(designs.begin(), designs.end());
    if (designs.empty())
        throw Failure("there is no design (*.json) and no mesh (*.obj, *.gltf, *.glb) in " + options.design);
    create_folder(options.out);
    Json cooked = Json::array(), failed = Json::array(), left_out = Json::array();
    std::set<std::string> names;
    for (const auto& design : designs) {
        if (is_simulation(design)) {
            left_out.push_back(design.string());
            continue;
        }
        std::string name = design.stem().string();
        if (!names.insert(name).second) {
            const std::string first = name = design.parent_path().filename().string() + "_" + name;
            for (int i = 2; !names.insert(name).second; ++i) name = vfit::text(first, "_", i);
        }
        try {
            for (const Json& report : kitchen.cook(
                     design.string(), (std::filesystem::path(options.out) / (name + ".json")).string())) {
                cooked.push_back(report);
                if (!options.json) std::cout << line_of(report) << std::endl;
            }
        } catch (const Error& error) {
            if (error.code() == VFIT_ERROR_UNSUPPORTED)
                left_out.push_back(design.string());
            else
                failed.push_back({{"design", design.string()}, {"error", error.what()}});
            if (!options.json) std::cout << design.string() << ": " << error.what() << std::endl;
        }
    }
    const Json report = {{"cooked", cooked}, {"failed", failed}, {"left_out", left_out}};
    write_text((std::filesystem::path(options.out) / "report.json").string(), document_text(report));
    if (options.json)
        print_document(report);
    else
        std::cout << cooked.size() << " cooked, " << failed.size() << " failed, " << left_out.size()
                  << " no designs; report.json beside them\n";
    if (!failed.empty())
        throw Failure(vfit::text(failed.size(), " of ", cooked.size() + failed.size(),
                                 " designs could not be cooked: see report.json in ", options.out));
}

}  // namespace

void add_cook(Command& app) {
    Command command =
        app.add_subcommand("cook", "Make garment files from designs, sewing patterns or meshes");
    auto o = std::make_shared<Options>();
    command
        .add_option("design", o->design,
                    "Design, GarmentCode specification, mesh (.obj, .gltf, .glb), or a folder of them "
                    "(docs/garments.md)")
        .required();
    command.add_option("--out", o->out, "Garment file to write; of a folder: the folder for them").required();
    command.add_option("--body", o->body, "Baked body (default: the one beside the program)");
    command.add_option("--fabrics", o->fabrics, "Fabrics (default: those beside the program)");
    command.add_option("--kind", o->kind,
                       "Of a specification or mesh: garment kind of the size charts (default dress)");
    command.add_option("--size-chart", o->size_chart,
                       "Name of the size chart that the garment's labels follow (default: the design's; of "
                       "others none is stated)");
    command.add_option("--fabric", o->fabric,
                       "Of a specification or mesh: its fabric (default cotton_woven)");
    command
        .add_option("--sex", o->sex,
                    "Of a specification or mesh: on whose default body it is draped (default f; of a "
                    "specification the better of both)")
        .one_of({"f", "m"});
    command.add_option(
        "--measures", o->measures,
        "Measures of the body that it was drawn for: GarmentCode's body_measurements.yaml or a "
        "profile (default: of a specification, those beside it)");
    command.add_option("--shape", o->shape,
                       "The body that it was made on: height=0.7,weight=1 (docs/virtual-person.md)");
    command.add_option("--size-label", o->size_label,
                       "Of a mesh: the label of the size that it is modelled in");
    command
        .add_option("--unit", o->unit,
                    "Of a mesh: the unit of its numbers: m, dm, cm, mm, in or ft (default: m, or the one in "
                    "which it fits)")
        .one_of({"m", "dm", "cm", "mm", "in", "ft"});
    command
        .add_option("--scale", o->scale,
                    "Of a mesh: by how much it is made larger (default: 1, or what brings it to the body)")
        .within(0.01, 100);
    command
        .add_option("--stand", o->stand,
                    "Of a mesh: how it comes to the body: as-modelled (it is not moved), by its shoulders or "
                    "by its waist (default: as it is worn without bones in its cloth)")
        .one_of({"as-modelled", "shoulders", "waist"});
    command
        .add_option("--remake", o->remake,
                    "Of a mesh: whether what is simulated is made anew along its outer side, and what was "
                    "modelled is drawn on it: never, always (default: where it can't be simulated as it is)")
        .one_of({"never", "always"});
    command.add_option("--triangle", o->triangle_mm, "Side of a triangle of a pattern in mm (default 20)")
        .within(5, 100);
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { cook(*o); });
}

}  // namespace vfit::tools
