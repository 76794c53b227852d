#include "sensor/plugin_host.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"

namespace vfit {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxUri = 4096;  // characters

}  // namespace

PluginHost::PluginHost(Log& log, std::function<uint64_t()> context_id, Ref<FrameBytes> frame_bytes)
    : log_(log), context_id_(std::move(context_id)), frame_bytes_(std::move(frame_bytes)) {}

PluginHost::~PluginHost() { shutdown(); }

void PluginHost::load(const std::string& path) {
    auto library = std::make_unique<DynamicLibrary>(path);
    void* symbol = library->symbol("vfit_plugin_negotiate");
    if (!symbol) fail(VFIT_ERROR_PLUGIN, path, ": is no plug-in, it exports no vfit_plugin_negotiate");
    add(path, std::move(library), reinterpret_cast<vfit_plugin_negotiate_fn>(symbol));
}

void PluginHost::attach(const std::string& name, vfit_plugin_negotiate_fn negotiate) {
    add(name, nullptr, negotiate);
}

void PluginHost::add(std::string path, std::unique_ptr<DynamicLibrary> library,
                     vfit_plugin_negotiate_fn negotiate) {
    const auto plugin = make<Plugin>(log_, context_id_, frame_bytes_, path, std::move(library), negotiate);
    try {
        std::lock_guard lock(mutex_);
        if (down_) fail(VFIT_ERROR_STATE, path, ": plug-ins were shut down");
        for (const Ref<Plugin>& other : plugins_)
            for (const std::string& scheme : plugin->schemes())
                if (other->serves(scheme))
                    fail(VFIT_ERROR_PLUGIN, path, ": the scheme '", scheme, "' is served by ",
                         other->info().path, " already");
        plugins_.push_back(plugin);
    } catch (...) {
        plugin->shutdown();
        throw;
    }
}

void PluginHost::load_folder(const std::string& folder) {
    std::vector<std::string> paths;
    std::error_code error;
    fs::directory_iterator file(fs::path(folder), error);
    for (; !error && file != fs::directory_iterator(); file.increment(error)) {
        const fs::path& path = file->path();
        if (path.filename().string().rfind("vfit_", 0) == 0 && path.extension() == library_suffix())
            paths.push_back(path.string());
    }
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) {
        try {
            load(path);
        } catch (const Error& e) {
            log_.warning("plug-in skipped: ", e.what());
        }
    }
}

std::vector<Ref<Plugin>> PluginHost::all() const {
    std::lock_guard lock(mutex_);
    return plugins_;
}

std::vector<PluginInfo> PluginHost::plugins() const {
    std::vector<PluginInfo> out;
    for (const Ref<Plugin>& plugin : all()) out.push_back(plugin->info());
    return out;
}

std::vector<vfit_sensor_info> PluginHost::discover() {
    std::vector<vfit_sensor_info> out;
    for (const Ref<Plugin>& plugin : all()) {
        const auto found = plugin->discover();
        out.insert(out.end(), found.begin(), found.end());
    }
    return out;
}

/// null: no plug-in declares a USB camera.
UsbWatch* PluginHost::usb() {
    std::vector<UsbId> ids;
    for (const Ref<Plugin>& plugin : all())
        ids.insert(ids.end(), plugin->usb_ids().begin(), plugin->usb_ids().end());
    {
        std::lock_guard lock(mutex_);
        if (usb_ || ids.empty() || down_) return usb_.get();
    }
    // Not under the lock: it logs, and the host may ask for sensors when it hears that.
    auto watch = std::make_unique<UsbWatch>(log_, std::move(ids));
    std::lock_guard lock(mutex_);
    if (!usb_ && !down_) usb_.swap(watch);
    return usb_.get();
}

uint64_t PluginHost::changes() {
    const UsbWatch* watch = usb();
    return all().size() + (watch ? watch->changes() : 0);
}

Ref<Plugin> PluginHost::serving(const std::string& scheme) const {
    for (const Ref<Plugin>& plugin : all())
        if (plugin->serves(scheme)) return plugin;
    return nullptr;
}

/// The scheme of an existing path: a folder is a recording, a file goes by its extension. Empty otherwise.
std::string PluginHost::scheme_of_path(const std::string& name) const {
    std::error_code ignored;
    const fs::path path(name);
    if (fs::is_directory(path, ignored)) return "recording";
    const std::string extension = path.extension().string();
    const bool is_known = extension.size() > 1 && serving(extension.substr(1));
    return is_known && fs::is_regular_file(path, ignored) ? extension.substr(1) : std::string();
}

/// A scheme decides. Without one, the longest existing path does, and what follows its ? are options: a path
/// that exists as written is taken literally.
SourceUri PluginHost::resolve(const std::string& uri) const {
    const std::string scheme = scheme_of(uri);
    if (const Ref<Plugin> plugin = serving(scheme)) return parse_source_uri(uri, plugin->has_addresses());
    size_t end = uri.size();
    while (end != std::string::npos && end > 0) {
        const std::string path = uri.substr(0, end);
        const std::string of_path = scheme_of_path(path);
        if (!of_path.empty())
            return {of_path, path, parse_source_options(uri.substr(std::min(end + 1, uri.size())))};
        end = uri.rfind('?', end - 1);
    }
    return {scheme, uri, {}};
}

Ref<Sensor> PluginHost::open_device(Plugin& plugin, const std::string& device) {
    try {
        return plugin.open(device);
    } catch (const Error& e) {
        const UsbWatch* watch = e.code() == VFIT_ERROR_IO && !plugin.usb_ids().empty() ? usb() : nullptr;
        const std::string trouble = watch ? watch->trouble(plugin.usb_ids()) : "";
        if (trouble.empty()) throw;
        fail(e.code(), e.what(), "; ", trouble);
    }
}

Ref<Sensor> PluginHost::open(const std::string& uri) {
    if (uri.empty() || uri.size() > kMaxUri)
        fail(VFIT_ERROR_ARGUMENT, "a sensor's URI has 1 to ", kMaxUri, " characters");
    const SourceUri source = resolve(uri);
    const Ref<Plugin> plugin = serving(source.scheme);
    if (!plugin) refuse(uri, source.scheme);
    Ref<Sensor> sensor = open_device(*plugin, source.device());
    try {
        for (const SourceOption& option : source.options) sensor->set_option(option.key, option.value);
    } catch (...) {
        sensor->close();
        throw;
    }
    return sensor;
}

void PluginHost::refuse(const std::string& uri, const std::string& scheme) const {
    std::string known;
    for (const Ref<Plugin>& plugin : all()) known += (known.empty() ? "" : ", ") + plugin->info().schemes;
    if (known.empty()) known = "none";
    if (scheme.empty())
        fail(VFIT_ERROR_UNSUPPORTED, uri,
             ": is neither an existing folder nor a sensor's URI; known schemes: ", known);
    fail(VFIT_ERROR_UNSUPPORTED, uri, ": no plug-in serves the scheme '", scheme,
         "'; known schemes: ", known);
}

void PluginHost::shutdown() {
    {
        std::lock_guard lock(mutex_);
        down_ = true;
    }
    for (const Ref<Plugin>& plugin : all()) plugin->shutdown();
    std::unique_ptr<UsbWatch> usb;  // its thread logs: it ends before the log does, and not under the lock
    std::lock_guard lock(mutex_);
    usb.swap(usb_);
}

}  // namespace vfit
