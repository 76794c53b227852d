// vfit cook: makes a garment file from its design, offline.
#include <fstream>
#include <iostream>

#include "body/body_model.h"
#include "commands/commands.h"
#include "cook/garment_writer.h"
#include "cook/sundress.h"
#include "core/error.h"
#include "core/files.h"
#include "core/platform.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string design, out, body;
    bool json = false;
};

void cook(const Options& options) {
    // Beside the program when it is installed or built: bin/ and lib/ are neighbours.
    const std::string body = options.body.empty() ? library_folder() + "/../lib/vfit_data/body.bin" : options.body;
    const auto model = BodyModel::load(body);
    const Garment garment = cook_sundress(*model, parse_sundress(read_file(options.design)));
    std::ofstream file(options.out, std::ios::binary);
    file << write_garment(garment);
    if (!file.flush()) fail(VFIT_ERROR_IO, options.out, ": cannot be written");
    if (options.json)
        std::cout << "{\"garment\": \"" << garment.name << "\", \"vertices\": " << garment.vertex_count()
                  << ", \"simulated\": " << garment.simulated_count() << "}\n";
    else
        std::cout << garment.name << ": " << garment.vertex_count() << " vertices, " << garment.simulated_count()
                  << " of them simulated, in " << options.out << "\n";
}

}  // namespace

void add_cook(CLI::App& app) {
    CLI::App* command = app.add_subcommand("cook", "Make a garment file from a design");
    auto o = std::make_shared<Options>();
    command->add_option("design", o->design, "Design file (docs/garments.md)")->required();
    command->add_option("--out", o->out, "Garment file to write")->required();
    command->add_option("--body", o->body, "Baked body (default: the one beside the program)");
    command->add_flag("--json", o->json, "Print JSON");
    command->callback([o] { cook(*o); });
}

}  // namespace vfit::tools
