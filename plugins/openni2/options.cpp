#include "options.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "support/failure.h"
#include "support/whole_number.h"

namespace openni2 {

using plugin::fail;
using plugin::whole_number;

namespace {

std::string name_of(const Mode& mode) {
    char name[64];
    std::snprintf(name, sizeof name, "%ux%u@%g%s", mode.width, mode.height, double(mode.rate_hz),
                  mode.depth_100um ? ",0.1mm" : "");
    return name;
}

}  // namespace

Options::Options(const Opened& opened)
    : opened_(opened),
      mode_(opened.mode),
      realtime_(!opened.is_file),
      registration_(opened.offers_registration),
      color_(!opened.is_file) {}

void Options::set(const std::string& key, const std::string& value) {
    if (key == "pace") {
        if (value != "none" && value != "realtime")
            fail(VFIT_ERROR_ARGUMENT, "option pace: '", value, "' is neither 'none' nor 'realtime'");
        realtime_ = value == "realtime";
    } else if (key == "mode") {
        for (uint32_t i = 0; i < opened_.mode_count; ++i)
            if (name_of(opened_.modes[i]) == value && (!opened_.is_file || i == opened_.mode)) {
                mode_ = i;
                return;
            }
        fail(VFIT_ERROR_ARGUMENT, "option mode: '", value, "' is none of the device's modes");
    } else if (key == "registration" && opened_.offers_registration) {
        registration_ = whole_number(key, value, 1) == 1;
    } else if (key == "color" && opened_.has_color) {
        color_ = whole_number(key, value, 1) == 1;
    } else if (key == "loop" && opened_.is_file) {
        loop_ = whole_number(key, value, 1) == 1;
    } else if (key == "start" && opened_.is_file) {
        first_ = whole_number(key, value, std::max(opened_.frames, 1u) - 1);
    } else if (key == "count" && opened_.is_file) {
        count_ = whole_number(key, value, UINT32_MAX);
    } else {
        std::string known;
        vfit_sensor_option option{};
        for (uint32_t i = 0; describe(i, option); ++i) known += (i ? ", " : "") + std::string(option.key);
        fail(VFIT_ERROR_UNSUPPORTED, "this device has no option '", key, "'; it has ", known);
    }
}

bool Options::mode(uint32_t index, vfit_sensor_mode& out) const {
    if (index >= (opened_.is_file ? 1 : opened_.mode_count)) return false;
    const Mode& mode = opened_.is_file ? this->mode() : opened_.modes[index];
    out.width = mode.width, out.height = mode.height, out.rate_hz = mode.rate_hz;
    std::snprintf(out.name, sizeof out.name, "%s", name_of(mode).c_str());
    return true;
}

bool Options::describe(uint32_t index, vfit_sensor_option& out) const {
    struct Entry {
        const char* key;
        std::string value;
        const char* text;
    };
    std::vector<Entry> all{
        {"pace", realtime_ ? "realtime" : "none", "none: every frame; realtime: as a camera does"},
        {"mode", name_of(mode()), "depth image, a name of the modes"}};
    if (opened_.offers_registration)
        all.push_back(
            {"registration", registration_ ? "1" : "0", "1: the device moves depth to where colour sees it"});
    if (opened_.has_color)
        all.push_back({"color", color_ ? "1" : "0",
                       opened_.is_file ? "1: colour too, right where depth was registered as it was recorded"
                                       : "1: colour too, where depth is registered to it"});
    if (opened_.is_file) {
        all.push_back({"loop", loop_ ? "1" : "0", "1: begin again after the last frame"});
        all.push_back({"start", std::to_string(first_), "first frame"});
        all.push_back({"count", std::to_string(count_), "number of frames; 0: all"});
    }
    if (index >= all.size()) return false;
    std::snprintf(out.key, sizeof out.key, "%s", all[index].key);
    std::snprintf(out.value, sizeof out.value, "%s", all[index].value.c_str());
    std::snprintf(out.text, sizeof out.text, "%s", all[index].text);
    return true;
}

Start Options::start() const { return {mode_, registration_, color_, first_, count_}; }

}  // namespace openni2
