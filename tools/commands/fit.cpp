// vfit fit: the whole chain on one source; leaves result.json, pictures and an animated GLB.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <tuple>

#include "client/assets.h"
#include "client/command_line.h"
#include "client/files.h"
#include "client/fitting.h"
#include "client/output.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "export/glb.h"
#include "picture/contact_sheet.h"
#include "picture/depth_picture.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr PortraitStyle kFine{620, 930, 3}, kDraft{310, 465, 1};
constexpr size_t kPortraits = 4;        // moments of the motion
constexpr double kKeyInterval_s = 0.1;  // of the GLB's key frames
constexpr double kLength_s =
    8.0;  // a key frame is a morph target of the garment, and a sensor may have no end

struct Options {
    FittingOptions fitting;
    std::string sex = "unknown", method, out;
    bool json = false, draft = false;
    TrackOptions track;
};

/// What is kept of a moment until the pictures are drawn.
struct Moment {
    double time_s;
    std::vector<RenderMesh> meshes;
    glm::vec3 centre;
};

Json timings(vfit_context context) {
    Json out = Json::object();
    for (const auto& p : list<vfit_profile>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_profile_list(context, items, stride, n);
         }))
        out[p.stage] = {{"calls", p.calls}, {"mean", p.mean_ms}, {"max", p.max_ms}};
    return out;
}

Json cloth_json(vfit_cloth cloth) {
    vfit_cloth_stats s = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth, &s));
    return {{"vertices", s.vertex_count},        {"simulated", s.simulated_count},
            {"constraints", s.constraint_count}, {"strain_mean", s.strain_mean},
            {"strain_p99", s.strain_p99},        {"strain_max", s.strain_max}};
}

Json garment_json(const Layer& layer, const SizeAdvice& advice, const std::string& size) {
    Json out = {{"garment", layer.name},
                {"kind", layer.info.garment_kind},
                {"size", size.empty() ? Json("made to measure") : Json(size)},
                {"chart", advice.chart},
                {"chart_kind", advice.kind},
                {"sizes", advice.sizes}};
    if (advice.sizes.empty())
        out["no_size"] = advice.reason;
    else if (!advice.reason.empty())
        out["chart_note"] = "sized by the chart \"" + advice.chart + "\": " + advice.reason;
    out["cloth"] = cloth_json(layer.cloth.get());
    return out;
}

/// The fields of a single garment that an outfit has as a whole: sizes are those of the outermost layer,
/// counts are sums, strains the largest.
void add_whole_outfit(Json& result, const Json& garments) {
    result["chart"] = garments.back().at("chart");
    result["sizes"] = garments.back().at("sizes");
    Json whole = garments[0].at("cloth");
    for (size_t i = 1; i < garments.size(); ++i)
        for (const auto& [key, value] : garments[i].at("cloth").items())
            if (key.rfind("strain", 0) == 0)
                whole[key] = std::max(whole[key].get<double>(), value.get<double>());
            else
                whole[key] = whole[key].get<int64_t>() + value.get<int64_t>();
    result["cloth"] = whole;
}

/// Pictures are scaled up so that a 320 x 240 image is not a stamp.
int depth_scale(vfit_frame frame) { return view_of(frame, VFIT_STREAM_DEPTH).width <= 400 ? 4 : 2; }

class Album {
public:
    explicit Album(std::string folder) : folder_(std::move(folder)) { create_folder(folder_); }
    void add(const std::string& name, const Canvas& picture) {
        picture.write_png(folder_ + "/" + name);
        names_.push_back(name);
    }
    const std::vector<std::string>& names() const { return names_; }
    std::string path(const std::string& name) const { return folder_ + "/" + name; }

private:
    std::string folder_;
    std::vector<std::string> names_;
};

/// How differently the person stands in two moments: mean distance of the skin over the floor's centre.
float difference(const Moment& a, const Moment& b) {
    const auto &p = a.meshes[0].positions, &q = b.meshes[0].positions;
    float sum = 0.0f;
    for (size_t i = 0; i < p.size(); i += 16) sum += glm::length((p[i] - a.centre) - (q[i] - b.centre));
    return sum;
}

