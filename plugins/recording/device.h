// One open recording: a thread that reads frame after frame and pushes them.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "folder.h"
#include "options.h"
#include "png_reader.h"
#include "vfit_plugin.h"

namespace recording {

class Device {
public:
    static constexpr const char *kName = "recording", *kSchemes = "recording", *kUsbIds = nullptr;

    Device(const vfit_host& host, void* stream, const std::string& uri);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    void set_option(const std::string& key, const std::string& value);
    bool option(uint32_t index, vfit_sensor_option& out) const { return options_.describe(index, out); }
    bool mode(uint32_t index, vfit_sensor_mode& out) const;
    void start();
    void stop();

private:
    enum class Outcome { pushed, dropped, stopping };

    void run();
    /// Plays the chosen frames once, the first at `time_ns`; false where the stream is stopping. After it
    /// `time_ns` is the time of the frame that would follow.
    bool play(int64_t& time_ns);
    int64_t recorded_time_ns(uint32_t frame);
    Outcome push(uint32_t frame, int64_t time_ns);
    void fill(vfit_frame handle, uint32_t frame);
    void fill_user_map(vfit_frame handle, uint32_t frame);
    void fill_bodies(vfit_frame handle, uint32_t frame);
    void fill_meta(vfit_frame handle, uint32_t frame);
    void* pixels(vfit_frame handle, vfit_stream kind, uint32_t& row_stride) const;
    bool wait_until(int64_t time_ns);
    bool stopping();
    bool has_user_map() const { return folder_.has_mask || folder_.camera.segmented; }

    const vfit_host& host_;
    void* const stream_;
    Folder folder_;
    const int64_t period_ns_;
    Options options_;
    PngReader png_;
    std::vector<RecordedBody> bodies_;
    int64_t last_recorded_ns_ = 0;  // of the frame before
    bool first_ = true;             // no frame before in this round

    std::thread thread_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
};

}  // namespace recording
