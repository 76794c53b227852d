#include "record/camera_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vfit {

namespace {

using OrderedJson = nlohmann::ordered_json;  // fields in the order of the format

/// The shortest decimal that reads back as the same float: 0.001, not 0.0010000000474974513; and 30,
/// not 30.0.
OrderedJson number(float x) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    double shortest = x;
    std::from_chars(digits, end, shortest);
    const auto whole = static_cast<int64_t>(std::abs(x) < 1e6f ? x : 0.5f);
    if (static_cast<float>(whole) == x) return whole;
    return shortest;
}

}  // namespace

std::string camera_json(const Camera& camera, const std::string& sensor_name, float rate_hz, bool segmented) {
    OrderedJson json;
    json["format"] = "vfit-recording";
    json["version"] = 1;
    json["sensor"] = sensor_name;
    json["width"] = camera.width;
    json["height"] = camera.height;
    json["fx"] = number(camera.fx);
    json["fy"] = number(camera.fy);
    json["cx"] = number(camera.cx);
    json["cy"] = number(camera.cy);
    json["fps"] = number(rate_hz);
    json["depth_unit_m"] = number(camera.depth_unit_m);
    const auto& distortion = camera.distortion;
    if (std::any_of(std::begin(distortion), std::end(distortion), [](float k) { return k != 0.0f; }))
        for (const float k : distortion) json["distortion"].push_back(number(k));
    if (segmented) json["segmented"] = true;
    if (camera.floor_state == VFIT_FLOOR_GIVEN) {
        const Vec3& n = camera.floor_normal;
        json["floor"]["normal"] = {number(n.x), number(n.y), number(n.z)};
        json["floor"]["distance_m"] = number(camera.floor_distance_m);
        json["camera_height_m"] = number(camera.camera_height_m());
        json["tilt_deg"] = number(camera.tilt_rad() * 180.0f / kPi);
    }
    // A name that is not UTF-8 must not end a recording.
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace vfit
