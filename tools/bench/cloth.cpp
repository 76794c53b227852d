// vfit-bench cloth: the common cloth scene, which the peers are judged on too. Unlike the other parts it runs
// the solver without the C ABI: the scene brings constraints of its own.
#include <fstream>
#include <iostream>

#include "bench/bench.h"
#include "bench/cloth_scene.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string folder, scene, positions;
    uint32_t substeps = 8, threads = 1;
    float self_mm = 0.0f;
    bool json = false;
};

void run(const Options& options) {
    pin_to_cores(options.threads);
    const bench::ClothScene scene = bench::load_cloth_scene(options.folder, options.scene);
    std::ofstream file;
    if (!options.positions.empty()) file.open(options.positions, std::ios::binary);
    const auto jobs = Jobs::own(options.threads - 1);
    const bench::ClothRun result = bench::run_cloth_scene(
        scene, options.substeps, 1e-3f * options.self_mm, *jobs, [&](std::span<const Vec3> positions) {
            if (file.is_open())
                file.write(reinterpret_cast<const char*>(positions.data()),
                           std::streamsize(positions.size_bytes()));
        });
    if (!options.positions.empty() && !file.flush()) throw Failure(options.positions + ": cannot be written");
    Samples samples;
    for (const double ms : result.frame_ms) samples.add(ms);
    if (options.json)
        print_line({{"ms_per_frame", {{"median", samples.quantile(0.5)}, {"p95", samples.quantile(0.95)}}},
                    {"vertices", result.last.vertex_count},
                    {"constraints", result.last.constraint_count}});
    else
        std::cout << options.scene << ": " << samples.quantile(0.5) << " ms a frame (p95 "
                  << samples.quantile(0.95) << "), " << result.last.vertex_count << " vertices, "
                  << result.last.constraint_count << " constraints, " << options.substeps << " sub-steps, "
                  << options.threads << " thread(s)\n";
}

}  // namespace

void add_cloth(Command& app) {
    Command command = app.add_subcommand("cloth", "The common cloth scene");
    auto o = std::make_shared<Options>();
    command.add_option("folder", o->folder, "Folder with mesh.bin and motion_<scene>.bin").required();
    command.add_option("scene", o->scene, "walk, kick, arm, kick8 or kick16").required();
    command.add_option("--substeps", o->substeps, "Sub-steps of 1/60 s").within(1, 256);
    command.add_option("--threads", o->threads, "Threads, pinned to as many cores").within(1, 64);
    command.add_option("--self", o->self_mm, "Millimetres kept between the cloth's own layers (0: they pass)")
        .within(0, 50);
    command.add_option("--positions", o->positions, "Write the positions after each frame there");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
