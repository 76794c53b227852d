// camera.json of a recording folder.
#pragma once

#include <string>

#include "frame/camera.h"

namespace vfit {

/// The text of camera.json. The floor is in it where somebody gave it; an estimate is left to the reader.
std::string camera_json(const Camera& camera, const std::string& sensor_name, float rate_hz, bool segmented);

}  // namespace vfit
