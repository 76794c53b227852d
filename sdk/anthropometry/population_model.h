// How the measures of real people go together: what the ones that are known make likely of the others.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"
#include "vfit.h"

namespace vfit {

/// Of whom measures are estimated.
struct Person {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    std::optional<float> age_years;
};

/// By sex a normal distribution of the logarithms of measures and of the age in years. In logarithms girths
/// are linear in body mass and stature over all of BMI 16 to 45, and a sigma is a fraction of the measure.
class PopulationModel {
public:
    /// Of the person's logarithms, as known so far.
    struct Belief {
        std::vector<double> mean;
        std::vector<double> covariance;  // rows of mean.size()
        double log_likelihood = 0.0;     // of what was observed

        double variance(size_t i) const { return covariance[i * mean.size() + i]; }
        /// One value more is known, with an error of that variance (the Kalman filter's update by a scalar).
        void observe(size_t i, double value, double error_variance);
    };

    /// VFIT_ERROR_DATA (VFIT_ERROR_VERSION for another version) with a sentence that names the fault.
    static PopulationModel parse(std::string_view json);

    const std::string& name() const { return name_; }
    /// In the order of measure_keys(); the age, "age_years", is none of them.
    const std::vector<std::string>& keys(vfit_sex sex) const { return of(sex).keys; }

    /// Every measure of the population, of an unknown sex those that both sexes have; known ones are
    /// observed. A known sigma of 0 is that of a typed measure. Known measures that the population has not
    /// are passed through. Their sigma is then that of a typed
    /// measure where it was 0. A key that is known twice, or an age that no adult has: VFIT_ERROR_DATA,
    /// VFIT_ERROR_ARGUMENT.
    std::vector<Measurement> estimate(const Person& person, const std::vector<Measurement>& known) const;

    /// What is likely before a measure is known; the first of its mean is the age.
    Belief prior(vfit_sex sex, const std::optional<float>& age_years) const;
    /// Place in Belief, or nothing.
    std::optional<size_t> place(vfit_sex sex, const std::string& key) const;
    /// Of the sex, by the known measures: 1 or 0 where it is told.
    double probability_female(const Person& person, const std::vector<Measurement>& known) const;

private:
    struct People {
        std::vector<std::string> keys;
        std::vector<double> mean, covariance;  // the age first
    };
    const People& of(vfit_sex sex) const { return people_[sex == VFIT_SEX_MALE ? 1 : 0]; }
    Belief belief(vfit_sex sex, const Person& person, const std::vector<Measurement>& known) const;

    std::string name_;
    std::array<People, 2> people_;  // women, men
};

/// Of a measure that a person tells without a scale of errors, as a fraction of its value.
double typed_error(std::string_view key);
/// Standard deviation of the logarithm.
double log_error(const Measurement& measurement);

}  // namespace vfit
