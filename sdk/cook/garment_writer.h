// Writes a garment file (docs/garments.md).
#pragma once

#include <string>

#include "cloth/garment/garment.h"

namespace vfit {

/// JSON with 5 decimals (a hundredth of a millimetre) to a coordinate: the same text on every machine.
std::string write_garment(const Garment& garment);

}  // namespace vfit
