// Reads the design of a garment.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "anthropometry/measure_keys.h"
#include "cook/draft/draft.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

/// One object of the file: reads its fields by name and in the end finds those that nobody asked for.
class DesignObject {
public:
    DesignObject(const Json& json, std::string name) : json_(json), name_(std::move(name)) {
        if (!json.is_object())
            fail(VFIT_ERROR_DATA, "design: ", name_.empty() ? "the file" : name_, " is not a JSON object");
    }

    bool has(const char* key) const { return json_.contains(key); }

    float number(const char* key, float low, float high) {
        const Json& value = field(key);
        if (!value.is_number()) fail(VFIT_ERROR_DATA, "design: ", path(key), " is not a number");
        return in_range(value.get<float>(), path(key), low, high);
    }
    float number_or(const char* key, float otherwise, float low, float high) {
        return has(key) ? number(key, low, high) : otherwise;
    }

    std::string word(const char* key) {
        const Json& value = field(key);
        if (!value.is_string() || value.get_ref<const std::string&>().empty())
            fail(VFIT_ERROR_DATA, "design: ", path(key), " is not a text");
        return value.get<std::string>();
    }
    /// The place of the word in the list.
    size_t choice(const char* key, std::initializer_list<std::string_view> words) {
        const std::string value = word(key);
        const auto it = std::find(words.begin(), words.end(), value);
        if (it != words.end()) return size_t(it - words.begin());
        std::string all;
        for (const std::string_view w : words) all += (all.empty() ? "" : ", ") + std::string(w);
        fail(VFIT_ERROR_DATA, "design: ", path(key), " must be one of ", all, ", is ", value);
    }

    LevelShare level(const char* key, BodyLevel highest) {
        const Json& value = field(key);
        if (!value.is_array() || value.size() != 3 || !value[0].is_string() || !value[1].is_string() ||
            !value[2].is_number())
            fail(VFIT_ERROR_DATA, "design: ", path(key), " is not of the form [\"hip\", \"knee\", 0.5]");
        LevelShare out;
        out.from = body_level(value[0].get<std::string>(), key);
        out.to = body_level(value[1].get<std::string>(), key);
        out.share = in_range(value[2].get<float>(), path(key), -0.5f, 1.5f);
        if (out.from >= out.to)
            fail(VFIT_ERROR_DATA, "design: ", path(key), " must go from a level down to a lower one");
        if (out.from < highest)
            fail(VFIT_ERROR_DATA, "design: ", path(key), " must not start at the ",
                 value[0].get<std::string>());
        return out;
    }

    const Json& field(const char* key) {
        const auto it = json_.find(key);
        if (it == json_.end()) fail(VFIT_ERROR_DATA, "design: ", path(key), " is missing");
        asked_.push_back(key);
        return *it;
    }

    /// A misspelt field that may be left out would otherwise do nothing and say nothing.
    void no_others() const {
        for (const auto& [key, value] : json_.items())
            if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
                fail(VFIT_ERROR_DATA, "design: ", path(key.c_str()), " is no field of a design");
    }

private:
    std::string path(const char* key) const { return text('"', name_, name_.empty() ? "" : ".", key, '"'); }
    static float in_range(float value, const std::string& path, float low, float high) {
        if (!(value >= low && value <= high))
            fail(VFIT_ERROR_DATA, "design: ", path, " must be ", low, " to ", high, ", is ", value);
        return value;
    }
    BodyLevel body_level(const std::string& word, const char* key) const {
        if (word == "waist") return BodyLevel::waist;
        if (word == "hip") return BodyLevel::hip;
        if (word == "knee") return BodyLevel::knee;
        if (word == "ankle") return BodyLevel::ankle;
        fail(VFIT_ERROR_DATA, "design: ", path(key), " names the unknown level ", word);
    }

    const Json& json_;
    std::string name_;
    std::vector<std::string> asked_;
};

// Ranges: what a garment can have at all; beyond them lies a slip of the unit.
constexpr float kMostEase_m = 0.6f,
                kLeastEase_m = -0.15f;  // knitted and stretch fabrics are cut smaller than the body

constexpr float kLeastStrip_m = 0.015f;  // of bands and collars: a row of triangles

