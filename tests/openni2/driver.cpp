// An OpenNI2 driver, for tests alone: the virtual person as a camera. OpenNI2 loads it from OpenNI2/Drivers
// beside its library.
//   VFIT_TEST_PERSON   the URI of the virtual person
//   VFIT_TEST_DRIVER   crash, hang, silent: from the sixth image on; no_depth, no_fov: as it opens
//   VFIT_TEST_PLUG     a file: while it is not there, nor is the device
//   VFIT_TEST_USB      a USB device, vvvv:pppp, looked for by libusb: while it is not there, nor is this one
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

// Names that OpenNI2's driver header expects from a library that is not shipped.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(p) delete (p)
#include <Driver/OniDriverAPI.h>
#include <OniCAPI.h>
#include <OniCProperties.h>

#include <libusb.h>

#include "vfit.h"

namespace {

constexpr int kRate_hz = 30, kMisbehaves_from = 6;

std::string setting(const char* name, const char* otherwise = "") {
    const char* value = std::getenv(name);
    return value ? value : otherwise;
}

/// By libusb, as drivers of real cameras do.
class Usb {
public:
    Usb() { libusb_init(&usb_); }
    ~Usb() { libusb_exit(usb_); }
    bool has(const std::string& id) const {
        libusb_device** devices = nullptr;
        bool found = false;
        const ssize_t count = libusb_get_device_list(usb_, &devices);
        for (ssize_t i = 0; i < count; ++i) {
            libusb_device_descriptor d;
            char name[16];
            if (libusb_get_device_descriptor(devices[i], &d) != LIBUSB_SUCCESS) continue;
            std::snprintf(name, sizeof name, "%04x:%04x", d.idVendor, d.idProduct);
            found = found || id == name;
        }
        if (count >= 0) libusb_free_device_list(devices, 1);
        return found;
    }

private:
    libusb_context* usb_ = nullptr;
};

bool is_plugged() {
    if (const std::string id = setting("VFIT_TEST_USB"); !id.empty()) {
        static const Usb usb;
        return usb.has(id);
    }
    const std::string file = setting("VFIT_TEST_PLUG");
    return file.empty() || std::filesystem::exists(file);
}

class Stream : public oni::driver::StreamBase {
public:
    Stream(OniSensorType type, const vfit_intrinsics& in) : type_(type) {
        mode_ = {type == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888,
                 int(in.width), int(in.height), kRate_hz};
        horizontal_fov_ = 2.0f * std::atan(0.5f * float(in.width) / in.fx);
        vertical_fov_ = 2.0f * std::atan(0.5f * float(in.height) / in.fy);
    }
    OniStatus start() override { return started_ = true, ONI_STATUS_OK; }
    void stop() override {
        std::lock_guard lock(raising_);
        started_ = false;
    }
    OniStatus getProperty(int id, void* data, int* size) override {
        const OniCropping cropping{};
        switch (id) {
            case ONI_STREAM_PROPERTY_VIDEO_MODE: return give(mode_, data, size);
            case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
                return setting("VFIT_TEST_DRIVER") == "no_fov" ? ONI_STATUS_NOT_SUPPORTED
                                                               : give(horizontal_fov_, data, size);
            case ONI_STREAM_PROPERTY_VERTICAL_FOV: return give(vertical_fov_, data, size);
            case ONI_STREAM_PROPERTY_MAX_VALUE: return give(10000, data, size);
            case ONI_STREAM_PROPERTY_MIN_VALUE: return give(0, data, size);
            case ONI_STREAM_PROPERTY_STRIDE: return give(stride(), data, size);
            case ONI_STREAM_PROPERTY_MIRRORING: return give(OniBool(FALSE), data, size);
            case ONI_STREAM_PROPERTY_CROPPING: return give(cropping, data, size);
            default: return ONI_STATUS_NOT_IMPLEMENTED;
        }
    }
    OniStatus setProperty(int id, const void* data, int) override {
        if (id == ONI_STREAM_PROPERTY_VIDEO_MODE)
            return std::memcmp(data, &mode_, sizeof mode_) == 0 ? ONI_STATUS_OK : ONI_STATUS_BAD_PARAMETER;
        return id == ONI_STREAM_PROPERTY_MIRRORING && *static_cast<const OniBool*>(data) == FALSE
                   ? ONI_STATUS_OK
                   : ONI_STATUS_NOT_SUPPORTED;
    }
    OniBool isPropertySupported(int id) override { return id <= ONI_STREAM_PROPERTY_MIRRORING; }
    /// A recorder writes what it is told here; without STRIDE and CROPPING the file does not play.
    void notifyAllProperties() override {
        for (const int id :
             {ONI_STREAM_PROPERTY_VIDEO_MODE, ONI_STREAM_PROPERTY_HORIZONTAL_FOV,
              ONI_STREAM_PROPERTY_VERTICAL_FOV, ONI_STREAM_PROPERTY_MAX_VALUE, ONI_STREAM_PROPERTY_MIN_VALUE,
              ONI_STREAM_PROPERTY_STRIDE, ONI_STREAM_PROPERTY_MIRRORING, ONI_STREAM_PROPERTY_CROPPING}) {
            char value[64];
            int size = sizeof value;
            if (getProperty(id, value, &size) == ONI_STATUS_OK) raisePropertyChanged(id, value, size);
        }
    }
    void show(const uint16_t* depth, uint32_t row_stride, int index, uint64_t time_us) {
        std::lock_guard lock(raising_);
        OniFrame* frame = started_ ? getServices().acquireFrame() : nullptr;
        if (!frame) return;
        frame->frameIndex = index, frame->timestamp = time_us;
        frame->sensorType = type_, frame->videoMode = mode_;
        frame->width = mode_.resolutionX, frame->height = mode_.resolutionY;
        frame->croppingEnabled = FALSE, frame->cropOriginX = frame->cropOriginY = 0;
        frame->stride = stride();
        frame->dataSize = frame->stride * frame->height;
        for (int y = 0; y < frame->height; ++y) {
            const auto* from = reinterpret_cast<const uint16_t*>(reinterpret_cast<const char*>(depth) +
                                                                 size_t(y) * row_stride);
            auto* to = static_cast<uint8_t*>(frame->data) + size_t(y) * size_t(frame->stride);
            if (type_ == ONI_SENSOR_DEPTH)
                std::memcpy(to, from, size_t(frame->stride));
            else
                for (int x = 0; x < frame->width; ++x)
                    to[3 * x] = uint8_t(from[x] >> 4), to[3 * x + 1] = uint8_t(from[x]),
                           to[3 * x + 2] = uint8_t(x);
        }
        raiseNewFrame(frame);
        getServices().releaseFrame(frame);
    }

private:
    int stride() const { return mode_.resolutionX * (type_ == ONI_SENSOR_DEPTH ? 2 : 3); }
    template <typename T>
    static OniStatus give(const T& value, void* data, int* size) {
        if (*size < int(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
        std::memcpy(data, &value, sizeof value);
        *size = int(sizeof value);
        return ONI_STATUS_OK;
    }
    const OniSensorType type_;
    OniVideoMode mode_{};
    float horizontal_fov_ = 0.0f, vertical_fov_ = 0.0f;
    std::mutex raising_;
    std::atomic<bool> started_{false};
};

class Device : public oni::driver::DeviceBase {
public:
    Device() {
        vfit_context_desc desc = vfit_context_desc_init();
        desc.api_version = VFIT_VERSION;
        if (vfit_context_create(&desc, &context_) != VFIT_OK) return;
        if (vfit_sensor_open(
                context_,
                setting("VFIT_TEST_PERSON", "virtual:sensor=kinect_v1_320&motion=demo&seed=7").c_str(),
                &sensor_) != VFIT_OK)
            return;
        // The first image tells what the camera is like.
        vfit_sensor_start(sensor_);
        if (vfit_sensor_acquire(sensor_, -1, &first_) != VFIT_OK) return;
        vfit_frame_intrinsics(first_, &intrinsics_);
        modes_[0] = {ONI_PIXEL_FORMAT_DEPTH_1_MM, int(intrinsics_.width), int(intrinsics_.height), kRate_hz};
        modes_[1] = {ONI_PIXEL_FORMAT_RGB888, int(intrinsics_.width), int(intrinsics_.height), kRate_hz};
        sensors_[0] = {ONI_SENSOR_DEPTH, 1, &modes_[0]};
        sensors_[1] = {ONI_SENSOR_COLOR, 1, &modes_[1]};
        ready_ = true;
    }
    ~Device() override {
        going_ = false;
        if (thread_.joinable()) thread_.join();
        vfit_context_destroy(context_);
    }
    bool ready() const { return ready_; }
    OniStatus getSensorInfoList(OniSensorInfo** list, int* count) override {
        const bool no_depth = setting("VFIT_TEST_DRIVER") == "no_depth";
        *list = sensors_ + no_depth, *count = 2 - no_depth;
        return ONI_STATUS_OK;
    }
    oni::driver::StreamBase* createStream(OniSensorType type) override {
        auto* stream = new Stream(type, intrinsics_);
        std::lock_guard lock(streams_);
        (type == ONI_SENSOR_DEPTH ? depth_ : color_) = stream;
        if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
        return stream;
    }
    void destroyStream(oni::driver::StreamBase* stream) override {
        std::lock_guard lock(streams_);
        (stream == depth_ ? depth_ : color_) = nullptr;
        delete stream;
    }
    OniStatus getProperty(int id, void* data, int* size) override {
        if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || *size < int(sizeof registration_))
            return ONI_STATUS_NOT_IMPLEMENTED;
        std::memcpy(data, &registration_, sizeof registration_);
        *size = sizeof registration_;
        return ONI_STATUS_OK;
    }
    OniStatus setProperty(int id, const void* data, int) override {
        if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_IMPLEMENTED;
        std::memcpy(&registration_, data, sizeof registration_);
        return ONI_STATUS_OK;
    }
    OniBool isPropertySupported(int id) override { return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION; }
    OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }
    void notifyAllProperties() override {
        raisePropertyChanged(ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION, &registration_, sizeof registration_);
    }

private:
    void run() {
        const std::string misbehaves = setting("VFIT_TEST_DRIVER");
        const auto begin = std::chrono::steady_clock::now();
        vfit_frame frame = first_;
        for (int index = 0; going_; ++index) {
            if (index > 0 && vfit_sensor_acquire(sensor_, -1, &frame) != VFIT_OK) return;
            std::this_thread::sleep_until(begin + std::chrono::microseconds(1000000LL * index / kRate_hz));
            while (going_ && !has_depth()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            if (index >= kMisbehaves_from && misbehaves == "crash") std::abort();
            if (index >= kMisbehaves_from && misbehaves == "silent") return;
            vfit_view view = vfit_view_init();
            vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view);
            std::lock_guard lock(streams_);
            if (index >= kMisbehaves_from && misbehaves == "hang")
                std::this_thread::sleep_for(std::chrono::hours(1));
            for (Stream* stream : {color_, depth_})
                if (stream && is_plugged())
                    stream->show(static_cast<const uint16_t*>(view.data), view.row_stride, index,
                                 uint64_t(1000000LL * index / kRate_hz));
            vfit_frame_release(frame);
        }
    }
    bool has_depth() {
        std::lock_guard lock(streams_);
        return depth_ != nullptr;
    }
    vfit_context context_{};
    vfit_sensor sensor_{};
    vfit_frame first_{};
    vfit_intrinsics intrinsics_ = vfit_intrinsics_init();
    OniVideoMode modes_[2]{};
    OniSensorInfo sensors_[2]{};
    int registration_ = ONI_IMAGE_REGISTRATION_OFF;
    bool ready_ = false;
    std::mutex streams_;
    Stream *depth_ = nullptr, *color_ = nullptr;
    std::thread thread_;
    std::atomic<bool> going_{true};
};

class Driver : public oni::driver::DriverBase {
public:
    explicit Driver(OniDriverServices* services) : DriverBase(services) {
        std::strcpy(info_.uri, "virtual-person");
        std::strcpy(info_.vendor, "vfit");
        std::strcpy(info_.name, "Virtual person behind OpenNI2");
    }
    OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                         oni::driver::DeviceDisconnectedCallback disconnected,
                         oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
        DriverBase::initialize(connected, disconnected, changed, cookie);
        plugged_ = is_plugged();
        if (plugged_) deviceConnected(&info_);
        if (!(setting("VFIT_TEST_PLUG") + setting("VFIT_TEST_USB")).empty())
            watch_ = std::thread([this] { watch(); });
        return ONI_STATUS_OK;
    }
    oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
        auto* device = new Device;
        if (device->ready()) return device;
        delete device;
        return nullptr;
    }
    void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
    void shutdown() override {
        going_ = false;
        if (watch_.joinable()) watch_.join();
    }

private:
    void watch() {
        for (; going_; std::this_thread::sleep_for(std::chrono::milliseconds(5)))
            if (const bool is = is_plugged(); is != plugged_) {
                plugged_ = is;
                if (is)
                    deviceConnected(&info_);
                else
                    deviceDisconnected(&info_);
            }
    }
    OniDeviceInfo info_{};
    bool plugged_ = true;
    std::atomic<bool> going_{true};
    std::thread watch_;
};

}  // namespace

ONI_EXPORT_DRIVER(Driver)
