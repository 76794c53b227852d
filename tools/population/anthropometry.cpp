#include "population/anthropometry.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "client/files.h"

namespace vfit::tools {

namespace {

size_t place_of(const std::vector<std::string>& keys, const std::string& key) {
    for (size_t i = 0; i < keys.size(); ++i)
        if (keys[i] == key) return i;
    throw Failure("the survey has no measure \"" + key + "\"");
}

}  // namespace

double SurveyMeasures::operator[](const std::string& key) const { return values_[place_of(*keys_, key)]; }

Anthropometry::Anthropometry(const std::string& path) {
    const Json file = Json::parse(read_text(path));
    keys_ = file.at("keys").get<std::vector<std::string>>();
    for (size_t i = 0; i < people_.size(); ++i) {
        const Json& in = file.at(i == 1 ? "men" : "women");
        People& out = people_[i];
        out.mean = in.at("mean").get<std::vector<double>>();
        out.covariance = in.at("corr").get<Matrix>();
        const auto sd = in.at("sd").get<std::vector<double>>();
        if (out.mean.size() != keys_.size() || sd.size() != keys_.size() ||
            out.covariance.size() != keys_.size())
            throw Failure(path + ": not one mean, deviation and row a key");
        for (size_t a = 0; a < keys_.size(); ++a)
            for (size_t b = 0; b < keys_.size(); ++b) out.covariance[a].at(b) *= sd[a] * sd[b];
        out.factor = factor_of(out.covariance);
    }
}

size_t Anthropometry::index(const std::string& key) const { return place_of(keys_, key); }

/// Cholesky; correlations that were rounded may leave a direction with next to no spread.
Anthropometry::Matrix Anthropometry::factor_of(const Matrix& covariance) {
    const size_t n = covariance.size();
    Matrix factor(n, std::vector<double>(n, 0.0));
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j) {
            double sum = covariance[i][j];
            for (size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
            factor[i][j] = i == j ? std::sqrt(std::max(sum, 1e-6 * covariance[i][i])) : sum / factor[j][j];
        }
    return factor;
}

SurveyMeasures Anthropometry::draw(vfit_sex sex, Random& random) const {
    const People& p = people(sex);
    std::vector<double> standard, values = p.mean;
    for (size_t i = 0; i < values.size(); ++i) standard.push_back(double(random.normal()));
    for (size_t i = 0; i < values.size(); ++i)
        for (size_t k = 0; k <= i; ++k) values[i] += p.factor[i][k] * standard[k];
    return {keys_, values};
}

std::vector<double> Anthropometry::weights(vfit_sex sex, const std::string& key,
                                           const std::vector<std::string>& others) const {
    const People& p = people(sex);
    const int n = int(others.size());
    cv::Mat_<double> known(n, n), shared(n, 1), weights;
    for (int i = 0; i < n; ++i) {
        const auto& row = p.covariance[index(others[size_t(i)])];
        shared(i) = row[index(key)];
        for (int j = 0; j < n; ++j) known(i, j) = row[index(others[size_t(j)])];
    }
    cv::solve(known, shared, weights, cv::DECOMP_CHOLESKY);
    return {weights.begin(), weights.end()};
}

double Anthropometry::expected(vfit_sex sex, const std::string& key, const SurveyMeasures& person,
                               const std::vector<std::string>& others) const {
    const People& p = people(sex);
    const std::vector<double> weight = weights(sex, key, others);
    double value = p.mean[index(key)];
    for (size_t i = 0; i < others.size(); ++i)
        value += weight[i] * (person[others[i]] - p.mean[index(others[i])]);
    return value;
}

double Anthropometry::scatter(vfit_sex sex, const std::string& key,
                              const std::vector<std::string>& others) const {
    const auto& row = people(sex).covariance[index(key)];
    const std::vector<double> weight = weights(sex, key, others);
    double left = row[index(key)];
    for (size_t i = 0; i < others.size(); ++i) left -= weight[i] * row[index(others[i])];
    return std::sqrt(left);
}

SurveyMeasures Anthropometry::with_mass(vfit_sex sex, const SurveyMeasures& person, double mass_kg) const {
    std::vector<double> values = person.values();
    const double more = mass_kg - person["weightkg"];
    for (size_t i = 0; i < values.size(); ++i)
        values[i] += more * weights(sex, keys_[i], {"weightkg", "stature"})[0];
    return {keys_, values};
}

}  // namespace vfit::tools
