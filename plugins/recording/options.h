// The options of a replay.
#pragma once

#include <cstdint>
#include <string>

#include "vfit.h"

namespace recording {

struct Options {
    bool realtime = false;
    bool loop = false;
    uint32_t start = 0;
    uint32_t count = 0;  // 0: all

    /// Fails with VFIT_ERROR_ARGUMENT or VFIT_ERROR_UNSUPPORTED, naming the key.
    void set(const std::string& key, const std::string& value, uint32_t frame_count);
    /// Key, value and meaning of the option at index; false past the last.
    bool describe(uint32_t index, vfit_sensor_option& out) const;
};

}  // namespace recording
