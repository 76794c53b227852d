// The scan of one person, by the paper's method alone or by the fitted body as well: which frames count, and
// for what.
#pragma once

#include <optional>

#include "paper/paper_scan.h"
#include "scan/body_scan.h"
#include "scan/measure_model.h"
#include "scan/turn_ring.h"

namespace vfit {

struct PersonScanDesc {
    ScanDesc paper;
    // Both, and measures are those of the fitted body; without them those of the paper's method.
    std::shared_ptr<const FitModel> fit_model;
    std::shared_ptr<const MeasureModel> measure_model;
    uint32_t side_frame_count = 0;
    bool bare = false;   // no shoes and no hair: stature needs no allowance
    bool tight = false;  // clothes lie on the skin
    bool turn = false;   // of the fitted body, after the other frames: once round on the spot
    // With paper.camera_count above 1 the fitted body also takes a few frames of each camera, last.
};

struct InferredSex {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    float probability = 0.0f;  // of that sex; 1 where the scan was told
};

class PersonScan {
public:
    /// Errors as those of PaperScan.
    explicit PersonScan(const PersonScanDesc& desc);
    /// Overwrites all body data.
    ~PersonScan() { reset(); }
    PersonScan(const PersonScan&) = delete;
    PersonScan& operator=(const PersonScan&) = delete;

    /// Ignores frames once the scan is complete.
    ScanProgress add(const ScanFrame& frame);
    /// Forgets the person, and what extend() added.
    void reset();
    /// Wants so many more of this person; side frames only of the body fit.
    void extend(uint32_t frames, uint32_t side_frames);

    /// From the front.
    uint32_t frames_taken() const { return paper_.frames_taken(); }
    uint32_t frames_wanted() const { return paper_.frames_wanted(); }
    uint32_t side_frames_taken() const { return side_frames_; }
    uint32_t side_frames_wanted() const { return body_ ? desc_.side_frame_count + more_side_frames_ : 0; }
    /// Ways that the person has been seen to face in the turn, and those that are wanted: a bit each.
    uint32_t turn_seen() const { return ring_.seen(); }
    uint32_t turn_wanted() const { return body_ && desc_.turn ? TurnRing::kAll : 0; }
    uint32_t camera_count() const { return uint32_t(views_of_camera_.size()); }
    bool complete() const {
        return paper_.complete() && side_frames_ >= side_frames_wanted() &&
               (turn_wanted() == 0 || ring_.complete()) && all_cameras_seen();
    }

    /// No frame from the front yet: VFIT_ERROR_STATE.
    std::vector<Measurement> measurements() const;
    /// What the fitted body tells; null by the paper's method alone, or before the first frame.
    const FitShape* fitted_shape() const { return body_ && frames_taken() ? &body_->shape() : nullptr; }
    /// As it was told, else the likelier of the two. Unknown by the paper's method alone.
    vfit_sex likely_sex() const { return inferred_sex().sex; }
    InferredSex inferred_sex() const;
    /// The paper's part, which gives spheres and garment scale in either method.
    const PaperScan& paper() const { return paper_; }

private:
    static constexpr uint32_t kFewestSideFrames = 5;  // fewer are not worth the other estimator
    bool with_side() const { return side_frames_ >= kFewestSideFrames; }
    ScanFeatures features() const { return before_turn_ ? *before_turn_ : body_->features(with_side()); }
    /// What is wrong with the frame for the body fit; it is kept where nothing is.
    vfit_guidance fit(const ScanFrame& frame);
    vfit_guidance turn(const ScanFrame& frame);
    vfit_guidance look_around(const ScanFrame& frame);
    bool several_cameras() const { return views_of_camera_.size() > 1; }
    bool all_cameras_seen() const;
    /// Guidance of the first camera that lacks views; HOLD_STILL where none of those has given any.
    vfit_guidance wanted_by_others() const;
    /// Null where they do not close.
    const SeenOfTurn* seen_of_turn() const;

    PersonScanDesc desc_;
    PaperScan paper_;
    std::unique_ptr<BodyScan> body_;
    uint32_t side_frames_ = 0, more_side_frames_ = 0;
    TurnRing ring_;
    std::vector<uint32_t> views_of_camera_;
    std::vector<vfit_guidance> said_by_camera_;  // guidance of its last frame
    // Of the views before the turn: the body goes on being fitted to all of it, and measures have not learnt
    // what that does to its shape.
    std::optional<ScanFeatures> before_turn_;
    // Of all views of the turn so far, where they close round the person: made when measures are asked for.
    mutable std::optional<SeenOfTurn> turned_;
    mutable size_t turned_views_ = 0;
    float turned_rad_ = 0.0f;  // where the speed of the turn is counted from
    int64_t turned_ns_ = 0;    // 0: nowhere yet
    bool fast_ = false;
};

}  // namespace vfit
