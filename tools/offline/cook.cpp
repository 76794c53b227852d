// vfit cook: makes garment files from their designs, offline.
#include <filesystem>
#include <iostream>
#include <optional>

#include "body/body_model.h"
#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/shape_option.h"
#include "cook/cook_file.h"
#include "cook/garment_writer.h"
#include "core/error.h"
#include "core/files.h"
#include "core/platform.h"
#include "offline/catalogue.h"
#include "offline/data_beside.h"
#include "offline/offline.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string design, out, body, fabrics, kind, size_chart, fabric, sex, unit, size_label, measures, shape,
        stand, remake, picture;
    float triangle_mm = 20.0f, scale = 0.0f;
    int jobs = 0, limit_s = 0;  // 0: not told
    bool json = false, resume = false;
};

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
            replace_text(file.string(), write_garment(cooked.garment));
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

/// As they are worn by the default body, from the front and from behind.
void draw(const std::vector<Json>& reports, const std::string& path) {
    constexpr PortraitStyle kStyle{280, 420, 2};
    constexpr float kLegsOut_rad = 0.1f;
    constexpr int kFrames = 40;  // nearly to rest
    const Context context = open_context();
    std::vector<Garment> garments;
    std::vector<std::string> called;
    for (const Json& report : reports) {
        called.push_back(report["file"].get<std::string>());
        garments.push_back(open_garment(context.get(), std::filesystem::absolute(called.back()).string()));
    }
    const Avatar avatar = default_wearer(context.get(), garments.front().get());
    stand(avatar.get(), kLegsOut_rad);
    vfit_cloth_desc cloth = vfit_cloth_desc_init();
    cloth.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_ANY_FIT;  // it may be made for another body
    cloth.self_thickness_m = kOwnLayers_m;
    WornOutfit outfit(avatar.get(), std::move(garments), called, cloth);
    outfit.settle(kFrames);
    const auto meshes = dressed_meshes(avatar.get(), drawn(outfit));
    std::vector<SheetItem> row;
    for (const float yaw : {0.35f, 3.5f})
        row.push_back({draw_dressed(meshes, centre_of(meshes[0]), yaw, kStyle), ""});
    contact_sheet(std::filesystem::path(path).stem().string(), {row}, kStyle.height).write_png(path);
}

/// The options that are said of every design.
std::vector<std::string> said_of_all(const Options& o) {
    std::vector<std::string> words;
    for (const auto& [option, value] : {std::pair("--body", &o.body),
                                        {"--fabrics", &o.fabrics},
                                        {"--kind", &o.kind},
                                        {"--size-chart", &o.size_chart},
                                        {"--fabric", &o.fabric},
                                        {"--sex", &o.sex},
                                        {"--unit", &o.unit},
                                        {"--size-label", &o.size_label},
                                        {"--measures", &o.measures},
                                        {"--shape", &o.shape},
                                        {"--stand", &o.stand},
                                        {"--remake", &o.remake}})
        if (!value->empty()) words.insert(words.end(), {option, *value});
    words.insert(words.end(), {"--triangle", text(o.triangle_mm)});
    if (o.scale != 0.0f) words.insert(words.end(), {"--scale", text(o.scale)});
    return words;
}

void cook_all(const Options& options) {
    if (!options.picture.empty()) throw WrongUsage("--picture is of one design; of a folder each has one");
    CatalogueOptions catalogue;
    catalogue.folder = options.design, catalogue.out = options.out;
    catalogue.cook = said_of_all(options);
    catalogue.is_mesh = is_mesh_file;
    catalogue.is_design = [](const std::string& path) {
        try {
            return is_design_file(path);
        } catch (const Error&) {
            return true;  // cooking it tells what is wrong
        }
    };
    catalogue.jobs = options.jobs > 0 ? options.jobs : int(physical_cores());
    if (options.limit_s > 0) catalogue.limit_s = double(options.limit_s);
    catalogue.resume = options.resume;
    const Json report = cook_catalogue(catalogue, [&](const Json& design) {
        if (options.json) return;
        if (design["state"] == "cooked")
            for (const Json& garment : design["garments"]) std::cout << line_of(garment) << std::endl;
        else
            std::cout << design["design"].get<std::string>() << ": " << design["error"].get<std::string>()
                      << std::endl;
    });
    const size_t cooked = report["cooked"].size(), failed = report["failed"].size();
    if (options.json)
        print_document(report);
    else
        std::cout << cooked << " cooked, " << failed << " failed, " << report["left_out"].size()
                  << " no designs; report.html and report.json beside them\n";
    if (failed > 0)
        throw Failure(text(failed, " of ", report["designs"].size() - report["left_out"].size(),
                           " designs could not be cooked: see report.html in ", options.out));
}

void cook(const Options& options) {
    if (std::filesystem::is_directory(options.design)) return cook_all(options);
    if (options.resume || options.jobs > 0 || options.limit_s > 0)
        throw WrongUsage("--jobs, --limit and --resume are of a folder of designs");
    const std::vector<Json> reports = Cook(options).cook(options.design, options.out);
    if (!options.picture.empty()) draw(reports, options.picture);
    if (!options.json)
        for (const Json& report : reports) std::cout << line_of(report) << "\n";
    else if (reports.size() == 1)
        print_document(reports[0]);
    else
        print_document({{"garments", reports}});
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
    command.add_option("--picture", o->picture, "Picture (PNG) of the garment on its body to write");
    command
        .add_option("--jobs", o->jobs, "Of a folder: designs at once (default: as many as there are cores)")
        .within(1, 256);
    command.add_flag("--resume", o->resume,
                     "Of a folder: what was cooked into --out before, in the same way, is not cooked again");
    command.add_option("--limit", o->limit_s, "Of a folder: seconds for each design (default 300)")
        .within(1, 86400);
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { cook(*o); });
}

}  // namespace vfit::tools
