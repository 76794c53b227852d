// vfit size: labels with probabilities from a file of measures, and how a size sits.
#include <cmath>
#include <iomanip>
#include <iostream>

#include "client/assets.h"
#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

// A label that is likelier than this is named alone; else the two best are, where one of them is right as
// often.
constexpr double kSure = 0.7;

struct Options {
    std::string measures, chart, garment, label;
    bool json = false;
};

Json size(const Options& options) {
    const StoredMeasures stored = measurements_from(read_text(options.measures));
    const Context context = open_context();
    const SizeChart chart = open_chart(context.get(), options.chart);
    Json out;
    out["chart"] = options.chart;
    out["garment"] = options.garment;
    const Json sizes = sizes_json(chart.get(), options.garment, stored.measurements);
    out["sizes"] = sizes;
    const double best = sizes[0]["probability"];
    if (sizes.size() > 1 && best < kSure) {
        const double second = sizes[1]["probability"];
        if (best + second >= kSure) out["between"] = {sizes[0]["label"], sizes[1]["label"]};
    }
    if (!options.label.empty()) {
        out["label"] = options.label;
        out["zones"] = zones_json(chart.get(), options.garment, options.label, stored.measurements);
    }
    return out;
}

/// Of a length in centimetres, of a mass in kilograms.
std::string amount(const std::string& key, double value) {
    const bool mass = key.size() > 3 && key.substr(key.size() - 3) == "_kg";
    std::ostringstream out;
    out << std::fixed << std::setprecision(1) << std::abs(mass ? value : 100.0 * value)
        << (mass ? " kg" : " cm");
    return out.str();
}

void print(const Json& result) {
    // A chart of two axes has a hundred labels.
    constexpr double kNotWorthALine = 0.0005;
    for (const Json& s : result["sizes"])
        if (s["probability"] >= kNotWorthALine)
            std::cout << std::left << std::setw(8) << s["label"].get<std::string>() << std::right
                      << std::fixed << std::setprecision(1) << std::setw(5)
                      << 100.0 * s["probability"].get<double>() << " %\n";
    if (result.contains("between"))
        std::cout << "between " << result["between"][0].get<std::string>() << " and "
                  << result["between"][1].get<std::string>() << "\n";
    if (!result.contains("zones")) return;
    std::cout << "size " << result["label"].get<std::string>() << ":\n";
    for (const auto& [key, zone] : result["zones"].items()) {
        const double ease = zone["ease"];
        std::cout << "  " << std::left << std::setw(20) << key << amount(key, ease)
                  << (ease < 0.0 ? " short of" : " more than") << " the middle of the size (+- "
                  << amount(key, zone["sigma"]) << "):";
        for (const char* how : {"tight", "regular", "loose"})
            std::cout << " " << how << " " << std::fixed << std::setprecision(0)
                      << 100.0 * zone[how].get<double>() << " %";
        std::cout << "\n";
    }
}

}  // namespace

void add_size(Command& app) {
    Command command = app.add_subcommand("size", "Name the clothing size from measures");
    auto o = std::make_shared<Options>();
    command.add_option("measures", o->measures, "JSON file as vfit measure prints it, or a profile")
        .required();
    command.add_option("--chart", o->chart, "Chart name, or file").required();
    command.add_option("--garment", o->garment, "Garment kind of the chart").required();
    command.add_option("--size", o->label, "Also tell how this size sits");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        const Json result = size(*o);
        if (o->json)
            print_document(result);
        else
            print(result);
    });
}

}  // namespace vfit::tools
