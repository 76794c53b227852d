// vfit wear: garments on a body, side by side: outfits, sizes, how they sit.
#include <algorithm>
#include <iostream>
#include <optional>

#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "client/shape_option.h"
#include "commands/commands.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr size_t kLongestCaption = 36;  // characters that fit below a picture

struct Options {
    std::string outfits, sizes, shape, sex = "f", out;
    bool json = false, draft = false;
};

const char* word_of(vfit_fit fit) {
    return fit == VFIT_FIT_TIGHT ? "tight" : fit == VFIT_FIT_LOOSE ? "loose" : "right";
}

/// One body in an outfit of one size.
class Dressed {
public:
    Dressed(vfit_context context, const Options& options, const std::string& names, const std::string& size)
        : size_(size) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = sex_from(options.sex);
        const auto shape = shape_values(options.shape);
        check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                            uint32_t(shape.size()), avatar_.out()));
        stand(avatar_.get(), 0.08f);
        vfit_cloth_desc cloth = vfit_cloth_desc_init();
        cloth.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_PRESSURE;
        cloth.self_thickness_m = kOwnLayers_m;
        cloth.substeps = kSubstepsAtRest;
        cloth.size_label = size.empty() ? nullptr : size.c_str();
        outfit_.emplace(context, avatar_.get(), names, cloth);
    }

    void settle() { outfit_->settle(); }

    std::string warning() const { return outfit_->warning(); }

    Json fit() const {
        Json out = Json::array();
        for (const Layer& layer : outfit_->layers()) {
            Json zones = Json::object();
            for (const vfit_fit_zone& z : list<vfit_fit_zone>([&](auto* items, uint32_t stride, uint32_t* n) {
                     return vfit_cloth_fit(layer.cloth.get(), items, stride, n);
                 }))
                zones[z.key] = {{"fit", word_of(z.fit)},    {"body_m", z.body_m},
                                {"garment_m", z.garment_m}, {"ease_m", z.ease_m},
                                {"strain", z.strain},       {"pressure_pa", z.pressure_pa}};
            out.push_back({{"garment", layer.name},
                           {"size", size_.empty() ? Json("made to measure") : Json(size_)},
                           {"zones", zones}});
        }
        return out;
    }

    Canvas draw(FitMap map, float yaw, const PortraitStyle& style) const {
        const auto meshes = dressed_meshes(avatar_.get(), drawn(*outfit_), map);
        return draw_dressed(meshes, centre_of(meshes[0]), yaw, style);
    }

private:
    std::string size_;
    Avatar avatar_;
    std::optional<WornOutfit> outfit_;
};

/// "shirt_men, M:  chest right (ease 9.1 cm)".
void print_fit(const Json& fit) {
    for (const Json& garment : fit) {
        std::cout << garment["garment"].get<std::string>() << ", " << garment["size"].get<std::string>()
                  << ":";
        for (const auto& [key, zone] : garment["zones"].items()) {
            char text[96];
            std::snprintf(text, sizeof text, "  %s %s (ease %.1f cm)", key.substr(0, key.find('_')).c_str(),
                          zone["fit"].get<std::string>().c_str(), 100.0 * zone["ease_m"].get<double>());
            std::cout << text;
        }
        std::cout << "\n";
    }
}

void wear(const Options& options) {
    const Context context = open_context();
    create_folder(options.out);
    const PortraitStyle style = options.draft ? kDraftPortrait : kFinePortrait;
    Json report = Json::array();
    std::vector<std::vector<SheetItem>> rows(4);
    std::string warnings;
    for (const std::string& names : split(options.outfits, ','))
        for (const std::string& size : split(options.sizes, ',')) {
            const std::string caption = names + (size.empty() ? ", made to measure" : ", " + size);
            const std::string label = size.empty() ? "made to measure" : "size " + size;
            std::optional<Dressed> dressed;
            try {
                dressed.emplace(context.get(), options, names, size);
            } catch (const NotWearable& refused) {
                report.push_back({{"outfit", names}, {"size", size}, {"not_wearable", refused.what()}});
                if (!options.json) std::cout << caption << ": " << refused.what() << "\n";
                continue;
            }
            dressed->settle();
            const Json fit = dressed->fit();
            const std::string warning = dressed->warning();
            report.push_back(
                {{"outfit", names}, {"size", size}, {"torn", !warning.empty()}, {"garments", fit}});
            if (!warning.empty()) warnings += (warnings.empty() ? "" : "; ") + warning;
            if (!options.json) print_fit(fit);
            rows[0].push_back({dressed->draw(FitMap::none, 0.35f, style), names.substr(0, kLongestCaption)});
            rows[1].push_back({dressed->draw(FitMap::none, 3.5f, style), label});
            rows[2].push_back({dressed->draw(FitMap::fit, 0.35f, style), "fit: red tight, blue loose"});
            rows[3].push_back({dressed->draw(FitMap::fit, 3.5f, style), "from behind"});
        }
    if (!rows[0].empty())
        contact_sheet(warned(options.outfits, warnings), rows, style.width)
            .write_png(options.out + "/worn.png");
    const Json document = {{"sex", options.sex}, {"shape", options.shape}, {"outfits", report}};
    write_text(options.out + "/worn.json", document_text(document));
    if (options.json)
        print_document(document);
    else
        std::cout << "in " << options.out << ": worn.json" << (rows[0].empty() ? "" : ", worn.png") << "\n"
                  << warnings << (warnings.empty() ? "" : "\n");
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
