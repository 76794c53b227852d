#include "anthropometry/population_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr const char* kFormat = "vfit-population";
constexpr int kVersion = 1;
constexpr float kYoungest = 18.0f, kOldest = 100.0f;  // years
constexpr double kAgeError = 0.5;                     // years: an age is told in whole ones
constexpr size_t kMaxKeys = 64;
constexpr double kLargestLog = 8.0;  // of a mean: more than any measure has, in metres or kilograms

const Json& field(const Json& object, const char* name, Json::value_t type, const char* type_name) {
    const auto it = object.find(name);
    if (it == object.end() || it->type() != type)
        fail(VFIT_ERROR_DATA, "population: \"", name, "\" is missing or is not ", type_name);
    return *it;
}

double number(const Json& value, const std::string& what) {
    const double v = value.is_number() ? value.get<double>() : std::nan("");
    if (!std::isfinite(v)) fail(VFIT_ERROR_DATA, "population: ", what, " is not a number");
    return v;
}

std::vector<std::string> parse_keys(const Json& people, const std::string& who) {
    std::vector<std::string> keys;
    for (const Json& item : field(people, "keys", Json::value_t::array, "a list")) {
        if (!item.is_string()) fail(VFIT_ERROR_DATA, "population: a key of ", who, " is not a text");
        const std::string key = item.get<std::string>();
        if (keys.empty() ? key != "age_years" : !is_measure(key))
            fail(VFIT_ERROR_DATA, "population: \"", key, "\" of ", who,
                 keys.empty() ? " stands first, where \"age_years\" must" : " is not a measure");
        if (std::find(keys.begin(), keys.end(), key) != keys.end())
            fail(VFIT_ERROR_DATA, "population: \"", key, "\" of ", who, " stands twice");
        keys.push_back(key);
    }
    if (keys.size() < 3 || keys.size() > kMaxKeys)
        fail(VFIT_ERROR_DATA, "population: ", who, " have ", keys.size(), " keys, not 3 to ", kMaxKeys);
    return keys;
}

/// Whether the matrix is a covariance: Cholesky's pivots are above 0.
bool is_positive(std::vector<double> a, size_t n) {
    for (size_t k = 0; k < n; ++k) {
        if (!(a[k * n + k] > 1e-12)) return false;
        for (size_t i = k + 1; i < n; ++i) {
            const double f = a[i * n + k] / a[k * n + k];
            for (size_t j = k; j < n; ++j) a[i * n + j] -= f * a[k * n + j];
        }
    }
    return true;
}

}  // namespace

void PopulationModel::Belief::observe(size_t i, double value, double error_variance) {
    const size_t n = mean.size();
    const double spread = variance(i) + error_variance, apart = value - mean[i];
    log_likelihood -= 0.5 * (apart * apart / spread + std::log(2.0 * std::numbers::pi * spread));
    std::vector<double> column(n);
    for (size_t k = 0; k < n; ++k) column[k] = covariance[k * n + i];
    for (size_t k = 0; k < n; ++k) {
        const double gain = column[k] / spread;
        mean[k] += gain * apart;
        for (size_t l = 0; l < n; ++l) covariance[k * n + l] -= gain * column[l];
    }
}

double typed_error(std::string_view key) {
    // Told heights differ from measured ones by 1 to 2 cm, weights by 1 to 2 kg, and a tape that people lay
    // around themselves by 1 to 3 cm (docs/measuring.md).
    return key == "stature_m" ? 0.008 : is_mass(key) ? 0.02 : 0.025;
}

double log_error(const Measurement& m) {
    return m.sigma > 0.0f ? double(m.sigma) / double(m.value) : typed_error(m.key);
}

PopulationModel PopulationModel::parse(std::string_view json) {
    const Json file = parse_json(json, "population");
    if (!file.is_object()) fail(VFIT_ERROR_DATA, "population: the text is not an object");
    if (field(file, "format", Json::value_t::string, "a text") != kFormat)
        fail(VFIT_ERROR_DATA, "population: the format is not \"", kFormat, "\"");
    const auto version = file.find("version");
    if (version == file.end() || !version->is_number_integer())
        fail(VFIT_ERROR_DATA, "population: the text has no whole number \"version\"");
    if (*version != kVersion)
        fail(VFIT_ERROR_VERSION, "population: version ", version->get<int64_t>(),
             " is unknown; this library reads ", kVersion);
    PopulationModel model;
    model.name_ = field(file, "name", Json::value_t::string, "a text").get<std::string>();
    for (const std::string who : {"women", "men"}) {
        People& people = model.people_[who == "men" ? 1 : 0];
        const Json& item = field(file, who.c_str(), Json::value_t::object, "an object");
        people.keys = parse_keys(item, who);
        const size_t n = people.keys.size();
        const Json& mean = field(item, "mean", Json::value_t::array, "a list");
        const Json& rows = field(item, "covariance", Json::value_t::array, "a list");
        if (mean.size() != n || rows.size() != n)
            fail(VFIT_ERROR_DATA, "population: ", who, " have ", n, " keys, ", mean.size(), " means and ",
                 rows.size(), " rows of covariance");
        people.covariance.resize(n * n);
        for (size_t i = 0; i < n; ++i) {
            people.mean.push_back(number(mean[i], "the mean of " + people.keys[i] + " of " + who));
            if (std::abs(people.mean.back()) > (i == 0 ? double(kOldest) : kLargestLog))
                fail(VFIT_ERROR_DATA, "population: the mean of ", people.keys[i], " of ", who,
                     " is not plausible");
            if (!rows[i].is_array() || rows[i].size() != i + 1)
                fail(VFIT_ERROR_DATA, "population: row ", i + 1, " of the covariance of ", who,
                     " is not a list of ", i + 1);
            for (size_t k = 0; k <= i; ++k)
                people.covariance[i * n + k] = people.covariance[k * n + i] =
                    number(rows[i][k], "a covariance of " + people.keys[i] + " of " + who);
        }
        for (size_t i = 1; i < n; ++i)
            if (people.covariance[i * n + i] > 1.0)
                fail(VFIT_ERROR_DATA, "population: the variance of ", people.keys[i], " of ", who,
                     " is not that of a logarithm");
        if (!is_positive(people.covariance, n))
            fail(VFIT_ERROR_DATA, "population: the covariance of ", who,
                 " is none: it is not positive definite");
    }
    return model;
}

