// vfit fit: the whole chain on one source; leaves result.json, pictures and an animated GLB.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <tuple>

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
    std::string sex = "f", out;
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

/// The first moment, and those that differ most from each other, in the order of time.
std::vector<Moment> choose(const std::vector<Moment>& all) {
    std::vector<size_t> chosen{0};
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
        const auto meshes = dressed_meshes(fitting.avatar(), fitting.cloth(), map);
        for (const auto& [yaw, side] : {std::pair(0.35f, ""), std::pair(3.5f, "_back")}) {
            const Canvas picture = draw_dressed(meshes, centre_of(meshes[0]), yaw, style);
            album.add(std::string("fit_map_") + name + side + ".png", picture);
            rows[2].push_back({picture, caption});
        }
    }
    album.add("contact_sheet.png", contact_sheet(title, rows, 620));
}

std::string title_of(const Json& result) {
    char text[160];
    const auto centimetres = [&](const char* key) {
        return 100.0 * result.at("measurements").at(key).at("value").get<double>();
    };
    const Json& best = result.at("sizes").at(0);
    std::snprintf(text, sizeof text, "%s: %.1f cm tall, shoulders %.1f cm, size %s (%.0f %%)",
                  result.at("garment").get<std::string>().c_str(), centimetres("stature_m"),
                  centimetres("shoulder_breadth_m"), best.at("label").get<std::string>().c_str(),
                  100.0 * best.at("probability").get<double>());
    return text;
}

Json fit(const Options& options) {
    Album album(options.out);
    const Context context = open_context();
    FittingOptions chain = options.fitting;
    chain.scan.sex = sex_from(options.sex);
    chain.scan.track = options.track;
    Fitting fitting(context.get(), chain);
    GlbAnimation animation(fitting.avatar(), fitting.cloth());
    std::vector<Moment> moments;
    {
        Progress progress("moving");
        fitting.play([&](vfit_frame, double time_s) {
            progress.at(fitting.frames_played(), chain.max_frames);
            if (time_s >= kLength_s) return false;
            if (time_s < double(moments.size()) * kKeyInterval_s) return true;
            animation.add_key(static_cast<float>(time_s));
            Moment moment{time_s, dressed_meshes(fitting.avatar(), fitting.cloth()), {}};
            moment.centre = centre_of(moment.meshes[0]);
            moments.push_back(std::move(moment));
            return true;
        });
    }

    Json result;
    result["source"] = chain.source;
    result["garment"] = chain.garment;
    result["size"] = chain.size.empty() ? Json("made to measure") : Json(chain.size);
    result["scan_frames"] = fitting.scan().frames_taken;
    result["measurements"] = measurements_json(measurements_of(fitting.scan().scan.get()));
    vfit_scale scale = vfit_scale_init();
    // Algorithm 3 knows the paper's three kinds.
    const bool scaled =
        vfit_scan_scale(fitting.scan().scan.get(), fitting.garment_kind().c_str(), &scale) == VFIT_OK;
    result["scale"] = scaled ? Json{{"x", scale.x}, {"y", scale.y}} : Json();
    result["chart"] = chain.chart;
    result["sizes"] = fitting.sizes();
    result["frames"] = fitting.frames_played();
    result["cloth"] = cloth_json(fitting.cloth());
    result["dress_ms"] = fitting.dress_ms();
    result["stage_ms"] = timings(context.get());

    draw_all(album, fitting, choose(moments), title_of(result), options.draft ? kDraft : kFine);
    animation.write(album.path("avatar.glb"));
    result["pictures"] = album.names();
    result["animation"] = "avatar.glb";
    write_text(album.path("result.json"), document_text(result));
    return result;
}

}  // namespace

void add_fit(Command& app) {
    Command command = app.add_subcommand("fit", "Scan, size, move and dress; leaves pictures and a GLB");
    auto o = std::make_shared<Options>();
    o->fitting.chart = "paper";
    command.add_option("source", o->fitting.source, "Recording folder or sensor URI").required();
    command.add_option("--garment", o->fitting.garment, "Garment by name or file (default sundress)");
    command.add_option("--size", o->fitting.size, "A label of the garment; default: made to measure");
    command.add_option("--chart", o->fitting.chart, "Size chart by name or file (default paper)");
    command.add_option("--sex", o->sex, "Whose default body: f, m or unknown").one_of({"f", "m", "unknown"});
    command.add_option("--frames", o->fitting.max_frames, "Play that many frames at most (8 seconds at most)")
        .positive();
    command.add_option("--detail", o->fitting.detail, "Level of detail of the avatar: 0, 1 or 2")
        .within(0, 2);
    command.add_option("--out", o->out, "Folder for the results").required();
    command.add_flag("--hands", o->fitting.hands, "Let forearms and hands push the garment");
    command.add_flag("--draft", o->draft, "Small, grainy pictures in a tenth of the time");
    command.add_flag("--json", o->json, "Print the result as JSON");
    add_track_options(command, o->track);
    command.callback([o] {
        const Json result = fit(*o);
        if (o->json)
            print_document(result);
        else
            std::cout << title_of(result) << "\nin " << o->out
                      << ": result.json, contact_sheet.png, avatar.glb, " << result["pictures"].size() - 1
                      << " pictures\n";
    });
}

}  // namespace vfit::tools
