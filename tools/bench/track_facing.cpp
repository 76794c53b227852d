// Whether the tracker knows where a person faces: after a cut from the front to a side view, as with a camera
// that was moved or a recording that was cut, and through a continuous turn.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "bench/track_parts.h"
#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 20, kBefore = 30, kAfter = 30;  // frames before and after the cut
constexpr uint32_t kTurnFrames = 216;                        // of motion=spin
constexpr int64_t kFrame_ns = 33'333'333;
constexpr const char* kMotions[] = {"sway", "wave", "forward", "jog", "reach"};

/// The same person in the same room, whatever way they face.
std::string person(uint32_t number, const JudgeOptions& options, const char* motion, double facing_deg,
                   uint32_t frames) {
    std::ostringstream uri;
    uri << "virtual:sensor=" << (number % 2 ? "tof" : "kinect_v1") << "&motion=" << motion
        << "&facing=" << facing_deg << "&body=" << 20000 + 100 * options.seed + number << "&seed=" << number
        << "&clothing=0.02&distance=2.9&floor=unknown&frames=" << frames;
    return uri.str();
}

/// Frames with a person, of which the tracker has the sides exchanged, and how often it changes to that.
struct Facings {
    size_t frames = 0, missed = 0, wrong = 0, flips = 0;
    Errors errors;

    void add(const Joints* found, const Joints& truth) {
        errors.add_all(found, truth);
        ++frames, missed += !found;
        const bool is_wrong = found && sides_are_exchanged(*found, truth);
        wrong += is_wrong, flips += is_wrong && !was_wrong_;
        was_wrong_ = is_wrong;
    }
    void begin_person() { was_wrong_ = false; }

private:
    bool was_wrong_ = false;
};

/// Its frames through the tracker, one frame apart from the last.
void play(vfit_context context, vfit_tracker tracker, const std::string& uri, int64_t& time_ns,
          Facings* facings) {
    Source source(context, uri);
    while (const auto frame = source.next()) {
        const vfit_view depth = view_of(frame->get(), VFIT_STREAM_DEPTH);
        vfit_intrinsics intrinsics = vfit_intrinsics_init();
        check(vfit_frame_intrinsics(frame->get(), &intrinsics));
        const vfit_camera camera = camera_of(frame->get());
        const vfit_stream stream = VFIT_STREAM_DEPTH;
        vfit_frame_desc desc = vfit_frame_desc_init();
        desc.count = 1, desc.streams = &stream, desc.views = &depth;
        desc.intrinsics = &intrinsics, desc.camera = &camera, desc.time_ns = time_ns += kFrame_ns;
        Frame restamped, tracked;
        check(vfit_frame_create(context, &desc, restamped.out()));
        check(vfit_tracker_update(tracker, restamped.get(), tracked.out()));
        const Joints truth = truth_of(frame->get());
        if (!facings || !truth.has(VFIT_JOINT_TORSO)) continue;
        const uint32_t id = body_near(tracked.get(), truth);
        const Joints found = id ? joints_in_camera(tracked.get(), id, camera) : Joints{};
        facings->add(id ? &found : nullptr, truth);
    }
}

Json say(const char* what, const Facings& f, bool quiet) {
    const double flips = 1000.0 * double(f.flips) / double(f.frames);
    if (!quiet)
        std::cout << "  " << std::left << std::setw(38) << what << std::right << std::setw(7) << f.frames
                  << std::setw(9) << f.missed << std::setw(8) << f.wrong << std::fixed << std::setprecision(1)
                  << std::setw(8) << flips << std::setprecision(3) << std::setw(8) << f.errors.within(0.1)
                  << "\n";
    return {{"frames", f.frames},
            {"frames_without_body", f.missed},
            {"frames_wrong", f.wrong},
            {"flips_per_1000", flips},
            {"within_10cm", f.errors.within(0.1)}};
}

}  // namespace

Json judge_facing(const JudgeOptions& options, Targets& targets) {
    Facings cuts, turns;
    if (!options.quiet)
        std::cout << "\nSYNTHETIC: " << kPeople << " virtual people of vfit's own, seed " << options.seed
                  << "\n  what                                    frames  no body   wrong  /1000      mAP\n";
    for (uint32_t i = 0; i < kPeople; ++i) {
        const Context context = open_context();
        const char* motion = kMotions[i % std::size(kMotions)];
        const double off_deg = double(i) - 10.0;  // from the view exactly from a side
        int64_t time_ns = 1;
        const Tracker tracker = open_own_tracker(context.get(), options.fit);
        play(context.get(), tracker.get(), person(i, options, motion, 0.0, kBefore), time_ns, nullptr);
        cuts.begin_person();
        play(context.get(), tracker.get(),
             person(i, options, motion, (i / 2 % 2 ? 90.0 : -90.0) + off_deg, kAfter), time_ns, &cuts);
        const Tracker other = open_own_tracker(context.get(), options.fit);
        turns.begin_person();
        play(context.get(), other.get(), person(i, options, "spin", 0.0, kTurnFrames), time_ns, &turns);
    }
    Json report = {{"cuts", say("side view after a cut", cuts, options.quiet)},
                   {"turns", say("a continuous turn", turns, options.quiet)}};
    if (!options.quiet) std::cout << "\n";
    targets.judge("side view after a cut: facing wrong, of 100 frames",
                  100.0 * double(cuts.wrong) / double(cuts.frames), Aim::at_most, 1.0, 1);
    targets.judge("side view after a cut: joints within 10 cm", cuts.errors.within(0.1), Aim::at_least, 0.93,
                  3);
    targets.judge("a continuous turn: flips of left and right, of 1000 frames",
                  1000.0 * double(turns.flips) / double(turns.frames), Aim::at_most, 1.0, 1);
    return report;
}

}  // namespace vfit::tools
