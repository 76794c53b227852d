#include "scan/seen_measures.h"

#include <cmath>

#include "anthropometry/tape_landmarks.h"

namespace vfit {

namespace {

/// Of the way from the hip joints to the neck's joint. The tape looks for the hip between the crotch and
/// halfway up to the waist, for the chest between the rib arch and the armpits.
struct Range {
    float low, high;
};
constexpr Range kHip{-0.12f, 0.17f}, kChest{0.45f, 0.66f};

}  // namespace

SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female) {
    const auto largest = [&](const Range& range) {
        float out = std::nanf("");
        for (int l = 0; l < TrunkProfile::kLevels; ++l)
            if (range.low < TrunkProfile::along(l) && TrunkProfile::along(l) < range.high)
                out = std::fmax(out, girths[size_t(l)]);
        return out;
    };
    const float waist = waist_share(female ? VFIT_SEX_FEMALE : VFIT_SEX_MALE);
    SeenMeasures out{crown_m, largest(kChest), std::nanf(""), largest(kHip)};
    for (int l = 0; l + 1 < TrunkProfile::kLevels; ++l) {
        const float low = TrunkProfile::along(l), high = TrunkProfile::along(l + 1);
        if (low <= waist && waist < high)
            out.waist_girth_m =
                std::lerp(girths[size_t(l)], girths[size_t(l) + 1], (waist - low) / (high - low));
    }
    return out;
}

}  // namespace vfit
