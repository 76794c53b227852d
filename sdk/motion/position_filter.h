// The filter of one joint position, by the host's choice: vfit's own, Holt's as the paper has it, or One
// Euro.
#pragma once

#include "motion/adaptive_filter.h"
#include "motion/holt_filter.h"
#include "motion/one_euro_filter.h"
#include "vfit.h"

namespace vfit {

struct PositionFilterSettings {
    vfit_position_filter kind = VFIT_POSITION_ADAPTIVE;
    HoltSettings holt;
    OneEuroSettings one_euro;
};

class PositionFilter {
public:
    void reset() { *this = PositionFilter(); }

    /// Takes one reading, `dt_s` > 0 after the one before (of the first it says nothing), and returns the
    /// output. `confidence`: 0..1, of a reading that is not inferred.
    Vec3 update(const PositionFilterSettings& settings, const Vec3& reading, bool inferred, float confidence,
                float dt_s);

    /// The trend at the last reading, m/s.
    const Vec3& velocity() const { return velocity_; }

private:
    AdaptiveFilter adaptive_;
    HoltFilter holt_;
    OneEuroFilter one_euro_;
    Vec3 velocity_{0.0f};
};

}  // namespace vfit
