#include "scan/turned_measures.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Of the two errors: 0 to 0.4 on generated people. A larger one trusts the turn more, which serves bodies of
// other makers better.
constexpr float kCorrelation = 0.5f;

}  // namespace

void combine_with_turn(std::vector<Measurement>& measures, const SeenMeasures& turned,
                       const TurnedGirths& errors, float doubt) {
    for (size_t k = 0; k < kTurnedKeys.size(); ++k) {
        const float girth = turned.of(kTurnedKeys[k]);
        const TurnedGirth error{errors[k].offset_m, doubt * errors[k].sigma_m};
        for (Measurement& m : measures) {
            if (m.key != kTurnedKeys[k] || std::isnan(girth) || !(error.sigma_m > 0.0f && m.sigma > 0.0f))
                continue;
            const float va = m.sigma * m.sigma, vb = error.sigma_m * error.sigma_m,
                        both = kCorrelation * m.sigma * error.sigma_m;
            const float w = std::clamp((va - both) / (va + vb - 2.0f * both), 0.0f, 1.0f);
            if (w == 0.0f) continue;
            m.value += w * (girth + error.offset_m - m.value);
            m.sigma = std::sqrt((1.0f - w) * (1.0f - w) * va + w * w * vb + 2.0f * w * (1.0f - w) * both);
            m.observed = true;
        }
    }
}

}  // namespace vfit
