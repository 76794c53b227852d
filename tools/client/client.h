// The C ABI as the tools use it: errors as exceptions, handles that let go of themselves, lists as vectors.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vfit.h"

namespace vfit::tools {

using Json = nlohmann::ordered_json;

/// A failed call, with the library's own sentence.
class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Passes news (>= 0) through; throws Failure for an error.
vfit_result check(vfit_result result);

/// A handle with its destroy function.
template <typename T, vfit_result (*kDestroy)(T)>
class Handle {
public:
    Handle() = default;
    explicit Handle(T value) : value_(value) {}
    Handle(Handle&& other) noexcept : value_(std::exchange(other.value_, T{})) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~Handle() {
        if (value_.id) kDestroy(value_);
    }
    T get() const { return value_; }
    T* out() {
        if (value_.id) kDestroy(value_);
        value_ = T{};
        return &value_;
    }
    explicit operator bool() const { return value_.id != 0; }

private:
    T value_{};
};

using Context = Handle<vfit_context, vfit_context_destroy>;
using Sensor = Handle<vfit_sensor, vfit_sensor_close>;
using Frame = Handle<vfit_frame, vfit_frame_release>;
using Tracker = Handle<vfit_tracker, vfit_tracker_destroy>;
using Scan = Handle<vfit_scan, vfit_scan_destroy>;
using SizeChart = Handle<vfit_size_chart, vfit_size_chart_destroy>;
using Population = Handle<vfit_population, vfit_population_destroy>;
using Motion = Handle<vfit_motion, vfit_motion_destroy>;
using Avatar = Handle<vfit_avatar, vfit_avatar_destroy>;
using Garment = Handle<vfit_garment, vfit_garment_destroy>;
using Cloth = Handle<vfit_cloth, vfit_cloth_destroy>;
using Recorder = Handle<vfit_recorder, vfit_recorder_destroy>;

/// All items of a list call: list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* count) {...}).
template <typename T, typename Call>
std::vector<T> list(Call&& call) {
    uint32_t count = 0;
    check(call(static_cast<T*>(nullptr), static_cast<uint32_t>(sizeof(T)), &count));
    std::vector<T> items(count);
    if (count > 0) check(call(items.data(), static_cast<uint32_t>(sizeof(T)), &count));
    items.resize(count);
    return items;
}

std::string joint_name(vfit_joint_id joint);
std::string bone_name(vfit_bone_id bone);
std::string last_error();

/// A context with the settings of the command line.
Context open_context();

/// Whose joints and user map are taken, and who is the active person.
struct TrackOptions {
    vfit_track_source joints = VFIT_TRACK_AUTO, user_map = VFIT_TRACK_AUTO;
    vfit_follow follow = VFIT_FOLLOW_NEAREST;
    vfit_track_fit fit = VFIT_FIT_AUTO;
    uint32_t chosen = 0;  // nobody else, where it is not 0
    bool asked = false;   // to follow somebody in particular
};
Tracker open_tracker(vfit_context context, const TrackOptions& options);

/// Frames of a recording or sensor, one after the other.
class Source {
public:
    Source(vfit_context context, const std::string& uri);
    /// The next frame; nothing at the end.
    std::optional<Frame> next();
    uint32_t taken() const { return taken_; }

private:
    Sensor sensor_;
    uint32_t taken_ = 0;
};

/// The id of the first body of the frame; 0: nobody.
uint32_t first_body(vfit_frame frame);
/// The id of the person to follow, who may be out of sight for a moment; 0: nobody.
uint32_t active_body(vfit_frame frame);
/// The same; 0 as well while they are out of sight.
uint32_t active_body_in_view(vfit_frame frame);
std::vector<vfit_joint> joints_of(vfit_frame frame, uint32_t body_id);
vfit_camera camera_of(vfit_frame frame);
vfit_view view_of(vfit_frame frame, vfit_stream stream);
bool has_stream(vfit_frame frame, vfit_stream stream);

/// A row of an image.
template <typename T>
const T* row_of(const vfit_view& view, uint32_t y) {
    return reinterpret_cast<const T*>(static_cast<const unsigned char*>(view.data) +
                                      size_t(y) * view.row_stride);
}

/// A copy of vertex data.
template <typename T>
std::vector<T> items_of(vfit_frame frame, vfit_stream stream) {
    const vfit_view view = view_of(frame, stream);
    std::vector<T> items(view.width);
    for (size_t i = 0; i < items.size(); ++i)
        std::memcpy(&items[i], static_cast<const unsigned char*>(view.data) + i * view.item_stride,
                    sizeof(T));
    return items;
}

std::vector<vfit_rig_bone> rig_of(vfit_avatar avatar);
/// The bones of the pose as it is now; the rest of it in `pose`.
std::vector<vfit_bone> bones_of(vfit_motion motion, vfit_pose& pose);
void set_pose(vfit_avatar avatar, const vfit_pose& pose, const std::vector<vfit_bone>& bones);

/// Upright, the arms at 45 degrees, each leg turned out by that much.
void stand(vfit_avatar avatar, float leg_rad);

/// Triangles of the avatar that the cloths leave visible: three indices each.
std::vector<uint32_t> seen_triangles(vfit_avatar avatar, std::span<const vfit_cloth> cloths);

/// A world-space point in the camera space of that camera.
struct Point {
    float x, y, z;
};
Point to_camera(const vfit_camera& camera, const float (&world)[3]);

/// {"HEAD": [x, y, z, confidence], ...} in camera space.
Json joints_json(const std::vector<vfit_joint>& joints, const vfit_camera& camera);

}  // namespace vfit::tools
