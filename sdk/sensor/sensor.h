// One open device of a plug-in.
#pragma once

#include <string>
#include <vector>

#include "core/handles.h"
#include "sensor/sensor_stream.h"

namespace vfit {

class Plugin;

/// Made by PluginHost::open, which keeps it open until close() or PluginHost::shutdown().
class Sensor : public Object {
public:
    static constexpr Kind kKind = Kind::sensor;

    /// Calls into the plug-in, one at a time for all its devices. After close(): VFIT_ERROR_STATE.
    void start();
    void stop();
    void set_option(const std::string& key, const std::string& value);
    std::vector<vfit_sensor_mode> modes();
    /// The plug-in's own, and "mode" and "pace" where it does not list them.
    std::vector<vfit_sensor_option> options();
    /// Stops, wakes every waiting acquire and lets go of the device. Once is enough, twice is harmless.
    void close();

    /// [any] See FrameQueue::take.
    vfit_result acquire(int64_t timeout_ns, Ref<Frame>& out) { return stream_->queue.take(timeout_ns, out); }
    vfit_sensor_stats describe() const { return stream_->queue.describe(); }
    const std::string& uri() const { return uri_; }

private:
    friend class Plugin;
    Sensor(Ref<Plugin> plugin, std::string uri, Ref<SensorStream> stream, void* token, void* device);
    template <typename T, typename... Arguments>
    friend Ref<T> make(Arguments&&... arguments);

    // All with the plug-in's lock held.
    void check_open() const;
    void stop_device();
    std::vector<vfit_sensor_mode> read_modes();
    std::vector<vfit_sensor_option> read_options();
    void forward_option(const std::string& key, const std::string& value);
    void choose_mode(const std::string& name);
    void read_default_pace();

    const Ref<Plugin> plugin_;
    const std::string uri_;
    const Ref<SensorStream> stream_;
    void* const token_;
    void* device_;
    bool running_ = false;
    std::string mode_;  // chosen by the host; empty: the first
};

}  // namespace vfit
