// One OpenNI2 device or .oni file: its reader, and the thread that carries images from there into the host's
// frames.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "options.h"
#include "reader_process.h"
#include "vfit_plugin.h"

namespace openni2 {

class Device {
public:
    static constexpr const char *kName = "openni2", *kSchemes = "openni2,oni";
    // As the rules for udev that come with OpenNI2 name them: PrimeSense, Asus, Occipital; Kinect; and
    // Orbbec's Astra.
    static constexpr const char* kUsbIds =
        "1d27:0200,1d27:0300,1d27:0400,1d27:0401,1d27:0500,1d27:0600,1d27:0601,1d27:0609,1d27:1280,1d27:2100,"
        "1d27:2200,1d27:f9db,045e:02ae,045e:02bf,2bc5:0401,2bc5:0402,2bc5:0403,2bc5:0404,2bc5:0407";
    static void discover(const vfit_host& host);

    /// "openni2:" the first device, "openni2:URI" one as OpenNI2 names it, "oni:PATH" a file.
    Device(const vfit_host& host, void* stream, const std::string& uri);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    void set_option(const std::string& key, const std::string& value);
    bool mode(uint32_t index, vfit_sensor_mode& out) const { return options_.mode(index, out); }
    bool option(uint32_t index, vfit_sensor_option& out) const { return options_.describe(index, out); }
    void start();
    void stop();

private:
    enum class Outcome { goes_on, ended, lost, stopping };

    Opened wait_for_opened(ReaderProcess& reader) const;
    void run();
    /// Until the stream stops, ends or is lost.
    Outcome play();
    Outcome take_state(const Head& head);
    Outcome take_image(const Head& head);
    Outcome broken();
    void fill(vfit_frame frame, const Image& image) const;
    void skip(size_t bytes);
    int64_t time_of(const Image& image);
    bool come_back();
    bool pause(int milliseconds);
    bool wait_until(int64_t time_ns);
    bool stopping();
    void tell(vfit_result state, const std::string& message) const;

    const vfit_host& host_;
    void* const stream_;
    std::string uri_;    // as the host gave it
    std::string opens_;  // as OpenNI2 wants it
    bool is_file_ = false;
    std::unique_ptr<ReaderProcess> reader_;
    Options options_;
    std::vector<uint8_t> skipped_;       // room for what nobody wants
    int64_t last_us_ = 0, last_ns_ = 0;  // of the image before
    bool first_ = true;                  // image of this round
    bool clean_ = false;  // the reader stopped in order, and nothing of it is left in the socket

    std::thread thread_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    bool opening_ = false;  // again, after it was lost
};

}  // namespace openni2
