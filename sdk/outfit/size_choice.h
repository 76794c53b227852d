// The meaning of a size label: lengths of its own, or a ratio to the lengths around the wearer.
#pragma once

#include "cloth/garment/garment.h"
#include "outfit/wear_options.h"
#include "outfit/wearer.h"

namespace vfit {

struct SizeChoice {
    float ratio = 1.0f;                // of the rest lengths around the body; 1: made to measure
    const GarmentSize* own = nullptr;  // of the garment; null: it has no lengths of its own in that size
};

/// VFIT_ERROR_ARGUMENT for a label that the garment lacks, VFIT_ERROR_DATA where it says no girth.
SizeChoice choose_size(const Garment& garment, const SizeLabel& label, const Wearer& wearer);

}  // namespace vfit
