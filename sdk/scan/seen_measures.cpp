#include "scan/seen_measures.h"

#include <cmath>

#include "anthropometry/tape_landmarks.h"

namespace vfit {

namespace {

/// Of the way from the hip joints to the neck's joint. The tape looks for the hip between the crotch and
/// halfway up to the waist, for the chest from the rib arch on.
struct Range {
    float low, high;
};
constexpr Range kHip{-0.12f, 0.17f}, kBust{0.45f, 0.75f};
constexpr float kRibArch = 0.45f;

float waist_of(bool female) { return waist_share(female ? VFIT_SEX_FEMALE : VFIT_SEX_MALE); }

}  // namespace

SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female) {
    SeenMeasures out{crown_m, std::nanf(""), std::nanf(""), std::nanf("")};
    const float waist = waist_of(female);
    for (int l = 0; l < TrunkProfile::kLevels; ++l) {
        const float low = TrunkProfile::along(l);
        if (kHip.low < low && low < kHip.high)
            out.hip_girth_m = std::fmax(out.hip_girth_m, girths[size_t(l)]);
        if (l + 1 == TrunkProfile::kLevels) continue;
        const float high = TrunkProfile::along(l + 1);
        if (low <= waist && waist < high)
            out.waist_girth_m =
                std::lerp(girths[size_t(l)], girths[size_t(l) + 1], (waist - low) / (high - low));
    }
    return out;
}

SeenMeasures seen_measures(const TurnedTrunk& trunk, bool female) {
    return {std::nanf(""),
            female ? trunk.girth_m(trunk.bust(kBust.low, kBust.high))
                   : trunk.largest_girth_m(kRibArch, trunk.armpits()),
            trunk.girth_m(waist_of(female)), trunk.largest_girth_m(kHip.low, kHip.high)};
}

}  // namespace vfit
