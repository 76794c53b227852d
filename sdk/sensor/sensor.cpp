#include "sensor/sensor.h"

#include <cmath>

#include "core/error.h"
#include "sensor/plugin.h"
#include "sensor/sized_struct.h"

namespace vfit {

namespace {

constexpr uint32_t kMaxListed = 256;     // modes or options of one device; more is a list without end
constexpr size_t kMaxOptionText = 4096;  // characters of a key or a value
constexpr size_t kShownText = 64;        // characters of a refused key that a message repeats

Pace pace_from(const std::string& value) {
    if (value == "realtime") return Pace::realtime;
    if (value == "none") return Pace::none;
    fail(VFIT_ERROR_ARGUMENT, "option pace: '", value, "' is neither 'realtime' nor 'none'");
}

const char* pace_name(Pace pace) { return pace == Pace::realtime ? "realtime" : "none"; }

template <size_t N>
void set_field(char (&field)[N], const std::string& value) {
    std::memset(field, 0, N);
    value.copy(field, N - 1);
}

/// What `item` tells of index 0, 1, ..., until it does not answer VFIT_OK.
template <typename T, typename Item>
std::vector<T> read_list(Item&& item) {
    std::vector<T> out;
    for (uint32_t i = 0; i < kMaxListed; ++i) {
        T value{};
        value.struct_size = sizeof(T);
        if (item(i, &value) != VFIT_OK) break;
        value.struct_size = sizeof(T);
        out.push_back(value);
    }
    return out;
}

bool lists(const std::vector<vfit_sensor_option>& options, const std::string& key) {
    for (const vfit_sensor_option& option : options)
        if (key == option.key) return true;
    return false;
}

}  // namespace

Sensor::Sensor(Ref<Plugin> plugin, std::string uri, Ref<SensorStream> stream, void* token, void* device)
    : plugin_(std::move(plugin)),
      uri_(std::move(uri)),
      stream_(std::move(stream)),
      token_(token),
      device_(device) {}

void Sensor::check_open() const {
    if (!device_) fail(VFIT_ERROR_STATE, "the sensor ", uri_, " is closed");
}

void Sensor::start() {
    std::lock_guard lock(plugin_->calls_);
    check_open();
    if (running_) fail(VFIT_ERROR_STATE, "the sensor ", uri_, " is running already");
    plugin_->check_well();
    stream_->open();
    const vfit_result result = plugin_->ask([&] { return plugin_->table_.start(device_); });
    if (result == VFIT_OK) {
        running_ = true;
        return;
    }
    stream_->queue.close();
    plugin_->fail_with_last_error(result, text("starting ", uri_));
}

void Sensor::stop() {
    // Before the lock: a push that waits inside the plug-in must return first.
    stream_->queue.close();
    std::lock_guard lock(plugin_->calls_);
    check_open();
    stop_device();
}

void Sensor::stop_device() {
    if (!running_) return;
    running_ = false;
    // Once more under the lock: a start on another thread may have opened it since, and the plug-in's stop
    // waits for a push that waits for the host.
    stream_->queue.close();
    if (plugin_->hangs_) return;
    const vfit_result result =
        plugin_->ask_to_end("stop", [stop = plugin_->table_.stop, device = device_] { return stop(device); });
    if (result != VFIT_OK) plugin_->host_.complain(text("stopping ", uri_, " failed, result ", result));
}

void Sensor::close() {
    const Ref<Sensor> self(this);  // the plug-in's list may hold the last reference
    stream_->queue.close();
    std::lock_guard lock(plugin_->calls_);
    if (!device_) return;
    stop_device();
    if (!plugin_->hangs_)
        plugin_->ask_to_end(
            "close", [close = plugin_->table_.close, device = device_] { return close(device), VFIT_OK; });
    device_ = nullptr;
    plugin_->host_.remove_stream(token_);
    plugin_->forget(this);
}

std::vector<vfit_sensor_mode> Sensor::read_modes() {
    const auto mode = plugin_->table_.mode;
    if (!mode || plugin_->hangs_) return {};
    auto modes = read_list<vfit_sensor_mode>([&](uint32_t i, vfit_sensor_mode* out) {
        return plugin_->ask([&] { return mode(device_, i, out); });
    });
    for (vfit_sensor_mode& mode : modes) {
        end_text(mode.name);
        if (!std::isfinite(mode.rate_hz) || mode.rate_hz < 0.0f) mode.rate_hz = 0.0f;
    }
    return modes;
}

std::vector<vfit_sensor_option> Sensor::read_options() {
    const auto option_at = plugin_->table_.option;
    if (!option_at || plugin_->hangs_) return {};
    auto options = read_list<vfit_sensor_option>([&](uint32_t i, vfit_sensor_option* out) {
        return plugin_->ask([&] { return option_at(device_, i, out); });
    });
    for (vfit_sensor_option& option : options) {
        end_text(option.key);
        end_text(option.value);
        end_text(option.text);
    }
    return options;
}

std::vector<vfit_sensor_mode> Sensor::modes() {
    std::lock_guard lock(plugin_->calls_);
    check_open();
    return read_modes();
}

std::vector<vfit_sensor_option> Sensor::options() {
    std::lock_guard lock(plugin_->calls_);
    check_open();
    std::vector<vfit_sensor_option> options = read_options();
    const auto add = [&](const char* key, const std::string& value, const char* text) {
        if (lists(options, key)) return;
        vfit_sensor_option option = vfit_sensor_option_init();
        set_field(option.key, key);
        set_field(option.value, value);
        set_field(option.text, text);
        options.push_back(option);
    };
    const std::vector<vfit_sensor_mode> modes = read_modes();
    add("mode", mode_.empty() && !modes.empty() ? modes.front().name : mode_,
        "a name from the list of modes");
    add("pace", pace_name(stream_->queue.pace()), "realtime: the newest frame; none: every frame");
    return options;
}

void Sensor::forward_option(const std::string& key, const std::string& value) {
    if (!plugin_->table_.set_option)
        fail(VFIT_ERROR_UNSUPPORTED, "the sensor ", uri_, " has no option '", key, "'; it has mode, pace");
    plugin_->check_well();
    const vfit_result result =
        plugin_->ask([&] { return plugin_->table_.set_option(device_, key.c_str(), value.c_str()); });
    if (result != VFIT_OK) plugin_->fail_with_last_error(result, text("option ", key));
}

void Sensor::choose_mode(const std::string& name) {
    std::string known;
    bool found = false;
    const std::vector<vfit_sensor_mode> modes = read_modes();
    if (modes.empty()) fail(VFIT_ERROR_ARGUMENT, "option mode: the sensor ", uri_, " lists no modes");
    for (const vfit_sensor_mode& mode : modes) {
        found = found || name == mode.name;
        known += (known.empty() ? "" : ", ") + std::string(mode.name);
    }
    if (!found) fail(VFIT_ERROR_ARGUMENT, "option mode: '", name, "' is not one of the modes: ", known);
    // The only mode of a device is on already.
    if (modes.size() > 1 || lists(read_options(), "mode")) forward_option("mode", name);
    mode_ = name;
}

void Sensor::set_option(const std::string& key, const std::string& value) {
    if (key.empty() || key.size() > kMaxOptionText || value.size() > kMaxOptionText)
        fail(VFIT_ERROR_ARGUMENT, "option '", key.substr(0, kShownText), "': a key has 1 to ", kMaxOptionText,
             " characters, a value at most ", kMaxOptionText);
    std::lock_guard lock(plugin_->calls_);
    check_open();
    if (key == "mode") {
        choose_mode(value);
    } else if (key == "pace") {
        const Pace pace = pace_from(value);
        if (lists(read_options(), "pace")) forward_option(key, value);
        stream_->queue.set_pace(pace);
    } else {
        forward_option(key, value);
    }
}

void Sensor::read_default_pace() {
    for (const vfit_sensor_option& option : read_options())
        if (std::string("pace") == option.key) stream_->queue.set_pace(pace_from(option.value));
}

}  // namespace vfit