TorsoDesign read_torso(const Json& json) {
    DesignObject o(json, "torso");
    TorsoDesign t;
    t.front = TorsoDesign::Front(o.choice("front", {"whole", "closed", "open"}));
    if (o.has("back")) t.back_seam = o.choice("back", {"whole", "seamed"}) == 1;
    t.chest_ease_m = o.number("chest_ease_m", kLeastEase_m, kMostEase_m);
    t.waist_ease_m = o.number("waist_ease_m", kLeastEase_m, kMostEase_m);
    t.length_ease_m = o.number_or("length_ease_m", 0.0f, -0.03f, 0.1f);
    if (o.has("hem")) {
        t.hem = o.level("hem", BodyLevel::waist);
        t.hip_ease_m = o.number("hip_ease_m", kLeastEase_m, kMostEase_m);
        t.flare = o.number_or("flare", 0.0f, 0.0f, 1.0f);
    }
    t.neck_width_m = o.number_or("neck_width_m", 0.0f, 0.0f, 0.15f);
    t.neck_depth_m = o.number_or("neck_depth_m", 0.0f, -0.03f, 0.4f);
    t.back_neck_depth_m = o.number_or("back_neck_depth_m", 0.0f, -0.02f, 0.3f);
    if (o.has("neck")) t.v_neck = o.choice("neck", {"round", "v"}) == 1;
    t.collar_height_m = o.number_or("collar_height_m", 0.0f, 0.0f, 0.12f);
    if (t.collar_height_m > 0.0f && t.collar_height_m < kLeastStrip_m)
        fail(VFIT_ERROR_DATA, "design: \"torso.collar_height_m\" must be 0 or at least ", kLeastStrip_m,
             ", is ", t.collar_height_m);
    if (t.collar_height_m > 0.0f && (t.v_neck || t.front == TorsoDesign::Front::open))
        fail(VFIT_ERROR_DATA,
             "design: \"torso.collar_height_m\" wants a round neck and a front that is not open");
    t.shoulder = o.number_or("shoulder", 1.0f, 0.4f, 1.6f);
    t.armhole_drop_m = o.number_or("armhole_drop_m", 0.0f, -0.02f, 0.2f);
    t.bust_dart = o.number_or("bust_dart", 0.0f, 0.0f, 1.0f);
    t.waist_dart = o.number_or("waist_dart", 0.0f, 0.0f, 1.0f);
    if (t.waist_dart > 0.0f && t.hem)
        fail(VFIT_ERROR_DATA,
             "design: \"torso.waist_dart\" wants a torso that ends at the waist, without \"torso.hem\"");
    o.no_others();
    return t;
}

SleeveDesign read_sleeve(const Json& json) {
    DesignObject o(json, "sleeve");
    SleeveDesign s;
    s.length = o.number("length", 0.15f, 1.3f);
    s.width_ease_m = o.number("width_ease_m", 0.0f, kMostEase_m);
    s.hem_ease_m = o.number("hem_ease_m", 0.0f, kMostEase_m);
    s.cap_ease = o.number_or("cap_ease", 0.0f, 0.0f, 0.04f);
    o.no_others();
    return s;
}

SkirtDesign read_skirt(const Json& json) {
    DesignObject o(json, "skirt");
    SkirtDesign s;
    s.hip_ease_m = o.number("hip_ease_m", 0.0f, 2.0f);
    s.hem = o.level("hem", BodyLevel::hip);
    s.flare = o.number_or("flare", 0.0f, 0.0f, 1.0f);
    o.no_others();
    return s;
}

TrousersDesign read_trousers(const Json& json) {
    DesignObject o(json, "trousers");
    TrousersDesign t;
    t.waist_ease_m = o.number("waist_ease_m", kLeastEase_m, kMostEase_m);
    t.hip_ease_m = o.number("hip_ease_m", kLeastEase_m, kMostEase_m);
    t.rise = o.number_or("rise", 0.0f, 0.0f, 0.6f);
    t.crotch_ease_m = o.number_or("crotch_ease_m", 0.01f, -0.02f, 0.25f);
    t.fork = o.number_or("fork", 0.16f, 0.1f, 0.3f);
    t.knee_ease_m = o.number("knee_ease_m", 0.0f, kMostEase_m);
    t.hem_ease_m = o.number("hem_ease_m", 0.0f, kMostEase_m);
    t.hem = o.level("hem", BodyLevel::knee);
    t.dart = o.number_or("dart", 0.0f, 0.0f, 0.6f);
    t.band_height_m = o.number_or("band_height_m", 0.0f, 0.0f, 0.15f);
    t.gather = o.number_or("gather", 0.0f, 0.0f, 1.0f);
    if (t.band_height_m > 0.0f && t.band_height_m < kLeastStrip_m)
        fail(VFIT_ERROR_DATA, "design: \"trousers.band_height_m\" must be 0 or at least ", kLeastStrip_m,
             ", is ", t.band_height_m);
    if (t.gather > 0.0f && t.band_height_m == 0.0f)
        fail(VFIT_ERROR_DATA, "design: \"trousers.gather\" wants a waistband, \"trousers.band_height_m\"");
    o.no_others();
    return t;
}

