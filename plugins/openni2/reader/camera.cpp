#include "reader/camera.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace openni2 {

namespace {

// A file gives its next frame at once; a camera that has given none for so long is lost, or was never there.
constexpr std::chrono::milliseconds kFilePatience{1500}, kDevicePatience{5000};

bool is_depth(const OniVideoMode& mode) {
    return mode.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_1_MM ||
           mode.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM;
}

bool is_color(OniPixelFormat format) {
    return format == ONI_PIXEL_FORMAT_RGB888 || format == ONI_PIXEL_FORMAT_GRAY8;
}

bool is_size(int width, int height) {
    return width > 0 && height > 0 && width <= int(kMostPixels) && height <= int(kMostPixels);
}

/// The rows of a frame lie within what it holds.
bool is_whole(const OniFrame& frame, int bytes_a_pixel) {
    if (!frame.data || !is_size(frame.width, frame.height) || frame.stride < frame.width * bytes_a_pixel)
        return false;
    return int64_t(frame.stride) * (frame.height - 1) + int64_t(frame.width) * bytes_a_pixel <=
           frame.dataSize;
}

template <size_t kRoom>
void put(char (&field)[kRoom], const std::string& text) {
    field[text.copy(field, kRoom - 1)] = 0;
}

std::string text_of(const char (&field)[ONI_MAX_STR]) { return {field, strnlen(field, sizeof field)}; }

}  // namespace

template <typename T>
bool Camera::get(OniStreamHandle stream, int property, T& value) const {
    int size = sizeof value;
    return library_.oniStreamGetProperty(stream, property, &value, &size) == ONI_STATUS_OK &&
           size == int(sizeof value);
}

template <typename T>
bool Camera::set(OniStreamHandle stream, int property, const T& value) const {
    return library_.oniStreamSetProperty(stream, property, &value, sizeof value) == ONI_STATUS_OK;
}

Camera::Camera(const Library& library, const std::string& uri)
    : library_(library), name_(uri.empty() ? "the first OpenNI2 device" : uri) {
    library_.check(library_.oniDeviceOpen(uri.empty() ? nullptr : uri.c_str(), &device_),
                   (name_ + ": OpenNI2 does not open it").c_str());
    OniDeviceInfo info{};
    if (library_.oniDeviceGetInfo(device_, &info) == ONI_STATUS_OK) {
        uri_ = text_of(info.uri);
        put(description_.name, text_of(info.name));
    }
    float speed = 0.0f;
    int size = sizeof speed;
    description_.is_file = library_.oniDeviceGetProperty(device_, ONI_DEVICE_PROPERTY_PLAYBACK_SPEED, &speed,
                                                         &size) == ONI_STATUS_OK;
    if (!library_.oniDeviceGetSensorInfo(device_, ONI_SENSOR_DEPTH))
        throw Ended(Ending::unsupported, name_ + ": has no depth stream");
    library_.check(library_.oniDeviceCreateStream(device_, ONI_SENSOR_DEPTH, &depth_),
                   (name_ + ": gives no depth stream").c_str());
    describe_modes();
    description_.offers_registration = library_.oniDeviceIsImageRegistrationModeSupported(
                                           device_, ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR) == TRUE;
    description_.has_color = library_.oniDeviceGetSensorInfo(device_, ONI_SENSOR_COLOR) != nullptr;
    if (description_.is_file) {
        int frames = 0;
        if (get(depth_, ONI_STREAM_PROPERTY_NUMBER_OF_FRAMES, frames) && frames == 0)
            throw Ended(Ending::damaged, name_ + ": holds no depth frame");
        description_.frames = uint32_t(std::max(frames, 0));
    } else {
        OniDeviceCallbacks callbacks{};
        callbacks.deviceDisconnected = [](const OniDeviceInfo* gone, void* self) {
            auto& camera = *static_cast<Camera*>(self);
            if (gone && camera.uri_ == text_of(gone->uri)) camera.gone_ = true;
        };
        library_.oniRegisterDeviceCallbacks(&callbacks, this, &callback_);
    }
}

