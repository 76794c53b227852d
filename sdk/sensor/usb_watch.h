// USB cameras of the makes that plug-ins declare: what comes and goes, and what stands in the way of one that
// is there.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/log.h"

struct libusb_context;
struct libusb_device;

namespace vfit {

struct UsbId {
    uint16_t vendor, product;
};

/// "1d27:0609,045e:02ae"; fails with VFIT_ERROR_PLUGIN for anything else. Empty: none.
std::vector<UsbId> parse_usb_ids(const std::string& text);

/// Its own thread waits for what the system tells. Where there is no USB, nothing ever comes.
class UsbWatch {
public:
    UsbWatch(Log& log, std::vector<UsbId> ids);
    ~UsbWatch();
    UsbWatch(const UsbWatch&) = delete;
    UsbWatch& operator=(const UsbWatch&) = delete;

    /// Rises whenever a device of these comes or goes.
    uint64_t changes() const { return changes_; }
    /// Why one of those that are plugged in cannot be opened: no permission, or somebody else has it. Empty:
    /// nothing is known.
    std::string trouble(const std::vector<UsbId>& ids) const;

private:
    static int on_change(libusb_context*, libusb_device* device, int event, void* self);
    void run();

    Log& log_;
    const std::vector<UsbId> ids_;
    libusb_context* usb_ = nullptr;
    int callback_ = 0;
    std::atomic<uint64_t> changes_{0};
    std::atomic<bool> going_{true};
    std::thread thread_;
};

}  // namespace vfit
