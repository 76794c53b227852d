// vfit calibrate: a shop's own tape measures beside scans of the same people.
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "client/files.h"
#include "client/output.h"
#include "client/people.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string calibration, scan, tape;
    bool json = false;
};

/// With one more person.
std::string added(const std::string& text, const std::vector<vfit_measurement>& scan,
                  const std::vector<vfit_measurement>& tape) {
    std::string out;
    uint32_t capacity = 0;
    const auto add = [&](char* to) {
        check(vfit_calibration_add(text.empty() ? nullptr : text.data(), text.size(), scan.data(),
                                   sizeof scan[0], uint32_t(scan.size()), tape.data(), sizeof tape[0],
                                   uint32_t(tape.size()), to, &capacity));
    };
    add(nullptr);
    out.resize(capacity);
    add(out.data());
    out.resize(capacity - 1);
    return out;
}

Json calibrate(const Options& o) {
    std::string text;
    std::error_code error;
    if (std::filesystem::exists(o.calibration, error)) text = read_text(o.calibration);
    if (!o.scan.empty()) {
        text = added(text, read_measures(o.scan).measurements, read_measures(o.tape).measurements);
        // Whole or not at all: a shop's work of weeks is in it.
        const std::string fresh = o.calibration + ".new";
        write_text(fresh, text);
        std::filesystem::rename(fresh, o.calibration, error);
        if (error) throw Failure(o.calibration + ": cannot be written: " + error.message());
    } else if (text.empty()) {
        throw Failure(o.calibration + ": there is no such file");
    }
    Json out = Json::object();
    for (const vfit_calibrated_measure& m :
         list<vfit_calibrated_measure>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_calibration_measures(text.data(), text.size(), items, stride, n);
         }))
        out[m.key] = {
            {"people", m.people}, {"enough", m.enough != 0}, {"offset", m.offset}, {"widening", m.widening}};
    return out;
}

void print(const Json& measures) {
    for (const auto& [key, m] : measures.items()) {
        std::cout << std::left << std::setw(24) << key << std::right << std::setw(5)
                  << m["people"].get<uint32_t>() << " people  ";
        if (m["enough"].get<bool>())
            std::cout << std::showpos << std::fixed << std::setprecision(3) << m["offset"].get<double>()
                      << std::noshowpos << ", sigma times " << std::setprecision(2)
                      << m["widening"].get<double>() << "\n";
        else
            std::cout << "too few: left as it is\n";
    }
}

}  // namespace

void add_calibrate(Command& app) {
    Command command = app.add_subcommand("calibrate", "Learn what your own tape differs by from scans");
    auto o = std::make_shared<Options>();
    command.add_option("calibration", o->calibration, "File that grows by a person at a time").required();
    command.add_option("--scan", o->scan, "What a scan told of one more person: a profile or a report");
    command.add_option("--tape", o->tape, "What the tape told of that person: {\"waist_girth_m\": 0.81}");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        if (o->scan.empty() != o->tape.empty()) throw Failure("--scan and --tape go together");
        const Json measures = calibrate(*o);
        if (o->json)
            print_document(measures);
        else
            print(measures);
    });
}

}  // namespace vfit::tools