/// The first moment, the one nearest to `worst_s` if that is not negative, and those that differ most from
/// each other, in the order of time.
std::vector<Moment> choose(const std::vector<Moment>& all, double worst_s) {
    std::vector<size_t> chosen{0};
    if (worst_s >= 0.0) {
        size_t worst = 0;
        for (size_t i = 0; i < all.size(); ++i)
            if (std::abs(all[i].time_s - worst_s) < std::abs(all[worst].time_s - worst_s)) worst = i;
        if (worst != 0) chosen.push_back(worst);
    }
    while (chosen.size() < std::min(kPortraits, all.size())) {
        size_t best = 0;
        float widest = -1.0f;
        for (size_t i = 0; i < all.size(); ++i) {
            float nearest = 1e9f;
            for (const size_t c : chosen) nearest = std::min(nearest, difference(all[i], all[c]));
            if (nearest > widest) {
                widest = nearest;
                best = i;
            }
        }
        chosen.push_back(best);
    }
    std::sort(chosen.begin(), chosen.end());
    std::vector<Moment> out;
    for (const size_t i : chosen) out.push_back(all[i]);
    return out;
}

void draw_all(Album& album, const Fitting& fitting, const std::vector<Moment>& moments,
              const std::string& title, const PortraitStyle& style) {
    const vfit_frame frame = fitting.scan_frame();
    const int scale = depth_scale(frame);
    Canvas depth = draw_depth(frame, scale);
    album.add("depth.png", depth);
    Canvas skeleton = depth;
    const auto joints = joints_of(frame, fitting.body_id());
    const auto colliders = list<vfit_collider>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_scan_colliders(fitting.scan().scan.get(), items, stride, n);
    });
    draw_colliders(skeleton, frame, colliders, scale);
    draw_skeleton(skeleton, frame, joints, scale);
    album.add("skeleton.png", skeleton);
    std::vector<std::vector<SheetItem>> rows(2);
    rows[0] = {{depth, "depth and user map"}, {skeleton, "joints and collision spheres of the scan"}};
    Progress progress("drawing");
    for (size_t k = 0; k < moments.size(); ++k) {
        progress.at(k, moments.size() + 1);
        const Canvas picture = draw_dressed(moments[k].meshes, moments[k].centre, 0.35f, style);
        album.add("dressed_" + std::to_string(k) + ".png", picture);
        char caption[32];
        std::snprintf(caption, sizeof caption, "%.1f s", moments[k].time_s);
        rows[1].push_back({picture, caption});
    }
    const Moment& last = moments.back();
    const Canvas back = draw_dressed(last.meshes, last.centre, 3.5f, style);
    album.add("dressed_back.png", back);
    rows[1].push_back({back, "from behind"});
    rows.emplace_back();
    for (const auto& [map, name, caption] :
         {std::tuple(FitMap::stretch, "stretch", "stretch: blue loose, yellow 4 %, red 10 %"),
          std::tuple(FitMap::pressure, "pressure", "pressure: yellow 0.5 kPa, red 2 kPa")}) {
        const auto meshes = dressed_meshes(fitting.avatar(), drawn(fitting.outfit()), map);
        for (const auto& [yaw, side] : {std::pair(0.35f, ""), std::pair(3.5f, "_back")}) {
            const Canvas picture = draw_dressed(meshes, centre_of(meshes[0]), yaw, style);
            album.add(std::string("fit_map_") + name + side + ".png", picture);
            rows[2].push_back({picture, caption});
        }
    }
    album.add("contact_sheet.png", contact_sheet(title, rows, 620));
}

