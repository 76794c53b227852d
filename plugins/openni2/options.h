// What a host may set of an OpenNI2 device or file.
#pragma once

#include <string>

#include "vfit.h"
#include "wire.h"

namespace openni2 {

class Options {
public:
    Options() = default;
    explicit Options(const Opened& opened);

    void set(const std::string& key, const std::string& value);
    /// False past the last.
    bool mode(uint32_t index, vfit_sensor_mode& out) const;
    bool describe(uint32_t index, vfit_sensor_option& out) const;

    Start start() const;
    bool realtime() const { return realtime_; }
    bool loop() const { return loop_; }
    const Mode& mode() const { return opened_.modes[opened_.is_file ? opened_.mode : mode_]; }

private:
    Opened opened_{};
    uint32_t mode_ = 0;
    bool realtime_ = true, loop_ = false, registration_ = false, color_ = true;
    uint32_t first_ = 0, count_ = 0;
};

}  // namespace openni2
