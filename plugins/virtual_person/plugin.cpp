// The plug-in's one symbol and its table: each entry turns exceptions into a result and a sentence.
#include <algorithm>
#include <exception>
#include <new>
#include <string>

#include "device.h"
#include "error.h"
#include "vfit_plugin.h"

namespace {

using vfit::virtual_person::Device;
using vfit::virtual_person::Error;

struct Plugin;

struct OpenDevice {
    Plugin* plugin;
    Device device;
};

struct Plugin {
    const vfit_host* host;
    std::string last_error;

    template <typename Call>
    vfit_result guard(Call&& call) noexcept {
        try {
            return call();
        } catch (const Error& e) {
            return note(e.code(), e.what());
        } catch (const std::bad_alloc&) {
            return note(VFIT_ERROR_OUT_OF_MEMORY, "virtual: out of memory");
        } catch (const std::exception& e) {
            return note(VFIT_ERROR_UNKNOWN, e.what());
        } catch (...) {
            return note(VFIT_ERROR_UNKNOWN, "virtual: unknown failure");
        }
    }

private:
    vfit_result note(vfit_result code, const char* message) noexcept {
        try {
            last_error = message;
        } catch (...) {
            last_error.clear();
        }
        return code;
    }
};

OpenDevice* as_device(void* device) { return static_cast<OpenDevice*>(device); }

const char* last_error(void* self) { return static_cast<Plugin*>(self)->last_error.c_str(); }

vfit_result discover(void* self) {
    auto* plugin = static_cast<Plugin*>(self);
    return plugin->guard([&] {
        vfit_sensor_info info = vfit_sensor_info_init();
        const auto put = [](auto& field, const char* text) {
            const std::string s(text);
            std::copy(s.begin(), s.end(), field);
        };
        put(info.uri, "virtual:");
        put(info.name, "Virtual person");
        put(info.plugin, "virtual_person");
        plugin->host->sensor_added(plugin->host->self, &info);
        return VFIT_OK;
    });
}

vfit_result open_device(void* self, const char* uri, void* stream, void** device) {
    auto* plugin = static_cast<Plugin*>(self);
    return plugin->guard([&] {
        *device = new OpenDevice{plugin, {plugin->host, stream, uri}};
        return VFIT_OK;
    });
}

vfit_result set_option(void* device, const char* key, const char* value) {
    return as_device(device)->plugin->guard([&] {
        as_device(device)->device.set_option(key, value);
        return VFIT_OK;
    });
}

vfit_result mode(void* device, uint32_t index, vfit_sensor_mode* out) {
    return as_device(device)->plugin->guard(
        [&] { return as_device(device)->device.mode(index, *out) ? VFIT_OK : VFIT_END_OF_STREAM; });
}

vfit_result option(void* device, uint32_t index, vfit_sensor_option* out) {
    return as_device(device)->plugin->guard(
        [&] { return as_device(device)->device.option(index, *out) ? VFIT_OK : VFIT_END_OF_STREAM; });
}

vfit_result start(void* device) {
    return as_device(device)->plugin->guard([&] {
        as_device(device)->device.start();
        return VFIT_OK;
    });
}

vfit_result stop(void* device) {
    return as_device(device)->plugin->guard([&] {
        as_device(device)->device.stop();
        return VFIT_OK;
    });
}

void close_device(void* device) { delete as_device(device); }

void shutdown(void* self) { delete static_cast<Plugin*>(self); }

}  // namespace

vfit_result vfit_plugin_negotiate(const vfit_host* host, vfit_plugin* out) {
    if (!host || !out) return VFIT_ERROR_ARGUMENT;
    if (VFIT_PLUGIN_ABI < host->abi_min || VFIT_PLUGIN_ABI > host->abi_max ||
        host->struct_size < sizeof(vfit_host) || out->struct_size < sizeof(vfit_plugin))
        return VFIT_ERROR_VERSION;
    auto* plugin = new (std::nothrow) Plugin{host, {}};
    if (!plugin) return VFIT_ERROR_OUT_OF_MEMORY;
    out->abi = VFIT_PLUGIN_ABI;
    out->version = VFIT_VERSION;
    out->name = "virtual_person";
    out->schemes = "virtual";
    out->self = plugin;
    out->discover = discover;
    out->last_error = last_error;
    out->open = open_device;
    out->set_option = set_option;
    out->mode = mode;
    out->option = option;
    out->start = start;
    out->stop = stop;
    out->close = close_device;
    out->shutdown = shutdown;
    return VFIT_OK;
}
