// vfit plot: the paper's curves of one recording. Fig. 9: correction of the depth map; Fig. 11: correction of
// the planted foot.
#include <iostream>

#include "client/output.h"
#include "client/people.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "picture/line_plot.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kFeetFrames = 300;

struct Options {
    std::string source, what, out;
    uint32_t frames = 0;
    bool json = false;
};

Curve depth_correction(vfit_context context, const Options& options) {
    Source source(context, options.source);
    const ScanRun run = run_scan(context, source, {options.frames});
    Curve curve{"Depth map correction (Fig. 9)", "frame", "mean absolute change, mm", {}};
    for (size_t i = 0; i < run.corrections_m.size(); ++i)
        curve.points.emplace_back(float(i), 1000.0f * run.corrections_m[i]);
    return curve;
}

Curve foot_correction(vfit_context context, const Options& options) {
    Source source(context, options.source);
    Tracker tracker;
    check(vfit_tracker_create(context, nullptr, tracker.out()));
    Motion motion;
    check(vfit_motion_create(context, nullptr, motion.out()));
    Curve curve{"Displacement of the planted foot (Fig. 11)", "s", "corrected displacement, mm", {}};
    int64_t first_ns = -1;
    uint32_t body = 0;
    const uint32_t wanted = options.frames ? options.frames : kFeetFrames;
    Progress progress("frames");
    while (source.taken() < wanted) {
        progress.at(source.taken(), wanted);
        const auto frame = source.next();
        if (!frame) break;
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (body == 0) body = active_body(tracked.get());
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion.get(), tracked.get(), body, now_ns)) != VFIT_OK) continue;
        if (first_ns < 0) first_ns = now_ns;
        vfit_pose pose = vfit_pose_init();
        uint32_t count = 0;
        check(vfit_motion_pose(motion.get(), &pose, nullptr, 0, &count));
        curve.points.emplace_back(float(double(now_ns - first_ns) * 1e-9), 1000.0f * pose.foot_correction_m);
    }
    return curve;
}

void plot(const Options& options) {
    const Context context = open_context();
    const Curve curve =
        options.what == "depth" ? depth_correction(context.get(), options) : foot_correction(context.get(), options);
    if (curve.points.empty()) throw Failure("nothing to plot: nobody was in view");
    draw_curve(curve, 900, 500).write_png(options.out);
    double sum = 0.0;
    for (const auto& p : curve.points) sum += p.second;
    const double mean = sum / double(curve.points.size());
    if (options.json)
        print_document({{"plot", options.out}, {"points", curve.points.size()}, {"mean_m", 1e-3 * mean}});
    else
        std::cout << curve.title << ": mean " << mean << " mm over " << curve.points.size() << " frames, in "
                  << options.out << "\n";
}

}  // namespace

void add_plot(Command& app) {
    Command command = app.add_subcommand("plot", "Draw the paper's curves of a recording");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->source, "Recording folder or sensor URI").required();
    command.add_option("--what", o->what, "depth (Fig. 9) or feet (Fig. 11)").required().one_of({"depth", "feet"});
    command.add_option("--out", o->out, "PNG file to write").required();
    command.add_option("--frames", o->frames, "Frames to scan (default 30), or to follow the feet for (default 300)").within(1, 3000);
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { plot(*o); });
}

}  // namespace vfit::tools
