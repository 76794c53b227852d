#include "outfit/size_choice.h"

namespace vfit {

SizeChoice choose_size(const Garment& garment, const SizeLabel& label, const Wearer& wearer) {
    if (!label) return {};
    const GarmentSize& size = garment.size(*label);
    if (!size.flat.empty() || !garment.cut_shape.empty()) return {1.0f, &size};
    return {size_ratio(garment, *label, wearer.measures()), nullptr};
}

}  // namespace vfit
