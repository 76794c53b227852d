#include "options.h"

#include <cstdio>

#include "support/failure.h"
#include "support/whole_number.h"

namespace recording {

using plugin::fail;
using plugin::whole_number;

void Options::set(const std::string& key, const std::string& value, uint32_t frame_count) {
    if (key == "pace") {
        if (value != "none" && value != "realtime")
            fail(VFIT_ERROR_ARGUMENT, "option pace: '", value, "' is neither 'none' nor 'realtime'");
        realtime = value == "realtime";
    } else if (key == "loop") {
        loop = whole_number(key, value, 1) == 1;
    } else if (key == "start") {
        start = whole_number(key, value, frame_count - 1);
    } else if (key == "count") {
        count = whole_number(key, value, UINT32_MAX);
    } else {
        fail(VFIT_ERROR_UNSUPPORTED, "a recording has no option '", key,
             "'; it has mode, pace, loop, start, count");
    }
}

bool Options::describe(uint32_t index, vfit_sensor_option& out) const {
    const auto fill = [&](const char* key, const std::string& value, const char* text) {
        std::snprintf(out.key, sizeof out.key, "%s", key);
        std::snprintf(out.value, sizeof out.value, "%s", value.c_str());
        std::snprintf(out.text, sizeof out.text, "%s", text);
        return true;
    };
    switch (index) {
        case 0:
            return fill("pace", realtime ? "realtime" : "none",
                        "none: every frame; realtime: as a camera does");
        case 1: return fill("loop", loop ? "1" : "0", "1: begin again after the last frame");
        case 2: return fill("start", std::to_string(start), "first frame");
        case 3: return fill("count", std::to_string(count), "number of frames; 0: all");
        default: return false;
    }
}

}  // namespace recording
