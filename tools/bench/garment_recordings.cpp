#include "bench/garment_recordings.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>

#include "bench/bench.h"
#include "bench/carried_props.h"
#include "bench/limb_cover.h"
#include "bench/targets.h"
#include "bench/welded.h"
#include "client/assets.h"
#include "client/files.h"
#include "client/fitting.h"
#include "client/output.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr double kSettled_s = 1.0;  // figures are of what comes later

/// The worst of all frames of one garment on one recording.
struct Worst {
    // frames that have any
    size_t frames = 0, with_skin = 0, with_seen_skin = 0, with_drawn_skin = 0, with_self = 0, with_layers = 0,
           with_props = 0, off_limb = 0;
    size_t skin_pairs = 0, self_pairs = 0;  // in the worst frame
    float strain_max = 0.0f, strain_p99 = 0.0f;
    double at_s = 0.0;  // of strain_max
};

class WornJudge {
public:
    WornJudge(vfit_context context, vfit_avatar avatar, const std::string& names, const vfit_cloth_desc& desc)
        : names_(names), avatar_(avatar), outfit_(context, avatar, names, desc) {}
    WornJudge(vfit_avatar avatar, const std::string& name, Garment garment, const vfit_cloth_desc& desc)
        : names_(name), avatar_(avatar), outfit_(avatar, one(std::move(garment)), {name}, desc) {}

    const std::string& names() const { return names_; }
    const Worst& worst() const { return worst_; }
    WornOutfit& outfit() { return outfit_; }
    const std::vector<RenderMesh>& worst_meshes() const { return worst_meshes_; }
    /// Of all cloths of the outfit, each step.
    const std::vector<float>& step_ms() const { return step_ms_; }
    /// Of vfit_outfit_skin(), each frame.
    const std::vector<float>& skin_ms() const { return skin_ms_; }

    void look(const Welded& skin, double time_s, bool pictures, bool props) {
        std::vector<Welded> layers;
        for (const vfit_cloth cloth : outfit_.cloths()) layers.push_back(mesh_of(cloth));
        std::vector<std::vector<LimbCover>> covers;
        for (const Welded& layer : layers) covers.push_back(cover_of_limbs(avatar_, layer));
        if (put_on_.empty()) put_on_ = covers, hidden_ = hidden_skin(skin.indices.size() / 3);
        if (time_s < kSettled_s) return;
        ++worst_.frames;
        size_t with_skin = 0, with_self = 0, with_layers = 0;
        bool with_seen_skin = false, with_drawn_skin = false;
        const Welded drawn_skin = skin_below(outfit_.cloths(), &skin_ms_.emplace_back());
        for (size_t i = 0; i < layers.size(); ++i) {
            const CrossedTriangles of_skin = crossings(layers[i], skin);
            with_skin += of_skin.size();
            for (const auto& [of_cloth, triangle] : of_skin) with_seen_skin |= !hidden_[triangle];
            with_drawn_skin |= !crossings(layers[i], drawn_skin).empty();
            with_self += crossings(layers[i]).size();
            for (size_t k = 0; k < i; ++k) with_layers += crossings(layers[i], layers[k]).size();
        }
        worst_.with_skin += with_skin > 0, worst_.with_self += with_self > 0;
        worst_.with_seen_skin += with_seen_skin, worst_.with_drawn_skin += with_drawn_skin;
        worst_.with_layers += with_layers > 0;
        if (props) worst_.with_props += prop_crossings(outfit_.cloths()) > 0;
        worst_.skin_pairs = std::max(worst_.skin_pairs, with_skin);
        worst_.self_pairs = std::max(worst_.self_pairs, with_self);
        bool off = false;
        for (size_t i = 0; i < layers.size(); ++i)
            for (size_t k = 0; k < covers[i].size(); ++k)
                off = off || is_off_limb(put_on_[i][k], covers[i][k]);
        worst_.off_limb += off;
        step_ms_.push_back(0.0f);
        for (const vfit_cloth cloth : outfit_.cloths()) {
            vfit_cloth_stats stats = vfit_cloth_stats_init();
            check(vfit_cloth_describe(cloth, &stats));
            step_ms_.back() = std::max(step_ms_.back(), stats.step_ms);  // each tells that of all
            worst_.strain_p99 = std::max(worst_.strain_p99, stats.strain_p99);
            if (stats.strain_max <= worst_.strain_max) continue;
            worst_.strain_max = stats.strain_max, worst_.at_s = time_s;
            if (pictures) worst_meshes_ = dressed_meshes(avatar_, drawn(outfit_));
        }
    }

private:
    static std::vector<Garment> one(Garment garment) {
        std::vector<Garment> out;
        out.push_back(std::move(garment));
        return out;
    }
    std::vector<uint8_t> hidden_skin(size_t triangles) const {
        std::vector<uint8_t> hidden(triangles);
        for (const vfit_cloth cloth : outfit_.cloths())
            check(vfit_cloth_hide_skin(cloth, 0.0f, hidden.data(), uint32_t(hidden.size())));
        return hidden;
    }