std::string title_of(const Json& result) {
    const auto centimetres = [&](const char* key) {
        return 100.0 * result.at("measurements").at(key).at("value").get<double>();
    };
    char text[160];
    std::snprintf(text, sizeof text, "%.1f cm tall, shoulders %.1f cm", centimetres("stature_m"),
                  centimetres("shoulder_breadth_m"));
    std::string title = text;
    if (result.contains("note")) title += " by the paper's method";
    for (const Json& garment : result.at("garments")) {
        title += "\n" + garment.at("garment").get<std::string>();
        title += garment.at("size") == "made to measure"
                     ? ", made to measure"
                     : " worn in " + garment.at("size").get<std::string>();
        if (!garment.at("sizes").empty()) title += ", recommended: " + size_text(garment.at("sizes"));
    }
    return title;
}

Json fit(const Options& options) {
    Album album(options.out);
    const Context context = open_context();
    FittingOptions chain = options.fitting;
    chain.scan.sex = sex_from(options.sex);
    chain.scan.method = scan_method_from(options.method);
    chain.scan.track = options.track;
    Fitting fitting(context.get(), chain);
    GlbAnimation animation(fitting.avatar(), fitting.outfit());
    std::vector<Moment> moments;
    {
        Progress progress("moving");
        fitting.play([&](vfit_frame, double time_s) {
            progress.at(fitting.frames_played(), chain.max_frames);
            if (time_s >= kLength_s) return false;
            if (time_s < double(moments.size()) * kKeyInterval_s) return true;
            animation.add_key(static_cast<float>(time_s));
            Moment moment{time_s, dressed_meshes(fitting.avatar(), drawn(fitting.outfit())), {}};
            moment.centre = centre_of(moment.meshes[0]);
            moments.push_back(std::move(moment));
            return true;
        });
    }

    Json result;
    result["source"] = chain.source;
    Json garments = Json::array();
    std::string names;
    for (size_t i = 0; i < fitting.outfit().layers().size(); ++i) {
        garments.push_back(garment_json(fitting.outfit().layers()[i], fitting.advice()[i], chain.size));
        names += (i > 0 ? "+" : "") + fitting.outfit().layers()[i].name;
    }
    result["garment"] = names;
    result["size"] = garments[0].at("size");
    result["method"] = scan_method_text(fitting.scan().method);
    if (!fitting.scan().note.empty()) result["note"] = fitting.scan().note;
    result["sex"] = {{"value", sex_text(fitting.sex())},
                     {"probability", fitting.sex_probability()},
                     {"told", chain.scan.sex != VFIT_SEX_UNKNOWN}};
    result["scan_frames"] = fitting.scan().frames_taken;
    result["measurements"] = measurements_json(measurements_of(fitting.scan().scan.get()));
    // Algorithm 3 knows the paper's three kinds; of another kind there is no scale.
    vfit_scale scale = vfit_scale_init();
    if (vfit_scan_scale(fitting.scan().scan.get(), fitting.outfit().layers().back().info.garment_kind,
                        &scale) == VFIT_OK)
        result["scale"] = {{"x", scale.x}, {"y", scale.y}};
    result["garments"] = garments;
    add_whole_outfit(result, garments);
    const WornOutfit::Worst& worst = fitting.outfit().worst();
    const std::string warning = fitting.outfit().warning();
    result["torn"] = !warning.empty();
    result["worst_strain"] = {{"strain", worst.strain}, {"garment", worst.garment}, {"time_s", worst.time_s}};
    if (!warning.empty()) result["warning"] = warning;
    result["frames"] = fitting.frames_played();
    result["dress_ms"] = fitting.dress_ms();
    result["stage_ms"] = timings(context.get());

    draw_all(album, fitting, choose(moments, warning.empty() ? -1.0 : double(worst.time_s)),
             warned(title_of(result), warning), options.draft ? kDraft : kFine);
    animation.write(album.path("avatar.glb"));
    result["pictures"] = album.names();
    result["animation"] = "avatar.glb";
    write_text(album.path("result.json"), document_text(result));
    return result;
}

