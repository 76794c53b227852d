#include "sensor/usb_watch.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include <libusb.h>

#include "core/error.h"

namespace vfit {

namespace {

std::string name_of(const UsbId& id) {
    char name[16];
    std::snprintf(name, sizeof name, "%04x:%04x", id.vendor, id.product);
    return name;
}

bool has(const std::vector<UsbId>& ids, const UsbId& id) {
    return std::any_of(ids.begin(), ids.end(), [&](const UsbId& other) {
        return other.vendor == id.vendor && other.product == id.product;
    });
}

bool id_of(libusb_device* device, UsbId& id) {
    libusb_device_descriptor descriptor;
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS) return false;
    id = {descriptor.idVendor, descriptor.idProduct};
    return true;
}

/// Opens it as a driver would, for a moment.
int try_to_open(libusb_device* device) {
    libusb_device_handle* handle = nullptr;
    if (const int error = libusb_open(device, &handle)) return error;
    const int error = libusb_claim_interface(handle, 0);
    if (error == LIBUSB_SUCCESS) libusb_release_interface(handle, 0);
    libusb_close(handle);
    return error;
}

}  // namespace

std::vector<UsbId> parse_usb_ids(const std::string& text) {
    std::vector<UsbId> ids;
    const auto refuse = [&] {
        fail(VFIT_ERROR_PLUGIN, "its USB ids '", text, "' are not 'vvvv:pppp,...' in hexadecimal");
    };
    for (size_t at = 0; at < text.size(); at += 10) {
        constexpr size_t kId = 9;  // vvvv:pppp
        UsbId id{};
        const auto number = [&](size_t from, uint16_t& out) {
            const char* begin = text.data() + from;
            const auto [end, error] = std::from_chars(begin, begin + 4, out, 16);
            if (error != std::errc() || end != begin + 4) refuse();
        };
        if (text.size() < at + kId || text[at + 4] != ':' ||
            (text.size() > at + kId && text[at + kId] != ',') || text.size() == at + kId + 1)
            refuse();
        number(at, id.vendor), number(at + 5, id.product);
        ids.push_back(id);
    }
    return ids;
}

UsbWatch::UsbWatch(Log& log, std::vector<UsbId> ids) : log_(log), ids_(std::move(ids)) {
    if (libusb_init(&usb_) != LIBUSB_SUCCESS) {
        usb_ = nullptr;
        log_.info("there is no USB here: cameras that come and go are not noticed");
        return;
    }
    if (!libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG)) return;
    const auto callback = [](libusb_context* usb, libusb_device* device, libusb_hotplug_event event,
                             void* self) { return on_change(usb, device, event, self); };
    const int events = LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT;
    if (libusb_hotplug_register_callback(usb_, events, LIBUSB_HOTPLUG_NO_FLAGS, LIBUSB_HOTPLUG_MATCH_ANY,
                                         LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, callback, this,
                                         &callback_) != LIBUSB_SUCCESS)
        return;
    thread_ = std::thread([this] { run(); });
}

UsbWatch::~UsbWatch() {
    if (!usb_) return;
    going_ = false;
    if (thread_.joinable()) {
        libusb_hotplug_deregister_callback(usb_, callback_);  // which wakes the thread as well
        libusb_interrupt_event_handler(usb_);
        thread_.join();
    }
    libusb_exit(usb_);
}

void UsbWatch::run() {
    while (going_) {
        timeval long_enough{60, 0};
        libusb_handle_events_timeout_completed(usb_, &long_enough, nullptr);
    }
}

int UsbWatch::on_change(libusb_context*, libusb_device* device, int event, void* self) {
    auto& watch = *static_cast<UsbWatch*>(self);
    UsbId id{};
    if (!id_of(device, id) || !has(watch.ids_, id)) return 0;
    watch.log_.info("USB camera ", name_of(id),
                    event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED ? ": plugged in" : ": unplugged");
    ++watch.changes_;
    return 0;
}

std::string UsbWatch::trouble(const std::vector<UsbId>& ids) const {
    std::string out;
    libusb_device** devices = nullptr;
    const ssize_t count = usb_ ? libusb_get_device_list(usb_, &devices) : -1;
    for (ssize_t i = 0; i < count && out.empty(); ++i) {
        UsbId id{};
        if (!id_of(devices[i], id) || !has(ids, id)) continue;
        const int error = try_to_open(devices[i]);
        if (error == LIBUSB_ERROR_ACCESS)
            out =
                "USB camera " + name_of(id) +
                " is plugged in, but its node may not be opened: permission denied (a udev rule is missing)";
        if (error == LIBUSB_ERROR_BUSY) out = "USB camera " + name_of(id) + " is in use by another process";
    }
    if (count >= 0) libusb_free_device_list(devices, 1);  // one of none as well
    return out;
}

}  // namespace vfit
