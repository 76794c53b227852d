#include "scan/measure_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr int kVersion = 8;
constexpr float kFarthest = 5.0f;  // deviations: what lies farther tells no more
// What of the body itself lies farther out than nearly all grown-ups' do, a child's crown say, is guessed at:
// linear rules do not reach there.
constexpr float kUsualReach = 3.0f;     // deviations
constexpr float kBeyond = 4.0f;         // of a deviation beyond, squared
constexpr float kEdge_px = 0.5f;        // a sensor's outlines, and so the crown, are known no better
constexpr float kCrownApart_m = 0.03f;  // from stature, usually less: then the two contradict each other
constexpr float kShortest_m = 0.001f, kLongest_m = 5.0f, kSmallestSigma_m = 1e-4f;
constexpr float kLeastStrangeness = 0.01f;  // training/measures/train.py has the same
constexpr float kMisread = 3.0f;  // of a stand-in's deviations: what is seen farther off is something else
constexpr float kUnseenScale = 1e30f;  // of a feature that a part does not look at
constexpr float kMassScale = 100.0f;   // of these in kilograms
constexpr const char* kKinds[] = {"front", "front_and_side", "front_tight", "front_and_side_tight"};

const Json& field(const Json& object, const char* name, std::string_view where) {
    const auto it = object.is_object() ? object.find(name) : object.end();
    if (it == object.end()) fail(VFIT_ERROR_DATA, "measure model: ", where, " has no \"", name, "\"");
    return *it;
}

float number(const Json& value, const std::string& where) {
    const float v = value.is_number() ? value.get<float>() : std::nanf("");
    if (!std::isfinite(v)) fail(VFIT_ERROR_DATA, "measure model: ", where, " is not a number");
    return v;
}

/// Mean square: 1 among the scans that were learnt from, were all features seen.
float strangeness(const ScanFeatures& x) {
    return std::inner_product(x.begin(), x.end(), x.begin(), 0.0f) / float(x.size());
}

std::vector<float> numbers(const Json& object, const char* name, size_t count, const std::string& where,
                           float unit = 1.0f) {
    const Json& list = field(object, name, where);
    if (!list.is_array() || list.size() != count)
        fail(VFIT_ERROR_DATA, "measure model: \"", name, "\" of ", where, " is not a list of ", count,
             " numbers");
    std::vector<float> out;
    const std::string item_of = where + ": an item of \"" + name + "\"";
    for (const Json& item : list) out.push_back(unit * number(item, item_of));
    return out;
}

/// Which of the features a part looks at; its lists hold these alone, the others count for nothing.
struct Chosen {
    std::vector<size_t> features;

    Chosen(const Json& part, const char* name, const std::string& where) {
        const Json& list = field(part, name, where);
        if (!list.is_array())
            fail(VFIT_ERROR_DATA, "measure model: \"", name, "\" of ", where, " is not a list");
        for (const Json& item : list) {
            if (!item.is_number_unsigned() || item.get<size_t>() >= kScanFeatures)
                fail(VFIT_ERROR_DATA, "measure model: \"", name, "\" of ", where,
                     ": there is no such feature");
            features.push_back(item.get<size_t>());
        }
    }
    /// One number a chosen feature, or many times that, as numbers of all features.
    std::vector<float> among_all(const std::vector<float>& list, float others = 0.0f) const {
        std::vector<float> out(list.size() / features.size() * kScanFeatures, others);
        for (size_t i = 0; i < list.size(); ++i)
            out[i / features.size() * kScanFeatures + features[i % features.size()]] = list[i];
        return out;
    }
};

TurnedGirths girths_of(const Json& object, const std::string& where) {
    TurnedGirths out;
    for (size_t k = 0; k < kTurnedKeys.size(); ++k) {
        const std::string key(kTurnedKeys[k]), what = where + ", " + key;
        const Json& one = field(object, key.c_str(), where);
        out[k] = {number(field(one, "offset", what), what), number(field(one, "sigma", what), what)};
        if (!(out[k].sigma_m > 0.0f))
            fail(VFIT_ERROR_DATA, "measure model: ", what, ": sigma is not above 0");
    }
    return out;
}

}  // namespace

