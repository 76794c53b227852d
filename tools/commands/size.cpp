// vfit size: labels with probabilities from a file of measures, and how a size sits.
#include <algorithm>
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

// A body is outside a range where it is likelier than not to be.
constexpr double kOutside = 0.5;

struct Options {
    std::string measures, chart, garment, label;
    bool json = false;
};

/// A label of a table serves several ranges: none of them can be told by measure.
bool has_one_range(vfit_size_chart chart, const std::string& garment, const std::string& label) {
    const auto rows = list<vfit_size_row>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_size_chart_rows(chart, items, stride, n);
    });
    return std::count_if(rows.begin(), rows.end(), [&](const vfit_size_row& row) {
               return garment == row.garment_kind && label == row.label;
           }) == 1;
}

/// {"chest_girth_m": "above"}: measures of the body that lie outside the ranges of a label.
Json outside_json(const Json& zones) {
    Json out = Json::object();
    for (const auto& [key, zone] : zones.items())
        if (zone["tight"] > kOutside)
            out[key] = "above";
        else if (zone["loose"] > kOutside)
            out[key] = "below";
    return out;
}

Json size(const Options& options) {
    const StoredMeasures stored = read_measures(options.measures);
    const Context context = open_context();
    const SizeChart chart = open_chart(context.get(), options.chart);
    Json out;
    out["chart"] = options.chart;
    out["garment"] = options.garment;
    const Json sizes = sizes_json(chart.get(), options.garment, stored.measurements);
    out["sizes"] = sizes;
    if (const Json between = between_json(sizes); !between.empty()) out["between"] = between;
    const std::string label = sizes[0]["label"];
    if (has_one_range(chart.get(), options.garment, label)) {
        const Json outside =
            outside_json(zones_json(chart.get(), options.garment, label, stored.measurements));
        if (!outside.empty()) out["outside"] = outside;
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

/// Columns that a text takes: UTF-8 characters, not bytes.
size_t columns(const std::string& text) {
    return size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, size_t width) {
    return text + std::string(width - columns(text), ' ');
}

void print_labels(const Json& sizes) {
    // A chart of two axes has a hundred labels.
    constexpr double kNotWorthALine = 0.0005;
    size_t width = 0;
    for (const Json& s : sizes)
        if (s["probability"] >= kNotWorthALine) width = std::max(width, columns(s["label"]));
    for (const Json& s : sizes)
        if (s["probability"] >= kNotWorthALine)
            std::cout << padded(s["label"], width) << std::right << std::fixed << std::setprecision(1)
                      << std::setw(7) << 100.0 * s["probability"].get<double>() << " %\n";
}

void print_zones(const Json& zones) {
    size_t width = 0;
    for (const auto& [key, zone] : zones.items()) width = std::max(width, columns(key));
    for (const auto& [key, zone] : zones.items()) {
        const double ease = zone["ease"];
        std::cout << "  " << padded(key, width) << "  " << amount(key, ease)
                  << (ease < 0.0 ? " short of" : " more than") << " the middle of the size (+- "
                  << amount(key, zone["sigma"]) << "):";
        for (const char* how : {"tight", "regular", "loose"})
            std::cout << " " << how << " " << std::fixed << std::setprecision(0)
                      << 100.0 * zone[how].get<double>() << " %";
        std::cout << "\n";
    }
}

void print(const Json& result) {
    print_labels(result["sizes"]);
    if (result.contains("between"))
        std::cout << "between " << result["between"][0].get<std::string>() << " and "
                  << result["between"][1].get<std::string>() << "\n";
    if (result.contains("outside"))
        for (const auto& [key, side] : result["outside"].items())
            std::cout << key << " is " << side.get<std::string>() << " the range of "
                      << result["sizes"][0]["label"].get<std::string>() << "\n";
    if (!result.contains("zones")) return;
    std::cout << "size " << result["label"].get<std::string>() << ":\n";
    print_zones(result["zones"]);
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
