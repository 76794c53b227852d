// What the fitted body tells of a person over the frames of a scan: one shape for all frames, and where the
// surface lies beside it.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "fit/body_fit.h"
#include "frame/body.h"
#include "scan/outline_loss.h"
#include "scan/surface_residuals.h"
#include "scan/trunk_profile.h"
#include "scan/turn_ring.h"
#include "scan/turned_trunk.h"

namespace vfit {

/// The numbers that measures are estimated from, in a fixed order: shape values (kFitShapes), height of the
/// crown (m), distance (m), size of a pixel there (mm), how far the person is turned from the front (rad,
/// squared) and from the side (rad, and squared), then of each view (front, side) and way of seeing (facing,
/// rim) every zone's distance outwards of the body of that shape (cm), then of each view the trunk's reaches
/// by level (cm), then of each view the roughness of trunk, arms and legs (cm). NaN: not seen.
inline constexpr size_t kScanFeatures =
    size_t(kFitShapes) + 6 + size_t(kViewKinds) * kSeenKinds * BodyZones::kCount +
    size_t(TrunkProfile::kLevels) * (TrunkProfile::kReachesFromFront + TrunkProfile::kReaches) +
    size_t(kViewKinds) * SurfaceResiduals::kRegions;
using ScanFeatures = std::array<float, kScanFeatures>;
/// Where some of them begin.
inline constexpr size_t kCrownFeature = size_t(kFitShapes), kPixelFeature = kCrownFeature + 2;
inline constexpr size_t kFrontReaches =
    size_t(kFitShapes) + 6 + size_t(kViewKinds) * kSeenKinds * BodyZones::kCount;
inline constexpr size_t kSideReaches =
    kFrontReaches + size_t(TrunkProfile::kLevels) * TrunkProfile::kReachesFromFront;

class BodyScan {
public:
    explicit BodyScan(std::shared_ptr<const FitModel> model);
    /// Overwrites all body data.
    ~BodyScan() { reset(); }
    BodyScan(const BodyScan&) = delete;
    BodyScan& operator=(const BodyScan&) = delete;

    /// Fits the body to a frame. Joints in camera space; the user map's id is the body's. What is seen is
    /// kept where the fit is good and the person is seen from the front or the side: then that view is
    /// returned. Does not allocate after the first frame of a size.
    ViewKind add(const DepthImage& image, const Body& body);
    /// Fits the body of a person who turns round on the spot. Radians that they are turned by to their left;
    /// nothing where the fit is not good.
    std::optional<float> fit_turning(const DepthImage& image, const Body& body);
    /// Keeps the frame that was fitted last, for the trunk alone. Does not allocate after the first.
    void keep_turning(const DepthImage& image, const Body& body);
    /// Forgets the person.
    void reset();

    uint32_t frames(ViewKind view) const { return residuals_.frames(view); }
    /// VFIT_ERROR_STATE before the first frame that was kept. Without `side` as if nothing had been seen from
    /// there: estimators for the front alone have not learnt what it means.
    ScanFeatures features(bool side) const;
    /// How many views keep_turning() has kept.
    size_t views_of_turn() const { return turn_.size(); }
    /// The surface that they show. 0.15 s after a whole turn.
    TurnedTrunk turned_trunk() const { return TurnedTrunk(turn_); }
    /// The shape of all frames together.
    const FitShape& shape() const { return fit_.output().pose.shape; }
    const BodyFitOutput& fit() const { return fit_.output(); }
    /// Where the readings of a head end below hair that gives none, metres above the floor: stature is more.
    /// 0: the crown is seen.
    float stature_bound_m() const { return crown_is_hidden() ? float(sums_.bound_m / sums_.bounds) : 0.0f; }
    /// How much the crown may lie higher or lower than features() tell, where the last reading of the head
    /// and the first of the background lie a little farther apart than elsewhere; standard deviation.
    float crown_sigma_m() const { return unseen_crown_m() / std::sqrt(12.0f); }
    /// What the sensor loses of outlines; features() has it added to all that is read off outlines.
    float outline_loss_px() const { return outline_loss_.pixels(); }

private:
    /// False where the body does not fit.
    bool run_fit(const DepthImage& image, const Body& body);
    /// How far the fitted body is turned to its left from facing the camera, radians.
    float facing(const Camera& camera) const;
    /// Of an image, at the person.
    float pixel_m(const Camera& camera) const;
    /// What the sensor loses of an outline, metres at the person.
    float outline_loss_m() const;
    struct Top {
        float height_m = 0.0f;  // over the floor; 0: the head is cut or nothing of it is seen
        float gap_m = 0.0f;     // from there to the background, where that is seen
        bool hidden = false;    // so far that hair must lie between
    };
    Top top_of_head(const DepthImage& image, uint8_t user) const;
    bool crown_is_hidden() const { return sums_.bounds > sums_.crowns; }
    /// Of the crown, between the last reading and the background, beyond what the sensor loses anyway; 0
    /// where it is within a pixel.
    float unseen_crown_m() const;

    std::shared_ptr<const FitModel> model_;
    BodyFit fit_;
    SurfaceResiduals residuals_;
    TrunkProfile profile_;
    std::vector<TrunkView> turn_;
    TurnRing ring_;  // of turn_
    OutlineLoss outline_loss_;
    struct Sums {
        double crown_m = 0.0, gap_m = 0.0, bound_m = 0.0, distance_m = 0.0, pixel_m = 0.0;
        std::array<double, kViewKinds> turned_rad{}, turned_squared{};  // from the view
        uint32_t crowns = 0, bounds = 0, frames = 0;
    } sums_;
};

}  // namespace vfit