std::shared_ptr<const MeasureModel> MeasureModel::load(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    return std::make_shared<const MeasureModel>(
        parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

MeasureModel MeasureModel::parse(std::string_view text) {
    const Json file = parse_json(text, "measure model");
    if (field(file, "format", "the file") != "vfit-measure-model")
        fail(VFIT_ERROR_DATA, "measure model: the file's \"format\" is not vfit-measure-model");
    if (field(file, "version", "the file") != kVersion)
        fail(VFIT_ERROR_VERSION, "measure model: this library reads version ", kVersion);
    const float unit = number(field(file, "unit", "the file"), "unit"),
                unit_of_places = number(field(file, "unit_of_places", "the file"), "unit_of_places");
    MeasureModel model;
    for (size_t kind = 0; kind < model.parts_.size(); ++kind) {
        const std::string where = kKinds[kind];
        const Json& in = field(file, kKinds[kind], "the file");
        Part& part = model.parts_[kind];
        const Chosen chosen(in, "features", where);
        const size_t features = chosen.features.size();
        if (features == 0) fail(VFIT_ERROR_DATA, "measure model: \"features\" of ", where, " is empty");
        const auto of_features = [&](const Json& object, const char* name, const std::string& what,
                                     float scale, float others) {
            return chosen.among_all(numbers(object, name, features, what, scale), others);
        };
        part.mean = of_features(in, "mean", where, 1.0f, 0.0f);
        part.scale = of_features(in, "scale", where, 1.0f, kUnseenScale);
        part.usual_strangeness = number(field(in, "usual_strangeness", where), where + ": usual_strangeness");
        part.shape_precision =
            numbers(in, "shape_precision", size_t(kFitComponents) * size_t(kFitComponents), where);
        if (std::any_of(part.scale.begin(), part.scale.end(), [](float s) { return !(s > 0.0f); }) ||
            !(part.usual_strangeness > 0.0f))
            fail(VFIT_ERROR_DATA, "measure model: a scale of ", where, " is not above 0");
        part.female = {number(field(in, "female_base", where), where + ": female_base"),
                       of_features(in, "female_weights", where, 1.0f, 0.0f)};
        const Json& centres = field(in, "centres", where);
        const size_t dimensions = field(in, "directions", where).size() / features;
        if (!centres.is_array() || centres.size() % std::max<size_t>(dimensions, 1) != 0)
            fail(VFIT_ERROR_DATA, "measure model: \"centres\" of ", where,
                 " are not places in its directions");
        part.basis = RadialBasis(
            chosen.among_all(numbers(in, "directions", dimensions * features, where, unit_of_places)),
            numbers(in, "centres", centres.size(), where, unit_of_places), kScanFeatures);
        part.sigma_features = Chosen(in, "sigma_features", where).features;
        const Json& bends = field(in, "bends", where);
        for (const auto& [sex, rows] : {std::pair("female", &part.female_rows), {"male", &part.male_rows}}) {
            const Json& measures = field(in, sex, where);
            if (!measures.is_object() || measures.empty())
                fail(VFIT_ERROR_DATA, "measure model: ", where, ", ", sex, ": no measures");
            for (const auto& [key, one] : measures.items()) {
                const std::string what = where + ", " + sex + ", " + key;
                if (measure_index(key) < 0)
                    fail(VFIT_ERROR_DATA, "measure model: ", what, ": no such measure");
                std::optional<StandIn> stand_in;
                if (one.contains("stand_in")) {
                    const Json& likely = one["stand_in"];
                    stand_in = {{number(field(likely, "base", what), what),
                                 of_features(likely, "weights", what, unit, 0.0f)},
                                number(field(likely, "sigma", what), what),
                                number(field(likely, "trust", what), what)};
                }
                rows->push_back(
                    {key,
                     field(one, "observed", what) == Json(true),
                     {number(field(one, "base", what), what), of_features(one, "weights", what, unit, 0.0f)},
                     std::move(stand_in),
                     numbers(bends, key.c_str(), part.basis.size(), what, unit),
                     number(field(one, "log_sigma", what), what),
                     numbers(one, "sigma_weights", part.sigma_features.size() + 1, what)});
            }
            std::sort(rows->begin(), rows->end(),
                      [](const Row& a, const Row& b) { return measure_index(a.key) < measure_index(b.key); });
        }
    }
    for (const auto& [view, of_view] : {std::pair("turn", &model.turned_[0]), {"cameras", &model.turned_[1]}})
        for (const auto& [clothes, of_clothes] :
             {std::pair("any", &(*of_view)[0]), {"tight", &(*of_view)[1]}})
            for (const auto& [sex, girths] :
                 {std::pair("male", &(*of_clothes)[0]), {"female", &(*of_clothes)[1]}})
                *girths = girths_of(field(field(field(file, view, "the file"), clothes, view), sex, clothes),
                                    std::string(view) + ", " + clothes + ", " + sex);
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
        x[i] = std::isnan(features[i])
                   ? 0.0f
                   : std::clamp((features[i] - mean[i]) / scale[i], -kFarthest, kFarthest);
    return x;
}

MeasureModel::Seen MeasureModel::Part::look(const ScanFeatures& features) const {
    const ScanFeatures x = standardised(features);
    const SectionGirths girths = section_girths(features);
    return {seen_measures(features[kCrownFeature], girths, false),
            seen_measures(features[kCrownFeature], girths, true), x, basis.nearness(x), doubt(features, x)};
}

float MeasureModel::Part::doubt(const ScanFeatures& features, const ScanFeatures& x) const {
    float beyond = 0.0f;
    const auto look = [&](size_t i) {
        const float farther =
            std::isnan(features[i]) ? 0.0f : std::abs(features[i] - mean[i]) / scale[i] - kUsualReach;
        if (farther > 0.0f) beyond += farther * farther;
    };
    for (size_t i = 0; i < size_t(kFitComponents); ++i) look(i);
    look(kCrownFeature);
    float shape = 0.0f;
    for (size_t i = 0; i < size_t(kFitComponents); ++i)
        for (size_t j = 0; j < size_t(kFitComponents); ++j)
            shape += x[i] * shape_precision[i * size_t(kFitComponents) + j] * x[j];
    const float stranger = std::max(strangeness(x) / usual_strangeness, shape);
    return std::sqrt(std::max(1.0f, stranger) * (1.0f + kBeyond * beyond));
}

std::vector<Measurement> MeasureModel::Part::measure(vfit_sex sex, const Seen& seen) const {
    const bool female = sex == VFIT_SEX_FEMALE;
    const auto& [x, nearness, doubt] = std::tie(seen.x, seen.nearness, seen.doubt);
    std::vector<Measurement> out;
    for (const Row& row : female ? female_rows : male_rows) {
        float log_sigma =
            row.log_sigma + row.sigma_weights.back() * std::log(strangeness(x) + kLeastStrangeness);
        for (size_t i = 0; i < sigma_features.size(); ++i)
            log_sigma += row.sigma_weights[i] * x[sigma_features[i]];
        const float unit = is_mass(row.key) ? kMassScale : 1.0f;
        float value =
            row.value.of(x) + std::inner_product(nearness.begin(), nearness.end(), row.bends.begin(), 0.0f);
        float sigma = std::exp(log_sigma);
        if (row.stand_in) {
            const float likely = row.stand_in->likely.of(x),
                        apart = (female ? seen.female : seen.male).of(row.key) - likely;
            const bool is_seen = std::abs(apart) <= kMisread * row.stand_in->sigma;  // not where NaN
            value += likely + (is_seen ? row.stand_in->trust * apart : 0.0f);
            if (!is_seen) sigma = std::hypot(sigma, row.stand_in->sigma);
        }
        out.push_back({row.key, std::clamp(value, unit * kShortest_m, unit * kLongest_m),
                       std::clamp(doubt * sigma, unit * kSmallestSigma_m, unit * kLongest_m), row.observed});
    }
    return out;
}

float MeasureModel::female_probability(const ScanFeatures& features, ScanKind kind) const {
    const Part& one = part(kind);
    return 1.0f / (1.0f + std::exp(-one.female.of(one.standardised(features))));
}

std::vector<Measurement> MeasureModel::measure(const ScanFeatures& features, ScanKind kind, vfit_sex sex,
                                               const SeenOfTurn* turn) const {
    std::vector<Measurement> out = measure_anybody(features, kind, sex, turn);
    for (Measurement& m : out)
        if (m.key == "stature_m" && !std::isnan(features[kCrownFeature])) {
            const float apart = std::max(0.0f, std::abs(m.value - features[kCrownFeature]) - kCrownApart_m);
            m.sigma = std::hypot(m.sigma, apart, kEdge_px * 1e-3f * features[kPixelFeature]);
        }
    return out;
}

std::vector<Measurement> MeasureModel::measure_anybody(const ScanFeatures& features, ScanKind kind,
                                                       vfit_sex sex, const SeenOfTurn* turn) const {
    const Part& learnt = part(kind);
    const Seen seen = learnt.look(features);
    const auto of_sex = [&](vfit_sex one) {
        const bool woman = one == VFIT_SEX_FEMALE;
        std::vector<Measurement> list = learnt.measure(one, seen);
        if (turn)
            combine_with_turn(list, woman ? turn->female : turn->male,
                              turned_[turn->by_cameras][kind.tight][woman], turn->doubt * seen.doubt);
        return list;
    };
    if (sex != VFIT_SEX_UNKNOWN) return of_sex(sex);
    const std::vector<Measurement> male = of_sex(VFIT_SEX_MALE), female = of_sex(VFIT_SEX_FEMALE);
    const float p = female_probability(features, kind);
    std::vector<Measurement> out;
    for (const Measurement& m : male) {
        const Measurement* f = find(female, m.key);
        if (!f) continue;  // a measure of one sex alone is told when the sex is
        // Mean and variance of the mixture.
        const float apart = f->value - m.value;
        const float variance =
            p * f->sigma * f->sigma + (1.0f - p) * m.sigma * m.sigma + p * (1.0f - p) * apart * apart;
        out.push_back({m.key, m.value + p * apart, std::sqrt(variance), m.observed && f->observed});
    }
    return out;
}

}  // namespace vfit