void list_garments(bool json) {
    const Context context = open_context();
    Json out = Json::array();
    for (const std::string& name : garment_names(context.get())) {
        const Garment garment = open_garment(context.get(), name);
        vfit_garment_info info = vfit_garment_info_init();
        check(vfit_garment_describe(garment.get(), &info));
        Json sizes = Json::array();
        for (uint32_t i = 0; i < info.size_count; ++i) {
            char label[32];
            vfit_garment_size_label(garment.get(), i, label, sizeof label);
            sizes.push_back(label);
        }
        out.push_back({{"garment", name},
                       {"kind", info.garment_kind},
                       {"chart", info.size_chart},
                       {"fabric", info.fabric},
                       {"made_for", sex_text(info.body_sex)},
                       {"sizes", sizes}});
    }
    if (json) return print_document(out);
    for (const Json& g : out) {
        std::cout << std::left << std::setw(20) << g["garment"].get<std::string>() << std::setw(14)
                  << g["kind"].get<std::string>() << std::setw(18) << g["chart"].get<std::string>();
        for (const Json& label : g["sizes"]) std::cout << " " << label.get<std::string>();
        std::cout << "\n";
    }
}

}  // namespace

void add_fit(Command& app) {
    Command command = app.add_subcommand("fit", "Scan, size, move and dress; leaves pictures and a GLB");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->fitting.source, "Recording folder or sensor URI");
    command.add_option(
        "--garment", o->fitting.garments,
        "Garments by name or file, A+B: B over A; \"list\" prints the names (default: sundress for "
        "a woman, pants_men+shirt_men for a man)");
    command.add_option("--size", o->fitting.size, "A label of the garments (default: made to measure)");
    command.add_option("--chart", o->fitting.chart,
                       "Size chart by name or file (default: the one that each garment names)");
    command.add_option("--kind", o->fitting.chart_kind,
                       "Garment kind of that chart (default: the garment's own)");
    command
        .add_option("--method", o->method,
                    "How to measure (default: fit; paper where no frame can be fitted)")
        .one_of({"fit", "paper", "paper-as-printed"});
    command.add_option("--sex", o->sex, "f or m, where known (default: as the scan finds)")
        .one_of({"f", "m", "unknown"});
    command.add_option("--frames", o->fitting.max_frames, "Play that many frames at most (8 seconds at most)")
        .positive();
    command.add_option("--detail", o->fitting.detail, "Level of detail of the avatar: 0, 1 or 2")
        .within(0, 2);
    command.add_option("--out", o->out, "Folder for the results");
    command.add_flag("--hands,!--no-hands", o->fitting.hands,
                     "Forearms and hands push the garments (default), or pass through all but their sleeves");
    command.add_flag("--draft", o->draft, "Small, grainy pictures in a tenth of the time");
    command.add_flag("--json", o->json, "Print the result as JSON");
    add_track_options(command, o->track);
    command.callback([o] {
        if (o->fitting.garments == "list") return list_garments(o->json);
        if (o->fitting.source.empty()) throw WrongUsage("fit: source is required");
        if (o->out.empty()) throw WrongUsage("fit: --out is required");
        const Json result = fit(*o);
        if (o->json) return print_document(result);
        std::cout << title_of(result) << "\nin " << o->out << ": result.json, contact_sheet.png, avatar.glb, "
                  << result["pictures"].size() - 1 << " pictures\n";
        for (const Json& garment : result["garments"])
            if (garment.contains("chart_note"))
                std::cout << garment["garment"].get<std::string>() << ": "
                          << garment["chart_note"].get<std::string>() << "\n";
            else if (garment.contains("no_size"))
                std::cout << garment["garment"].get<std::string>()
                          << ": no size: " << garment["no_size"].get<std::string>() << "\n";
        if (result.contains("note")) std::cout << result["note"].get<std::string>() << "\n";
        if (result.contains("warning")) std::cout << result["warning"].get<std::string>() << "\n";
    });
}

}  // namespace vfit::tools
