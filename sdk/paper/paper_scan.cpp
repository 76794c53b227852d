#include "paper/paper_scan.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/error.h"
#include "core/wipe.h"
#include "paper/body_lines.h"
#include "paper/guidance.h"
#include "paper/sphere_fit.h"

namespace vfit {

namespace {

/// What one frame says; unknown quantities have no value.
struct FrameValues {
    Lines lines;
    std::array<float, kPaperJointCount> radii;
};

/// What is kept of a camera from frame to frame.
struct CameraView {
    DepthFilter filter;
    FilteredDepth depth;  // the filter's last answer
    Body last;
    bool has_last = false;

    void reset() {
        wipe(last);
        has_last = false;
        depth = FilteredDepth{};
        filter.wipe();
    }
};

}  // namespace

struct PaperScan::State {
    explicit State(const ScanDesc& d) : desc(d), wanted(d.frame_count), views(d.camera_count) {
        frames.reserve(wanted);
    }
    const ScanDesc desc;
    uint32_t wanted;  // frames; more than desc's where the scan was extended
    std::vector<FrameValues> frames;
    std::vector<CameraView> views;

    void require_frames() const {
        if (frames.empty()) fail(VFIT_ERROR_STATE, "scan: no frame has been taken yet");
    }

    /// The frames of one second share most of their error (posture, calibration, user map), so that their
    /// mean is credited with no less uncertainty than one of them.
    Lines averaged_lines() const {
        Lines lines{};
        std::vector<float> values;
        for (size_t i = 0; i < kLineCount; ++i) {
            values.clear();
            double rule_sigma = 0.0;
            for (const FrameValues& f : frames) {
                if (!f.lines[i].known) continue;
                values.push_back(f.lines[i].value_m);
                rule_sigma += f.lines[i].sigma_m;
            }
            if (values.empty()) continue;
            rule_sigma /= double(values.size());
            const Averaged line = average(values, desc.outliers);
            lines[i] = {line.mean, float(std::hypot(line.deviation, rule_sigma)), true};
        }
        return lines;
    }

    float averaged_radius(size_t joint) const {
        std::vector<float> values;
        for (const FrameValues& f : frames)
            if (f.radii[joint] > 0.0f) values.push_back(f.radii[joint]);
        return average(values, desc.outliers).mean;
    }

