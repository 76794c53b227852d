// vfit wear: garments on a body, side by side: outfits, sizes, how they sit.
#include <algorithm>
#include <iostream>

#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr PortraitStyle kFine{420, 640, 3}, kDraft{280, 420, 1};
constexpr float kFrame_s = 1.0f / 60.0f, kOwnLayers_m = 0.004f;
constexpr int kFramesToRest = 90;
constexpr uint32_t kSubsteps = 32;      // of 1/60 s: with few, cloth sags
constexpr size_t kLongestCaption = 36;  // characters that fit below a picture

struct Options {
    std::string outfits, sizes, shape, sex = "f", out;
    bool json = false, draft = false;
};

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// "height=0.7,weight=1".
std::vector<vfit_shape_value> shape_of(const std::string& text) {
    std::vector<vfit_shape_value> values;
    if (text.empty()) return values;
    for (const std::string& part : split(text, ',')) {
        const auto parts = split(part, '=');
        vfit_shape_value v = vfit_shape_value_init();
        char* end = nullptr;
        if (parts.size() == 2) v.value = std::strtof(parts[1].c_str(), &end);
        if (parts.size() != 2 || parts[0].size() >= sizeof v.key || !end || end == parts[1].c_str() || *end)
            throw Failure("--shape: \"" + part + "\" is not KEY=NUMBER");
        std::snprintf(v.key, sizeof v.key, "%s", parts[0].c_str());
        values.push_back(v);
    }
    return values;
}

const char* word_of(vfit_fit fit) {
    return fit == VFIT_FIT_TIGHT ? "tight" : fit == VFIT_FIT_LOOSE ? "loose" : "right";
}

/// One body in garments that are worn over each other.
class Outfit {
public:
    Outfit(vfit_context context, const Options& options, const std::string& names, const std::string& size)
        : size_(size) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = sex_from(options.sex);
        const auto shape = shape_of(options.shape);
        check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                            uint32_t(shape.size()), avatar_.out()));
        stand(avatar_.get(), 0.08f);
        for (const std::string& name : split(names, '+')) put_on(context, name);
    }

    /// Empty: it is worn. Else why it cannot be.
    const std::string& refused() const { return refused_; }

    void settle() {
        for (int i = 0; i < kFramesToRest; ++i)
            for (const Cloth& cloth : cloths_) check(vfit_cloth_step(cloth.get(), kFrame_s));
    }

    Json fit() const {
        Json out = Json::array();
        for (size_t i = 0; i < cloths_.size(); ++i) {
            Json zones = Json::object();
            for (const vfit_fit_zone& z : list<vfit_fit_zone>([&](auto* items, uint32_t stride, uint32_t* n) {
                     return vfit_cloth_fit(cloths_[i].get(), items, stride, n);
                 }))
                zones[z.key] = {{"fit", word_of(z.fit)},    {"body_m", z.body_m},
                                {"garment_m", z.garment_m}, {"ease_m", z.ease_m},
                                {"strain", z.strain},       {"pressure_pa", z.pressure_pa}};
            out.push_back({{"garment", names_[i]},
                           {"size", size_.empty() ? Json("made to measure") : Json(size_)},
                           {"zones", zones}});
        }
        return out;
    }

    Canvas draw(FitMap map, float yaw, const PortraitStyle& style) const {
        std::vector<RenderMesh> meshes{dressed_meshes(avatar_.get(), cloths_[0].get(), map)[0]};
        if (cloths_.size() > 1) meshes[0] = dressed_meshes(avatar_.get(), vfit_cloth{}, map)[0];
        for (size_t i = 0; i < cloths_.size(); ++i) {
            RenderMesh mesh = dressed_meshes(avatar_.get(), cloths_[i].get(), map)[1];
            if (map == FitMap::none) paint(garments_[i].get(), mesh);
            meshes.push_back(std::move(mesh));
        }
        return draw_dressed(meshes, centre_of(meshes[0]), yaw, style);
    }

