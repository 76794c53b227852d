// The scan of one person by the paper's method: filtered depth (Algorithm 1), collision spheres (Algorithm
// 2), body dimensions (Algorithm 3) and their average over the frames of one second (Algorithm 4, whose array
// of 16 radii a frame is taken to mean the 15 joints of Fig. 3).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "anthropometry/measurement.h"
#include "frame/body.h"
#include "frame/depth_image.h"
#include "paper/averaging.h"
#include "paper/proportions.h"
#include "vfit.h"

namespace vfit {

/// The defaults of `ratios` and `combination` are those with the smaller error: on 20 rendered bodies of
/// known size (Kinect-like noise, floor known) they come within 0.2 % of stature and 1 to 2 % of bideltoid
/// breadth on average; the paper as printed, as_printed(), within 9 % (its canon knows no real person's hips
/// and hands) and 2.5 %.
struct ScanDesc {
    uint32_t frame_count = 30;  // Algorithm 4: one second at 30 Hz
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    RatioTable ratios = RatioTable::kAnthropometric;
    Combination combination = Combination::kInverseVariance;
    Outliers outliers = Outliers::kLeaveOut;
    uint32_t camera_count = 1;  // that see the person at once
    static ScanDesc as_printed() {
        ScanDesc desc;
        desc.ratios = RatioTable::kCanon;
        desc.combination = Combination::kMean;
        desc.outliers = Outliers::kKeep;
        return desc;
    }
};

struct ScanFrame {
    DepthImage image;
    const Body* body = nullptr;  // joints in camera space; null: nobody is tracked
    uint32_t person_count = 1;
    uint32_t camera = 0;  // which one of several
};

struct ScanProgress {
    bool taken = false;
    vfit_guidance guidance = VFIT_GUIDANCE_NONE;  // why the frame was not taken
    float correction_m = 0.0f;                    // Fig. 9
    double compute_ms = 0.0;
    uint32_t frames_taken = 0;
};

class PaperScan {
public:
    /// VFIT_ERROR_ARGUMENT unless 1 to 3600 frames are wanted and the sex is a known one.
    explicit PaperScan(const ScanDesc& desc);
    /// Overwrites all body data.
    ~PaperScan();
    PaperScan(const PaperScan&) = delete;
    PaperScan& operator=(const PaperScan&) = delete;

    /// Ignores frames once the scan is complete. Does not allocate after the first frame of a size.
    ScanProgress add(const ScanFrame& frame);
    /// The two halves of add(), for who has more to ask of a frame: whether it is good, and that it is kept
    /// (the one that was looked at last, which must live still). Frames of one camera follow each other.
    ScanProgress look(const ScanFrame& frame);
    void take(const ScanFrame& frame);
    /// Forgets the person, and what extend() added.
    void reset();
    /// Wants so many frames more, of this person.
    void extend(uint32_t frames);

    uint32_t frames_taken() const;
    uint32_t frames_wanted() const;
    bool complete() const { return frames_taken() >= frames_wanted(); }

    /// Every dimension that was seen at least once, and the estimates of Algorithm 3 in place of stature_m
    /// and shoulder_breadth_m. No frame yet: VFIT_ERROR_STATE.
    std::vector<Measurement> measurements() const;

    /// Radii of the paper's 15 joints; 0: never measured.
    std::array<float, kPaperJointCount> radii() const;

    struct Scale {
        float x = 1, y = 1, sigma_x = 0, sigma_y = 0;  // relative to the garment kind's nominal size
        float width_m = 0, height_m = 0;               // the primary dimensions of Table 2
    };
    /// Algorithm 3 for "short_sleeves", "long_sleeves" or "trousers"; another kind is a VFIT_ERROR_ARGUMENT
    /// that names the three. No frame yet: VFIT_ERROR_STATE; a primary dimension that cannot be estimated:
    /// VFIT_ERROR_DATA.
    Scale scale(const std::string& garment_kind) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vfit