    std::string names_;
    vfit_avatar avatar_;
    WornOutfit outfit_;
    Worst worst_;
    std::vector<uint8_t> hidden_;  // triangles of the skin, by the outfit
    std::vector<float> step_ms_, skin_ms_;
    std::vector<std::vector<LimbCover>> put_on_;  // of each layer
    std::vector<RenderMesh> worst_meshes_;
};

Json json_of(const Worst& w) {
    return {{"frames", w.frames},
            {"frames_crossing_skin", w.with_skin},
            {"frames_crossing_seen_skin", w.with_seen_skin},
            {"frames_crossing_drawn_skin", w.with_drawn_skin},
            {"frames_crossing_self", w.with_self},
            {"frames_crossing_layers", w.with_layers},
            {"frames_crossing_props", w.with_props},
            {"frames_off_limb", w.off_limb},
            {"skin_pairs_worst", w.skin_pairs},
            {"self_pairs_worst", w.self_pairs},
            {"strain_max", w.strain_max},
            {"strain_max_s", w.at_s},
            {"strain_p99", w.strain_p99}};
}

void say(const std::string& recording, const std::string& garment, const Worst& w) {
    std::cout << std::left << std::setw(26) << recording << std::setw(18) << garment << std::right
              << std::fixed << std::setprecision(2) << " strain max " << std::setw(6) << w.strain_max
              << " at " << w.at_s << " s, p99 " << w.strain_p99 << "; frames " << std::setw(3) << w.frames
              << ": skin " << std::setw(3) << w.with_skin << " (" << w.skin_pairs << ") seen " << std::setw(3)
              << w.with_seen_skin << " drawn " << std::setw(3) << w.with_drawn_skin << " self "
              << std::setw(3) << w.with_self << " (" << w.self_pairs << ") layers " << std::setw(3)
              << w.with_layers << " props " << std::setw(3) << w.with_props << " off limb " << std::setw(3)
              << w.off_limb << std::endl;
}

std::vector<std::filesystem::path> recordings_in(const RecordingsOptions& options) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder))
        if (entry.is_directory() &&
            entry.path().filename().string().find(options.recording) != std::string::npos)
            out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    if (out.empty()) throw Failure(options.folder + ": holds no recordings");
    return out;
}

std::vector<std::filesystem::path> cooked_in(const std::string& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json") out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    if (out.empty()) throw Failure(folder + ": holds no garment files");
    return out;
}

/// What is drawn instead of the simulated mesh has linings and hidden layers that cross each other and the
/// skin as they were modelled: the simulated one is judged.
Garment as_simulated(vfit_context context, const std::filesystem::path& path) {
    Json file = Json::parse(read_text(path.string()));
    if (file.erase("drawn") > 0) file.erase("parts");
    const std::string bytes = file.dump();
    Garment garment;
    check(vfit_garment_load(context, bytes.data(), bytes.size(), garment.out()));
    return garment;
}

/// Every garment on the person of one recording, in the order of their names.
std::vector<std::unique_ptr<WornJudge>> judge_recording(vfit_context context,
                                                        const std::filesystem::path& path,
                                                        const RecordingsOptions& options) {
    const std::vector<std::string> names = !options.cooked.empty() ? std::vector<std::string>()
                                           : options.garment.empty()
                                               ? garment_names(context)
                                               : std::vector<std::string>{options.garment};
    FittingOptions chain;
    chain.source = path.string();
    if (!names.empty()) chain.garments = names.front();
    chain.hands = options.hands;
    chain.substeps = uint32_t(options.substeps);
    if (options.own_tracker) chain.scan.track.joints = chain.scan.track.user_map = VFIT_TRACK_BUILT_IN;
    Fitting fitting(context, chain);
    std::vector<std::unique_ptr<WornJudge>> judges;
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.flags = VFIT_CLOTH_SKIN | (options.hands ? 0u : uint32_t(VFIT_CLOTH_NO_HANDS));
    desc.self_thickness_m = kOwnLayers_m;
    desc.substeps = uint32_t(options.substeps);
    desc.carry_speed_m_s = options.carry_speed_m_s, desc.carry_way_m = options.carry_way_m;
    for (const std::string& name : names)
        judges.push_back(std::make_unique<WornJudge>(context, fitting.avatar(), name, desc));
    if (!options.cooked.empty())
        for (const auto& file : cooked_in(options.cooked))
            judges.push_back(std::make_unique<WornJudge>(fitting.avatar(), file.stem().string(),
                                                         as_simulated(context, file), desc));
    std::optional<CarriedProps> carried;
    if (options.props) {
        carried.emplace(context);
        for (const auto& judge : judges) carried->add_to(judge->outfit().cloths());
    }
    double last_s = -1.0;
    fitting.play([&](vfit_frame, double time_s) {
        const Welded skin = mesh_of(fitting.avatar());
        if (carried) carried->move(fitting.avatar(), time_s);
        for (const auto& judge : judges) {
            if (last_s < 0.0)
                judge->outfit().reset();
            else
                judge->outfit().step(float(time_s - last_s));
            judge->look(skin, time_s, !options.pictures.empty(), options.props);
        }
        last_s = time_s;
        return true;
    });
    return judges;
}

}  // namespace