std::optional<size_t> PopulationModel::place(vfit_sex sex, const std::string& key) const {
    const auto& keys = of(sex).keys;
    const auto at = std::find(keys.begin() + 1, keys.end(), key);
    if (at == keys.end()) return std::nullopt;
    return size_t(at - keys.begin());
}

PopulationModel::Belief PopulationModel::prior(vfit_sex sex, const std::optional<float>& age_years) const {
    Belief belief{of(sex).mean, of(sex).covariance};
    if (age_years) {
        if (!(*age_years >= kYoungest && *age_years <= kOldest))
            fail(VFIT_ERROR_ARGUMENT, "age_years ", *age_years, " is not ", kYoungest, " to ", kOldest,
                 "; 0: not told");
        belief.observe(0, double(*age_years), kAgeError* kAgeError);
        belief.log_likelihood = 0.0;  // people of any age are of both sexes
    }
    return belief;
}

PopulationModel::Belief PopulationModel::belief(vfit_sex sex, const Person& person,
                                                const std::vector<Measurement>& known) const {
    Belief belief = prior(sex, person.age_years);
    const vfit_sex other = sex == VFIT_SEX_MALE ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    const auto observe = [&](bool common) {
        for (const Measurement& m : known)
            if (const auto at = place(sex, m.key); at && place(other, m.key).has_value() == common) {
                const double error = log_error(m);
                belief.observe(*at, std::log(double(m.value)), error * error);
            }
    };
    observe(true);
    // What one sex alone has does not tell which one it is.
    const double likelihood = belief.log_likelihood;
    observe(false);
    belief.log_likelihood = likelihood;
    return belief;
}

double PopulationModel::probability_female(const Person& person,
                                           const std::vector<Measurement>& known) const {
    if (person.sex != VFIT_SEX_UNKNOWN) return person.sex == VFIT_SEX_FEMALE ? 1.0 : 0.0;
    const double female = belief(VFIT_SEX_FEMALE, person, known).log_likelihood,
                 male = belief(VFIT_SEX_MALE, person, known).log_likelihood;
    return 1.0 / (1.0 + std::exp(std::clamp(male - female, -500.0, 500.0)));
}

std::vector<Measurement> PopulationModel::estimate(const Person& person,
                                                   const std::vector<Measurement>& known) const {
    for (size_t i = 0; i < known.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (known[i].key == known[k].key)
                fail(VFIT_ERROR_DATA, "population: ", known[i].key, " is known twice");
    struct Part {
        vfit_sex sex;
        double weight;
        Belief belief;
    };
    std::vector<Part> parts;
    const double female = probability_female(person, known);
    const bool unknown = person.sex == VFIT_SEX_UNKNOWN;
    if (unknown || female > 0.0)
        parts.push_back({VFIT_SEX_FEMALE, female, belief(VFIT_SEX_FEMALE, person, known)});
    if (unknown || female < 1.0)
        parts.push_back({VFIT_SEX_MALE, 1.0 - female, belief(VFIT_SEX_MALE, person, known)});
    std::vector<Measurement> out;
    const std::vector<std::string>& keys = of(parts[0].sex).keys;
    for (size_t i = 1; i < keys.size(); ++i) {
        double mean = 0.0, square = 0.0;
        bool all_have = true;
        for (const Part& part : parts) {
            const auto at = place(part.sex, keys[i]);
            all_have &= at.has_value();
            if (!at) continue;
            const double m = part.belief.mean[*at];
            mean += part.weight * m;
            square += part.weight * (part.belief.variance(*at) + m * m);
        }
        if (!all_have) continue;
        const double value = std::exp(mean), sd = std::sqrt(std::max(0.0, square - mean * mean));
        out.push_back({keys[i], float(value), float(value * sd), find(known, keys[i]) != nullptr});
    }
    for (const Measurement& m : known)
        if (!find(out, m.key)) {
            out.push_back(m);
            out.back().sigma = float(double(m.value) * log_error(m));
        }
    std::stable_sort(out.begin(), out.end(), [](const Measurement& a, const Measurement& b) {
        return measure_order(a.key) < measure_order(b.key);
    });
    return out;
}

}  // namespace vfit