Camera::~Camera() {
    stop();
    close_color();
    if (callback_) library_.oniUnregisterDeviceCallbacks(callback_);
    library_.oniStreamDestroy(depth_);
    library_.oniDeviceClose(device_);
}

void Camera::describe_modes() {
    const OniSensorInfo* sensor = library_.oniDeviceGetSensorInfo(device_, ONI_SENSOR_DEPTH);
    OniVideoMode now{};
    if (!get(depth_, ONI_STREAM_PROPERTY_VIDEO_MODE, now) || !is_size(now.resolutionX, now.resolutionY))
        throw Ended(Ending::damaged, name_ + ": does not tell the size of its depth image");
    const auto add = [&](const OniVideoMode& mode) {
        if (!is_depth(mode) || !is_size(mode.resolutionX, mode.resolutionY) || modes_.size() == kMostModes)
            return;
        modes_.push_back(mode);
    };
    for (int i = 0; sensor && i < sensor->numSupportedVideoModes; ++i) add(sensor->pSupportedVideoModes[i]);
    const auto same = [&](const OniVideoMode& mode) {
        return mode.pixelFormat == now.pixelFormat && mode.resolutionX == now.resolutionX &&
               mode.resolutionY == now.resolutionY && mode.fps == now.fps;
    };
    if (std::none_of(modes_.begin(), modes_.end(), same)) {
        if (modes_.size() == kMostModes) modes_.pop_back();
        add(now);
    }
    const auto found = std::find_if(modes_.begin(), modes_.end(), same);
    if (found == modes_.end() && modes_.empty())
        throw Ended(Ending::unsupported, name_ + ": its depth is not in millimetres");
    description_.mode = found == modes_.end() ? 0 : uint32_t(found - modes_.begin());
    description_.mode_count = uint32_t(modes_.size());
    for (size_t i = 0; i < modes_.size(); ++i)
        description_.modes[i] = {uint32_t(modes_[i].resolutionX), uint32_t(modes_[i].resolutionY),
                                 float(modes_[i].fps),
                                 modes_[i].pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM};
}

void Camera::start(const Start& start) {
    stop();
    check_plugged();
    start_ = start;
    if (!description_.is_file) {
        if (start.mode >= modes_.size()) throw Ended(Ending::failed, name_ + ": has no such mode");
        library_.check(library_.oniStreamSetProperty(depth_, ONI_STREAM_PROPERTY_VIDEO_MODE,
                                                     &modes_[start.mode], sizeof(OniVideoMode)),
                       (name_ + ": refuses the mode").c_str());
        set(depth_, ONI_STREAM_PROPERTY_CROPPING, OniCropping{});
        const int registration =
            start.registration ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
        if (description_.offers_registration) {
            library_.check(library_.oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION,
                                                         &registration, sizeof registration),
                           (name_ + ": refuses to register depth to colour").c_str());
            is_registered_ = start.registration != 0;
        }
    }
    const auto mirrored = [&](OniStreamHandle stream) {
        OniBool is = FALSE;
        set(stream, ONI_STREAM_PROPERTY_MIRRORING, OniBool(FALSE));
        return get(stream, ONI_STREAM_PROPERTY_MIRRORING, is) && is;
    };
    depth_mirrored_ = mirrored(depth_);
    if (!get(depth_, ONI_STREAM_PROPERTY_HORIZONTAL_FOV, horizontal_fov_rad_) ||
        !get(depth_, ONI_STREAM_PROPERTY_VERTICAL_FOV, vertical_fov_rad_))
        throw Ended(description_.is_file ? Ending::damaged : Ending::unsupported,
                    name_ + ": does not tell its field of view");
    // No file tells whether its depth was registered: who asks for its colour knows.
    if (start.color && description_.has_color && (description_.is_file || is_registered_))
        open_color();
    else
        close_color();
    if (color_) color_mirrored_ = mirrored(color_);
    if (description_.is_file) {
        const float manual = -1.0f;
        const OniBool once = FALSE;
        library_.oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_PLAYBACK_REPEAT_ENABLED, &once,
                                      sizeof once);
        library_.check(library_.oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_PLAYBACK_SPEED, &manual,
                                                     sizeof manual),
                       (name_ + ": does not play frame by frame").c_str());
    }
    if (color_)
        library_.check(library_.oniStreamStart(color_),
                       (name_ + ": its colour stream does not start").c_str());
    library_.check(library_.oniStreamStart(depth_), (name_ + ": its depth stream does not start").c_str());
    running_ = true;
    read_ = 0;
    newest_depth_ = Clock::now();
    newest_color_.clear();
    color_us_ = INT64_MIN;
    holds_ = false;
}

