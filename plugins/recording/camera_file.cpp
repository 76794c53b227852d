#include "camera_file.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/failure.h"

namespace recording {

using plugin::fail;

namespace {

using nlohmann::json;

constexpr uintmax_t kMaxBytes = 1 << 20;            // of a JSON file; camera.json has less than 1 kB
constexpr uint32_t kMaxSide = 16384;                // pixels
constexpr double kMinFps = 0.01, kMaxFps = 1000.0;  // Hz
constexpr double kUnitTolerance = 0.01;             // of the floor normal's length, for hand-written files
constexpr double kPi = 3.14159265358979323846;

json read_object(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(VFIT_ERROR_IO, path.string(), ": cannot be read");
    std::string text(kMaxBytes + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<size_t>(file.gcount()));
    if (text.size() > kMaxBytes)
        fail(VFIT_ERROR_DATA, path.string(), ": is longer than ", kMaxBytes, " bytes");
    json value;
    try {
        value = json::parse(text);
    } catch (const json::exception& error) {
        fail(VFIT_ERROR_DATA, path.string(), ": is no valid JSON: ", error.what());
    }
    if (!value.is_object()) fail(VFIT_ERROR_DATA, path.string(), ": is not a JSON object");
    return value;
}

/// The fields of one file; each error names the file and the field.
class Fields {
public:
    Fields(const json& object, std::string file, std::string prefix = "")
        : object_(object), file_(std::move(file)), prefix_(std::move(prefix)) {}

    bool has(const char* key) const { return object_.contains(key); }

    template <typename... Parts>
    [[noreturn]] void refuse(const char* key, const Parts&... why) const {
        fail(VFIT_ERROR_DATA, file_, ": field \"", prefix_, key, "\" ", why...);
    }
    const json& at(const char* key) const {
        const auto it = object_.find(key);
        if (it == object_.end()) refuse(key, "is missing");
        return *it;
    }
    double number(const char* key, double low, double high) const { return checked(at(key), key, low, high); }
    /// false where it is missing.
    bool flag(const char* key) const {
        if (!has(key)) return false;
        if (!at(key).is_boolean()) refuse(key, "is neither true nor false");
        return at(key).get<bool>();
    }
    double positive(const char* key, double high) const {
        const double x = number(key, 0.0, high);
        if (x == 0.0) refuse(key, "must be greater than 0");
        return x;
    }
    uint32_t count(const char* key, uint32_t high) const {
        const double x = number(key, 1.0, high);
        if (x != std::floor(x)) refuse(key, "is not a whole number");
        return static_cast<uint32_t>(x);
    }
    std::string string(const char* key) const {
        if (!at(key).is_string()) refuse(key, "is not a text");
        return at(key).get<std::string>();
    }
    /// `count` numbers into `out`; a shorter list is padded with zeros where `or_fewer`.
    template <typename T>
    void numbers(const char* key, T* out, size_t count, bool or_fewer, double high) const {
        const json& list = at(key);
        if (!list.is_array() || list.size() > count || (!or_fewer && list.size() != count))
            refuse(key, "is not a list of ", count, " numbers");
        for (size_t i = 0; i < list.size(); ++i) out[i] = static_cast<T>(checked(list[i], key, -high, high));
    }

private:
    double checked(const json& value, const char* key, double low, double high) const {
        if (!value.is_number()) refuse(key, "is not a number");
        const double x = value.get<double>();
        if (!(x >= low && x <= high)) refuse(key, "is ", x, ", not in ", low, "..", high);
        return x;
    }

    const json& object_;
    const std::string file_, prefix_;
};

void set_floor(vfit_camera& camera, const double (&normal)[3], double distance_m) {
    camera.floor_state = VFIT_FLOOR_GIVEN;
    for (int i = 0; i < 3; ++i) camera.floor_normal[i] = static_cast<float>(normal[i]);
    camera.floor_distance_m = static_cast<float>(distance_m);
}

void read_floor(const Fields& fields, const std::string& file, vfit_camera& camera) {
    constexpr double kHighest = 100.0;  // m
    if (fields.has("floor")) {
        if (!fields.at("floor").is_object()) fields.refuse("floor", "is not an object");
        const Fields floor(fields.at("floor"), file, "floor.");
        double normal[3] = {};
        floor.numbers("normal", normal, 3, false, 2.0);
        const double length = std::hypot(normal[0], normal[1], normal[2]);
        if (std::abs(length - 1.0) > kUnitTolerance) floor.refuse("normal", "is not a unit vector");
        for (double& x : normal) x /= length;
        // The camera is above the floor, and the normal points up to it.
        set_floor(camera, normal, floor.positive("distance_m", kHighest));
    } else if (fields.has("camera_height_m") && fields.has("tilt_deg")) {
        const double tilt = fields.number("tilt_deg", -90.0, 90.0) * kPi / 180.0;
        const double roll =
            fields.has("roll_deg") ? fields.number("roll_deg", -180.0, 180.0) * kPi / 180.0 : 0.0;
        set_floor(camera,
                  {-std::cos(tilt) * std::sin(roll), -std::cos(tilt) * std::cos(roll), -std::sin(tilt)},
                  fields.positive("camera_height_m", kHighest));
    } else if (fields.has("roll_deg")) {
        fields.refuse("roll_deg", "tells the floor only together with \"camera_height_m\" and \"tilt_deg\"");
    }
}

}  // namespace

CameraFile read_camera_file(const std::filesystem::path& path) {
    const json object = read_object(path);
    const std::string file = path.string();
    const Fields fields(object, file);
    if (fields.string("format") != "vfit-recording") fields.refuse("format", "is not \"vfit-recording\"");
    const uint32_t version = fields.count("version", UINT32_MAX);
    if (version != 1)
        fail(VFIT_ERROR_VERSION, file, ": field \"version\" is ", version, ", this reader knows 1");

    CameraFile out;
    out.sensor = fields.has("sensor") ? fields.string("sensor") : "unknown";
    out.fps = fields.number("fps", kMinFps, kMaxFps);
    constexpr double kFar = 1e6;  // pixels, for focal lengths and principal points
    vfit_intrinsics& in = out.intrinsics;
    in.struct_size = sizeof in;
    in.width = fields.count("width", kMaxSide);
    in.height = fields.count("height", kMaxSide);
    in.fx = static_cast<float>(fields.positive("fx", kFar));
    in.fy = static_cast<float>(fields.positive("fy", kFar));
    in.cx = static_cast<float>(fields.number("cx", -kFar, kFar));
    in.cy = static_cast<float>(fields.number("cy", -kFar, kFar));
    if (fields.has("distortion")) fields.numbers("distortion", in.distortion, 8, true, kFar);
    out.camera.struct_size = sizeof out.camera;
    out.camera.depth_unit_m = static_cast<float>(fields.positive("depth_unit_m", 1.0));
    if (in.fx <= 0 || in.fy <= 0 || out.camera.depth_unit_m <= 0)
        fail(VFIT_ERROR_DATA, file, ": a focal length or \"depth_unit_m\" is too small");
    out.segmented = fields.flag("segmented");
    out.mirrored = fields.flag("mirrored");
    if (out.mirrored) {
        in.cx = float(in.width - 1) - in.cx;
        in.distortion[3] = -in.distortion[3];  // p2 is across
    }
    read_floor(fields, file, out.camera);
    return out;
}

std::string read_measures_file(const std::filesystem::path& path) {
    const json object = read_object(path);
    for (const auto& [key, value] : object.items())
        if (!value.is_number()) fail(VFIT_ERROR_DATA, path.string(), ": \"", key, "\" is not a number");
    return object.dump();
}

}  // namespace recording
