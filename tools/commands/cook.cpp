// vfit cook: makes a garment file from its design, offline.
#include <filesystem>
#include <iostream>

#include "body/body_model.h"
#include "client/files.h"
#include "client/output.h"
#include "commands/commands.h"
#include "cook/garment_writer.h"
#include "cook/sundress.h"
#include "core/files.h"
#include "core/platform.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string design, out, body;
    bool json = false;
};

/// The body beside the program: of a build, or of an installation with its own name for lib.
std::string default_body() {
    const std::string prefix = library_folder() + "/../", file = "/vfit_data/body.bin";
    const std::string built = prefix + "lib" + file;
    return std::filesystem::exists(built) ? built : prefix + VFIT_LIBDIR + file;
}

void cook(const Options& options) {
    const auto model = BodyModel::load(options.body.empty() ? default_body() : options.body);
    const vfit::Garment garment = cook_sundress(*model, parse_sundress(read_file(options.design)));
    write_text(options.out, write_garment(garment));
    if (options.json)
        print_document({{"garment", garment.name},
                        {"vertices", garment.vertex_count()},
                        {"simulated", garment.simulated_count()}});
    else
        std::cout << garment.name << ": " << garment.vertex_count() << " vertices, " << garment.simulated_count()
                  << " of them simulated, in " << options.out << "\n";
}

}  // namespace

void add_cook(Command& app) {
    Command command = app.add_subcommand("cook", "Make a garment file from a design");
    auto o = std::make_shared<Options>();
    command.add_option("design", o->design, "Design file (docs/garments.md)").required();
    command.add_option("--out", o->out, "Garment file to write").required();
    command.add_option("--body", o->body, "Baked body (default: the one beside the program)");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { cook(*o); });
}

}  // namespace vfit::tools