/// Colour that is not of the depth's size belongs to no pixel of it.
void Camera::open_color() {
    if (!color_ && library_.oniDeviceCreateStream(device_, ONI_SENSOR_COLOR, &color_) != ONI_STATUS_OK)
        return;
    const OniVideoMode& depth = modes_[description_.is_file ? description_.mode : start_.mode];
    OniVideoMode now{};
    const auto fits = [&](const OniVideoMode& mode) {
        return is_color(mode.pixelFormat) && mode.resolutionX == depth.resolutionX &&
               mode.resolutionY == depth.resolutionY;
    };
    if (get(color_, ONI_STREAM_PROPERTY_VIDEO_MODE, now) && fits(now)) return;
    const OniSensorInfo* sensor = library_.oniDeviceGetSensorInfo(device_, ONI_SENSOR_COLOR);
    for (int i = 0; !description_.is_file && sensor && i < sensor->numSupportedVideoModes; ++i)
        if (fits(sensor->pSupportedVideoModes[i]) &&
            set(color_, ONI_STREAM_PROPERTY_VIDEO_MODE, sensor->pSupportedVideoModes[i]))
            return;
    close_color();
}

void Camera::close_color() {
    if (color_) library_.oniStreamDestroy(color_);
    color_ = nullptr;
}

void Camera::stop() {
    if (!running_) return;
    running_ = false;
    library_.oniStreamStop(depth_);
    if (color_) library_.oniStreamStop(color_);
}

bool Camera::next(int milliseconds, Picture& picture) {
    check_plugged();
    const bool all = (start_.count && read_ >= uint64_t(start_.first) + start_.count) ||
                     (description_.frames && read_ >= description_.frames);
    if (all && !holds_) throw Ended(Ending::end, "");
    OniStreamHandle streams[] = {depth_, color_};
    int which = 0;
    const OniStatus status = library_.oniWaitForAnyStream(streams, color_ ? 2 : 1, &which, milliseconds);
    if (status == ONI_STATUS_TIME_OUT) {
        if (holds_) return give(picture);
        check_patience();
        return false;
    }
    library_.check(status, (name_ + ": gives no image").c_str());
    OniFrame* frame = nullptr;
    library_.check(library_.oniStreamReadFrame(streams[which], &frame),
                   (name_ + ": an image cannot be read").c_str());
    struct Release {
        const Library& library;
        OniFrame* frame;
        ~Release() { library.oniFrameRelease(frame); }
    } release{library_, frame};
    if (which == 1) {
        read_color(*frame);
        check_patience();
        return holds_ && color_us_ >= held_.image.time_us && give(picture);
    }
    newest_depth_ = Clock::now();
    const bool given = holds_ && give(picture);
    if (all || (description_.is_file && read_++ < start_.first)) return given;
    read_depth(*frame, held_);
    holds_ = true;
    // A recorder may write depth before the colour of the same moment; a camera's images are not kept
    // waiting.
    const bool waits = given || (description_.is_file && color_ && color_us_ < held_.image.time_us);
    return given || (!waits && give(picture));
}

void Camera::check_plugged() const {
    if (gone_) throw Ended(Ending::lost, name_ + ": was unplugged");
}

/// Colour may still come when depth does not.
void Camera::check_patience() const {
    const auto silence = Clock::now() - newest_depth_;
    if (description_.is_file && silence >= kFilePatience) end_of_file();
    if (!description_.is_file && silence >= kDevicePatience)
        throw Ended(Ending::lost, name_ + ": has given no image for 5 seconds");
}

/// The depth that was held, with the newest colour.
bool Camera::give(Picture& picture) {
    std::swap(picture, held_);
    picture.color = newest_color_;
    picture.image.has_color = picture.color.size() == 4 * picture.depth.size();
    holds_ = false;
    return true;
}

