// vfit alter: what a tailor changes of a garment so that it sits on a body as its size was drawn to sit.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>

#include "client/alteration.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "client/shape_option.h"
#include "commands/commands.h"
#include "picture/contact_sheet.h"
#include "picture/dressed_picture.h"

namespace vfit::tools {

namespace {

constexpr float kWorthIt_m = 0.01f;  // of a girth: no tailor moves a seam for less
constexpr float kSeams_m = 0.03f;    // of a girth: the cloth that seams have to be let out
constexpr float kSame_m = 0.002f;
constexpr int kRounds = 5;
// Of stature: mean heights of chest, natural waist and buttocks of ANSUR II. Panels become wider or narrower
// there; the girths themselves are measured by vfit_cloth_fit.
const std::map<std::string, float> kLevels = {
    {"chest_girth_m", 0.72f}, {"waist_girth_m", 0.63f}, {"hip_girth_m", 0.51f}};

struct Options {
    std::string garment, size, shape, sex = "f", ease, out;
    bool json = false, draft = false;
};

/// The avatar in one size of the garment, at rest.
class Fitted {
public:
    Fitted(vfit_context context, vfit_avatar avatar, const Json& file, const std::string& name,
           const std::string& label)
        : avatar_(avatar) {
        const std::string bytes = file.dump();
        std::vector<Garment> garments(1);
        check(vfit_garment_load(context, bytes.data(), bytes.size(), garments[0].out()));
        vfit_cloth_desc cloth = vfit_cloth_desc_init();
        cloth.flags = VFIT_CLOTH_SKIN | VFIT_CLOTH_PRESSURE | VFIT_CLOTH_ANY_FIT;
        cloth.self_thickness_m = kOwnLayers_m;
        cloth.substeps = kSubstepsAtRest;
        cloth.size_label = label.c_str();
        outfit_.emplace(avatar, std::move(garments), std::vector<std::string>{name}, cloth);
        outfit_->settle();
    }

    std::map<std::string, vfit_fit_zone> zones() const {
        std::map<std::string, vfit_fit_zone> out;
        for (const vfit_fit_zone& zone : list<vfit_fit_zone>([&](auto* items, uint32_t stride, uint32_t* n) {
                 return vfit_cloth_fit(outfit_->cloths().front(), items, stride, n);
             }))
            out[zone.key] = zone;
        return out;
    }
    vfit_cloth_stats stats() const {
        vfit_cloth_stats out = vfit_cloth_stats_init();
        check(vfit_cloth_describe(outfit_->cloths().front(), &out));
        return out;
    }
    Canvas draw(FitMap map, const PortraitStyle& style) const {
        const auto meshes = dressed_meshes(avatar_, drawn(*outfit_), map);
        return draw_dressed(meshes, centre_of(meshes[0]), 0.35f, style);
    }

private:
    vfit_avatar avatar_;
    std::optional<WornOutfit> outfit_;
};

/// One line of the ticket.
struct Change {
    std::string key;
    float body_m, garment_m, goal_m;  // garment_m before it; goal_m: that it should have
    float by_m() const { return goal_m - garment_m; }
};

/// "waist" of "waist_girth_m".
std::string place_of(const std::string& key) { return key.substr(0, key.find('_')); }

/// "chest=8,waist=10", in centimetres.
std::map<std::string, float> wanted_eases(const std::string& text) {
    std::map<std::string, float> out;
    if (text.empty()) return out;
    for (const std::string& item : split(text, ',')) {
        const size_t at = item.find('=');
        const std::string key = item.substr(0, at) + "_girth_m";
        char* end = nullptr;
        const float cm = at == std::string::npos ? NAN : std::strtof(item.c_str() + at + 1, &end);
        constexpr float kMost_cm = 100.0f;
        if (!kLevels.count(key) || !end || *end != 0 || !(std::abs(cm) <= kMost_cm))
            throw WrongUsage("--ease is a list as chest=8,waist=10,hip=6, in centimetres; \"" + item +
                             "\" is not");
        out[key] = cm / 100.0f;
    }
    return out;
}

/// A body's girth less that of the label is what the cloth has too little. Where the size tells of no such
/// girth, its seams are moved as at the others, or until it is not tight.
std::vector<Change> changes_of(const std::map<std::string, vfit_fit_zone>& zones, const Json& size,
                               const std::map<std::string, float>& wanted) {
    std::map<std::string, float> by;
    float sum = 0.0f;
    for (const auto& [key, zone] : zones) {
        if (zone.opening_m > 0.0f) continue;  // it is as wide as it is worn
        if (const auto ease = wanted.find(key); ease != wanted.end())
            by[key] = ease->second - zone.ease_m;
        else if (size.contains(key))
            by[key] = zone.body_m - size[key].get<float>();
        else
            continue;
        sum += by[key];
    }
    const float mean = by.empty() ? 0.0f : sum / float(by.size());
    std::vector<Change> out;
    for (const auto& [key, zone] : zones) {
        if (zone.opening_m > 0.0f) continue;
        const auto known = by.find(key);
        const float change = known != by.end() ? known->second : std::max(mean, -zone.ease_m);
        if (std::abs(change) >= kWorthIt_m)
            out.push_back({key, zone.body_m, zone.garment_m, zone.garment_m + change});
    }
    return out;
}

float stature_of(vfit_context context, const Json& garment) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = garment.at("body_sex") == "m" ? VFIT_SEX_MALE : VFIT_SEX_FEMALE;
    std::vector<vfit_shape_value> shape;
    if (garment.contains("body_shape"))
        for (const auto& [key, value] : garment["body_shape"].items()) {
            shape.push_back(vfit_shape_value_init());
            std::snprintf(shape.back().key, sizeof shape.back().key, "%s", key.c_str());
            shape.back().value = value.get<float>();
        }
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context, &desc, shape.data(), sizeof(vfit_shape_value),
                                        uint32_t(shape.size()), avatar.out()));
    Frame frame;
    check(vfit_avatar_acquire(avatar.get(), frame.out()));
    float top = 0.0f;
    for (const glm::vec3& p : items_of<glm::vec3>(frame.get(), VFIT_STREAM_POSITION))
        top = std::max(top, p.y);
    return top;
}

