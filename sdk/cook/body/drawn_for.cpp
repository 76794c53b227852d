#include "cook/body/drawn_for.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "anthropometry/measure_keys.h"
#include "anthropometry/profile.h"
#include "avatar/avatar_measures.h"
#include "cook/body/body_outline.h"
#include "core/error.h"

namespace vfit {

namespace {

// A tape's own error. Levels are softer: a pattern hangs from its shoulders or its waist, and reaches a
// little further up or down.
constexpr double kGirth_m = 0.004, kStature_m = 0.005, kLength_m = 0.008, kLevel_m = 0.012;

double tolerance_of(const std::string& key) {
    return key == "stature_m" ? kStature_m : key.ends_with("_girth_m") ? kGirth_m : kLength_m;
}

/// GarmentCode's names (its "Body Measurements" sheet), and what they are here.
struct GarmentCodeMeasure {
    const char *name, *key;
};
constexpr GarmentCodeMeasure kGarmentCode[] = {{"height", "stature_m"},
                                               {"bust", "chest_girth_m"},
                                               {"underbust", "underbust_girth_m"},
                                               {"hips", "hip_girth_m"},
                                               {"waist", "waist_minimum_girth_m"},
                                               {"leg_circ", "thigh_girth_m"},
                                               {"arm_length", "arm_length_m"},
                                               {"shoulder_w", "biacromial_breadth_m"}};
// Their shoulders end where a sleeve begins: 34.7 and 38.5 cm of mean people whose acromia are 36.7 and 41.1
// apart (ANSUR II).
constexpr double kAcromiaOverShoulders = 1.062;

std::string_view trimmed(std::string_view s) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!s.empty() && is_space(s.front())) s.remove_prefix(1);
    while (!s.empty() && is_space(s.back())) s.remove_suffix(1);
    return s;
}

/// "name: number" in every line, below "body:" or without it.
std::map<std::string, double> parse_flat_yaml(std::string_view text) {
    std::map<std::string, double> out;
    size_t line_number = 0;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line_number;
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty() || line == "---" || line == "body:") continue;
        const size_t colon = line.find(':');
        const std::string_view name = trimmed(line.substr(0, colon)),
                               value = colon == line.npos ? "" : trimmed(line.substr(colon + 1));
        double number = 0.0;
        const auto [read_to, error] = std::from_chars(value.data(), value.data() + value.size(), number);
        if (name == "body_sample") continue;  // the name of a mesh
        if (error != std::errc() || read_to != value.data() + value.size() || !std::isfinite(number))
            fail(VFIT_ERROR_DATA, "measures: line ", line_number, " is not \"name: number\"");
        out[std::string(name)] = number;
    }
    return out;
}

DrawnFor of_garmentcode(const std::map<std::string, double>& sheet) {
    constexpr double kMetres = 0.01;
    DrawnFor out;
    const auto value = [&](const char* name) {
        const auto it = sheet.find(name);
        return it == sheet.end() ? std::nullopt : std::optional(it->second * kMetres);
    };
    for (const auto& [name, key] : kGarmentCode)
        if (const auto v = value(name)) {
            const MeasureKey& range = measure_keys()[size_t(measure_index(key))];
            if (!(*v >= double(range.smallest) && *v <= double(range.largest)))
                fail(VFIT_ERROR_DATA, "measures: ", name, ": ", *v / kMetres,
                     " is no person's in centimetres");
            const double share =
                key == std::string_view("biacromial_breadth_m") ? kAcromiaOverShoulders : 1.0;
            out.wanted.push_back({key, share * *v, tolerance_of(key)});
        }
    const auto height = value("height"), head = value("head_l"), waist = value("waist_line"),
               hips = value("hips_line");
    if (!height || !value("waist") || !value("hips"))
        fail(VFIT_ERROR_DATA, "measures: \"height\", \"waist\" and \"hips\" have to be told");
    // Women's breasts make their bust 17 % larger than the girth below it, men's chest is 10 % larger (mean
    // bodies of GarmentCode).
    constexpr double kWomansBust = 0.13;
    if (const auto bust = value("bust"), below = value("underbust"); bust && below)
        out.sex = (*bust - *below) / *bust > kWomansBust ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    if (!head) return out;
    out.wanted.push_back({kNapeLevel, *height - *head, kLevel_m});
    if (waist) out.wanted.push_back({kWaistLevel, *height - *head - *waist, kLevel_m});
    if (waist && hips) out.wanted.push_back({kHipLevel, *height - *head - *waist - *hips, kLevel_m});
    return out;
}

