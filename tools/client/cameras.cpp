#include "client/cameras.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "client/files.h"

namespace vfit::tools {

namespace {

constexpr int64_t kTogether_ns = 20'000'000;  // frames of one moment: half a frame at 30 Hz, and a little

/// Turned about up, to the left.
std::array<float, 3> turned(const std::array<float, 3>& p, float by_rad) {
    const float c = std::cos(by_rad), s = std::sin(by_rad);
    return {c * p[0] + s * p[2], p[1], c * p[2] - s * p[0]};
}

/// A recording is played from its first frame on, whenever it is opened.
bool is_recorded(const std::string& uri) {
    std::error_code error;
    return uri.starts_with("virtual:") || uri.starts_with("recording:") || uri.starts_with("oni:") ||
           uri.ends_with(".oni") || std::filesystem::is_directory(uri, error);
}

}  // namespace

CameraPlace CameraPlace::of(const CameraPlace& other) const {
    CameraPlace out;
    out.turned_rad = other.turned_rad - turned_rad;
    for (size_t k = 0; k < 3; ++k) out.position[k] = other.position[k] - position[k];
    out.position = turned(out.position, -turned_rad);
    return out;
}

std::array<float, 4> CameraPlace::rotation() const {
    return {0.0f, std::sin(0.5f * turned_rad), 0.0f, std::cos(0.5f * turned_rad)};
}

std::string places_text(const std::vector<CameraPlace>& places) {
    Json out = {{"format", "vfit-cameras"}, {"version", 1}, {"cameras", Json::array()}};
    for (const CameraPlace& place : places)
        out["cameras"].push_back(
            {{"position", place.position}, {"turned_deg", place.turned_rad / kRadPerDegree}});
    return out.dump(2) + "\n";
}

std::vector<CameraPlace> read_places(const std::string& path, size_t cameras) {
    const std::string text = read_text(path);
    std::vector<CameraPlace> out;
    try {
        const Json file = Json::parse(text);
        if (file.value("format", "") != "vfit-cameras") throw Failure(path + ": is not of vfit cameras");
        if (file.value("version", 0) != 1) throw Failure(path + ": is of another version than 1");
        if (!file.at("cameras").is_array()) throw Failure(path + ": \"cameras\" is no list");
        for (const Json& camera : file.at("cameras")) {
            CameraPlace place;
            const auto number = [&](const Json& value, float most) {
                const float v = value.is_number() ? value.get<float>() : NAN;
                if (!(std::abs(v) <= most))
                    throw Failure(path + ": camera " + std::to_string(out.size()) + ": " + value.dump() +
                                  " is not a number within " + std::to_string(int(most)));
                return v;
            };
            place.turned_rad = kRadPerDegree * number(camera.at("turned_deg"), 360.0f);
            const Json& position = camera.at("position");
            if (position.size() != 3) throw Failure(path + ": a position is not three numbers");
            for (size_t k = 0; k < 3; ++k) place.position[k] = number(position.at(k), 100.0f);
            out.push_back(place);
        }
    } catch (const Json::exception& error) {
        throw Failure(path + ": " + error.what());
    }
    if (out.size() != cameras)
        throw Failure(path + ": has " + std::to_string(out.size()) + " cameras, not " +
                      std::to_string(cameras));
    return out;
}

Cameras::Cameras(vfit_context context, const std::vector<std::string>& uris, const TrackOptions& options,
                 std::vector<CameraPlace> places)
    : places_(std::move(places)) {
    for (const std::string& uri : uris)
        cameras_.push_back({Source(context, uri), open_tracker(context, options), {}, {}, is_recorded(uri)});
}

bool Cameras::read(Camera& camera) {
    auto frame = camera.source.next();
    if (!frame) return false;
    camera.frame = std::move(*frame);
    const int64_t time_ns = view_of(camera.frame.get(), VFIT_STREAM_DEPTH).time_ns;
    if (camera.source.taken() == 1 && camera.recorded) camera.first_ns = time_ns;
    camera.time_ns = time_ns - camera.first_ns;
    return true;
}

void Cameras::hint(size_t camera) {
    for (size_t other = 0; other < cameras_.size(); ++other) {
        if (other == camera || !cameras_[other].tracked) continue;
        const uint32_t body = active_body(tracked(other));
        if (body == 0) continue;
        const CameraPlace place = places_[camera].of(places_[other]);
        check(vfit_tracker_hint_from(cameras_[camera].tracker.get(), tracked(other), body,
                                     place.position.data(), place.rotation().data()));
    }
}

bool Cameras::next() {
    int64_t latest_ns = INT64_MIN;
    for (Camera& camera : cameras_) {
        if (!read(camera)) return false;
        latest_ns = std::max(latest_ns, camera.time_ns);
    }
    for (Camera& camera : cameras_)
        while (camera.time_ns < latest_ns - kTogether_ns)
            if (!read(camera)) return false;
    for (size_t i = 0; i < cameras_.size(); ++i) {
        if (!places_.empty()) hint(i);
        check(vfit_tracker_update(cameras_[i].tracker.get(), cameras_[i].frame.get(),
                                  cameras_[i].tracked.out()));
    }
    return true;
}

}  // namespace vfit::tools
