#include "scan/measure_model.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "measure/measure_keys.h"

namespace vfit {

namespace {

constexpr int kVersion = 1;
constexpr float kFarthest = 5.0f;  // deviations: what lies farther tells no more
constexpr float kShortest_m = 0.001f, kLongest_m = 5.0f, kSmallestSigma_m = 1e-4f;
constexpr const char* kViews[] = {"front", "front_and_side"};

const Json& field(const Json& object, const char* name, const std::string& where) {
    const auto it = object.is_object() ? object.find(name) : object.end();
    if (it == object.end()) fail(VFIT_ERROR_DATA, "measure model: ", where, " has no \"", name, "\"");
    return *it;
}

float number(const Json& value, const std::string& where) {
    const float v = value.is_number() ? value.get<float>() : std::nanf("");
    if (!std::isfinite(v)) fail(VFIT_ERROR_DATA, "measure model: ", where, " is not a number");
    return v;
}

std::vector<float> numbers(const Json& object, const char* name, size_t count, const std::string& where) {
    const Json& list = field(object, name, where);
    if (!list.is_array() || list.size() != count)
        fail(VFIT_ERROR_DATA, "measure model: \"", name, "\" of ", where, " is not a list of ", count, " numbers");
    std::vector<float> out;
    for (const Json& item : list) out.push_back(number(item, where + ": an item of \"" + name + "\""));
    return out;
}

}  // namespace

std::shared_ptr<const MeasureModel> MeasureModel::load(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    return std::make_shared<const MeasureModel>(parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

MeasureModel MeasureModel::parse(std::string_view text) {
    const Json file = parse_json(text, "measure model");
    if (field(file, "format", "the file") != "vfit-measure-model")
        fail(VFIT_ERROR_DATA, "measure model: the file's \"format\" is not vfit-measure-model");
    if (field(file, "version", "the file") != kVersion)
        fail(VFIT_ERROR_VERSION, "measure model: this library reads version ", kVersion);
    MeasureModel model;
    for (size_t view = 0; view < model.parts_.size(); ++view) {
        const std::string where = kViews[view];
        const Json& in = field(file, kViews[view], "the file");
        Part& part = model.parts_[view];
        part.mean = numbers(in, "mean", kScanFeatures, where);
        part.scale = numbers(in, "scale", kScanFeatures, where);
        part.usual_strangeness = number(field(in, "usual_strangeness", where), where + ": usual_strangeness");
        if (std::any_of(part.scale.begin(), part.scale.end(), [](float s) { return !(s > 0.0f); }) ||
            !(part.usual_strangeness > 0.0f))
            fail(VFIT_ERROR_DATA, "measure model: a scale of ", where, " is not above 0");
        part.female = {number(field(in, "female_base", where), where + ": female_base"),
                       numbers(in, "female_weights", kScanFeatures, where)};
        const Json& chosen = field(in, "sigma_features", where);
        if (!chosen.is_array()) fail(VFIT_ERROR_DATA, "measure model: \"sigma_features\" of ", where, " is not a list");
        for (const Json& item : chosen) {
            if (!item.is_number_unsigned() || item.get<size_t>() >= kScanFeatures)
                fail(VFIT_ERROR_DATA, "measure model: \"sigma_features\" of ", where, ": there is no such feature");
            part.sigma_features.push_back(item.get<size_t>());
        }
        for (const auto& [sex, rows] : {std::pair("female", &part.female_rows), {"male", &part.male_rows}}) {
            const Json& measures = field(in, sex, where);
            if (!measures.is_object() || measures.empty())
                fail(VFIT_ERROR_DATA, "measure model: ", where, ", ", sex, ": no measures");
            for (const auto& [key, one] : measures.items()) {
                const std::string what = where + ", " + sex + ", " + key;
                if (measure_index(key) < 0) fail(VFIT_ERROR_DATA, "measure model: ", what, ": no such measure");
                rows->push_back({key, field(one, "observed", what) == Json(true),
                                 {number(field(one, "base_m", what), what), numbers(one, "weights", kScanFeatures, what)},
                                 number(field(one, "log_sigma", what), what),
                                 numbers(one, "sigma_weights", part.sigma_features.size(), what)});
            }
            std::sort(rows->begin(), rows->end(),
                      [](const Row& a, const Row& b) { return measure_index(a.key) < measure_index(b.key); });
        }
    }
    return model;
}

float MeasureModel::Linear::of(const ScanFeatures& x) const {
    float sum = base;
    for (size_t i = 0; i < x.size(); ++i) sum += weights[i] * x[i];
    return sum;
}

ScanFeatures MeasureModel::Part::standardised(const ScanFeatures& features) const {
    ScanFeatures x;
    for (size_t i = 0; i < x.size(); ++i)
        x[i] = std::clamp((features[i] - mean[i]) / scale[i], -kFarthest, kFarthest);
    return x;
}

std::vector<Measurement> MeasureModel::Part::measure(const std::vector<Row>& rows, const ScanFeatures& x) const {
    float squares = 0.0f;
    for (const float value : x) squares += value * value;
    const float wider = std::sqrt(std::max(1.0f, squares / float(x.size()) / usual_strangeness));
    std::vector<Measurement> out;
    for (const Row& row : rows) {
        float log_sigma = row.log_sigma;
        for (size_t i = 0; i < sigma_features.size(); ++i) log_sigma += row.sigma_weights[i] * x[sigma_features[i]];
        out.push_back({row.key, std::clamp(row.value.of(x), kShortest_m, kLongest_m), std::clamp(wider * std::exp(log_sigma), kSmallestSigma_m, kLongest_m),
                       row.observed});
    }
    return out;
}

float MeasureModel::female_probability(const ScanFeatures& features, bool side) const {
    const Part& part = parts_[side ? 1 : 0];
    return 1.0f / (1.0f + std::exp(-part.female.of(part.standardised(features))));
}

std::vector<Measurement> MeasureModel::measure(const ScanFeatures& features, bool side, vfit_sex sex) const {
    const Part& part = parts_[side ? 1 : 0];
    const ScanFeatures x = part.standardised(features);
    if (sex == VFIT_SEX_FEMALE) return part.measure(part.female_rows, x);
    const std::vector<Measurement> male = part.measure(part.male_rows, x);
    if (sex == VFIT_SEX_MALE) return male;
    const std::vector<Measurement> female = part.measure(part.female_rows, x);
    const float p = female_probability(features, side);
    std::vector<Measurement> out;
    for (const Measurement& m : male) {
        const Measurement* f = find(female, m.key);
        if (!f) continue;  // a measure of one sex alone is told when the sex is
        // Mean and variance of the mixture.
        const float apart = f->value - m.value;
        const float variance = p * f->sigma * f->sigma + (1.0f - p) * m.sigma * m.sigma + p * (1.0f - p) * apart * apart;
        out.push_back({m.key, m.value + p * apart, std::sqrt(variance), m.observed && f->observed});
    }
    return out;
}

}  // namespace vfit