void read_sizes(DesignObject& root, GarmentDesign& design) {
    const Json& sizes = root.field("sizes");
    if (!sizes.is_array() || sizes.empty()) fail(VFIT_ERROR_DATA, "design: \"sizes\" is not a list of sizes");
    for (const Json& entry : sizes) {
        DesignObject o(entry, "sizes");
        const std::string label = o.word("label");
        if (std::find(design.labels.begin(), design.labels.end(), label) != design.labels.end())
            fail(VFIT_ERROR_DATA, "design: size ", label, " occurs twice");
        std::vector<Measurement> girths;
        for (const char* key : {"chest_girth_m", "waist_girth_m", "hip_girth_m"})
            if (o.has(key) || std::string_view(key) != "hip_girth_m")
                girths.push_back({key, DesignObject(entry, "size " + label).number(key, 0.4f, 2.5f)});
        for (const Measurement& m : girths) o.field(m.key.c_str());
        o.no_others();
        design.labels.push_back(label);
        design.girths.push_back(std::move(girths));
    }
}

}  // namespace

GarmentDesign parse_design(std::span<const std::byte> json) {
    const Json file = parse_json(json, "design");
    DesignObject root(file, "");
    if (root.word("format") != "vfit-design") fail(VFIT_ERROR_DATA, "design: format is not \"vfit-design\"");
    if (root.number("version", 1.0f, 1e6f) != 1.0f) fail(VFIT_ERROR_VERSION, "design: version is not 1");

    GarmentDesign design;
    design.name = root.word("name");
    design.kind = root.word("kind");
    if (root.has("size_chart")) design.size_chart = root.word("size_chart");
    design.fabric = root.word("fabric");
    design.sex = root.choice("body_sex", {"f", "m"}) == 0 ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    if (root.has("color")) {
        const Json& color = root.field("color");
        if (!color.is_array() || color.size() != 3)
            fail(VFIT_ERROR_DATA, "design: \"color\" is not three numbers");
        for (size_t i = 0; i < 3; ++i) {
            if (!color[i].is_number() || !(color[i].get<float>() >= 0.0f && color[i].get<float>() <= 1.0f))
                fail(VFIT_ERROR_DATA, "design: \"color\" is not three numbers from 0 to 1");
            design.color[i] = color[i].get<float>();
        }
    }
    if (root.has("torso")) design.torso = read_torso(root.field("torso"));
    if (root.has("sleeve")) design.sleeve = read_sleeve(root.field("sleeve"));
    if (root.has("skirt")) design.skirt = read_skirt(root.field("skirt"));
    if (root.has("trousers")) design.trousers = read_trousers(root.field("trousers"));
    if (!design.torso && !design.trousers)
        fail(VFIT_ERROR_DATA, "design: it has neither \"torso\" nor \"trousers\"");
    if (design.sleeve && !design.torso) fail(VFIT_ERROR_DATA, "design: \"sleeve\" wants a \"torso\"");
    if (design.skirt && !design.torso) fail(VFIT_ERROR_DATA, "design: \"skirt\" wants a \"torso\"");
    if (design.skirt && design.trousers)
        fail(VFIT_ERROR_DATA, "design: \"skirt\" and \"trousers\" do not go together");
    if (design.torso) {
        const bool joined = design.skirt || design.trousers;
        if (joined == design.torso->hem.has_value())
            fail(VFIT_ERROR_DATA,
                 "design: \"torso.hem\" is wanted where nothing is sewn on at the waist, and only there");
        if (joined && design.torso->front == TorsoDesign::Front::open)
            fail(VFIT_ERROR_DATA, "design: \"torso.front\" must not be open above \"skirt\" or \"trousers\"");
        if (design.trousers && (design.trousers->band_height_m > 0.0f || design.trousers->rise > 0.0f ||
                                design.trousers->dart > 0.0f || design.torso->waist_dart > 0.0f))
            fail(VFIT_ERROR_DATA,
                 "design: \"torso\" and \"trousers\" join at the waist: no band, no rise, no darts there");
    }
    read_sizes(root, design);
    root.no_others();
    return design;
}

}  // namespace vfit