void judge_recordings(const RecordingsOptions& options) {
    if (!options.pictures.empty()) create_folder(options.pictures);
    Json rows = Json::array();
    Samples strain_max, strain_p99, step_ms, skin_ms;
    size_t skin = 0, seen_skin = 0, drawn_skin = 0, self = 0, layers = 0, props = 0, off = 0, frames = 0,
           refused = 0;  // recordings
    for (const auto& path : recordings_in(options)) {
        const std::string recording = path.filename().string();
        const Context context = open_context();
        std::vector<std::unique_ptr<WornJudge>> judges;
        try {
            judges = judge_recording(context.get(), path, options);
        } catch (const Failure& failure) {
            std::cerr << recording << ": " << failure.what() << "\n";
            ++refused;
            continue;
        }
        std::vector<SheetItem> pictures;
        for (const auto& judge : judges) {
            const Worst& w = judge->worst();
            Json row = json_of(w);
            row["recording"] = recording, row["garment"] = judge->names();
            rows.push_back(std::move(row));
            if (!options.json) say(recording, judge->names(), w);
            frames += w.frames, skin += w.with_skin, self += w.with_self, layers += w.with_layers;
            props += w.with_props, off += w.off_limb, seen_skin += w.with_seen_skin,
                drawn_skin += w.with_drawn_skin;
            for (const float ms : judge->step_ms()) step_ms.add(ms);
            for (const float ms : judge->skin_ms()) skin_ms.add(ms);
            strain_max.add(w.strain_max), strain_p99.add(w.strain_p99);
            if (judge->worst_meshes().empty()) continue;
            constexpr PortraitStyle kStyle{300, 450, 1};
            char caption[80];
            std::snprintf(caption, sizeof caption, "%s, %.1f at %.1f s", judge->names().c_str(), w.strain_max,
                          w.at_s);
            for (const float yaw : {0.35f, 3.5f})
                pictures.push_back(
                    {draw_dressed(judge->worst_meshes(), centre_of(judge->worst_meshes()[0]), yaw, kStyle),
                     caption});
        }
        if (pictures.empty()) continue;
        std::vector<std::vector<SheetItem>> sheet(1);
        for (SheetItem& item : pictures) {
            if (sheet.back().size() == 8) sheet.emplace_back();
            sheet.back().push_back(std::move(item));
        }
        contact_sheet(recording + ": each garment where it is stretched most", sheet, 300)
            .write_png(options.pictures + "/" + recording + ".png");
    }
    if (rows.empty()) throw Failure(options.folder + ": no recording can be judged");
    Targets targets(options.json);
    if (!options.json)
        std::cout << "\n"
                  << rows.size() << " garments on recordings, " << frames << " frames after " << kSettled_s
                  << " s; a step of " << std::setprecision(1) << step_ms.quantile(0.5)
                  << " ms, 95 of 100 at most " << step_ms.quantile(0.95) << " ms; the skin below an outfit "
                  << skin_ms.quantile(0.5) << " ms, 95 of 100 at most " << skin_ms.quantile(0.95) << " ms\n";
    targets.judge("recordings that cannot be judged", double(refused), Aim::exactly, 0.0);
    targets.judge("frames in which cloth crosses the skin", double(skin), Aim::exactly, 0.0);
    targets.judge("frames in which it crosses skin that vfit_cloth_hide_skin() leaves", double(seen_skin),
                  Aim::exactly, 0.0);
    targets.judge("frames in which it crosses skin as vfit_outfit_skin() draws it", double(drawn_skin),
                  Aim::exactly, 0.0);
    targets.judge("frames in which cloth crosses itself", double(self), Aim::exactly, 0.0);
    targets.judge("frames in which layers cross", double(layers), Aim::exactly, 0.0);
    if (options.props)
        targets.judge("frames in which cloth crosses a prop", double(props), Aim::exactly, 0.0);
    targets.judge("frames with a sleeve or leg off its limb", double(off), Aim::exactly, 0.0);
    targets.judge("strain_max, worst", strain_max.quantile(1.0), Aim::at_most, 0.6, 2);
    targets.judge("strain_p99, worst", strain_p99.quantile(1.0), Aim::at_most, 0.2, 2);
    targets.judge("strain_max, median", strain_max.quantile(0.5), Aim::at_most, 0.6, 2);
    targets.judge("strain_p99, median", strain_p99.quantile(0.5), Aim::at_most, 0.2, 2);
    if (options.json)
        print_document({{"rows", rows},
                        {"frames", frames},
                        {"step_ms", step_ms.json()},
                        {"skin_ms", skin_ms.json()},
                        {"targets", targets.json()}});
}

}  // namespace vfit::tools
