#include "anthropometry/profile.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/measure_keys.h"
#include "anthropometry/measurement_check.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr const char* kFormat = "vfit-profile";
constexpr int kProfileVersion = 1;
// Share of an error's variance that every scan of one person has in common (vfit-bench measure --only
// repeated).
constexpr float kOwn = 0.6f;
constexpr float kTwoPeople = 6.0f;  // deviations between two statures

float number(const Json& value, const std::string& what) {
    const float v = value.is_number() ? value.get<float>() : std::nanf("");
    if (!std::isfinite(v)) fail(VFIT_ERROR_DATA, "profile: ", what, " is not a number");
    return v;
}

Measurement parse_one(const std::string& key, const Json& value) {
    if (!is_measure(key)) fail(VFIT_ERROR_DATA, "profile: \"", key, "\" is no measure; see vfit_measure_key");
    Measurement m{key, 0.0f, 0.0f, true};
    if (value.is_object()) {
        const auto at = value.find("value");
        if (at == value.end()) fail(VFIT_ERROR_DATA, "profile: ", key, " has no \"value\"");
        m.value = number(*at, key);
        if (const auto s = value.find("sigma"); s != value.end()) m.sigma = number(*s, key + ": sigma");
        if (const auto o = value.find("observed"); o != value.end()) {
            if (!o->is_boolean())
                fail(VFIT_ERROR_DATA, "profile: \"observed\" of ", key, " is neither true nor false");
            m.observed = o->get<bool>();
        }
    } else {
        m.value = number(value, key);
    }
    check_measurement(m, "profile: ");
    return m;
}

Measurement merge_one(const Measurement& a, const Measurement& b) {
    if (a.sigma == 0.0f && b.sigma == 0.0f)
        return {a.key, 0.5f * (a.value + b.value), 0.0f, a.observed || b.observed};
    if (a.sigma == 0.0f || b.sigma == 0.0f) return a.sigma == 0.0f ? b : a;
    const float va = a.sigma * a.sigma, vb = b.sigma * b.sigma, wa = vb / (va + vb), wb = va / (va + vb);
    const float apart = a.value - b.value, room = (1.0f - kOwn) * (va + vb);
    // Of the mean, whose errors have kOwn in common; and what the difference shows beyond.
    const float variance = kOwn * (wa * va + wb * vb) + (1.0f - kOwn) * (va * vb / (va + vb)) +
                           wa * wb * std::max(0.0f, apart * apart - room);
    return {a.key, wa * a.value + wb * b.value, std::sqrt(variance), a.observed || b.observed};
}

}  // namespace

std::string profile_text(const PersonProfile& profile) {
    Json out = {{"format", kFormat}, {"version", kProfileVersion}};
    if (profile.sex != VFIT_SEX_UNKNOWN) out["sex"] = profile.sex == VFIT_SEX_FEMALE ? "f" : "m";
    Json& all = out["measurements"] = Json::object();
    for (const Measurement& m : profile.measurements)
        all[m.key] = {{"value", m.value}, {"sigma", m.sigma}, {"observed", m.observed}};
    return json_text(out, 2);
}

PersonProfile parse_profile(std::string_view text) {
    const Json file = parse_json(text, "profile");
    if (!file.is_object()) fail(VFIT_ERROR_DATA, "profile: not a JSON object");
    PersonProfile out;
    if (const auto format = file.find("format"); format != file.end()) {
        if (*format != kFormat) fail(VFIT_ERROR_DATA, "profile: the \"format\" is not ", kFormat);
        const auto version = file.find("version");
        if (version == file.end() || !version->is_number_integer())
            fail(VFIT_ERROR_DATA, "profile: no whole \"version\"");
        if (*version != kProfileVersion)
            fail(VFIT_ERROR_VERSION, "profile: version ", version->get<int64_t>(),
                 " is unknown; this library reads ", kProfileVersion);
    }
    if (const auto sex = file.find("sex"); sex != file.end()) {
        if (*sex != "f" && *sex != "m") fail(VFIT_ERROR_DATA, "profile: \"sex\" is neither f nor m");
        out.sex = *sex == "f" ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    }
    const bool whole = file.contains("measurements");
    const Json& all = whole ? file["measurements"] : file;
    if (!all.is_object()) fail(VFIT_ERROR_DATA, "profile: \"measurements\" is not an object");
    for (const auto& [key, value] : all.items())
        if (whole || (key != "format" && key != "version" && key != "sex"))
            out.measurements.push_back(parse_one(key, value));
    std::stable_sort(out.measurements.begin(), out.measurements.end(),
                     [](const Measurement& a, const Measurement& b) {
                         return measure_order(a.key) < measure_order(b.key);
                     });
    return out;
}

std::vector<Measurement> merge(const std::vector<Measurement>& a, const std::vector<Measurement>& b) {
    const Measurement *one = find(a, "stature_m"), *other = find(b, "stature_m");
    if (one && other && one->sigma > 0.0f && other->sigma > 0.0f &&
        std::abs(one->value - other->value) > kTwoPeople * std::hypot(one->sigma, other->sigma))
        fail(VFIT_ERROR_DATA, "these are measurements of two people: stature_m ", one->value, " and ",
             other->value);
    std::vector<Measurement> out;
    for (const Measurement& m : a) {
        const Measurement* again = find(b, m.key);
        out.push_back(again ? merge_one(m, *again) : m);
    }
    for (const Measurement& m : b)
        if (!find(a, m.key)) out.push_back(m);
    std::stable_sort(out.begin(), out.end(), [](const Measurement& x, const Measurement& y) {
        return measure_order(x.key) < measure_order(y.key);
    });
    return out;
}

}  // namespace vfit
