// What an app keeps of a person, with their consent: measurements as JSON, and two sets of one person made
// one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"
#include "vfit.h"

namespace vfit {

struct PersonProfile {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    std::vector<Measurement> measurements;
};

/// {"format": "vfit-profile", "version": 1, "sex": "f", "measurements": {"stature_m": {"value", "sigma",
/// "observed"}}}
std::string profile_text(const PersonProfile& profile);

/// That, a report of vfit measure, or plain {"stature_m": 1.7}. VFIT_ERROR_DATA (VFIT_ERROR_VERSION for
/// another version) with a sentence that names the key where it is none of them.
PersonProfile parse_profile(std::string_view json);

/// Two scans of one person: means by their variances. More than half of an error is the person's own and the
/// same in both, so that the deviation hardly falls; where the two differ by more than that leaves room for,
/// it grows. VFIT_ERROR_DATA where their statures are those of two people. What only one holds is taken as it
/// is.
std::vector<Measurement> merge(const std::vector<Measurement>& a, const std::vector<Measurement>& b);

}  // namespace vfit