DrawnFor of_profile(std::string_view json) {
    const PersonProfile profile = parse_profile(json);
    DrawnFor out;
    out.sex = profile.sex;
    for (const Measurement& m : profile.measurements)
        if (measure_index(m.key) >= 0 && !is_mass(m.key))
            out.wanted.push_back({m.key, double(m.value), std::max(tolerance_of(m.key), double(m.sigma))});
    if (out.wanted.empty()) fail(VFIT_ERROR_DATA, "measures: none of a tape is among them");
    return out;
}

std::vector<FreeShape> free_shapes() {
    std::vector<FreeShape> free = {{"height", 0.5, 0.3}, {"weight", 0.5, 0.3}, {"cupsize", 0.5, 0.2}};
    for (const char* key :
         {"measure-upperarm-length", "measure-lowerarm-length", "measure-upperleg-height",
          "measure-lowerleg-height", "measure-thigh-circ", "measure-neck-circ", "measure-underbust-circ",
          "measure-shoulder-dist", "measure-hips-circ", "measure-waist-circ", "measure-bust-circ",
          "measure-napetowaist-dist", "measure-waisttohip-dist", "measure-neck-height"})
        free.push_back({key, 0.0, 0.35});
    return free;
}

struct Found {
    std::vector<float> shape;
    BodyMeasures measures;
    double cost;
};

Found nearest_body(const BodyModel& model, const DrawnFor& drawn_for, vfit_sex sex) {
    // The caller keeps the model for as long as this.
    const std::shared_ptr<const BodyModel> shared(std::shared_ptr<void>(), &model);
    const auto wants = [&](std::string_view key) {
        return std::any_of(drawn_for.wanted.begin(), drawn_for.wanted.end(),
                           [&](const WantedMeasure& w) { return w.key == key; });
    };
    const bool wants_levels = wants(kNapeLevel) || wants(kWaistLevel) || wants(kHipLevel);
    const auto measure = [&](const std::vector<float>& shape) {
        BodyMeasures out;
        for (const Measurement& m : measure_avatar(Avatar(shared, {sex}, shape, Vec2(1.0f)), sex))
            out[m.key] = double(m.value);
        if (!wants_levels) return out;
        EvaluatedBody body;
        model.evaluate(shape, body);
        out[kNapeLevel] = double(body.bone_heads[size_t(model.rig_bone(VFIT_BONE_NECK))].y);
        const TailorLevels levels = BodyOutline(model, std::move(body)).levels();
        out[kWaistLevel] = double(levels.waist), out[kHipLevel] = double(levels.hip);
        return out;
    };
    std::vector<WantedMeasure> wanted;
    std::vector<std::string> keys;
    for (const WantedMeasure& w : drawn_for.wanted) {
        if (w.key == "underbust_girth_m" && sex == VFIT_SEX_MALE) continue;  // a woman's measure
        wanted.push_back(w);
        keys.push_back(w.key);
    }
    BodyWithMeasures solver(shared, sex, free_shapes(), keys, measure);
    Found out;
    out.shape = model.default_shape(sex);
    out.measures = solver.solve(wanted, measure, out.shape);
    out.cost = solver.cost(wanted, out.measures, out.shape) / double(wanted.size());
    return out;
}

}  // namespace

DrawnFor parse_drawn_for(std::string_view text) {
    const std::string_view start = trimmed(text.substr(0, text.find_first_not_of(" \t\r\n") + 1));
    if (!start.empty() && start.back() == '{') return of_profile(text);
    return of_garmentcode(parse_flat_yaml(text));
}

BodyDrawnFor body_drawn_for(const BodyModel& model, const DrawnFor& drawn_for) {
    BodyDrawnFor out;
    out.sex = drawn_for.sex;
    Found found;
    if (drawn_for.sex == VFIT_SEX_UNKNOWN) {
        Found woman = nearest_body(model, drawn_for, VFIT_SEX_FEMALE),
              man = nearest_body(model, drawn_for, VFIT_SEX_MALE);
        out.sex = woman.cost <= man.cost ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
        found = woman.cost <= man.cost ? std::move(woman) : std::move(man);
    } else {
        found = nearest_body(model, drawn_for, drawn_for.sex);
    }
    constexpr double kMissed_m = 0.02;  // levels are soft anyway
    for (const WantedMeasure& w : drawn_for.wanted)
        if (const auto it = found.measures.find(w.key); it != found.measures.end() &&
                                                        !w.key.ends_with("_level_m") &&
                                                        std::abs(it->second - w.value_m) > kMissed_m)
            out.notes.push_back(
                text(w.key, " of the body that it is made on is ", std::round(1000.0 * it->second) / 10.0,
                     " cm, of the one that it was drawn for ", std::round(1000.0 * w.value_m) / 10.0));
    out.shape = settings_of(model, out.sex, found.shape);
    return out;
}

}  // namespace vfit
