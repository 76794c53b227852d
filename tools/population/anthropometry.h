// Measures of real people as a normal distribution: ANSUR II (Gordon et al. 2014, 4,082 men and 1,986 women),
// by its means, deviations and correlations. People are drawn from it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "client/client.h"
#include "math/random.h"

namespace vfit::tools {

/// Of one person, by the survey's names, in millimetres (weightkg: kilograms).
class SurveyMeasures {
public:
    SurveyMeasures(const std::vector<std::string>& keys, std::vector<double> values)
        : keys_(&keys), values_(std::move(values)) {}
    double operator[](const std::string& key) const;
    const std::vector<double>& values() const { return values_; }
    double bmi() const { return (*this)["weightkg"] / ((*this)["stature"] * (*this)["stature"] * 1e-6); }

private:
    const std::vector<std::string>* keys_;
    std::vector<double> values_;
};

class Anthropometry {
public:
    /// Reads {"keys": [...], "men": {"mean", "sd", "corr"}, "women": {...}}.
    explicit Anthropometry(const std::string& path);

    SurveyMeasures draw(vfit_sex sex, Random& random) const;
    /// What that measure is of people who have those values of the others, on average.
    double expected(vfit_sex sex, const std::string& key, const SurveyMeasures& person,
                    const std::vector<std::string>& others) const;

    /// That person at another body mass: every measure moves with it as it does among people of one stature.
    SurveyMeasures with_mass(vfit_sex sex, const SurveyMeasures& person, double mass_kg) const;
    /// Standard deviation of what is left of a measure when the others are known, millimetres.
    double scatter(vfit_sex sex, const std::string& key, const std::vector<std::string>& others) const;

private:
    using Matrix = std::vector<std::vector<double>>;
    struct People {
        std::vector<double> mean;
        Matrix covariance, factor;  // factor * transposed factor = covariance
    };
    const People& people(vfit_sex sex) const { return people_[sex == VFIT_SEX_MALE ? 1 : 0]; }
    size_t index(const std::string& key) const;
    /// Of the regression of a measure on others.
    std::vector<double> weights(vfit_sex sex, const std::string& key,
                                const std::vector<std::string>& others) const;
    static Matrix factor_of(const Matrix& covariance);

    std::vector<std::string> keys_;
    std::array<People, 2> people_;  // women, men
};

}  // namespace vfit::tools
