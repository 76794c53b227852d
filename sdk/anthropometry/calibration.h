// A shop's own tape measures beside scans of the same people: what its definitions differ by from vfit's, and
// intervals that hold for its customers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"

namespace vfit {

/// Of one measure.
struct CalibratedMeasure {
    std::string key;
    uint32_t people = 0;
    bool enough = false;    // people; else nothing is changed
    float offset = 0.0f;    // of the tape from the scan, the measure's unit
    float widening = 1.0f;  // of sigma
};

class Calibration {
public:
    static constexpr uint32_t kFewestPeople = 20;

    /// A person's scan, each measure with its sigma, and what a tape told. Measures that only one list has
    /// are passed over; without a common one, and for a scan without sigma, VFIT_ERROR_DATA.
    void add(const std::vector<Measurement>& scanned, const std::vector<Measurement>& taped);
    uint32_t people() const { return people_; }

    /// By split conformal prediction (Lei et al. 2018): every other person gives the offset, a median; of the
    /// others' errors, in sigmas, the 90 % quantile with the finite-sample correction sets the intervals. Of
    /// further people who are to those as they are to each other, at least 90 % of values then lie
    /// within 1.645 sigma, whatever the errors' distribution.
    std::vector<CalibratedMeasure> measures() const;
    /// Measures for which there are not enough people, and those of sigma 0, stay as they are.
    std::vector<Measurement> apply(std::vector<Measurement> scanned) const;

    /// Errors and sigmas alone, which tell no body; parse() takes it back. Errors: VFIT_ERROR_DATA,
    /// VFIT_ERROR_VERSION.
    std::string text() const;
    static Calibration parse(std::string_view json);

private:
    struct Error {
        float apart = 0.0f, sigma = 0.0f;  // tape - scan
    };
    struct Errors {
        std::string key;
        std::vector<Error> list;
    };
    Errors& of(const std::string& key);
    static CalibratedMeasure measure_of(const Errors& errors);

    std::vector<Errors> errors_;
    uint32_t people_ = 0;
};

}  // namespace vfit