    Estimate primary(const Lines& lines, Line line) const {
        return estimate_primary(lines, line, desc.ratios, desc.sex, desc.combination);
    }
};

PaperScan::PaperScan(const ScanDesc& desc) {
    constexpr uint32_t kMostFrames = 3600;  // two minutes at 30 Hz
    if (desc.frame_count == 0 || desc.frame_count > kMostFrames)
        fail(VFIT_ERROR_ARGUMENT, "scan: frame_count ", desc.frame_count, " is not in 1 to ", kMostFrames);
    if (desc.camera_count == 0) fail(VFIT_ERROR_ARGUMENT, "scan: no camera");
    if (desc.sex < VFIT_SEX_UNKNOWN || desc.sex > VFIT_SEX_MALE)
        fail(VFIT_ERROR_ARGUMENT, "scan: unknown sex ", desc.sex);
    state_ = std::make_unique<State>(desc);
}

PaperScan::~PaperScan() { reset(); }

void PaperScan::reset() {
    for (FrameValues& f : state_->frames) wipe(f);
    state_->frames.clear();
    state_->wanted = state_->desc.frame_count;
    for (CameraView& view : state_->views) view.reset();
}

void PaperScan::extend(uint32_t frames) {
    state_->wanted += frames;
    std::vector<FrameValues> longer;
    longer.reserve(state_->wanted);
    longer.assign(state_->frames.begin(), state_->frames.end());
    for (FrameValues& f : state_->frames) wipe(f);
    state_->frames = std::move(longer);
}

uint32_t PaperScan::frames_taken() const { return uint32_t(state_->frames.size()); }
uint32_t PaperScan::frames_wanted() const { return state_->wanted; }

ScanProgress PaperScan::look(const ScanFrame& frame) {
    CameraView& view = state_->views.at(frame.camera);
    ScanProgress progress;
    progress.frames_taken = frames_taken();
    const Stopwatch watch;
    view.depth = view.filter.run(frame.image, frame.body ? frame.body->id : 0);
    progress.correction_m = view.depth.correction_m;
    const bool same_person = view.has_last && frame.body && view.last.id == frame.body->id;
    progress.guidance = check_frame(view.depth, frame.image.camera, frame.body,
                                    same_person ? &view.last : nullptr, frame.person_count);
    view.has_last = frame.body != nullptr;
    if (frame.body) view.last = *frame.body;
    progress.compute_ms = watch.ms();
    return progress;
}

void PaperScan::take(const ScanFrame& frame) {
    const FilteredDepth& depth = state_->views.at(frame.camera).depth;
    const Camera& camera = frame.image.camera;
    state_->frames.push_back(
        {measure_lines(depth, camera, *frame.body), fit_spheres(depth, camera, *frame.body)});
}

ScanProgress PaperScan::add(const ScanFrame& frame) {
    ScanProgress progress;
    progress.frames_taken = frames_taken();
    if (complete()) return progress;
    const Stopwatch watch;
    progress = look(frame);
    if (progress.guidance == VFIT_GUIDANCE_NONE) {
        take(frame);
        progress.taken = true;
        progress.frames_taken = frames_taken();
    }
    progress.compute_ms = watch.ms();
    return progress;
}

std::vector<Measurement> PaperScan::measurements() const {
    state_->require_frames();
    const Lines lines = state_->averaged_lines();
    std::vector<Measurement> list;
    for (size_t i = 0; i < kLineCount; ++i) {
        const Line line = static_cast<Line>(i);
        // Body height and shoulder width are what Algorithm 3 estimates; the others are reported as they were
        // seen, and inferred where they were not.
        const bool combined = line == Line::kBodyHeight || line == Line::kShoulderWidth || !lines[i].known;
        const Estimate value = combined ? state_->primary(lines, line) : lines[i];
        if (value.known) list.push_back({line_key(line), value.value_m, value.sigma_m, lines[i].known});
    }
    return list;
}

std::array<float, kPaperJointCount> PaperScan::radii() const {
    std::array<float, kPaperJointCount> radii{};
    for (size_t i = 0; i < radii.size(); ++i) radii[i] = state_->averaged_radius(i);
    return radii;
}

// Algorithm 3. The paper averages x_s and y_s over the frames; its means are linear, so that averaging the
// lines first gives the same where every frame shows every line and no outlier is left out.
PaperScan::Scale PaperScan::scale(const std::string& name) const {
    const GarmentKind& kind = garment_kind(name);
    state_->require_frames();
    const Lines lines = state_->averaged_lines();
    const auto require = [&](Line line) {
        const Estimate e = state_->primary(lines, line);
        if (!e.known)
            fail(VFIT_ERROR_DATA, "scan: ", line_key(line), ", the scale of ", name, ", was not seen");
        return e;
    };

    const Estimate height = require(kind.height);
    Scale scale;
    scale.height_m = height.value_m;
    scale.y = height.value_m / kind.nominal_height_m;
    scale.sigma_y = height.sigma_m / kind.nominal_height_m;
    scale.x = 0.0f;
    float variance = 0.0f;
    for (size_t i = 0; i < kind.width_count; ++i) {
        const Estimate width = require(kind.widths[i]);
        if (i == 0) scale.width_m = width.value_m;
        scale.x += width.value_m / kind.nominal_widths_m[i] / float(kind.width_count);
        variance += std::pow(width.sigma_m / kind.nominal_widths_m[i] / float(kind.width_count), 2.0f);
    }
    scale.sigma_x = std::sqrt(variance);
    return scale;
}

}  // namespace vfit
