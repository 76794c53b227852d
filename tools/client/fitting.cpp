#include "client/fitting.h"

#include <algorithm>
#include <chrono>

#include "client/assets.h"

namespace vfit::tools {

namespace {

constexpr double kLongestStep_s = 0.1;  // vfit_cloth_step shortens longer ones
constexpr int64_t kLongestPause_ns =
    500'000'000;  // a recording that rests for an hour is not played for an hour

double seconds(int64_t ns) { return double(ns) * 1e-9; }

}  // namespace

Fitting::Fitting(vfit_context context, const FittingOptions& options) : context_(context), options_(options) {
    // What cannot be opened is said before a person has stood still for it.
    if (!options.garments.empty()) open_outfit(context, options.garments);
    if (!options.chart.empty()) open_chart(context, options.chart);
    scan_ = scan_source(context, options.source, options.scan, &scan_frame_);
    const auto start = std::chrono::steady_clock::now();
    dress();
    dress_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    for (const Layer& layer : outfit_->layers()) advice_.push_back(advise(layer));
}

void Fitting::dress() {
    check(vfit_scan_sex(scan_.scan.get(), &sex_, &sex_probability_));
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = sex_;
    desc.detail = options_.detail;
    check(vfit_avatar_create_from_scan(context_, &desc, scan_.scan.get(), avatar_.out()));
    check(vfit_motion_create(context_, nullptr, motion_.out()));
    check(vfit_motion_bind(motion_.get(), avatar_.get()));
    const vfit_view depth = view_of(scan_frame_.get(), VFIT_STREAM_DEPTH);
    check(vfit_motion_step(motion_.get(), scan_frame_.get(), scan_.body_id, depth.time_ns));
    pose_avatar();
    vfit_cloth_desc cloth = vfit_cloth_desc_init();
    cloth.flags =
        VFIT_CLOTH_SKIN | VFIT_CLOTH_PRESSURE | (options_.hands ? 0u : uint32_t(VFIT_CLOTH_NO_HANDS));
    cloth.substeps = options_.substeps;
    if (!options_.size.empty()) cloth.size_label = options_.size.c_str();
    outfit_.emplace(context_, avatar_.get(),
                    options_.garments.empty() ? default_outfit(sex_) : options_.garments, cloth);
    Frame body, garment;
    check(vfit_avatar_acquire(avatar_.get(), body.out()));
    for (const vfit_cloth worn : outfit_->cloths()) check(vfit_cloth_acquire(worn, garment.out()));
}

SizeAdvice Fitting::advise(const Layer& layer) const {
    SizeAdvice out;
    out.kind = options_.chart_kind.empty() ? layer.info.garment_kind : options_.chart_kind;
    // The chart that is asked for, or the garment's own; without girths, the one by breadths.
    std::vector<std::string> charts{options_.chart};
    if (options_.chart.empty()) {
        const char* by_sex = layer.info.body_sex == VFIT_SEX_MALE ? "en13402_men" : "en13402_women";
        charts = {layer.info.size_chart[0] != 0 ? layer.info.size_chart : by_sex, "paper"};
    }
    for (const std::string& name : charts) try {
            const SizeChart chart = open_chart(context_, name);
            out.sizes = sizes_json(chart.get(), out.kind, measurements_of(scan_.scan.get()));
            out.chart = name;
            return out;
        } catch (const Failure& failure) {
            // A garment may be of a kind that no chart here knows: it is worn all the same.
            if (!options_.chart.empty()) throw;
            if (out.reason.empty()) out.chart = name, out.reason = failure.what();
        }
    return out;
}

void Fitting::pose_avatar() {
    vfit_pose pose = vfit_pose_init();
    const auto bones = bones_of(motion_.get(), pose);
    set_pose(avatar_.get(), pose, bones);
}

void Fitting::play(const std::function<bool(vfit_frame, double)>& on_frame) {
    Source source(context_, options_.source);
    const Tracker tracker = open_tracker(context_, options_.scan.track);
    // Arms do not go on from where the scan left them: how long ago that was depends on the machine.
    vfit_pose pose = vfit_pose_init();
    const auto bones = bones_of(motion_.get(), pose);
    pose.time_ns = 0;
    set_pose(avatar_.get(), pose, bones);
    check(vfit_motion_reset(motion_.get()));
    int64_t first_ns = 0, last_ns = 0;
    double cloth_time = 0.0;
    uint32_t body = 0;
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (body == 0) body = active_body(tracked.get());
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion_.get(), tracked.get(), body, now_ns)) == VFIT_OK) {
            pose_avatar();
            if (frames_played_++ == 0) {
                first_ns = last_ns = now_ns;
                outfit_->reset();
            }
            first_ns += std::max<int64_t>(0, now_ns - last_ns - kLongestPause_ns);
            last_ns = now_ns;
            const double time = seconds(now_ns - first_ns);
            for (; cloth_time < time; cloth_time += std::min(kLongestStep_s, time - cloth_time))
                outfit_->step(float(std::min(kLongestStep_s, time - cloth_time)));
            if (!on_frame(tracked.get(), time)) break;
        }
        if (options_.max_frames && frames_played_ == options_.max_frames) break;
    }
    if (frames_played_ == 0) throw Failure("the source ended without a person in view");
}

}  // namespace vfit::tools
