#include "sensor/plugin.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "sensor/sensor.h"
#include "sensor/sized_struct.h"
#include "sensor/source_uri.h"

namespace vfit {

namespace {

constexpr size_t kMaxName = 63;  // characters, the room of vfit_plugin_info
constexpr std::chrono::seconds kPatience{10};
constexpr size_t kMaxUsbIds = 4096;     // characters
constexpr size_t kMaxLastError = 1024;  // characters of last_error that are kept

bool is_scheme(const std::string& scheme) {
    return !scheme.empty() && std::all_of(scheme.begin(), scheme.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '+';
    });
}

std::vector<std::string> split_schemes(const std::string& list) {
    std::vector<std::string> out;
    std::stringstream stream(list);
    for (std::string item; std::getline(stream, item, ',');) out.push_back(item);
    return out;
}

/// The table, with room for one of a newer header: such a plug-in may fill fields that are unknown here.
struct NegotiatedTable {
    vfit_plugin table;
    unsigned char newer[256];
};

}  // namespace

Plugin::Plugin(Log& log, std::function<uint64_t()> context_id, Ref<FrameBytes> frame_bytes, std::string path,
               std::unique_ptr<DynamicLibrary> library, vfit_plugin_negotiate_fn negotiate)
    : frame_bytes_(std::move(frame_bytes)), host_(log, std::move(context_id)), library_(std::move(library)) {
    info_.path = std::move(path);
    host_.set_name(info_.path);
    NegotiatedTable negotiated{};
    negotiated.table.struct_size = sizeof(vfit_plugin);
    const vfit_result result = negotiate(host_.table(), &negotiated.table);
    const std::string needs =
        text(info_.path, ": needs another plug-in ABI than ", VFIT_PLUGIN_ABI, ", which this library has");
    if (result == VFIT_ERROR_VERSION) fail(VFIT_ERROR_VERSION, needs);
    if (result != VFIT_OK) fail(VFIT_ERROR_PLUGIN, info_.path, ": refuses to load, result ", result);
    if (negotiated.table.abi != VFIT_PLUGIN_ABI)
        fail(VFIT_ERROR_VERSION, needs, "; it asks for ", negotiated.table.abi);
    try {
        check_table(negotiated.table);
    } catch (...) {
        if (negotiated.table.shutdown) negotiated.table.shutdown(negotiated.table.self);
        throw;
    }
    table_ = negotiated.table;
    host_.set_name(info_.name);
}

void Plugin::check_table(const vfit_plugin& table) {
    const auto refuse = [&](const auto&... why) { fail(VFIT_ERROR_PLUGIN, info_.path, ": ", why...); };
    info_.name = bounded_text(table.name, kMaxName + 1);
    info_.schemes = bounded_text(table.schemes, kMaxName + 1);
    info_.version = table.version;
    info_.caps = table.caps;
    if (info_.name.empty() || info_.name.size() > kMaxName)
        refuse("has no name of 1 to ", kMaxName, " characters");
    if (info_.schemes.size() > kMaxName)
        refuse("its list of schemes is longer than ", kMaxName, " characters");
    schemes_ = split_schemes(info_.schemes);
    if (schemes_.empty()) refuse("names no URI scheme that it opens");
    for (const std::string& scheme : schemes_)
        if (!is_scheme(scheme)) refuse("'", scheme, "' is not a URI scheme (a-z, 0-9, _ - +)");
    try {
        usb_ids_ = parse_usb_ids(table.usb_ids ? bounded_text(table.usb_ids, kMaxUsbIds) : "");
    } catch (const Error& e) {
        refuse(e.what());
    }
    if (!table.open) refuse("has no open function");
    if (!table.start) refuse("has no start function");
    if (!table.stop) refuse("has no stop function");
    if (!table.close) refuse("has no close function");
}

bool Plugin::serves(const std::string& scheme) const {
    return std::find(schemes_.begin(), schemes_.end(), scheme) != schemes_.end();
}

void Plugin::fail_with_last_error(vfit_result result, const std::string& what) {
    std::string message =
        table_.last_error ? bounded_text(table_.last_error(table_.self), kMaxLastError) : "";
    if (message.empty()) message = text("plug-in ", info_.name, ": ", what, " failed, result ", result);
    const bool known = result < 0 && result >= VFIT_ERROR_PLUGIN;
    fail(known ? result : VFIT_ERROR_PLUGIN, message);
}