void Camera::end_of_file() const {
    if (read_ == 0) throw Ended(Ending::damaged, name_ + ": gives no depth frame");
    if (read_ < description_.frames)
        throw Ended(Ending::damaged, name_ + ": ends after " + std::to_string(read_) + " of " +
                                         std::to_string(description_.frames) + " frames");
    throw Ended(Ending::end, "");
}

void Camera::read_depth(const OniFrame& frame, Picture& picture) {
    const auto number = [&] {
        return name_ + ": frame " +
               std::to_string(description_.is_file ? read_ - 1 : uint32_t(frame.frameIndex));
    };
    if (!is_depth(frame.videoMode)) throw Ended(Ending::damaged, number() + " is not in millimetres");
    const int width = frame.videoMode.resolutionX, height = frame.videoMode.resolutionY;
    const OniVideoMode& mode = modes_[description_.is_file ? description_.mode : start_.mode];
    if (width != mode.resolutionX || height != mode.resolutionY)
        throw Ended(Ending::damaged,
                    number() + " is " + std::to_string(width) + " x " + std::to_string(height) + ", not " +
                        std::to_string(mode.resolutionX) + " x " + std::to_string(mode.resolutionY));
    const int left = frame.croppingEnabled ? frame.cropOriginX : 0,
              top = frame.croppingEnabled ? frame.cropOriginY : 0;
    if (!is_whole(frame, 2) || left < 0 || top < 0 || left > width - frame.width ||
        top > height - frame.height)
        throw Ended(Ending::damaged, number() + " is smaller than it says");
    picture.image = {description_.is_file ? read_ - 1 : uint32_t(frame.frameIndex),
                     uint32_t(width),
                     uint32_t(height),
                     0,
                     int64_t(frame.timestamp),
                     frame.videoMode.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 1e-4f : 1e-3f,
                     horizontal_fov_rad_,
                     vertical_fov_rad_,
                     0};
    picture.depth.assign(size_t(width) * size_t(height), 0);
    for (int y = 0; y < frame.height; ++y) {
        uint16_t* row = picture.depth.data() + size_t(top + y) * size_t(width);
        std::memcpy(row + left, static_cast<const char*>(frame.data) + size_t(y) * size_t(frame.stride),
                    size_t(frame.width) * sizeof *row);
        if (depth_mirrored_) std::reverse(row, row + width);
    }
}

void Camera::read_color(const OniFrame& frame) {
    const bool grey = frame.videoMode.pixelFormat == ONI_PIXEL_FORMAT_GRAY8;
    const int bytes = grey ? 1 : 3;
    color_us_ = int64_t(frame.timestamp);
    if (!is_color(frame.videoMode.pixelFormat) || !is_whole(frame, bytes)) return;
    newest_color_.resize(4 * size_t(frame.width) * size_t(frame.height));
    for (int y = 0; y < frame.height; ++y) {
        const auto* from = static_cast<const uint8_t*>(frame.data) + size_t(y) * size_t(frame.stride);
        uint8_t* to = newest_color_.data() + 4 * size_t(y) * size_t(frame.width);
        for (int x = 0; x < frame.width; ++x) {
            const uint8_t* pixel = from + size_t(bytes) * size_t(color_mirrored_ ? frame.width - 1 - x : x);
            for (int k = 0; k < 3; ++k) to[4 * x + k] = pixel[grey ? 0 : k];
            to[4 * x + 3] = 255;
        }
    }
}

std::vector<Listed> list_devices(const Library& library) {
    OniDeviceInfo* devices = nullptr;
    int count = 0;
    library.check(library.oniGetDeviceList(&devices, &count), "OpenNI2 does not list its devices");
    std::vector<Listed> out;
    for (int i = 0; i < count; ++i) {
        Listed listed{};
        put(listed.uri, "openni2:" + text_of(devices[i].uri));
        put(listed.name, text_of(devices[i].name));
        out.push_back(listed);
    }
    library.oniReleaseDeviceList(devices);
    return out;
}

}  // namespace openni2
