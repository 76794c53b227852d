// A virtual person as a sensor: options, and the thread that makes frames and hands them to the host.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "options.h"
#include "person.h"
#include "renderer.h"
#include "vfit_plugin.h"

namespace vfit::virtual_person {

class Device {
public:
    static constexpr const char *kName = "virtual_person", *kSchemes = "virtual", *kUsbIds = nullptr;
    static constexpr uint32_t kCaps = VFIT_PLUGIN_NO_ADDRESS;
    static void discover(const vfit_host& host);

    Device(const vfit_host& host, void* stream, const std::string& uri);
    ~Device() { stop(); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    void set_option(const std::string& key, const std::string& value);
    /// False past the last.
    bool mode(uint32_t index, vfit_sensor_mode& out) const;
    bool option(uint32_t index, vfit_sensor_option& out) const;
    void start();
    void stop();

private:
    void run();
    /// The result that ends the stream, or VFIT_OK.
    vfit_result push_frame(uint64_t index, int64_t time_ns);
    void wait_until(int64_t time_ns) const;

    const vfit_host* host_;
    void* stream_;
    OwnContext context_;
    Options options_;
    std::vector<vfit_shape_value> shape_keys_;
    std::map<std::string, float> shape_;
    std::unique_ptr<Renderer> renderer_;
    std::thread thread_;
    std::atomic<bool> stopping_{false};
};

}  // namespace vfit::virtual_person
