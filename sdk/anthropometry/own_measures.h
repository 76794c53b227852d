// Measures that a user adds as data: landmarks, planes and paths on a body's mesh (docs/measuring.md).
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"
#include "anthropometry/tape.h"

namespace vfit {

class OwnMeasures {
public:
    /// VFIT_ERROR_DATA (VFIT_ERROR_VERSION for another version) with a sentence that names measure and field
    /// where the text is no list of measures.
    static OwnMeasures parse(std::string_view json);
    ~OwnMeasures();
    OwnMeasures(OwnMeasures&&) noexcept;

    /// Of that body, sigma 0, in the order of the list. VFIT_ERROR_DATA naming the measure that this body has
    /// not: a plane that meets no limb, a landmark that is not found.
    std::vector<Measurement> measure(const TapeBody& body) const;

    struct Definition;

private:
    OwnMeasures();
    std::vector<std::unique_ptr<Definition>> list_;
};

}  // namespace vfit
