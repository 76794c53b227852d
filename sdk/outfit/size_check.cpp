#include "outfit/size_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"

namespace vfit {

namespace {

/// To a tenth, for messages.
float rounded(float value) { return std::round(value * 10.0f) / 10.0f; }

template <typename... Rest>
TooSmall too_small_by(float beyond, const SizedGarment& sized, const Rest&... rest) {
    return {beyond, text("garment ", sized.garment.garment().name, " is too small in size ", sized.label,
                         ": ", rest...)};
}

TooSmall at_crotch(const SizedGarment& sized, const ClothPiece& cloth) {
    const CrotchLine crotch =
        crotch_line({sized.dress.rest(), sized.dress.indices(), sized.cut, {}, {}}, cloth.positions());
    const float gives = std::max(kCrotchGives, sized.garment.material().most_strain);
    return too_small_by(crotch.strain - gives, sized, "its ", rounded(crotch.garment_m * 100.0f),
                        " cm from front to back through the crotch would be stretched by ",
                        rounded(crotch.strain * 100.0f), " %; ", sized.garment.garment().fabric,
                        " stretches by at most ", rounded(gives * 100.0f), " % there");
}

TooSmall in_a_tenth(const SizedGarment& sized, const ClothPiece& cloth) {
    const float strain = most_strained(cloth.strain()), most = kDrawn * sized.garment.material().most_strain;
    return too_small_by(strain - most, sized, "a tenth of it would be stretched by more than ",
                        rounded(strain * 100.0f), " %; ", sized.garment.garment().fabric,
                        " stretches by at most ", rounded(most * 100.0f), " %");
}

TooSmall at_an_opening(const SizedGarment& sized, const ClothPiece& cloth) {
    const Garment& garment = sized.garment.garment();
    std::vector<uint8_t> counts = garment.simulated;
    for (const LimbHem& hem : sized.dress.hems())
        for (const uint32_t v : hem.vertices) counts[v] = 0;
    const Opening opening =
        tightest_opening({cloth.positions(), sized.dress.indices(), sized.cut, garment.on_arm, {}}, counts);
    const float gives = std::max(kOpeningGives, sized.garment.material().most_strain);
    return too_small_by(opening.strain - gives, sized, "its opening of ", rounded(opening.garment_m * 100.0f),
                        " cm at ", rounded(opening.middle.y * 100.0f), " cm of height would be stretched by ",
                        rounded(opening.strain * 100.0f), " %; ", garment.fabric, " gives ",
                        rounded(gives * 100.0f), " % there");
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

std::optional<TooSmall> too_small(const SizedGarment& sized, const ClothPiece& cloth) {
    std::optional<TooSmall> worst;
    for (TooSmall& small :
         std::array{at_crotch(sized, cloth), in_a_tenth(sized, cloth), at_an_opening(sized, cloth)})
        if (small.beyond > (worst ? worst->beyond : 0.0f)) worst = std::move(small);
    return worst;
}

}  // namespace vfit
