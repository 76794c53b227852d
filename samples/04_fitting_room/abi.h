// The C ABI with errors as exceptions and handles that let go of themselves: all that this sample adds to
// vfit.h.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "vfit.h"

namespace room {

/// What ends the program: one sentence for its user.
class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

inline std::string last_error() {
    char text[512];
    vfit_last_error(text, sizeof text);
    return text;
}

/// Lets news (>= 0) through.
inline vfit_result check(vfit_result result) {
    if (result < 0) throw Failure(last_error());
    return result;
}

template <typename T, vfit_result (*kDestroy)(T)>
class Handle {
public:
    Handle() = default;
    Handle(Handle&& other) noexcept : value_(std::exchange(other.value_, T{})) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~Handle() { clear(); }
    void clear() {
        if (value_.id) kDestroy(value_);
        value_ = T{};
    }
    T get() const { return value_; }
    /// For a call that gives a handle; what was held before is let go of.
    T* out() {
        clear();
        return &value_;
    }
    explicit operator bool() const { return value_.id != 0; }

private:
    T value_{};
};

using Context = Handle<vfit_context, vfit_context_destroy>;
using Sensor = Handle<vfit_sensor, vfit_sensor_close>;
using Frame = Handle<vfit_frame, vfit_frame_release>;
using Tracker = Handle<vfit_tracker, vfit_tracker_destroy>;
using Scan = Handle<vfit_scan, vfit_scan_destroy>;
using SizeChart = Handle<vfit_size_chart, vfit_size_chart_destroy>;
using Motion = Handle<vfit_motion, vfit_motion_destroy>;
using Avatar = Handle<vfit_avatar, vfit_avatar_destroy>;
using Garment = Handle<vfit_garment, vfit_garment_destroy>;
using Cloth = Handle<vfit_cloth, vfit_cloth_destroy>;

inline vfit_view view_of(vfit_frame frame, vfit_stream stream) {
    vfit_view view = vfit_view_init();
    check(vfit_frame_view(frame, stream, &view));
    return view;
}

}  // namespace room
