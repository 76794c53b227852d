// Reads sewing patterns of GarmentCode (Korosteleva and Sorkine-Hornung 2023): *_specification.json.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cook/pattern/pattern.h"

namespace vfit {

/// Does the text look like one? (An object with a "pattern" that has "panels".)
bool is_garmentcode(std::span<const std::byte> json);

/// Lengths become metres. VFIT_ERROR_DATA names the panel, edge or stitch; the pattern has passed
/// check_pattern. A specification whose numbers are no size for a garment in its own unit is refused with the
/// unit that would fit.
Pattern parse_garmentcode(std::span<const std::byte> json, const std::string& name);

}  // namespace vfit