vfit_result Plugin::ask_to_end(const char* what, std::function<vfit_result()> call) {
    Answer answer{};
    if (ask_in_time(kPatience, std::move(call), answer)) {
        if (!answer.thrown.empty()) host_.complain(answer.thrown);
        return answer.result;
    }
    hangs_ = true;
    // Its threads may still use the host's table, and its code cannot be unloaded: it stays, for good.
    static std::mutex mutex;
    static auto& hanging = *new std::vector<Ref<Plugin>>;
    std::lock_guard lock(mutex);
    hanging.emplace_back(this);
    host_.complain(
        text(what, " has not returned for ", kPatience.count(), " s: the plug-in is left alone from now on"));
    return VFIT_ERROR_PLUGIN;
}

void Plugin::check_well() const {
    if (hangs_) fail(VFIT_ERROR_PLUGIN, "plug-in ", info_.name, " hangs in a call that never returned");
}

std::vector<vfit_sensor_info> Plugin::discover() {
    std::lock_guard lock(calls_);
    if (down_ || hangs_ || !table_.discover) return listed();
    host_.begin_discovery();
    const vfit_result result = ask([&] { return table_.discover(table_.self); });
    host_.end_discovery(result == VFIT_OK);
    if (result != VFIT_OK) host_.complain(text("discover failed, result ", result));
    return listed();
}

/// The sensors that it reported. A plug-in knows addresses as they are; a URI encodes them.
std::vector<vfit_sensor_info> Plugin::listed() {
    std::vector<vfit_sensor_info> out;
    for (vfit_sensor_info info : host_.sensors()) {
        const std::string uri = has_addresses() ? encode_device(info.uri) : info.uri;
        if (uri.size() >= sizeof info.uri) {
            host_.complain(text(uri, ": is not listed, a URI of a sensor has at most ", sizeof info.uri - 1,
                                " characters"));
            continue;
        }
        std::memset(info.uri, 0, sizeof info.uri);
        uri.copy(info.uri, sizeof info.uri - 1);
        out.push_back(info);
    }
    return out;
}

Ref<Sensor> Plugin::open(const std::string& uri) {
    std::lock_guard lock(calls_);
    if (down_) fail(VFIT_ERROR_STATE, "plug-in ", info_.name, " was shut down");
    check_well();
    auto stream = make<SensorStream>(frame_bytes_);
    void* token = host_.add_stream(stream);
    void* device = nullptr;
    try {
        const vfit_result result = ask([&] { return table_.open(table_.self, uri.c_str(), token, &device); });
        if (result != VFIT_OK) {
            device = nullptr;  // whatever it wrote there: a failed open leaves nothing to close
            fail_with_last_error(result, text("opening ", uri));
        }
        if (!device) fail(VFIT_ERROR_PLUGIN, "plug-in ", info_.name, " opened ", uri, " but gave no device");
        Ref<Sensor> sensor = make<Sensor>(Ref<Plugin>(this), uri, stream, token, device);
        sensor->read_default_pace();
        sensors_.push_back(sensor);
        return sensor;
    } catch (...) {
        if (device) ask([&] { return table_.close(device), VFIT_OK; });
        host_.remove_stream(token);
        throw;
    }
}

void Plugin::forget(Sensor* sensor) {
    std::erase_if(sensors_, [&](const Ref<Sensor>& s) { return s.get() == sensor; });
}

void Plugin::shutdown() {
    std::vector<Ref<Sensor>> open;
    {
        std::lock_guard lock(calls_);
        if (down_) return;
        down_ = true;
        open = sensors_;
    }
    for (const Ref<Sensor>& sensor : open) sensor->close();
    std::lock_guard lock(calls_);
    const vfit_plugin table = table_;
    if (table.shutdown && !hangs_)
        ask_to_end("shutdown", [table] { return table.shutdown(table.self), VFIT_OK; });
    host_.retire();
    table_ = {};
    if (!hangs_) library_.reset();
}

}  // namespace vfit
