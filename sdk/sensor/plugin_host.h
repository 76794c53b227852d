// All sensor plug-ins of a context: loading, discovery, and the plug-in that serves a URI.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/log.h"
#include "sensor/plugin.h"
#include "sensor/sensor.h"
#include "sensor/source_uri.h"
#include "sensor/usb_watch.h"

namespace vfit {

class PluginHost {
public:
    /// context_id: the handle below which frames live while a plug-in fills them. The memory of all its
    /// frames is counted in frame_bytes.
    PluginHost(Log& log, std::function<uint64_t()> context_id, Ref<FrameBytes> frame_bytes = nullptr);
    ~PluginHost();
    PluginHost(const PluginHost&) = delete;
    PluginHost& operator=(const PluginHost&) = delete;

    /// Fails with VFIT_ERROR_PLUGIN, or VFIT_ERROR_VERSION for another ABI, naming the file and the cause.
    void load(const std::string& path);
    /// A plug-in that is linked into the program; name stands for the file in messages.
    void attach(const std::string& name, vfit_plugin_negotiate_fn negotiate);
    /// Every vfit_* library of a folder, in the order of their names; one that does not load is logged and
    /// skipped, a folder that is not there holds none.
    void load_folder(const std::string& folder);

    std::vector<PluginInfo> plugins() const;
    /// Asks every plug-in; sensors that came or went between two calls are in the list or not.
    std::vector<vfit_sensor_info> discover();
    /// "scheme:address?key=value&key=value" (source_uri.h); or the path of a folder (a recording), or of a
    /// file whose extension is a scheme, with or without options. Each option is set as Sensor::set_option
    /// does and fails as it does. Fails with VFIT_ERROR_UNSUPPORTED, listing the schemes, where no plug-in
    /// serves it.
    Ref<Sensor> open(const std::string& uri);
    /// Rises whenever discover() may have something else to tell: plug-ins were loaded, or a USB camera came
    /// or went.
    uint64_t changes();
    /// Closes every sensor, then shuts down every plug-in. Nothing of a plug-in is called afterwards.
    void shutdown();

private:
    void add(std::string path, std::unique_ptr<DynamicLibrary> library, vfit_plugin_negotiate_fn negotiate);
    Ref<Plugin> serving(const std::string& scheme) const;
    std::string scheme_of_path(const std::string& name) const;
    SourceUri resolve(const std::string& uri) const;
    Ref<Sensor> open_device(Plugin& plugin, const std::string& device);
    [[noreturn]] void refuse(const std::string& uri, const std::string& scheme) const;
    std::vector<Ref<Plugin>> all() const;
    UsbWatch* usb();

    Log& log_;
    const std::function<uint64_t()> context_id_;
    const Ref<FrameBytes> frame_bytes_;
    mutable std::mutex mutex_;
    std::vector<Ref<Plugin>> plugins_;
    bool down_ = false;
    std::unique_ptr<UsbWatch> usb_;  // from the first time that anybody asks for sensors
};

}  // namespace vfit
