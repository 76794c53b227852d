// Several cameras that see the same people at once, each with a tracker of its own.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

inline constexpr float kRadPerDegree = 0.017453292f;

/// Where a camera's world space lies in the first camera's: turned about up (to the left, as seen from
/// above), then moved. Metres.
struct CameraPlace {
    float turned_rad = 0.0f;
    std::array<float, 3> position{};

    /// Of another camera's world space in this one's, of two that lie in the same.
    CameraPlace of(const CameraPlace& other) const;
    std::array<float, 4> rotation() const;  // x, y, z, w
};

/// As `vfit cameras` writes them: {"format": "vfit-cameras", "version": 1, "cameras": [{"position",
/// "turned_deg"}, ...]}.
std::string places_text(const std::vector<CameraPlace>& places);
/// Fails with the file and what is wrong with it, also where it has another number of cameras.
std::vector<CameraPlace> read_places(const std::string& path, size_t cameras);

class Cameras {
public:
    /// Recordings begin at the same moment, or were cut so; cameras have the host's clock.
    /// `places`: one of each, or none where they are not known. Then nothing that one tracker sees helps
    /// another.
    Cameras(vfit_context context, const std::vector<std::string>& uris, const TrackOptions& options,
            std::vector<CameraPlace> places = {});
    /// Tracks a frame of each, all of about one moment as far as their rates allow. False where a source has
    /// ended.
    bool next();
    size_t count() const { return cameras_.size(); }
    vfit_frame tracked(size_t camera) const { return cameras_[camera].tracked.get(); }
    /// The same, for whom it shall outlive the next one: it hints no other tracker then.
    Frame take_tracked(size_t camera) { return std::move(cameras_[camera].tracked); }

private:
    struct Camera {
        Source source;
        Tracker tracker;
        Frame frame, tracked;
        bool recorded = false;
        int64_t first_ns = 0, time_ns = 0;  // of what is recorded: since its first frame
    };
    bool read(Camera& camera);
    void hint(size_t camera);

    std::vector<Camera> cameras_;
    std::vector<CameraPlace> places_;
};

}  // namespace vfit::tools
