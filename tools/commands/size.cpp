// vfit size: labels with probabilities from a file of measures.
#include <iomanip>
#include <iostream>

#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string measures, chart, garment;
    bool json = false;
};

Json size(const Options& options) {
    const Json document = Json::parse(read_text(options.measures), nullptr, false);
    if (document.is_discarded()) throw Failure(options.measures + ": not JSON");
    const Context context = open_context();
    const SizeChart chart = open_chart(context.get(), options.chart);
    Json out;
    out["chart"] = options.chart;
    out["garment"] = options.garment;
    out["sizes"] = sizes_json(chart.get(), options.garment, measurements_from(document));
    return out;
}

}  // namespace

void add_size(Command& app) {
    Command command = app.add_subcommand("size", "Name the clothing size from measures");
    auto o = std::make_shared<Options>();
    command.add_option("measures", o->measures, "JSON file as vfit measure prints it").required();
    command.add_option("--chart", o->chart, "Chart name, or file").required();
    command.add_option("--garment", o->garment, "Garment kind of the chart").required();
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        const Json result = size(*o);
        if (o->json) {
            print_document(result);
            return;
        }
        for (const Json& s : result["sizes"])
            std::cout << std::left << std::setw(6) << s["label"].get<std::string>() << std::fixed
                      << std::setprecision(1) << 100.0 * s["probability"].get<double>() << " %\n";
    });
}

}  // namespace vfit::tools
