// The body that a garment was drawn for, from the measures that lie beside it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "avatar/body_with_measures.h"
#include "body/shape_setting.h"

namespace vfit {

/// Measures of a person: keys of measure_keys.h, and heights of a standing body's levels above the soles.
struct DrawnFor {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    std::vector<WantedMeasure> wanted;
};

inline constexpr const char *kNapeLevel = "nape_level_m", *kWaistLevel = "waist_level_m",
                            *kHipLevel = "hip_level_m";

/// Of GarmentCode's body_measurements.yaml (centimetres), or a profile of vfit's (JSON). VFIT_ERROR_DATA
/// names the line or the key.
DrawnFor parse_drawn_for(std::string_view text);

struct BodyDrawnFor {
    vfit_sex sex = VFIT_SEX_FEMALE;
    std::vector<ShapeSetting> shape;
    std::vector<std::string> notes;  // of measures that it could not be given
};

/// 0.5 to 2 s. Of an unknown sex the one whose body comes nearer to the measures.
BodyDrawnFor body_drawn_for(const BodyModel& model, const DrawnFor& drawn_for);

}  // namespace vfit
