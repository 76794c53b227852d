// Where a person's surface lies beside the fitted body: what the body's few shapes cannot follow, averaged over frames.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fit/fit_pose.h"
#include "frame/depth_image.h"

namespace vfit {

/// Patches of the body's surface, smaller on the trunk than on limbs.
class FitZones {
public:
    static constexpr int kCount = 96;
    explicit FitZones(const FitModel& model);
    int of(uint32_t vertex) const { return of_vertex_[vertex]; }

private:
    std::vector<uint8_t> of_vertex_;
};

/// How the person stands to the camera.
enum class FitViewKind : uint8_t { kFront, kSide, kOther };
inline constexpr int kFitViewKinds = 2;  // of which surfaces are kept
FitViewKind view_kind_of(const FitBody& body);

/// What of a surface was seen: facing the camera, by its depth, or edge-on, by the outline.
enum class FitSeen : uint8_t { kFacing, kRim };
inline constexpr int kFitSeenKinds = 2;

class FitResiduals {
public:
    explicit FitResiduals(const FitModel& model);
    /// Overwrites all that was seen.
    void reset();
    /// Of that frame, on every pixel; `body` as it was fitted to it with that shape. Does not allocate.
    void add(const DepthImage& image, uint8_t user, const FitBody& body, const FitShape& shape);

    uint32_t frames(FitViewKind view) const { return frames_[size_t(view)]; }
    /// Mean distance of each zone's surface outwards of the body of that shape, metres; 0 where nothing was seen.
    using Zones = std::array<float, FitZones::kCount>;
    Zones means_m(FitViewKind view, FitSeen seen, const FitShape& shape) const;
    /// How uneven the surface is within the zones of trunk, arms or legs (0 to 2): root mean square, metres.
    float roughness_m(FitViewKind view, int region, const FitShape& shape) const;
    static constexpr int kRegions = 3;

private:
    // Sums of a vertex over frames: of its distance outwards of the mean body, by the fields of shape.
    struct Sum {
        float distance = 0.0f;
        uint32_t count = 0;
    };
    std::vector<Sum>& sums(FitViewKind view, FitSeen seen) { return sums_[size_t(view) * kFitSeenKinds + size_t(seen)]; }
    const std::vector<Sum>& sums(FitViewKind view, FitSeen seen) const {
        return sums_[size_t(view) * kFitSeenKinds + size_t(seen)];
    }
    /// Outwards, of that shape beside the mean body at a vertex.
    float outwards(uint32_t vertex, const FitShape& shape) const;

    const FitModel& model_;
    FitZones zones_;
    std::vector<FitShape> outwards_;  // one a vertex: metres a unit of shape
    std::array<std::vector<Sum>, size_t(kFitViewKinds) * kFitSeenKinds> sums_;
    std::array<uint32_t, kFitViewKinds> frames_{};
};

}  // namespace vfit
