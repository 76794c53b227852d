// One loaded plug-in: its negotiated table, its devices, and its end.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/object.h"
#include "core/platform.h"
#include "sensor/host_table.h"
#include "sensor/plugin_call.h"
#include "sensor/usb_watch.h"

namespace vfit {

class Sensor;

struct PluginInfo {
    std::string name, schemes, path;
    uint32_t version = 0, caps = 0;
};

class Plugin : public Object {
public:
    /// Negotiates; fails with VFIT_ERROR_PLUGIN or VFIT_ERROR_VERSION, naming the file and the cause.
    Plugin(Log& log, std::function<uint64_t()> context_id, Ref<FrameBytes> frame_bytes, std::string path,
           std::unique_ptr<DynamicLibrary> library, vfit_plugin_negotiate_fn negotiate);

    const PluginInfo& info() const { return info_; }
    const std::vector<std::string>& schemes() const { return schemes_; }
    const std::vector<UsbId>& usb_ids() const { return usb_ids_; }
    bool serves(const std::string& scheme) const;
    /// False: in its URIs options follow the colon.
    bool has_addresses() const { return !(info_.caps & VFIT_PLUGIN_NO_ADDRESS); }

    /// Its sensors, with URIs that PluginHost::open takes.
    std::vector<vfit_sensor_info> discover();
    /// A device without options: "scheme:address", decoded.
    Ref<Sensor> open(const std::string& uri);
    void shutdown();

private:
    friend class Sensor;
    void check_table(const vfit_plugin& table);
    /// Turns a failed call's result into an Error with the plug-in's own words.
    [[noreturn]] void fail_with_last_error(vfit_result result, const std::string& what);
    void forget(Sensor* sensor);
    std::vector<vfit_sensor_info> listed();
    /// What it throws is complained about, and becomes VFIT_ERROR_PLUGIN.
    template <typename Call>
    vfit_result ask(Call&& call) {
        std::string thrown;
        const vfit_result result = ask_plugin(thrown, call);
        if (!thrown.empty()) host_.complain(thrown);
        return result;
    }
    /// One that has to wait for its threads, and may do so for ever: it is given up then, with all that it
    /// holds.
    vfit_result ask_to_end(const char* what, std::function<vfit_result()> call);
    void check_well() const;

    const Ref<FrameBytes> frame_bytes_;
    HostTable host_;
    std::unique_ptr<DynamicLibrary> library_;
    vfit_plugin table_{};
    PluginInfo info_;
    std::vector<std::string> schemes_;
    std::vector<UsbId> usb_ids_;

    // One thread at a time inside the plug-in, so that its last_error belongs to the call that failed. Never
    // taken by a callback of the host table: a plug-in may join its threads inside stop.
    std::mutex calls_;
    std::vector<Ref<Sensor>> sensors_;
    bool down_ = false;
    bool hangs_ = false;  // inside a call that never came back
};

}  // namespace vfit
