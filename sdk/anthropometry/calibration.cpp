#include "anthropometry/calibration.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr const char* kFormat = "vfit-calibration";
constexpr int kVersion = 1;
constexpr double kLevel = 0.9;
constexpr float kOfLevel = 1.645f;  // sigmas, of a normal distribution
constexpr size_t kMostPeople = 10000;
// Of an error, metres or kilograms; of a sigma, that a ratio to it is a number.
constexpr float kLargestError = 1000.0f, kSmallestSigma = 1e-6f;
// Of sigma, which is 0 only where it is unknown: twenty equal errors are no proof of perfect scans.
constexpr float kMinWidening = 0.1f;

float median(std::vector<float> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return 0.5f * (values[(n - 1) / 2] + values[n / 2]);
}

float number(const Json& value, const std::string& what) {
    const float v = value.is_number() ? value.get<float>() : std::nanf("");
    if (!std::isfinite(v)) fail(VFIT_ERROR_DATA, "calibration: ", what, " is not a number");
    return v;
}

}  // namespace

Calibration::Errors& Calibration::of(const std::string& key) {
    for (Errors& one : errors_)
        if (one.key == key) return one;
    return errors_.emplace_back(Errors{key, {}});
}

void Calibration::add(const std::vector<Measurement>& scanned, const std::vector<Measurement>& taped) {
    if (people_ >= kMostPeople) fail(VFIT_ERROR_ARGUMENT, "calibration: more than ", kMostPeople, " people");
    std::vector<std::pair<const Measurement*, const Measurement*>> pairs;
    for (const Measurement& tape : taped)
        if (const Measurement* scan = find(scanned, tape.key)) pairs.emplace_back(scan, &tape);
    for (size_t i = 0; i < pairs.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (pairs[i].second->key == pairs[k].second->key)
                fail(VFIT_ERROR_DATA, "calibration: the tape tells ", pairs[i].second->key, " twice");
    if (pairs.empty()) fail(VFIT_ERROR_DATA, "calibration: scan and tape have no measure in common");
    for (const auto& [scan, tape] : pairs)
        if (!(scan->sigma >= kSmallestSigma && scan->sigma <= kLargestError))
            fail(VFIT_ERROR_DATA, "calibration: ", scan->key,
                 " of the scan has no sigma, or one that is not "
                 "plausible: ",
                 scan->sigma);
    for (const auto& [scan, tape] : pairs)
        of(scan->key).list.push_back({tape->value - scan->value, scan->sigma});
    ++people_;
}

CalibratedMeasure Calibration::measure_of(const Errors& errors) {
    CalibratedMeasure out{errors.key, uint32_t(errors.list.size())};
    if (errors.list.size() < kFewestPeople) return out;
    std::vector<float> apart, scores;
    for (size_t i = 0; i < errors.list.size(); i += 2) apart.push_back(errors.list[i].apart);
    out.offset = median(std::move(apart));
    for (size_t i = 1; i < errors.list.size(); i += 2)
        scores.push_back(std::abs(errors.list[i].apart - out.offset) / errors.list[i].sigma);
    std::sort(scores.begin(), scores.end());
    const auto place = size_t(std::ceil(kLevel * double(scores.size() + 1)));
    out.widening = std::max(kMinWidening, scores[std::min(place, scores.size()) - 1] / kOfLevel);
    out.enough = true;
    return out;
}

std::vector<CalibratedMeasure> Calibration::measures() const {
    std::vector<CalibratedMeasure> out;
    for (const Errors& one : errors_) out.push_back(measure_of(one));
    std::stable_sort(out.begin(), out.end(), [](const CalibratedMeasure& a, const CalibratedMeasure& b) {
        return measure_order(a.key) < measure_order(b.key);
    });
    return out;
}

std::vector<Measurement> Calibration::apply(std::vector<Measurement> scanned) const {
    for (const CalibratedMeasure& c : measures()) {
        if (!c.enough) continue;
        for (Measurement& m : scanned)
            if (m.key == c.key && m.sigma > 0.0f) m.value += c.offset, m.sigma *= c.widening;
    }
    return scanned;
}

std::string Calibration::text() const {
    Json measures = Json::object();
    for (const Errors& one : errors_) {
        Json list = Json::array();
        for (const Error& e : one.list) list.push_back({{"error", e.apart}, {"sigma", e.sigma}});
        measures[one.key] = list;
    }
    return json_text(
        {{"format", kFormat}, {"version", kVersion}, {"people", people_}, {"measures", measures}});
}

Calibration Calibration::parse(std::string_view json) {
    const Json file = parse_json(json, "calibration");
    if (!file.is_object() || file.value("format", Json()) != kFormat)
        fail(VFIT_ERROR_DATA, "calibration: \"format\" is not ", kFormat);
    if (file.value("version", Json()) != kVersion)
        fail(VFIT_ERROR_VERSION, "calibration: this library reads version ", kVersion);
    const Json measures = file.value("measures", Json()), people = file.value("people", Json());
    if (!measures.is_object() || !people.is_number_unsigned() || people.get<uint64_t>() > kMostPeople)
        fail(VFIT_ERROR_DATA, "calibration: has not \"people\", at most ", kMostPeople, ", and \"measures\"");
    Calibration out;
    out.people_ = people.get<uint32_t>();
    for (const auto& [key, list] : measures.items()) {
        if (!is_measure(key))
            fail(VFIT_ERROR_DATA, "calibration: \"", key, "\" is no measure; see vfit_measure_key");
        if (!list.is_array() || list.size() > out.people_)
            fail(VFIT_ERROR_DATA, "calibration: ", key, " is not a list of at most ", out.people_, " people");
        for (const Json& item : list) {
            const Json empty = Json::object();
            const Json& one = item.is_object() ? item : empty;
            const Error error{number(one.value("error", Json()), key + ": an error"),
                              number(one.value("sigma", Json()), key + ": a sigma")};
            if (!(error.sigma >= kSmallestSigma && error.sigma <= kLargestError))
                fail(VFIT_ERROR_DATA, "calibration: ", key, ": a sigma is not above 0, or too large");
            if (!(std::abs(error.apart) <= kLargestError))
                fail(VFIT_ERROR_DATA, "calibration: ", key, ": an error of ", error.apart, " is no person's");
            out.of(key).list.push_back(error);
        }
    }
    return out;
}

}  // namespace vfit
