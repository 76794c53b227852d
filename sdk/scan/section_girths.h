// Girths of the trunk by level, as outlines from the front and from the side and depth show its sections.
#pragma once

#include <array>

#include "scan/body_scan.h"

namespace vfit {

using SectionGirths = std::array<float, size_t(TrunkProfile::kLevels)>;  // metres; NaN: not seen

SectionGirths section_girths(const ScanFeatures& features);

}  // namespace vfit
