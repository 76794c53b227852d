// The whole chain for one person: scanned, sized, dressed, moved. What vfit fit does, without its files.
#pragma once

#include <functional>

#include "client/people.h"

namespace vfit::tools {

struct FittingOptions {
    std::string source, garment = "sundress", size, chart;
    ScanOptions scan;
    uint32_t detail = 0;
    bool hands = false;       // forearms and hands push the garment
    uint32_t max_frames = 0;  // of the moving part; 0: all
};

class Fitting {
public:
    Fitting(vfit_context context, const FittingOptions& options);

    /// The tracked frame that the scan took last, for pictures.
    vfit_frame scan_frame() const { return scan_frame_.get(); }
    const ScanRun& scan() const { return scan_; }
    vfit_avatar avatar() const { return avatar_.get(); }
    vfit_cloth cloth() const { return cloth_.get(); }
    uint32_t body_id() const { return scan_.body_id; }
    /// From the last scan frame to the first buffer of the dressed avatar.
    double dress_ms() const { return dress_ms_; }
    const std::string& garment_kind() const { return garment_kind_; }
    /// Sizes by the chart, best first.
    const Json& sizes() const { return sizes_; }

    /// Plays the source from its start: each frame moves the avatar and the garment, which runs at 60 Hz.
    /// on_frame sees the tracked frame and the seconds since the first, long pauses cut short; false ends the
    /// play.
    void play(const std::function<bool(vfit_frame tracked, double time_s)>& on_frame);
    uint32_t frames_played() const { return frames_played_; }

private:
    void dress();
    void pose_avatar();

    vfit_context context_;
    FittingOptions options_;
    ScanRun scan_;
    Frame scan_frame_;
    Avatar avatar_;
    Motion motion_;
    Garment garment_;
    Cloth cloth_;
    std::string garment_kind_;
    Json sizes_;
    double dress_ms_ = 0.0;
    uint32_t frames_played_ = 0;
};

}  // namespace vfit::tools
