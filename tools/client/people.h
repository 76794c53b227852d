// The steps that several commands share: scan a person, name the size.
#pragma once

#include "client/cameras.h"
#include "client/client.h"

namespace vfit::tools {

struct ScanOptions {
    uint32_t frames = 0;  // 0: the library's default
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    vfit_scan_method method = VFIT_SCAN_DEFAULT;
    TrackOptions track{};
    uint32_t side_frames = 0;                  // of VFIT_SCAN_FIT
    uint32_t flags = 0;                        // VFIT_SCAN_*
    std::vector<std::string> other_cameras{};  // that see the person at the same time; of scan_source
    std::vector<CameraPlace> places{};         // of all cameras, or none
};

struct ScanRun {
    Scan scan;
    uint32_t frames_taken = 0, frames_wanted = 0, side_frames_taken = 0;
    uint32_t turn_seen = 0;  // vfit_scan_state
    bool complete = false;   // all that was asked for has been seen
    uint32_t body_id = 0;    // who was scanned: the first that a frame was taken of
    vfit_scan_method method = VFIT_SCAN_DEFAULT;
    std::string note;                  // why another method than the default measured; empty: it did not
    double compute_ms = 0.0;           // of all frames taken
    double last_ms = 0.0;              // of the last: what is left to do when capture ends
    std::vector<float> corrections_m;  // one a frame taken (Fig. 9)
};

/// No frame of the source was good enough for the scan; the text counts the reasons.
class NoFrameTaken : public Failure {
public:
    using Failure::Failure;
};

/// Feeds frames into a scan until it is complete or the source ends. Fails where not one frame could be
/// taken, with the reasons counted. last_frame, where given, gets the tracked frame that was taken last.
ScanRun run_scan(vfit_context context, Source& source, const ScanOptions& options,
                 Frame* last_frame = nullptr);
/// Opens the source and scans. Where no method is asked for, the fitted body measures; a source without a
/// frame that it can use is played again for the paper's method, and `note` says so.
ScanRun scan_source(vfit_context context, const std::string& uri, const ScanOptions& options,
                    Frame* last_frame = nullptr);

const char* guidance_text(vfit_guidance guidance);

Json measurements_json(const std::vector<vfit_measurement>& measurements);
/// A line each, of what measurements_json returned.
void print_measurements(const Json& measurements);
std::vector<vfit_measurement> measurements_of(vfit_scan scan);
struct StoredMeasures {
    std::vector<vfit_measurement> measurements;
    vfit_sex sex = VFIT_SEX_UNKNOWN;
};
/// From a profile, a report of vfit measure, or a plain {"stature_m": 1.7}; sigma 0 where it is not given.
StoredMeasures measurements_from(const std::string& text);
/// The same from a file, which a failure names.
StoredMeasures read_measures(const std::string& path);
/// Two scans of one person in one.
std::vector<vfit_measurement> merged_measurements(const std::vector<vfit_measurement>& a,
                                                  const std::vector<vfit_measurement>& b);
/// A scan's measures as the tape of a calibration would tell them.
std::vector<vfit_measurement> calibrated_measurements(const std::string& calibration,
                                                      const std::vector<vfit_measurement>& scanned);
/// What measurements_from reads again.
std::string profile_text(const std::vector<vfit_measurement>& measurements, vfit_sex sex);

/// [{"label", "probability"}, ...], best first.
Json sizes_json(vfit_size_chart chart, const std::string& garment_kind,
                const std::vector<vfit_measurement>& measurements);

/// The two labels that the size lies between, where no label is sure and the best two are; empty otherwise.
Json between_json(const Json& sizes);
/// "M (84 %)", "between M and L", or "no clear size, M is likeliest (26 %)".
std::string size_text(const Json& sizes);

/// {"chest_girth_m": {"ease", "sigma", "tight", "regular", "loose"}, ...}: how the label sits.
Json zones_json(vfit_size_chart chart, const std::string& garment_kind, const std::string& label,
                const std::vector<vfit_measurement>& measurements);

vfit_sex sex_from(const std::string& option);
/// "f", "m" or "unknown".
const char* sex_text(vfit_sex sex);
/// "fit", "paper" or "paper-as-printed"; empty: the default.
vfit_scan_method scan_method_from(const std::string& option);
const char* scan_method_text(vfit_scan_method method);

}  // namespace vfit::tools
