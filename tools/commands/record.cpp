// vfit record: writes what a sensor sees as a recording folder.
#include <iostream>

#include "client/output.h"
#include "client/progress.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source, out;
    uint32_t frames = 0;
    bool json = false;
};

void record(const Options& options) {
    const Context context = open_context();
    Source source(context.get(), options.source);
    vfit_recorder_desc desc = vfit_recorder_desc_init();
    desc.sensor_name = options.source.c_str();
    Recorder recorder;
    check(vfit_recorder_create(context.get(), options.out.c_str(), &desc, recorder.out()));
    Progress progress("recording");
    while (options.frames == 0 || source.taken() < options.frames) {
        const auto frame = source.next();
        if (!frame) break;
        check(vfit_recorder_write(recorder.get(), frame->get()));
        progress.at(source.taken(), options.frames);
    }
    if (options.json)
        print_document({{"recording", options.out}, {"frames", source.taken()}});
    else
        std::cout << source.taken() << " frames in " << options.out << "\n";
}

}  // namespace

void add_record(Command& app) {
    Command command = app.add_subcommand("record", "Record a sensor, or copy a recording");
    auto o = std::make_shared<Options>();
    command.add_option("source", o->source, "Sensor URI or recording folder").required();
    command.add_option("out", o->out, "Folder to write; must be new or empty").required();
    command.add_option("--frames", o->frames, "Stop after that many frames (default: at the end)").positive();
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { record(*o); });
}

}  // namespace vfit::tools
