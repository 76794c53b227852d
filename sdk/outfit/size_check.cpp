#include "outfit/size_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace vfit {

namespace {

/// To a tenth, for messages.
float rounded(float value) { return std::round(value * 10.0f) / 10.0f; }

void check_crotch(const SizedGarment& sized, const Cloth& cloth) {
    const WearableGarment& garment = sized.garment;
    const CrotchLine crotch =
        crotch_line({sized.dress.rest(), sized.dress.indices(), sized.cut, {}, {}}, cloth.positions());
    const float gives = std::max(kCrotchGives, garment.material().most_strain);
    if (crotch.strain > gives)
        fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment.garment().name, " is too small in size ",
             sized.label, ": its ", rounded(crotch.garment_m * 100.0f),
             " cm from front to back through the crotch would be stretched by ",
             rounded(crotch.strain * 100.0f), " %; ", garment.garment().fabric, " stretches by at most ",
             rounded(gives * 100.0f), " % there");
}

void check_tenth(const SizedGarment& sized, const Cloth& cloth) {
    const WearableGarment& garment = sized.garment;
    const float strain = most_strained(cloth.strain()), most = kDrawn * garment.material().most_strain;
    if (strain > most)
        fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment.garment().name, " is too small in size ",
             sized.label, ": a tenth of it would be stretched by more than ", rounded(strain * 100.0f),
             " %; ", garment.garment().fabric, " stretches by at most ", rounded(most * 100.0f), " %");
}

void check_openings(const SizedGarment& sized, const Cloth& cloth) {
    const WearableGarment& garment = sized.garment;
    std::vector<uint8_t> counts = garment.garment().simulated;
    for (const LimbHem& hem : sized.dress.hems())
        for (const uint32_t v : hem.vertices) counts[v] = 0;
    const Opening opening = tightest_opening(
        {cloth.positions(), sized.dress.indices(), sized.cut, garment.garment().on_arm, {}}, counts);
    const float gives = std::max(kOpeningGives, garment.material().most_strain);
    if (opening.strain > gives)
        fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment.garment().name, " is too small in size ",
             sized.label, ": its opening of ", opening.garment_m * 100.0f, " cm at ",
             opening.middle.y * 100.0f, " cm of height would be stretched by ", opening.strain * 100.0f,
             " %; ", garment.garment().fabric, " gives ", gives * 100.0f, " % there");
}

}  // namespace

void check_closes(const SizedGarment& sized, std::span<const GirthLevel> levels) {
    const WearableGarment& garment = sized.garment;
    const auto fits =
        fit_of({sized.dress.rest(), sized.dress.indices(), sized.cut, garment.garment().on_arm, {}}, levels);
    const GirthFit* at = nullptr;
    const float strain = needed_strain(fits, &at), most = garment.material().most_strain;
    if (strain <= most) return;
    fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment.garment().name, " does not close in size ", sized.label,
         ": ", at->key, " of the body is ", rounded(at->body_m * 100.0f), " cm, of the garment ",
         rounded(at->garment_m * 100.0f), " cm; ", garment.garment().fabric, " stretches by at most ",
         rounded(most * 100.0f), " %");
}

void check_stretch(const SizedGarment& sized, const Cloth& cloth) {
    check_crotch(sized, cloth);
    check_tenth(sized, cloth);
    check_openings(sized, cloth);
}

}  // namespace vfit
