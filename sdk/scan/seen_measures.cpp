#include "scan/seen_measures.h"

#include <cmath>

#include "anthropometry/tape_landmarks.h"

namespace vfit {

namespace {

/// Of the way from the hip joints to the neck's joint. The tape looks for the hip between the crotch and
/// halfway up to the waist, for the bust from the rib arch to the armpits.
struct Range {
    float low, high;
};
constexpr Range kHip{-0.12f, 0.17f}, kBust{0.45f, 0.75f};
/// A man's armpits, from mean heights of ANSUR II as the waist (axilla 0.757 of stature; from person to
/// person 0.023 of the way), less half of a tape's width.
constexpr float kArmpits = 0.695f - 0.017f;

struct Levels {
    explicit Levels(bool female) {
        const vfit_sex sex = female ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
        waist = waist_share(sex), navel = navel_share(sex), rib_arch = rib_arch_share(sex);
    }
    float waist, navel, rib_arch;
};

float girth_at(const SectionGirths& girths, float share) {
    for (size_t l = 0; l + 1 < girths.size(); ++l) {
        const float low = TrunkProfile::along(int(l)), high = TrunkProfile::along(int(l) + 1);
        if (low <= share && share < high)
            return std::lerp(girths[l], girths[l + 1], (share - low) / (high - low));
    }
    return std::nanf("");
}

}  // namespace

float SeenMeasures::of(std::string_view key) const {
    return key == "stature_m"               ? stature_m
           : key == "chest_girth_m"         ? chest_girth_m
           : key == "waist_girth_m"         ? waist_girth_m
           : key == "hip_girth_m"           ? hip_girth_m
           : key == "waist_navel_girth_m"   ? waist_navel_girth_m
           : key == "waist_minimum_girth_m" ? waist_minimum_girth_m
                                            : std::nanf("");
}

SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female) {
    const Levels levels(female);
    SeenMeasures out;
    out.stature_m = crown_m;
    out.waist_girth_m = girth_at(girths, levels.waist);
    out.waist_navel_girth_m = out.waist_minimum_girth_m = girth_at(girths, levels.navel);
    for (size_t l = 0; l < girths.size(); ++l) {
        const float share = TrunkProfile::along(int(l));
        if (kHip.low < share && share < kHip.high) out.hip_girth_m = std::fmax(out.hip_girth_m, girths[l]);
        if (levels.navel < share && share < levels.rib_arch)
            out.waist_minimum_girth_m = std::fmin(out.waist_minimum_girth_m, girths[l]);
    }
    return out;
}

SeenMeasures seen_measures(const TurnedTrunk& trunk, bool female) {
    const Levels levels(female);
    SeenMeasures out;
    out.chest_girth_m = female ? trunk.girth_m(trunk.bust(kBust.low, kBust.high))
                               : trunk.largest_girth_m(levels.rib_arch, kArmpits);
    out.waist_girth_m = trunk.girth_m(levels.waist);
    out.hip_girth_m = trunk.largest_girth_m(kHip.low, kHip.high);
    out.waist_navel_girth_m = trunk.girth_m(levels.navel);
    out.waist_minimum_girth_m = trunk.smallest_girth_m(levels.navel, levels.rib_arch);
    return out;
}

}  // namespace vfit