/// The factors of the zones by height; above the chest and below the hips they end.
std::vector<Widening> widenings_of(const std::map<std::string, float>& factors, float stature_m) {
    constexpr float kAbove_m = 0.12f, kBelow_m = 0.25f;
    std::vector<Widening> out;
    for (const auto& [key, factor] : factors) out.push_back({kLevels.at(key) * stature_m, factor});
    std::sort(out.begin(), out.end(),
              [](const Widening& a, const Widening& b) { return a.height_m < b.height_m; });
    out.insert(out.begin(), {out.front().height_m - kBelow_m, 1.0f});
    out.push_back({out.back().height_m + kAbove_m, 1.0f});
    return out;
}

double cm(float metres) { return std::round(double(metres) * 1000.0) / 10.0; }

std::string line_of(const Json& change) {
    std::ostringstream out;
    const double by = change["by_m"].get<double>() * 100.0;
    out << change["place"].get<std::string>() << ": "
        << (change.contains("ease_before_m") ? by < 0.0 ? "take in " : "let out " : "shorten by ")
        << std::round(std::abs(by) * 10.0) / 10.0 << " cm";
    if (change.contains("ease_before_m")) {
        out << " (ease " << cm(change["ease_before_m"].get<float>()) << " cm, then ";
        if (change["ease_after_m"].is_null())
            out << "its hem is too high to tell)";
        else
            out << cm(change["ease_after_m"].get<float>()) << " cm)";
    }
    if (change.value("beyond_seams", false))
        out << "; seams have about " << cm(kSeams_m) << " cm: a larger size is needed";
    return out.str();
}

