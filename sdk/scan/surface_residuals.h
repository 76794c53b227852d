// Where a person's surface lies beside the fitted body: what the body's few shapes cannot follow, averaged
// over frames.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit/body_fit.h"
#include "frame/depth_image.h"
#include "scan/body_zones.h"
#include "scan/view_kind.h"

namespace vfit {

/// What of a surface was seen: facing the camera, by its depth, or edge-on, by the outline.
enum class Seen : uint8_t { kFacing, kRim };
inline constexpr int kSeenKinds = 2;

class SurfaceResiduals {
public:
    explicit SurfaceResiduals(const FitModel& model);
    /// Overwrites all that was seen.
    void reset();
    /// Of the frame that was fitted last, on every pixel. Does not allocate.
    void add(const DepthImage& image, uint8_t user, const BodyFit& fit);

    uint32_t frames(ViewKind view) const { return frames_[size_t(view)]; }
    /// Mean distance of each zone's surface outwards of the body of that shape, metres; NaN where nothing was
    /// seen.
    using Zones = std::array<float, BodyZones::kCount>;
    Zones means_m(ViewKind view, Seen seen, const FitShape& shape) const;
    /// How uneven the surface is within the zones of trunk, arms or legs (0 to 2): root mean square, metres;
    /// NaN where nothing was seen.
    float roughness_m(ViewKind view, int region, const FitShape& shape) const;
    static constexpr int kRegions = 3;

private:
    // Sums of a vertex over frames: of its distance outwards of the mean body, metres, by the fields of
    // shape.
    struct Sum {
        float distance = 0.0f;
        uint32_t count = 0;
    };
    const std::vector<Sum>& sums(ViewKind view, Seen seen) const {
        return sums_[size_t(view) * kSeenKinds + size_t(seen)];
    }
    std::vector<Sum>& sums(ViewKind view, Seen seen) {
        return sums_[size_t(view) * kSeenKinds + size_t(seen)];
    }
    /// Of a vertex over the frames, outwards of that shape; NaN where it was hardly seen.
    float mean_m(ViewKind view, Seen seen, uint32_t vertex, const FitShape& shape) const;
    /// Outwards, of that shape beside the mean body at a vertex.
    float outwards(uint32_t vertex, const FitShape& shape) const;

    const FitModel& model_;
    BodyZones zones_;
    std::vector<FitShape> outwards_;  // one a vertex: metres a unit of shape
    std::array<std::vector<Sum>, size_t(kViewKinds) * kSeenKinds> sums_;
    std::array<uint32_t, kViewKinds> frames_{};
};

}  // namespace vfit
