// The plug-in's table: recording folders as sensors. Each function turns a Failure into a result and keeps
// its sentence for last_error.
#include <new>

#include "device.h"
#include "failure.h"
#include "vfit_plugin.h"

namespace recording {
namespace {

constexpr char kScheme[] = "recording:";

struct Plugin {
    const vfit_host& host;
    std::string error;
};

/// A device as the host knows it: with the plug-in that keeps its errors.
struct OpenDevice {
    Plugin& plugin;
    Device device;
};

template <typename Body>
vfit_result guard(Plugin& plugin, Body&& body) noexcept {
    try {
        try {
            return body();
        } catch (const Failure& failure) {
            plugin.error = failure.what();
            return failure.result();
        } catch (const std::bad_alloc&) {
            plugin.error = "out of memory";
            return VFIT_ERROR_OUT_OF_MEMORY;
        } catch (const std::exception& error) {
            plugin.error = error.what();
            return VFIT_ERROR_UNKNOWN;
        }
    } catch (...) {
        return VFIT_ERROR_UNKNOWN;
    }
}

vfit_result listed(bool there) { return there ? VFIT_OK : VFIT_END_OF_STREAM; }

OpenDevice& device_of(void* device) { return *static_cast<OpenDevice*>(device); }

const char* last_error(void* self) { return static_cast<Plugin*>(self)->error.c_str(); }

vfit_result open(void* self, const char* uri, void* stream, void** device) {
    Plugin& plugin = *static_cast<Plugin*>(self);
    return guard(plugin, [&] {
        std::string path = uri;
        if (path.rfind(kScheme, 0) == 0) path.erase(0, sizeof kScheme - 1);
        Folder folder = open_folder(std::filesystem::path(path));
        *device = new OpenDevice{plugin, Device(plugin.host, stream, std::move(folder))};
        return VFIT_OK;
    });
}

vfit_result set_option(void* device, const char* key, const char* value) {
    OpenDevice& d = device_of(device);
    return guard(d.plugin, [&] {
        d.device.set_option(key, value);
        return VFIT_OK;
    });
}

vfit_result mode(void* device, uint32_t index, vfit_sensor_mode* out) {
    OpenDevice& d = device_of(device);
    return guard(d.plugin, [&] { return listed(d.device.describe_mode(index, *out)); });
}

vfit_result option(void* device, uint32_t index, vfit_sensor_option* out) {
    OpenDevice& d = device_of(device);
    return guard(d.plugin, [&] { return listed(d.device.describe_option(index, *out)); });
}

vfit_result start(void* device) {
    OpenDevice& d = device_of(device);
    return guard(d.plugin, [&] {
        d.device.start();
        return VFIT_OK;
    });
}

vfit_result stop(void* device) {
    OpenDevice& d = device_of(device);
    return guard(d.plugin, [&] {
        d.device.stop();
        return VFIT_OK;
    });
}

void close(void* device) { delete static_cast<OpenDevice*>(device); }

void shutdown(void* self) { delete static_cast<Plugin*>(self); }

}  // namespace
}  // namespace recording

extern "C" VFIT_PLUGIN_EXPORT vfit_result vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out) {
    using namespace recording;
    if (!host || !out) return VFIT_ERROR_ARGUMENT;
    if (host->abi_min > VFIT_PLUGIN_ABI || host->abi_max < VFIT_PLUGIN_ABI ||
        host->struct_size < sizeof(vfit_host) || out->struct_size < sizeof(vfit_plugin))
        return VFIT_ERROR_VERSION;
    auto* plugin = new (std::nothrow) Plugin{*host, {}};
    if (!plugin) return VFIT_ERROR_OUT_OF_MEMORY;
    out->struct_size = sizeof(vfit_plugin);
    out->abi = VFIT_PLUGIN_ABI;
    out->version = VFIT_VERSION;
    out->name = "recording";
    out->schemes = "recording";
    out->self = plugin;
    out->last_error = last_error;
    out->open = open;
    out->set_option = set_option;
    out->mode = mode;
    out->option = option;
    out->start = start;
    out->stop = stop;
    out->close = close;
    out->shutdown = shutdown;
    return VFIT_OK;
}