void alter(const Options& options) {
    const std::map<std::string, float> wanted = wanted_eases(options.ease);
    const Context context = open_context();
    const std::string bytes = read_text(options.garment);
    Garment known;  // the library tells what is wrong with it
    if (vfit_garment_load(context.get(), bytes.data(), bytes.size(), known.out()) < 0)
        throw Failure(options.garment + ": " + last_error());
    const Json file = Json::parse(bytes);
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = sex_from(options.sex);
    const auto shape = shape_values(options.shape);
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context.get(), &body, shape.data(), sizeof(vfit_shape_value),
                                        uint32_t(shape.size()), avatar.out()));
    stand(avatar.get(), 0.08f);

    const std::string name = file.at("name").get<std::string>(), as = options.size + " altered";
    // Also where nothing is to be done: it says which sizes there are, and whether it has panels.
    altered(file, options.size, as, {{0.0f, 1.0f}});
    const auto is_size = [&](const Json& size) { return size["label"] == options.size; };
    const Json size = *std::find_if(file["sizes"].begin(), file["sizes"].end(), is_size);
    const Fitted before(context.get(), avatar.get(), file, name, options.size);
    const auto zones = before.zones();
    for (const auto& [key, ease] : wanted)
        if (!zones.count(key)) throw Failure(name + " does not go round the " + place_of(key));
    const std::vector<Change> changes = changes_of(zones, size, wanted);
    constexpr float kMin = 0.5f;  // of the body's girth
    for (const Change& change : changes)
        if (change.goal_m < kMin * change.body_m)
            throw Failure(name + ": at the " + place_of(change.key) +
                          " less than half of the body's girth would be left");

    // Girths that are not changed stay as wide as they are.
    std::map<std::string, float> factors, goals;
    for (const auto& [key, zone] : zones)
        if (kLevels.count(key) && zone.opening_m == 0.0f) factors[key] = 1.0f, goals[key] = zone.garment_m;
    for (const Change& change : changes) goals[change.key] = change.goal_m;
    Json out = file;
    std::optional<Fitted> after;
    std::map<std::string, vfit_fit_zone> now = zones;
    const float stature_m = stature_of(context.get(), file);
    for (int round = 0; round < kRounds && !changes.empty(); ++round) {
        float worst = 0.0f;
        for (auto& [key, factor] : factors) {
            if (!now.count(key) || now[key].opening_m > 0.0f) continue;  // it goes round it no more
            worst = std::max(worst, std::abs(goals[key] - now[key].garment_m));
            factor *= goals[key] / now[key].garment_m;
        }
        if (worst < kSame_m) break;
        out = altered(file, options.size, as, widenings_of(factors, stature_m));
        after.emplace(context.get(), avatar.get(), out, name, as);
        now = after->zones();
    }

    Json ticket = Json::array();
    for (const Change& change : changes) {
        const auto zone = now.find(change.key);
        ticket.push_back({{"place", place_of(change.key)},
                          {"by_m", change.by_m()},
                          {"ease_before_m", change.garment_m - change.body_m},
                          {"ease_goal_m", change.goal_m - change.body_m},
                          {"ease_after_m", zone == now.end() ? Json() : Json(zone->second.ease_m)},
                          {"beyond_seams", change.by_m() > kSeams_m}});
    }
    const vfit_cloth_stats stats = before.stats();
    for (const auto& [place, too_long] :
         {std::pair("sleeves", stats.sleeves_taken_up_m), std::pair("legs", stats.legs_taken_up_m)})
        if (too_long >= kWorthIt_m) ticket.push_back({{"place", place}, {"by_m", -too_long}});

    create_folder(options.out);
    const auto in_out = [&](const std::string& of) {
        return (std::filesystem::path(options.out) / of).string();
    };
    // By the file's name: the garment's own is what a stranger wrote into it.
    const std::string of = std::filesystem::path(options.garment).stem().string() + "_altered.json";
    const std::string altered_file = changes.empty() ? "" : in_out(of);
    if (!changes.empty()) replace_text(altered_file, out.dump());
    const Json document = {{"garment", name},        {"size", options.size}, {"sex", options.sex},
                           {"shape", options.shape}, {"changes", ticket},    {"altered", altered_file}};
    replace_text(in_out("ticket.json"), document_text(document));
    std::string text = name + ", size " + options.size + "\n";
    for (const Json& change : ticket) text += "  " + line_of(change) + "\n";
    if (ticket.empty()) text += "  nothing to change\n";
    replace_text(in_out("ticket.txt"), text);
    const PortraitStyle style = options.draft ? kDraftPortrait : kFinePortrait;
    std::vector<std::vector<SheetItem>> rows(2);
    std::vector<const Fitted*> both{&before};
    if (after) both.push_back(&*after);
    for (const Fitted* fitted : both) {
        rows[0].push_back({fitted->draw(FitMap::none, style), fitted == &before ? "as it is" : "altered"});
        rows[1].push_back({fitted->draw(FitMap::fit, style), "fit: red tight, blue loose"});
    }
    contact_sheet(text, rows, style.width).write_png(in_out("ticket.png"));
    if (options.json)
        print_document(document);
    else
        std::cout << text << "in " << options.out << ": ticket.txt, ticket.json, ticket.png"
                  << (changes.empty() ? "" : ", " + of + " (size \"" + as + "\")") << "\n";
}

}  // namespace

void add_alter(Command& app) {
    Command command = app.add_subcommand(
        "alter",
        "What a tailor changes of a garment for a body: a ticket, a picture and the altered garment");
    auto o = std::make_shared<Options>();
    command.add_option("garment", o->garment, "Garment file with flat panels (docs/garments.md)").required();
    command.add_option("--size", o->size, "Label of the size that is altered").required();
    command.add_option("--sex", o->sex, "Whose default body: f, m or unknown").one_of({"f", "m", "unknown"});
    command.add_option("--shape", o->shape, "Of the body: height=0.7,weight=1 (docs/virtual-person.md)");
    command.add_option(
        "--ease", o->ease,
        "Ease that is wanted, in cm: chest=8,waist=10,hip=6 (default: as the size was drawn for "
        "its own girths)");
    command
        .add_option("--out", o->out, "Folder for ticket.txt, ticket.json, ticket.png and the altered garment")
        .required();
    command.add_flag("--draft", o->draft, "Small, grainy pictures in a tenth of the time");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { alter(*o); });
}

}  // namespace vfit::tools
