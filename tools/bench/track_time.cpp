// Time of the whole tracker: frames are made first and then sent at 30 Hz as by a camera of the host's, so
// that nothing but the host's own work shares the core.
#include <iostream>
#include <thread>

#include "bench/bench.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kWarmUp = 30;
constexpr std::chrono::nanoseconds kFrame{33'333'333};

/// Depth pictures of a source, and what they are.
struct Reel {
    std::vector<std::vector<uint16_t>> depth;
    vfit_intrinsics intrinsics = vfit_intrinsics_init();
};

Reel take(const std::string& uri) {
    Reel reel;
    const Context context = open_context();
    Source source(context.get(), uri);
    while (const auto frame = source.next()) {
        const vfit_view view = view_of(frame->get(), VFIT_STREAM_DEPTH);
        auto& pixels = reel.depth.emplace_back(size_t(view.width) * view.height);
        for (uint32_t y = 0; y < view.height; ++y)
            std::copy_n(row_of<uint16_t>(view, y), view.width, pixels.begin() + long(size_t(y) * view.width));
        check(vfit_frame_intrinsics(frame->get(), &reel.intrinsics));
    }
    return reel;
}

struct Times {
    Samples update, latency;
    Samples bodies;
};

Times play(const Reel& reel) {
    Times times;
    const Context context = open_context();
    const Tracker tracker = open_own_tracker(context.get());
    Motion motion;
    check(vfit_motion_create(context.get(), nullptr, motion.out()));
    vfit_view pixels = vfit_view_init();
    pixels.format = VFIT_FORMAT_U16;
    pixels.width = reel.intrinsics.width, pixels.height = reel.intrinsics.height;
    pixels.item_stride = 2, pixels.row_stride = 2 * pixels.width;
    const vfit_stream stream = VFIT_STREAM_DEPTH;
    vfit_frame_desc desc = vfit_frame_desc_init();
    desc.count = 1, desc.streams = &stream, desc.views = &pixels, desc.intrinsics = &reel.intrinsics;
    auto next = std::chrono::steady_clock::now();
    for (size_t i = 0; i < reel.depth.size(); ++i) {
        std::this_thread::sleep_until(next += kFrame);
        check(vfit_context_time(context.get(), &desc.time_ns));
        pixels.data = reel.depth[i].data();
        Frame frame, tracked;
        check(vfit_frame_create(context.get(), &desc, frame.out()));
        const Timer timer;
        check(vfit_tracker_update(tracker.get(), frame.get(), tracked.out()));
        const double update_ms = timer.ms();
        const auto bodies = bodies_of(tracked.get());
        for (const vfit_body& body : bodies) joints_of(tracked.get(), body.body_id);
        int64_t now_ns = 0;
        check(vfit_context_time(context.get(), &now_ns));
        if (!bodies.empty())
            check(vfit_motion_step(motion.get(), tracked.get(), bodies.front().body_id, now_ns));
        check(vfit_context_time(context.get(), &now_ns));
        if (i < kWarmUp) continue;
        times.update.add(update_ms);
        times.latency.add(double(now_ns - desc.time_ns) * 1e-6);
        times.bodies.add(double(bodies.size()));
    }
    return times;
}

Json json(const char* name, const Times& t) {
    return {{"scene", name},
            {"update_ms", t.update.json()},
            {"latency_ms", t.latency.json()},
            {"bodies", t.bodies.quantile(0.5)}};
}

}  // namespace

Json judge_time(const JudgeOptions& options, Targets& targets) {
    if (!options.quiet) std::cout << "\nSYNTHETIC: time on one core at 640 x 480, frames at 30 Hz\n";
    const std::string common = "virtual:sensor=kinect_v1&clothing=0.02&seed=" + std::to_string(options.seed) +
                               "&body=" + std::to_string(9200 + options.seed) +
                               "&frames=" + std::to_string(options.long_run ? 630 : 180);
    const Times one = play(take(common + "&motion=demo&distance=2.7"));
    const Times three = play(take(common + "&motion=wave&people=3&distance=3"));
    targets.judge("one person: bodies tracked", one.bodies.quantile(0.5), Aim::exactly, 1);
    targets.judge("one person: whole tracker a frame, median", one.update.quantile(0.5), Aim::at_most, 8, 1,
                  " ms");
    targets.judge("one person: whole tracker a frame, p95", one.update.quantile(0.95), Aim::at_most, 12, 1,
                  " ms");
    targets.judge("one person: time stamp to pose, median", one.latency.quantile(0.5), Aim::at_most, 12, 1,
                  " ms");
    targets.judge("one person: time stamp to pose, p95", one.latency.quantile(0.95), Aim::at_most, 12, 1,
                  " ms");
    targets.judge("three people: bodies tracked", three.bodies.quantile(0.5), Aim::exactly, 3);
    targets.judge("three people: whole tracker a frame, median", three.update.quantile(0.5), Aim::at_most, 16,
                  1, " ms");
    return Json::array({json("one person", one), json("three people", three)});
}

}  // namespace vfit::tools
