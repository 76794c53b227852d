// The whole chain for one person: scanned, sized, dressed, moved. What vfit fit does, without its files.
#pragma once

#include <functional>
#include <optional>

#include "client/outfit.h"
#include "client/people.h"

namespace vfit::tools {

struct FittingOptions {
    std::string source;
    std::string garments;    // "A+B": B over A; empty: default_outfit of the person's sex
    std::string size;        // of every garment; empty: made to measure
    std::string chart;       // by name or path; empty: the one that each garment names
    std::string chart_kind;  // garment kind of that chart; empty: the garment's own
    ScanOptions scan;
    uint32_t detail = 0;
    uint32_t substeps = 0;    // of the cloth per 1/60 s; 0: the library's default
    bool hands = true;        // forearms and hands push the garment
    uint32_t max_frames = 0;  // of the moving part; 0: all
};

/// What a chart says about one garment.
struct SizeAdvice {
    std::string chart, kind;
    Json sizes = Json::array();  // best first
    std::string reason;          // why sizes is empty, or of another chart than the garment's own
};

class Fitting {
public:
    Fitting(vfit_context context, const FittingOptions& options);

    /// The tracked frame that the scan took last, for pictures.
    vfit_frame scan_frame() const { return scan_frame_.get(); }
    const ScanRun& scan() const { return scan_; }
    vfit_sex sex() const { return sex_; }
    /// Of that sex; 1 where it was told.
    float sex_probability() const { return sex_probability_; }
    vfit_avatar avatar() const { return avatar_.get(); }
    const WornOutfit& outfit() const { return *outfit_; }
    /// One for each layer of the outfit.
    const std::vector<SizeAdvice>& advice() const { return advice_; }
    uint32_t body_id() const { return scan_.body_id; }
    /// From the last scan frame to the first buffer of the dressed avatar.
    double dress_ms() const { return dress_ms_; }

    /// Plays the source from its start: each frame moves the avatar, and the outfit by one step.
    /// on_frame sees the tracked frame and the seconds since the first, long pauses cut short; false ends the
    /// play.
    void play(const std::function<bool(vfit_frame tracked, double time_s)>& on_frame);
    uint32_t frames_played() const { return frames_played_; }

private:
    void dress();
    void pose_avatar();
    SizeAdvice advise(const Layer& layer) const;

    vfit_context context_;
    FittingOptions options_;
    ScanRun scan_;
    Frame scan_frame_;
    vfit_sex sex_ = VFIT_SEX_UNKNOWN;
    float sex_probability_ = 0.0f;
    Avatar avatar_;
    Motion motion_;
    std::optional<WornOutfit> outfit_;
    std::vector<SizeAdvice> advice_;
    double dress_ms_ = 0.0;
    uint32_t frames_played_ = 0;
};

}  // namespace vfit::tools
