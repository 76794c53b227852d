// A plug-in's table from a class of its devices: each entry turns exceptions into a result, and keeps the
// sentence for last_error.
//
// Device has
//   static constexpr const char *kName, *kSchemes, *kUsbIds (may be null)
//   Device(const vfit_host&, void* stream, const std::string& uri), set_option(key, value), start(), stop()
//   bool mode(index, vfit_sensor_mode&), bool option(index, vfit_sensor_option&): false past the last
// and may have
//   static constexpr uint32_t kCaps
//   static void discover(const vfit_host&)
#pragma once

#include <exception>
#include <new>
#include <string>

#include "support/failure.h"
#include "vfit_plugin.h"

namespace plugin {

template <typename Device>
class Table {
public:
    static vfit_result negotiate(const vfit_host* host, vfit_plugin* out) noexcept {
        if (!host || !out) return VFIT_ERROR_ARGUMENT;
        if (host->abi_min > VFIT_PLUGIN_ABI || host->abi_max < VFIT_PLUGIN_ABI ||
            host->struct_size < sizeof(vfit_host) || out->struct_size < sizeof(vfit_plugin))
            return VFIT_ERROR_VERSION;
        auto* self = new (std::nothrow) Table(*host);
        if (!self) return VFIT_ERROR_OUT_OF_MEMORY;
        out->struct_size = sizeof(vfit_plugin);
        out->abi = VFIT_PLUGIN_ABI;
        out->version = VFIT_VERSION;
        if constexpr (requires { Device::kCaps; }) out->caps = Device::kCaps;
        out->name = Device::kName;
        out->schemes = Device::kSchemes;
        out->usb_ids = Device::kUsbIds;
        out->self = self;
        if constexpr (requires { Device::discover(*host); })
            out->discover = [](void* plugin) {
                return of(plugin).guard([&] { Device::discover(of(plugin).host_); });
            };
        out->last_error = [](void* plugin) { return of(plugin).error_.c_str(); };
        out->open = open;
        out->set_option = [](void* device, const char* key, const char* value) {
            return call(device, [&](Device& d) { d.set_option(key, value); });
        };
        out->mode = [](void* device, uint32_t index, vfit_sensor_mode* item) {
            return listed(device, [&](Device& d) { return d.mode(index, *item); });
        };
        out->option = [](void* device, uint32_t index, vfit_sensor_option* item) {
            return listed(device, [&](Device& d) { return d.option(index, *item); });
        };
        out->start = [](void* device) { return call(device, [](Device& d) { d.start(); }); };
        out->stop = [](void* device) { return call(device, [](Device& d) { d.stop(); }); };
        out->close = [](void* device) { delete static_cast<Open*>(device); };
        out->shutdown = [](void* plugin) { delete &of(plugin); };
        return VFIT_OK;
    }

private:
    /// A device as the host knows it: with the plug-in that keeps its errors.
    struct Open {
        Table& plugin;
        Device device;
    };

    explicit Table(const vfit_host& host) : host_(host) {}

    static Table& of(void* plugin) { return *static_cast<Table*>(plugin); }

    static vfit_result open(void* plugin, const char* uri, void* stream, void** device) {
        return of(plugin).guard(
            [&] { *device = new Open{of(plugin), Device(of(plugin).host_, stream, uri)}; });
    }
    template <typename Call>
    static vfit_result call(void* device, Call&& what) {
        auto& open = *static_cast<Open*>(device);
        return open.plugin.guard([&] { what(open.device); });
    }
    template <typename Call>
    static vfit_result listed(void* device, Call&& what) {
        bool there = false;
        const vfit_result result = call(device, [&](Device& d) { there = what(d); });
        return result == VFIT_OK && !there ? VFIT_END_OF_STREAM : result;
    }

    template <typename Call>
    vfit_result guard(Call&& what) noexcept {
        try {
            what();
            return VFIT_OK;
        } catch (const Failure& failure) {
            return note(failure.code(), failure.what());
        } catch (const std::bad_alloc&) {
            return note(VFIT_ERROR_OUT_OF_MEMORY, "out of memory");
        } catch (const std::exception& error) {
            return note(VFIT_ERROR_UNKNOWN, error.what());
        } catch (...) {
            return note(VFIT_ERROR_UNKNOWN, "unknown failure");
        }
    }
    vfit_result note(vfit_result code, const char* message) noexcept {
        try {
            error_ = message;
        } catch (...) {
            error_.clear();
        }
        return code;
    }

    const vfit_host& host_;
    std::string error_;
};

}  // namespace plugin
