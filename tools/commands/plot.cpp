// vfit plot: the paper's curves of one recording. Fig. 9: correction of the depth map; Fig. 11: correction of
// the planted foot.
#include <iostream>

#include "client/output.h"
#include "client/people.h"
#include "client/progress.h"
#include "commands/commands.h"
#include "picture/foot_curve.h"

namespace vfit::tools {

namespace {

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

void plot(const Options& options) {
    const Context context = open_context();
    const Curve curve = options.what == "depth"
                            ? depth_correction(context.get(), options)
                            : foot_correction(context.get(), options.source, options.frames);
    if (curve.points.empty()) throw Failure("nothing to plot: no person was in view");
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
    command.add_option("--what", o->what, "depth (Fig. 9) or feet (Fig. 11)")
        .required()
        .one_of({"depth", "feet"});
    command.add_option("--out", o->out, "PNG file to write").required();
    command
        .add_option("--frames", o->frames,
                    "Frames to scan (default 30), or to follow the feet for (default 300)")
        .within(1, 3000);
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { plot(*o); });
}

}  // namespace vfit::tools
