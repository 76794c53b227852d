// An open OpenNI2 device or file: its depth stream and, where there is one of the same size, its colour
// stream.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "reader/library.h"

namespace openni2 {

struct Picture {
    Image image;
    std::vector<uint16_t> depth;
    std::vector<uint8_t> color;  // RGBA; empty: none
};

class Camera {
public:
    /// An empty URI: the first device. Where it throws, what it opened stays so: the process is about to end,
    /// and closing what is damaged has crashed before anybody was told why.
    Camera(const Library& library, const std::string& uri);
    ~Camera();
    Camera(const Camera&) = delete;
    Camera& operator=(const Camera&) = delete;

    const Opened& description() const { return description_; }
    void start(const Start& start);
    void stop();
    /// false: nothing came within that time. Throws Ended at the end.
    bool next(int milliseconds, Picture& picture);

private:
    using Clock = std::chrono::steady_clock;
    template <typename T>
    bool get(OniStreamHandle stream, int property, T& value) const;
    template <typename T>
    bool set(OniStreamHandle stream, int property, const T& value) const;
    void describe_modes();
    void open_color();
    void close_color();
    void read_depth(const OniFrame& frame, Picture& picture);
    void read_color(const OniFrame& frame);
    bool give(Picture& picture);
    void check_plugged() const;
    void check_patience() const;
    [[noreturn]] void end_of_file() const;

    const Library& library_;
    std::string name_;  // in sentences
    OniDeviceHandle device_ = nullptr;
    OniStreamHandle depth_ = nullptr, color_ = nullptr;
    OniCallbackHandle callback_ = nullptr;
    std::string uri_;
    std::atomic<bool> gone_{false};
    Opened description_{};
    std::vector<OniVideoMode> modes_;
    bool is_registered_ = false;
    bool depth_mirrored_ = false, color_mirrored_ = false;
    float horizontal_fov_rad_ = 0.0f, vertical_fov_rad_ = 0.0f;
    Start start_{};
    bool running_ = false;
    uint32_t read_ = 0;  // frames of the file
    Clock::time_point newest_depth_;
    std::vector<uint8_t> newest_color_;
    int64_t color_us_ = 0;  // of that
    Picture held_{};        // depth whose colour may still come
    bool holds_ = false;
};

/// All devices that the drivers see, as plug-ins tell sensors.
std::vector<Listed> list_devices(const Library& library);

}  // namespace openni2