private:
    void put_on(vfit_context context, const std::string& name) {
        garments_.push_back(open_garment(context, name));
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_PRESSURE;
        desc.self_thickness_m = kOwnLayers_m;
        desc.substeps = kSubsteps;
        desc.size_label = size_.empty() ? nullptr : size_.c_str();
        Cloth cloth;
        const vfit_result made = vfit_cloth_create(avatar_.get(), garments_.back().get(), &desc, cloth.out());
        if (made == VFIT_ERROR_NOT_WEARABLE) {
            refused_ = last_error();
            return;
        }
        check(made);
        for (const Cloth& inner : cloths_) check(vfit_cloth_wear_over(cloth.get(), inner.get()));
        if (!cloths_.empty()) check(vfit_cloth_reset(cloth.get()));
        cloths_.push_back(std::move(cloth));
        names_.push_back(name);
    }

    static void paint(vfit_garment garment, RenderMesh& mesh) {
        mesh.vertex_colors.assign(mesh.positions.size(), mesh.color);
        for (const vfit_garment_part& part :
             list<vfit_garment_part>([&](auto* items, uint32_t stride, uint32_t* n) {
                 return vfit_garment_parts(garment, items, stride, n);
             }))
            for (uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
                mesh.vertex_colors[mesh.indices[i]] = {part.color[0], part.color[1], part.color[2]};
    }

    std::string size_, refused_;
    Avatar avatar_;
    std::vector<Garment> garments_;
    std::vector<Cloth> cloths_;
    std::vector<std::string> names_;
};

void wear(const Options& options) {
    const Context context = open_context();
    create_folder(options.out);
    const PortraitStyle style = options.draft ? kDraft : kFine;
    Json report = Json::array();
    std::vector<std::vector<SheetItem>> rows(4);
    for (const std::string& names : split(options.outfits, ','))
        for (const std::string& size : split(options.sizes, ',')) {
            Outfit outfit(context.get(), options, names, size);
            const std::string caption = names + (size.empty() ? ", made to measure" : ", " + size);
            const std::string label = size.empty() ? "made to measure" : "size " + size;
            if (!outfit.refused().empty()) {
                report.push_back({{"outfit", names}, {"size", size}, {"not_wearable", outfit.refused()}});
                if (!options.json) std::cout << caption << ": " << outfit.refused() << "\n";
                continue;
            }
            outfit.settle();
            const Json fit = outfit.fit();
            report.push_back({{"outfit", names}, {"size", size}, {"garments", fit}});
            if (!options.json)
                for (const Json& garment : fit) {
                    std::cout << garment["garment"].get<std::string>() << ", "
                              << garment["size"].get<std::string>() << ":";
                    for (const auto& [key, zone] : garment["zones"].items()) {
                        char text[96];
                        std::snprintf(
                            text, sizeof text, "  %s %s (ease %.1f cm)", key.substr(0, key.find('_')).c_str(),
                            zone["fit"].get<std::string>().c_str(), 100.0 * zone["ease_m"].get<double>());
                        std::cout << text;
                    }
                    std::cout << "\n";
                }
            rows[0].push_back({outfit.draw(FitMap::none, 0.35f, style), names.substr(0, kLongestCaption)});
            rows[1].push_back({outfit.draw(FitMap::none, 3.5f, style), label});
            rows[2].push_back({outfit.draw(FitMap::fit, 0.35f, style), "fit: red tight, blue loose"});
            rows[3].push_back({outfit.draw(FitMap::fit, 3.5f, style), "from behind"});
        }
    if (!rows[0].empty())
        contact_sheet(options.outfits, rows, style.width).write_png(options.out + "/worn.png");
    const Json document = {{"sex", options.sex}, {"shape", options.shape}, {"outfits", report}};
    write_text(options.out + "/worn.json", document_text(document));
    if (options.json)
        print_document(document);
    else
        std::cout << "in " << options.out << ": worn.json" << (rows[0].empty() ? "" : ", worn.png") << "\n";
}

}  // namespace

void add_wear(Command& app) {
    Command command =
        app.add_subcommand("wear", "Garments on a body, side by side: outfits, sizes, how they sit");
    auto o = std::make_shared<Options>();
    command.add_option("outfits", o->outfits, "Garments by name or file; A+B: B over A; A,B: side by side")
        .required();
    command.add_option("--size", o->sizes, "Labels, side by side: S,M,L (default: made to measure)");
    command.add_option("--sex", o->sex, "Whose default body: f, m or unknown").one_of({"f", "m", "unknown"});
    command.add_option("--shape", o->shape, "Of the body: height=0.7,weight=1 (docs/virtual-person.md)");
    command.add_option("--out", o->out, "Folder for worn.png and worn.json").required();
    command.add_flag("--draft", o->draft, "Small, grainy pictures in a tenth of the time");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { wear(*o); });
}

}  // namespace vfit::tools
