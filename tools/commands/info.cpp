// vfit info: version, build, SIMD level, plug-ins and sensors.
#include <iostream>

#include "client/output.h"
#include "commands/commands.h"

namespace vfit::tools {

namespace {

Json describe() {
    const Context context = open_context();
    vfit_library_info library = vfit_library_info_init();
    check(vfit_library_describe(&library));
    const uint32_t v = library.version;
    Json out;
    out["version"] =
        std::to_string(v >> 22) + "." + std::to_string(v >> 12 & 0x3FF) + "." + std::to_string(v & 0xFFF);
    out["build"] = library.build;
    out["simd"] = library.simd;
    vfit_context_stats stats = vfit_context_stats_init();
    check(vfit_context_describe(context.get(), &stats));
    out["workers"] = stats.worker_count;
    out["plugins"] = Json::array();
    for (const auto& p : list<vfit_plugin_info>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_plugin_list(context.get(), items, stride, n);
         }))
        out["plugins"].push_back({{"name", p.name}, {"schemes", p.schemes}, {"path", p.path}});
    out["sensors"] = Json::array();
    for (const auto& s : list<vfit_sensor_info>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_sensor_list(context.get(), items, stride, n);
         }))
        out["sensors"].push_back({{"uri", s.uri}, {"name", s.name}, {"plugin", s.plugin}});
    return out;
}

void print(const Json& info) {
    std::cout << "vfit " << info["version"].get<std::string>() << " (" << info["build"].get<std::string>()
              << ")\n"
              << "SIMD     " << info["simd"].get<std::string>() << ", " << info["workers"]
              << " worker threads\n";
    for (const Json& p : info["plugins"])
        std::cout << "plug-in  " << p["name"].get<std::string>() << ": opens "
                  << p["schemes"].get<std::string>() << ":...\n";
    for (const Json& s : info["sensors"])
        std::cout << "sensor   " << s["uri"].get<std::string>() << "  " << s["name"].get<std::string>()
                  << "\n";
}

}  // namespace

void add_info(Command& app) {
    Command command = app.add_subcommand("info", "Version, build, SIMD level, plug-ins and sensors");
    auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "Print JSON");
    command.callback([json] {
        const Json info = describe();
        if (*json)
            print_document(info);
        else
            print(info);
    });
}

}  // namespace vfit::tools
